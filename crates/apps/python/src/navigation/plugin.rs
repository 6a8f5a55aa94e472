//! Objects of Python that are plugins of a server.

use std::fmt;
use std::sync::{Arc, Mutex};

use periplus::controllers::PluginSetup;
use periplus::diagnostics::{Diagnostic, Diagnostics};
use periplus::geometry::Pose2;
use pyo3::exceptions::{PyException, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTraceback};

use crate::arrays::{input, require_finite};
use crate::work::{in_plugin, lock};

/// Class of a plugin, or a function that returns one.
pub(super) type Factory = Arc<Py<PyAny>>;

/// Exception that ends the call of Python in which it occurs: one of the creation of a plugin, or `KeyboardInterrupt`
/// and the like at any time.
#[derive(Clone, Default)]
pub(super) struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    pub(super) fn take(&self) -> Option<PyErr> {
        lock(&self.0).take()
    }

    /// Returns true if there is one.
    pub(super) fn is_some(&self) -> bool {
        lock(&self.0).is_some()
    }

    /// Keeps the first exception.
    pub(super) fn keep(&self, error: PyErr) {
        lock(&self.0).get_or_insert(error);
    }
}

/// Exception of a plugin as the text of an error.
pub(super) struct PluginError {
    /// Class of the exception, without its module.
    pub(super) class: String,
    /// Text of the exception.
    pub(super) text: String,
    /// Position in the source of the line that raised it, as `file:line`.
    position: Option<String>,
}

impl PluginError {
    /// Describes an exception. One that is no `Exception`, such as `KeyboardInterrupt`, is kept to be raised later.
    pub(super) fn new(py: Python<'_>, error: PyErr, raised: &Raised) -> Self {
        let class = error.get_type(py).name().map_or_else(|_| String::new(), |it| it.to_string());
        let text = error.value(py).str().map_or_else(|_| String::new(), |it| it.to_string());
        let position = error.traceback(py).and_then(position);
        if !error.is_instance_of::<PyException>(py) {
            raised.keep(error);
        }
        Self { class, text, position }
    }
}

impl fmt::Display for PluginError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.class)?;
        if !self.text.is_empty() {
            write!(f, ": {}", self.text)?;
        }
        match &self.position {
            Some(position) => write!(f, " ({position})"),
            None => Ok(()),
        }
    }
}

/// File and line of the innermost frame of Python.
fn position(traceback: Bound<'_, PyTraceback>) -> Option<String> {
    let mut last = traceback.into_any();
    loop {
        match last.getattr("tb_next") {
            Ok(next) if !next.is_none() => last = next,
            _ => break,
        }
    }
    let line: u32 = last.getattr("tb_lineno").ok()?.extract().ok()?;
    let code = last.getattr("tb_frame").and_then(|frame| frame.getattr("f_code")).ok()?;
    let file: String = code.getattr("co_filename").ok()?.extract().ok()?;
    Some(format!("{file}:{line}"))
}

/// Calls Python for a plugin; the error is a text.
pub(super) fn call<T>(
    raised: &Raised,
    work: impl for<'py> FnOnce(Python<'py>) -> PyResult<T>,
) -> Result<T, PluginError> {
    Python::attach(|py| in_plugin(|| work(py)).map_err(|error| PluginError::new(py, error, raised)))
}

/// Creates a plugin: calls the factory, and then `configure(name, parameters)` if it has that method. None after an
/// error, which is reported, and kept for the caller of Python.
pub(super) fn create(
    factory: &Factory,
    setup: &PluginSetup<'_>,
    required: &str,
    raised: &Raised,
    diagnostics: &mut Diagnostics,
) -> Option<Py<PyAny>> {
    let created = Python::attach(|py| {
        let made = in_plugin(|| make(py, factory, setup, required));
        made.inspect_err(|error| raised.keep(error.clone_ref(py)))
            .map_err(|error| PluginError::new(py, error, raised))
    });
    created
        .map_err(|error| {
            let text = format!("`{}`: {error}", setup.name);
            diagnostics.push(Diagnostic::error("plugin-raised", text).at(setup.class_origin));
        })
        .ok()
}

fn make(
    py: Python<'_>,
    factory: &Factory,
    setup: &PluginSetup<'_>,
    required: &str,
) -> PyResult<Py<PyAny>> {
    let object = factory.bind(py).call0()?;
    if !object.getattr(required).is_ok_and(|method| method.is_callable()) {
        return Err(PyTypeError::new_err(format!(
            "{} has no method `{required}`, which the plugin `{}` needs",
            object.repr()?,
            setup.name
        )));
    }
    if let Some(configure) = object.getattr_opt("configure")? {
        let parameters = PyDict::new(py);
        for given in setup.given.entries().iter().filter(|given| given.name != "plugin") {
            parameters.set_item(given.name, value(py, &given.text)?)?;
        }
        configure.call1((setup.name, parameters))?;
    }
    Ok(object.unbind())
}

/// Value of a parameter: a truth value, a number, a list of numbers, or a text.
fn value<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let text = text.trim();
    if let "true" | "True" | "false" | "False" = text {
        return Ok(text.eq_ignore_ascii_case("true").into_pyobject(py)?.to_owned().into_any());
    }
    if let Ok(integer) = text.parse::<i64>() {
        return Ok(integer.into_pyobject(py)?.into_any());
    }
    if let Ok(number) = text.parse::<f64>() {
        return Ok(number.into_pyobject(py)?.into_any());
    }
    let numbers: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
    match numbers {
        Ok(numbers) if !numbers.is_empty() => Ok(numbers.into_pyobject(py)?),
        _ => Ok(text.into_pyobject(py)?.into_any()),
    }
}

/// Poses that a plugin returns: an array of shape (N, 3).
pub(super) fn poses(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Pose2>> {
    let array = input::<f64>(value, name, &[None, Some(3)])?;
    let values = array.as_slice()?;
    require_finite(values, name)?;
    Ok(values.chunks_exact(3).map(|row| Pose2::new(row[0], row[1], row[2])).collect())
}

/// Velocity that a plugin returns: (vx, vy, wz).
pub(super) fn velocity(value: &Bound<'_, PyAny>) -> PyResult<periplus::geometry::Twist2> {
    let array = input::<f64>(value, "velocity", &[Some(3)])?;
    let values = array.as_slice()?;
    require_finite(values, "velocity")?;
    Ok(periplus::geometry::Twist2::new(values[0], values[1], values[2]))
}

/// A pose as Python gets it.
pub(super) fn tuple(pose: Pose2) -> (f64, f64, f64) {
    (pose.x_m, pose.y_m, pose.yaw_rad)
}

/// Poses as an array of shape (N, 3).
pub(super) fn pose_array<'py>(py: Python<'py>, poses: &[Pose2]) -> PyResult<Bound<'py, PyAny>> {
    let values = poses.iter().flat_map(|pose| [pose.x_m, pose.y_m, pose.yaw_rad]).collect();
    Ok(crate::arrays::moved(py, values, &[poses.len(), 3])?.into_any())
}
