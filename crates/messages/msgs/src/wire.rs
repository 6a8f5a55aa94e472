//! Interface of all serialization formats: sinks and sources of values.

use crate::{DecodeError, Number, NumberKind, Numbers, NumbersMut};

/// Number of elements of a list by its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Fixed size.
    Fixed(usize),
    /// Maximum size.
    AtMost(usize),
    /// Unlimited.
    Any,
}

/// Receives the values of a message in order.
pub trait Sink {
    /// Starts a structure, with the full name of its type.
    fn begin(&mut self, type_name: &str);
    /// Ends the structure; `is_empty` if the type has no fields.
    fn end(&mut self, is_empty: bool);
    /// Starts a field.
    fn field(&mut self, name: &str);
    /// Writes a number.
    fn number(&mut self, number: Number);
    /// Writes a text of at most `limit` bytes.
    fn text(&mut self, text: &str, limit: Option<u32>);
    /// Writes a UTF-16 text of at most `limit` units.
    fn wide_text(&mut self, text: &str, limit: Option<u32>);
    /// Starts a list.
    fn list(&mut self, length: usize, count: Count);
    /// Ends the list.
    fn end_list(&mut self);
    /// Writes all elements of a list.
    fn numbers(&mut self, numbers: Numbers<'_>);
}

/// Provides the values of a message in order.
///
/// # Errors
/// All functions fail if the actual value is not of the requested type.
pub trait Source {
    /// Starts a structure, with the full name of its type and the names of its fields.
    fn begin(
        &mut self,
        type_name: &str,
        fields: &mut dyn Iterator<Item = &str>,
    ) -> Result<(), DecodeError>;
    /// Ends the structure; `is_empty` if the type has no fields.
    fn end(&mut self, is_empty: bool) -> Result<(), DecodeError>;
    /// Enters a field; returns false if it is missing and keeps its value.
    fn enter(&mut self, name: &str) -> Result<bool, DecodeError>;
    /// Enters an element of a list.
    fn enter_element(&mut self, index: usize) -> Result<(), DecodeError>;
    /// Leaves a field or an element.
    fn leave(&mut self);
    /// Reads a number of exactly this type.
    fn number(&mut self, kind: NumberKind) -> Result<Number, DecodeError>;
    /// Reads a text of at most `limit` bytes.
    fn text(&mut self, limit: Option<u32>) -> Result<String, DecodeError>;
    /// Reads a UTF-16 text of at most `limit` units.
    fn wide_text(&mut self, limit: Option<u32>) -> Result<String, DecodeError>;
    /// Reads the number of elements of a list; each has at least `min_bytes`.
    fn list(&mut self, count: Count, min_bytes: usize) -> Result<usize, DecodeError>;
    /// Fills all elements of a list.
    fn numbers(&mut self, numbers: NumbersMut<'_>) -> Result<(), DecodeError>;
}
