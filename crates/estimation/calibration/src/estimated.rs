//! Values with their standard errors.

/// A value with its standard error, both in the unit of the value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimated {
    /// Value.
    pub value: f64,
    /// Standard error.
    pub standard_error: f64,
}
