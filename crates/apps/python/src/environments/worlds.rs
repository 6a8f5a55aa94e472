//! Worlds of environments: files of worlds and maps, and generated worlds.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use periplus::diagnostics::{Diagnostics, SourceMap};
use periplus::environments::{
    EnvironmentRobot, NavigationWorld, WORLD_GENERATOR, WorldGeneratorParams, generate_world,
};
use periplus::loader::{FileFormat, LoadContext, LoadedFile, load_bytes, map_world};
use periplus::maps::Distro;
use periplus::os::Machine;
use periplus::resources::Resolver;
use periplus::scene::{Scene, World};
use periplus::sim::AssetFiles;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::settings;
use crate::errors::{file_error, require_file, require_no_errors};
use crate::rays::file::load_file;
use crate::work::released;

/// Height of the walls of a map [m].
const MAP_WALL_HEIGHT_M: f64 = 2.0;

/// World as it is asked for.
pub(super) enum WorldSource {
    File(PathBuf),
    Generated { params: WorldGeneratorParams, seed: u64 },
}

impl WorldSource {
    /// A path, or a dictionary with the parameters of a generator and its `seed`.
    pub(super) fn of(argument: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Ok(given) = argument.cast::<PyDict>() else {
            return Ok(Self::File(argument.extract()?));
        };
        let given = given.copy()?;
        let seed = match given.get_item("seed")? {
            Some(seed) => seed.extract()?,
            None => 0,
        };
        if given.contains("seed")? {
            given.del_item("seed")?;
        }
        let values = settings::read(argument.py(), &WORLD_GENERATOR, Some(&given))?;
        Ok(Self::Generated { params: WorldGeneratorParams::from_values(&values), seed })
    }

    /// Name for messages.
    fn name(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Generated { params, seed } => {
                format!("{} {seed}", periplus::params::ParamChoice::word(params.kind))
            }
        }
    }

    /// The world, and the sources of its findings.
    fn read(&self, py: Python<'_>) -> PyResult<(World, SourceMap)> {
        match self {
            Self::Generated { params, seed } => {
                Ok((generate_world(params, *seed), SourceMap::new()))
            }
            Self::File(path) => read_file(py, path),
        }
    }
}

fn read_file(py: Python<'_>, path: &Path) -> PyResult<(World, SourceMap)> {
    require_file(path)?;
    let mut loaded = released(py, "reading the file", || {
        let loaded = load_file(path, Vec::new(), Vec::new());
        if loaded.language == FileFormat::Map { walls_of_map(path) } else { loaded }
    })?;
    require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
    let scene = loaded.scene.take().unwrap_or_default();
    let Scene { mut worlds, models, .. } = scene;
    let world = if worlds.is_empty() && !models.is_empty() {
        World { models, ..World::empty("default") }
    } else if worlds.is_empty() {
        let text = "the file describes no world; give an SDF, a URDF or the YAML of a map";
        return Err(file_error(py, path, text));
    } else {
        worlds.swap_remove(0)
    };
    Ok((world, loaded.sources))
}

/// The walls of a map as a world.
fn walls_of_map(path: &Path) -> LoadedFile {
    let read = periplus::maps::load(&path.to_string_lossy(), Distro::Jazzy, &Machine);
    let context = LoadContext {
        host: &Machine,
        resolver: &Resolver::new(&Machine, &[]),
        working_folder: std::env::current_dir().unwrap_or_default(),
        arguments: Vec::new(),
        open_meshes: false,
    };
    let (name, text) = match &read.map {
        Some(map) => {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            (path.with_extension("sdf"), map_world(&map.grid, &name, MAP_WALL_HEIGHT_M).0)
        }
        None => (path.to_path_buf(), String::new()),
    };
    if read.map.is_none() {
        let mut loaded = load_bytes(&name, b"", &context);
        (loaded.diagnostics, loaded.sources) = (read.diagnostics, read.sources);
        return loaded;
    }
    load_bytes(&name, text.as_bytes(), &context)
}

/// SDF of a world.
pub(super) fn sdf_text(py: Python<'_>, source: &WorldSource) -> PyResult<String> {
    let (world, _) = source.read(py)?;
    let scene = Scene { worlds: vec![world], ..Scene::default() };
    let document = periplus::sdf::write(&scene, &mut Diagnostics::new());
    Ok(periplus::xml::write_document(&document))
}

/// Reads and prepares worlds for a robot, several at a time.
pub(super) fn prepare(
    py: Python<'_>,
    sources: &[WorldSource],
    robot: &EnvironmentRobot,
    threads: usize,
) -> PyResult<Vec<Arc<NavigationWorld>>> {
    let mut worlds = Vec::new();
    for source in sources {
        worlds.push(source.read(py)?);
    }
    let count = worlds.len();
    let prepared = released(py, "preparing the worlds", || {
        let slots: Vec<Mutex<Option<(NavigationWorld, Diagnostics)>>> =
            (0..count).map(|_| Mutex::new(None)).collect();
        let queue = Mutex::new(worlds.iter().zip(&slots));
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        let help = || {
            while let Some(((world, _), slot)) = next() {
                let made = NavigationWorld::new(world, robot, &AssetFiles::default(), 1);
                *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(made);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads.min(count) {
                scope.spawn(help);
            }
            help();
        });
        let filled = slots
            .into_iter()
            .filter_map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner));
        filled.collect::<Vec<_>>()
    })?;
    let mut ready = Vec::new();
    for (((world, findings), source), (_, files)) in prepared.into_iter().zip(sources).zip(&worlds)
    {
        require_no_errors(py, &findings, files).map_err(|error| named(py, &error, source))?;
        ready.push(Arc::new(world));
    }
    Ok(ready)
}

/// The error with a note that names the world; Python has notes from version 3.11 on.
fn named(py: Python<'_>, error: &PyErr, source: &WorldSource) -> PyErr {
    let error = error.clone_ref(py);
    let note = format!("in the world {}", source.name());
    _ = error.value(py).call_method1("add_note", (note,));
    error
}
