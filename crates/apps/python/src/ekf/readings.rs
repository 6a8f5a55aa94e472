//! Values and covariances of readings.

use numpy::PyUntypedArrayMethods as _;
use periplus::diagnostics::closest;
use periplus::ekf::{STATE_DIMENSIONS, Variable};
use periplus::geometry::{DQuat, DVec3};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{contiguous, input, require_finite};

/// Names of the variables, in the order of the state.
pub(super) const NAMES: [&str; STATE_DIMENSIONS] = [
    "x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "vroll", "vpitch", "vyaw", "ax", "ay",
    "az",
];
const VARIABLES: [Variable; STATE_DIMENSIONS] = [
    Variable::X,
    Variable::Y,
    Variable::Z,
    Variable::Roll,
    Variable::Pitch,
    Variable::Yaw,
    Variable::Vx,
    Variable::Vy,
    Variable::Vz,
    Variable::Vroll,
    Variable::Vpitch,
    Variable::Vyaw,
    Variable::Ax,
    Variable::Ay,
    Variable::Az,
];
/// Largest difference between entries of a symmetric matrix, as a fraction of the larger one.
const MAX_ASYMMETRY_RATIO: f64 = 1e-6;
/// Minimum norm of a quaternion that has a direction.
const MIN_QUATERNION_NORM_RATIO: f64 = 1e-3;

/// Variable by its name.
pub(super) fn variable(name: &str) -> PyResult<Variable> {
    NAMES.iter().position(|it| *it == name).map(|at| VARIABLES[at]).ok_or_else(|| {
        let near = closest(name, NAMES);
        let advice = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        PyValueError::new_err(format!("there is no variable `{name}`{advice}"))
    })
}

pub(super) fn vector_argument(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<DVec3> {
    let array = input::<f64>(argument, name, &[Some(3)])?;
    let values = array.as_slice()?;
    require_finite(values, name)?;
    Ok(DVec3::new(values[0], values[1], values[2]))
}

pub(super) fn rotation_argument(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<DQuat> {
    let array = input::<f64>(argument, name, &[Some(4)])?;
    let values = array.as_slice()?;
    let rotation = DQuat::from_xyzw(values[0], values[1], values[2], values[3]);
    let length = rotation.length();
    if length.is_finite() && length > MIN_QUATERNION_NORM_RATIO {
        Ok(rotation.normalize())
    } else {
        Err(PyValueError::new_err(format!("`{name}` is a quaternion without a direction")))
    }
}

/// Value with its covariance; none where the value is missing or its covariance begins with -1.
pub(super) fn with_covariance<T>(
    (value, name): (Option<&Bound<'_, PyAny>>, &str),
    (covariance, covariance_name): (Option<&Bound<'_, PyAny>>, &str),
    read: impl Fn(&Bound<'_, PyAny>, &str) -> PyResult<T>,
) -> PyResult<Option<(T, [f64; 9])>> {
    let Some(value) = value else { return Ok(None) };
    let covariance = covariance
        .ok_or_else(|| PyTypeError::new_err(format!("`{name}` needs `{covariance_name}`")))?;
    let first = contiguous::<f64>(covariance, covariance_name)?;
    if first.as_slice()?.first() == Some(&-1.0) {
        return Ok(None);
    }
    let covariance = covariance_argument::<9>(covariance, covariance_name, 3)?;
    Ok(Some((read(value, name)?, covariance)))
}

/// Covariance of `size` values, row-major; N is the square of the size.
pub(super) fn covariance_argument<const N: usize>(
    argument: &Bound<'_, PyAny>,
    name: &str,
    size: usize,
) -> PyResult<[f64; N]> {
    let values = covariance_values(argument, name, size)?;
    values.try_into().map_err(|_| PyValueError::new_err(format!("`{name}` has a wrong size")))
}

/// Covariance of `size` values, row-major, from a matrix, its values in rows, its diagonal, or one variance.
///
/// # Errors
/// `ValueError` that names the argument for another shape, a negative variance, or a matrix that is not symmetric.
pub(super) fn covariance_values(
    argument: &Bound<'_, PyAny>,
    name: &str,
    size: usize,
) -> PyResult<Vec<f64>> {
    let array = contiguous::<f64>(argument, name)?;
    let values = array.as_slice()?;
    require_finite(values, name)?;
    let diagonal = |of: &dyn Fn(usize) -> f64| {
        (0..size * size)
            .map(|at| if at % (size + 1) == 0 { of(at / (size + 1)) } else { 0.0 })
            .collect::<Vec<f64>>()
    };
    let matrix = match *array.shape() {
        [count] if count == size => diagonal(&|at| values[at]),
        [] | [1] => diagonal(&|_| values[0]),
        [count] if count == size * size => values.to_vec(),
        [rows, columns] if rows == size && columns == size => values.to_vec(),
        ref shape => {
            return Err(PyValueError::new_err(format!(
                "`{name}` must have the shape ({size}, {size}), ({},) or ({size},), not {shape:?}",
                size * size
            )));
        }
    };
    for row in 0..size {
        if matrix[row * (size + 1)] < 0.0 {
            return Err(PyValueError::new_err(format!(
                "variance {row} of `{name}` is negative: {}",
                matrix[row * (size + 1)]
            )));
        }
        for column in 0..row {
            let (a, b) = (matrix[row * size + column], matrix[column * size + row]);
            if (a - b).abs() > MAX_ASYMMETRY_RATIO * a.abs().max(b.abs()) {
                return Err(PyValueError::new_err(format!(
                    "`{name}` must be symmetric: entries ({row}, {column}) and ({column}, {row}) are {a} and {b}"
                )));
            }
        }
    }
    Ok(matrix)
}
