//! Times in seconds and nanoseconds.

use numpy::PyUntypedArrayMethods as _;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::input;

/// Number of nanoseconds in a second.
const SECOND_NS: i64 = 1_000_000_000;
/// Largest time \[s\]: that of 64 bits of nanoseconds, 292 years.
const MAX_TIME_S: f64 = 9.2e9;
/// Time in nanoseconds, rounded.
///
/// # Errors
/// `ValueError` that names the argument if the time is not finite or too large.
pub(crate) fn nanoseconds(time_s: f64, name: &str) -> PyResult<i64> {
    if time_s.is_nan() || time_s.abs() > MAX_TIME_S {
        return Err(PyValueError::new_err(format!(
            "`{name}` must be a time in seconds within 292 years of 0, not {time_s}"
        )));
    }
    // Whole seconds apart, which keeps the digits of late times.
    let whole_s = time_s.floor();
    Ok(whole_s as i64 * SECOND_NS + ((time_s - whole_s) * 1e9).round() as i64)
}

/// Time in seconds.
pub(crate) fn seconds(time_ns: i64) -> f64 {
    let rest_ns = time_ns.rem_euclid(SECOND_NS);
    time_ns.div_euclid(SECOND_NS) as f64 + rest_ns as f64 * 1e-9
}

/// Time that is given in seconds or, exactly, in nanoseconds.
///
/// # Errors
/// `TypeError` if both are given, `ValueError` for seconds out of range.
pub(crate) fn time_argument(time_s: Option<f64>, time_ns: Option<i64>) -> PyResult<Option<i64>> {
    match (time_s, time_ns) {
        (Some(_), Some(_)) => Err(PyTypeError::new_err("give `time_s` or `time_ns`, not both")),
        (Some(time_s), None) => nanoseconds(time_s, "time_s").map(Some),
        (None, time_ns) => Ok(time_ns),
    }
}

/// Times that are given in seconds or, exactly, in nanoseconds.
///
/// # Errors
/// `TypeError` unless one of both is given or for fractions of nanoseconds, `ValueError` for seconds out of range.
pub(crate) fn times_argument(
    times_s: Option<&Bound<'_, PyAny>>,
    times_ns: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<i64>> {
    match (times_s, times_ns) {
        (Some(times_s), None) => {
            let times = input::<f64>(times_s, "times_s", &[None])?;
            times.as_slice()?.iter().map(|it| nanoseconds(*it, "times_s")).collect()
        }
        (None, Some(times_ns)) => Ok(whole_numbers(times_ns, "times_ns", &[None])?.0),
        _ => Err(PyTypeError::new_err("give either `times_s` or `times_ns`")),
    }
}

/// Array of whole numbers and its shape; fractions are a `TypeError`. `None` in `shape` is any length.
pub(crate) fn whole_numbers(
    argument: &Bound<'_, PyAny>,
    name: &str,
    shape: &[Option<usize>],
) -> PyResult<(Vec<i64>, Vec<usize>)> {
    let numpy = argument.py().import(pyo3::intern!(argument.py(), "numpy"))?;
    let array = numpy
        .call_method1("asarray", (argument,))
        .map_err(|_| PyTypeError::new_err(format!("`{name}` is not an array of whole numbers")))?;
    let is_empty = array.getattr("size")?.extract::<usize>()? == 0;
    let fits = numpy.call_method1("can_cast", (array.getattr("dtype")?, "int64"))?;
    if !is_empty && !fits.extract::<bool>()? {
        return Err(PyTypeError::new_err(format!(
            "`{name}` must be whole numbers of at most 64 bits, not {}",
            array.getattr("dtype")?.str()?
        )));
    }
    let array = input::<i64>(&array, name, shape)?;
    Ok((array.as_slice()?.to_vec(), array.shape().to_vec()))
}
