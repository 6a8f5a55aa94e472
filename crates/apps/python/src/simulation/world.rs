//! Worlds from files.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use periplus::diagnostics::{RenderStyle, Severity, render};
use periplus::loader::{LoadContext, LoadedFile, load};
use periplus::sim::{Composition, PlacementPose, RobotPlacement, Search, compose, compose_plain};
use periplus_session::terminal::search;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use crate::errors::{require_file, require_no_errors};
use crate::poses::pose_argument;
use crate::work::{lock, released};

/// A world with robots, from files: what a `Simulation` simulates.
///
/// ``World()`` is an empty plane under a sun. ``World.load`` reads an SDF file, a saved world, or a robot, which is
/// put on a plane. ``World.demo`` is the world of ``periplus demo``.
///
/// >>> from periplus import World
/// >>> World.demo()
/// World.demo()
#[pyclass(name = "World", module = "periplus", frozen)]
pub(crate) struct PyWorld(Mutex<WorldFiles>);

/// Origin of a world.
#[derive(Clone)]
enum Source {
    Plane,
    Demo,
    File { path: PathBuf, arguments: Vec<(String, String)> },
}

/// Files of a world.
#[derive(Clone)]
pub(crate) struct WorldFiles {
    source: Source,
    robots: Vec<RobotPlacement>,
    search: Search,
    findings: Vec<String>,
}

impl PyWorld {
    /// The files, as they are now.
    pub(crate) fn files(&self) -> WorldFiles {
        lock(&self.0).clone()
    }
}

impl WorldFiles {
    /// Folders in which files are searched.
    pub(crate) fn search(&self) -> &Search {
        &self.search
    }

    /// Reads all files.
    pub(crate) fn compose(&self) -> Composition {
        match &self.source {
            Source::Demo => periplus_cli::demo_composition(),
            Source::Plane => {
                self.search.with_context(true, |context| compose_plain(&self.robots, context))
            }
            Source::File { path, arguments } => self.search.with_context(true, |context| {
                let arguments = arguments.clone();
                compose(path, &self.robots, &LoadContext { arguments, ..context.clone() })
            }),
        }
    }

    fn read(&self, path: &Path, arguments: &[(String, String)]) -> LoadedFile {
        self.search.with_context(true, |context| {
            load(path, &LoadContext { arguments: arguments.to_vec(), ..context.clone() })
        })
    }
}

#[pymethods]
impl PyWorld {
    #[new]
    #[pyo3(signature = (*, resource_path=Vec::new()))]
    fn new(resource_path: Vec<PathBuf>) -> Self {
        Self(Mutex::new(WorldFiles {
            source: Source::Plane,
            robots: Vec::new(),
            search: search(&resource_path),
            findings: Vec::new(),
        }))
    }

    /// Read a world file: SDF, a world saved by Periplus, or a robot (URDF, xacro, SDF) that is put on a plane.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file.
    /// arguments : dict, optional
    ///     Arguments of its xacro, name to value.
    /// resource_path : list of paths, optional
    ///     Folders of packages and models, before those of the environment.
    ///
    /// Raises ``FileNotFoundError``, or ``FileError`` with line and column. Warnings are in ``findings``.
    #[staticmethod]
    #[pyo3(signature = (path, *, arguments=None, resource_path=Vec::new()))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        arguments: Option<&Bound<'_, PyDict>>,
        resource_path: Vec<PathBuf>,
    ) -> PyResult<Self> {
        require_file(&path)?;
        let arguments = pairs(arguments)?;
        let source = Source::File { path: path.clone(), arguments: arguments.clone() };
        let mut files = WorldFiles {
            source,
            robots: Vec::new(),
            search: search(&resource_path),
            findings: Vec::new(),
        };
        let loaded = released(py, "reading a world", || files.read(&path, &arguments))?;
        require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
        files.findings = rendered(&loaded);
        Ok(Self(Mutex::new(files)))
    }

    /// The world of ``periplus demo``: two rooms with a few things, and a robot with lidar, camera and IMU.
    #[staticmethod]
    fn demo() -> Self {
        Self(Mutex::new(WorldFiles {
            source: Source::Demo,
            robots: Vec::new(),
            search: search(&[]),
            findings: Vec::new(),
        }))
    }

    /// Add a robot from a file: URDF, xacro, or an SDF with a model. Returns the world.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file.
    /// pose : Pose or tuple, optional
    ///     ``(x, y, yaw)`` puts the robot on the plane z = 0; a ``Pose`` or six numbers put its frame there. Default:
    ///     that of its file, or above the origin so that it touches the floor.
    /// arguments : dict, optional
    ///     Arguments of its xacro, name to value.
    /// name : str, optional
    ///     Name in the world; default: that of its file, with a number if it is in use.
    /// namespace : str, optional
    ///     Namespace of its topics; default: none for one robot, its name for one of several.
    ///
    /// Raises ``FileNotFoundError``, or ``FileError`` with line and column.
    #[pyo3(signature = (path, pose=None, arguments=None, *, name=None, namespace=None))]
    fn add_robot<'py>(
        slf: Bound<'py, Self>,
        path: PathBuf,
        pose: Option<&Bound<'py, PyAny>>,
        arguments: Option<&Bound<'_, PyDict>>,
        name: Option<String>,
        namespace: Option<String>,
    ) -> PyResult<Bound<'py, Self>> {
        let py = slf.py();
        require_file(&path)?;
        let pose = pose.map(placement).transpose()?.unwrap_or_default();
        let arguments = pairs(arguments)?;
        let files = slf.get().files();
        if matches!(files.source, Source::Demo) {
            return Err(PyValueError::new_err(
                "the demo has its robot; add robots to World() or World.load(...)",
            ));
        }
        let loaded = released(py, "reading a robot", || files.read(&path, &arguments))?;
        require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
        let mut files = lock(&slf.get().0);
        files.findings.extend(rendered(&loaded));
        files.robots.push(RobotPlacement { file: path, arguments, name, namespace, pose });
        drop(files);
        Ok(slf)
    }

    /// Warnings and hints of the files, as text with file, line and column.
    #[getter]
    fn findings(&self) -> Vec<String> {
        lock(&self.0).findings.clone()
    }

    fn __repr__(&self) -> String {
        let files = lock(&self.0);
        let start = match &files.source {
            Source::Plane => "World()".to_owned(),
            Source::Demo => "World.demo()".to_owned(),
            Source::File { path, .. } => format!("World.load({:?})", path.display().to_string()),
        };
        files.robots.iter().fold(start, |text, robot| {
            format!("{text}.add_robot({:?})", robot.file.display().to_string())
        })
    }
}

/// Arguments of xacro from a dict; truth values are `true` and `false`.
fn pairs(arguments: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, String)>> {
    let Some(arguments) = arguments else { return Ok(Vec::new()) };
    let text = |value: &Bound<'_, PyAny>| -> PyResult<String> {
        let text = value.str()?.to_string();
        Ok(if value.is_instance_of::<PyBool>() { text.to_lowercase() } else { text })
    };
    arguments.iter().map(|(name, value)| Ok((name.extract()?, text(&value)?))).collect()
}

/// Pose argument of a robot: three numbers are a position and yaw on the floor.
fn placement(pose: &Bound<'_, PyAny>) -> PyResult<PlacementPose> {
    if let Ok([x, y, yaw]) = pose.extract::<[f64; 3]>() {
        // Checks that the numbers are finite.
        pose_argument(pose, "pose")?;
        return Ok(PlacementPose::OnGround([x, y, yaw]));
    }
    Ok(PlacementPose::At(pose_argument(pose, "pose")?))
}

/// Findings of a file below errors.
pub(crate) fn rendered(loaded: &LoadedFile) -> Vec<String> {
    let findings = loaded.diagnostics.iter().filter(|finding| finding.severity != Severity::Error);
    findings.map(|finding| render(finding, &loaded.sources, RenderStyle::Plain)).collect()
}
