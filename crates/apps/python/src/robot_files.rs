//! Robot and world files.

use std::path::{Path, PathBuf};

use periplus::diagnostics::{Diagnostics, Severity, SourceMap};
use periplus::loader::LoadedFile;
use periplus_cli::files::{ConversionTarget, check_file, convert_file};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};

use crate::errors::{file_error, require_file, require_no_errors, value_error};
use crate::work::released;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyFinding>()?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(convert, module)?)?;
    module.add_function(wrap_pyfunction!(load_robot, module)?)?;
    module.add_function(wrap_pyfunction!(expand_xacro, module)?)?;
    Ok(())
}

/// Checks a file of a robot or a world: URDF, xacro, SDF, launch, map, parameters, mesh and others.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     File.
/// arguments : dict, optional
///     Arguments of xacro: text, numbers or bools.
/// resource_path : list of paths, optional
///     Folders to search for packages, models and meshes, before those of the environment and around the file.
///
/// Returns
/// -------
/// list of Finding
///     Findings, as ``periplus check --json`` gives them; empty for a sound file.
///
/// Raises ``FileNotFoundError`` if there is no such file. Faults in files are findings, not exceptions.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "cart.urdf"
/// ...     _ = path.write_text("<robot name='cart'><link name='a'/><lnk name='b'/></robot>")
/// ...     [(finding.severity, finding.code) for finding in periplus.check(path)]
/// [('warning', 'unknown-element'), ('warning', 'massless-link')]
#[pyfunction]
#[pyo3(signature = (path, *, arguments=None, resource_path=Vec::new()))]
fn check(
    py: Python<'_>,
    path: PathBuf,
    arguments: Option<&Bound<'_, PyDict>>,
    resource_path: Vec<PathBuf>,
) -> PyResult<Vec<PyFinding>> {
    require_file(&path)?;
    let arguments = xacro_arguments(arguments)?;
    let checked =
        released(py, "checking the file", || check_file(&path, arguments, &resource_path))?;
    let mut findings = findings_of(&checked.loaded.diagnostics, &checked.loaded.sources);
    for (found, sources) in &checked.more {
        findings.extend(findings_of(found, sources));
    }
    Ok(findings)
}

/// Converts a robot or a world to another format, or a map to a world.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     File: URDF, xacro, SDF, the YAML of a map, or an image of a floor plan.
/// to : {'urdf', 'sdf', 'json'}
///     Format.
/// arguments : dict, optional
///     Arguments of xacro.
/// model : str, optional
///     Converts only this model.
/// output : path, optional
///     File for which the text is meant: relative paths in it start there. It is not written.
/// resolution : float, optional
///     Pixel size of a floor plan [m].
/// wall_height : float, optional
///     Height of the walls of a map [m] (default 2.5).
/// resource_path : list of paths, optional
///     Folders to search for packages, models and meshes.
///
/// Returns
/// -------
/// str
///     Text of the new file.
///
/// Raises ``FileNotFoundError``, ``FileError`` with file, line and column for a fault in a file, and
/// ``ValueError`` for an unknown format.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "box.sdf"
/// ...     _ = path.write_text("<sdf version='1.9'><model name='box'><link name='a'/></model></sdf>")
/// ...     "<link name=\"a\"" in periplus.convert(path, to="urdf")
/// True
#[pyfunction]
#[pyo3(signature = (
    path, to, *, arguments=None, model=None, output=None, resolution=None, wall_height=None,
    resource_path=Vec::new()
))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
fn convert(
    py: Python<'_>,
    path: PathBuf,
    to: &str,
    arguments: Option<&Bound<'_, PyDict>>,
    model: Option<String>,
    output: Option<PathBuf>,
    resolution: Option<f64>,
    wall_height: Option<f64>,
    resource_path: Vec<PathBuf>,
) -> PyResult<String> {
    for (name, length_m) in [("resolution", resolution), ("wall_height", wall_height)] {
        if length_m.is_some_and(|length_m| !length_m.is_finite() || length_m <= 0.0) {
            return Err(value_error(format!("`{name}` must be positive")));
        }
    }
    let mut target = ConversionTarget::new(to);
    target.model = model;
    target.output = output;
    target.resolution_m = resolution;
    target.wall_height_m = wall_height.unwrap_or(target.wall_height_m);
    converted(py, &path, arguments, &target, &resource_path)
}

/// Reads a robot (URDF, xacro, SDF) and returns it as text in one format, with xacro expanded, includes read and
/// faults reported.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     File of the robot.
/// arguments : dict, optional
///     Arguments of xacro.
/// to : {'sdf', 'urdf', 'json'}, optional
///     Format of the text (default ``'sdf'``).
/// resource_path : list of paths, optional
///     Folders to search for packages, models and meshes.
///
/// Raises ``FileNotFoundError`` and ``FileError`` as :func:`convert`.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "box.sdf"
/// ...     _ = path.write_text("<sdf version='1.9'><model name='box'><link name='a'/></model></sdf>")
/// ...     "<model name=\"box\"" in periplus.load_robot(path)
/// True
#[pyfunction]
#[pyo3(signature = (path, arguments=None, *, to="sdf", resource_path=Vec::new()))]
fn load_robot(
    py: Python<'_>,
    path: PathBuf,
    arguments: Option<&Bound<'_, PyDict>>,
    to: &str,
    resource_path: Vec<PathBuf>,
) -> PyResult<String> {
    converted(py, &path, arguments, &ConversionTarget::new(to), &resource_path)
}

/// Expands the macros of a xacro file, as the program ``xacro`` does.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     File.
/// arguments : dict, optional
///     Arguments: text, numbers or bools.
/// resource_path : list of paths, optional
///     Folders to search for packages.
///
/// Returns
/// -------
/// str
///     Text of the URDF.
///
/// Raises ``FileNotFoundError`` and ``FileError`` with file, line and column.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "cart.xacro"
/// ...     text = "<robot name='cart' xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:arg name='n' default='a'/>"
/// ...     _ = path.write_text(text + "<link name='$(arg n)'/></robot>")
/// ...     "<link name=\"wheel\"" in periplus.expand_xacro(path, {"n": "wheel"})
/// True
#[pyfunction]
#[pyo3(signature = (path, arguments=None, *, resource_path=Vec::new()))]
fn expand_xacro(
    py: Python<'_>,
    path: PathBuf,
    arguments: Option<&Bound<'_, PyDict>>,
    resource_path: Vec<PathBuf>,
) -> PyResult<String> {
    converted(py, &path, arguments, &ConversionTarget::new("urdf"), &resource_path)
}

fn converted(
    py: Python<'_>,
    path: &Path,
    arguments: Option<&Bound<'_, PyDict>>,
    target: &ConversionTarget,
    resource_path: &[PathBuf],
) -> PyResult<String> {
    require_file(path)?;
    let arguments = xacro_arguments(arguments)?;
    let given = arguments.clone();
    let (loaded, text) = released(py, "converting the file", || {
        convert_file(path, arguments, target, resource_path)
    })?
    .map_err(value_error)?;
    require_known_arguments(&loaded, &given)?;
    match text {
        Some(text) => Ok(text),
        None => {
            require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
            Err(file_error(py, path, "cannot be converted"))
        }
    }
}

/// Fails with `TypeError` for an argument that the file does not declare.
fn require_known_arguments(loaded: &LoadedFile, given: &[(String, String)]) -> PyResult<()> {
    if loaded.diagnostics.has_errors() || loaded.known_arguments.is_empty() {
        return Ok(());
    }
    let Some(name) = loaded.unknown_arguments(given).first().copied() else { return Ok(()) };
    let known = || loaded.known_arguments.iter().map(String::as_str);
    let near = match periplus::diagnostics::closest(name, known()) {
        Some(near) => format!(", did you mean `{near}`?"),
        None => format!("; its arguments are: {}", known().collect::<Vec<_>>().join(", ")),
    };
    Err(PyTypeError::new_err(format!("the file has no argument `{name}`{near}")))
}

/// Arguments of xacro: names with the texts of their values.
fn xacro_arguments(arguments: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, String)>> {
    let mut texts = Vec::new();
    for (name, value) in arguments.into_iter().flatten() {
        let name = name
            .cast::<PyString>()
            .map_err(|_| PyTypeError::new_err("the names in `arguments` must be of type str"))?
            .to_str()?
            .to_owned();
        let text = match value.cast::<PyBool>() {
            Ok(truth) => truth.is_true().to_string(),
            Err(_) => value.str()?.to_str()?.to_owned(),
        };
        texts.push((name, text));
    }
    Ok(texts)
}

/// Problem found in a file, or a hint.
///
/// >>> import periplus, tempfile, pathlib
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     path = pathlib.Path(folder) / "cart.urdf"
/// ...     _ = path.write_text("<robot name='cart'>\n<link name='a'/><lnk name='b'/>\n</robot>")
/// ...     finding = periplus.check(path)[0]
/// >>> finding.severity, finding.line, finding.column
/// ('warning', 2, 18)
#[pyclass(name = "Finding", module = "periplus", frozen, eq, get_all)]
#[derive(Clone, PartialEq)]
pub(crate) struct PyFinding {
    /// ``error``, ``warning`` or ``hint``.
    severity: String,
    /// Short stable name, such as ``unknown-element``.
    code: String,
    /// Description of the fault.
    message: String,
    /// Path of the file; None if it concerns no line of a file.
    file: Option<String>,
    /// Line, from 1.
    line: Option<usize>,
    /// Column, from 1.
    column: Option<usize>,
    /// Facts that explain it.
    notes: Vec<String>,
    /// Advice.
    help: Vec<String>,
}

#[pymethods]
impl PyFinding {
    fn __repr__(&self) -> String {
        format!("Finding({} {}: {})", self.severity, self.code, self)
    }

    fn __str__(&self) -> String {
        self.to_string()
    }
}

impl std::fmt::Display for PyFinding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
            if let (Some(line), Some(column)) = (self.line, self.column) {
                write!(f, "{line}:{column}:")?;
            }
            write!(f, " ")?;
        }
        f.write_str(&self.message)
    }
}

impl PyFinding {
    /// Warning without a location.
    pub(crate) fn warning(code: &str, message: &str) -> Self {
        Self {
            severity: Severity::Warning.name().to_owned(),
            code: code.to_owned(),
            message: message.to_owned(),
            file: None,
            line: None,
            column: None,
            notes: Vec::new(),
            help: Vec::new(),
        }
    }

    /// Warning about a line of a file.
    pub(crate) fn of_line(code: &str, message: &str, file: &str, line: usize) -> Self {
        Self {
            file: Some(file.to_owned()),
            line: Some(line),
            column: Some(1),
            ..Self::warning(code, message)
        }
    }
}

/// Findings with their locations.
pub(crate) fn findings_of(found: &Diagnostics, sources: &SourceMap) -> Vec<PyFinding> {
    let one = |finding: &periplus::diagnostics::Diagnostic| {
        let place =
            finding.span.filter(|span| sources.holds(*span)).map(|span| sources.locate(span));
        PyFinding {
            severity: finding.severity.name().to_owned(),
            code: finding.code.to_owned(),
            message: finding.message.clone(),
            file: place.map(|(file, _)| file.to_owned()),
            line: place.map(|(_, at)| at.line),
            column: place.map(|(_, at)| at.column),
            notes: finding.notes.clone(),
            help: finding.help.clone(),
        }
    };
    found.iter().map(one).collect()
}
