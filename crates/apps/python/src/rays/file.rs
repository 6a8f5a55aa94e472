//! Scenes of files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus::geometry::{DVec3, Pose};
use periplus::loader::{LoadContext, LoadedFile, load, read_mesh, settle_images};
use periplus::os::Machine;
use periplus::raycast::{Hit, InstanceId};
use periplus::rendering::{RenderScene, SensedGeometry};
use periplus::resources::Host as _;
use periplus::scene::World;
use periplus::sim::{AssetFiles, Search};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::scene::{FixedMesh, Geometry, SceneState};
use crate::errors::{file_error, require_file, require_no_errors};
use crate::work::released;

/// Reads the shapes of a world, robot or mesh file.
pub(super) fn read(
    py: Python<'_>,
    path: &Path,
    geometry: &str,
    arguments: Option<&Bound<'_, PyDict>>,
    folders: Vec<PathBuf>,
) -> PyResult<SceneState> {
    let geometry = match geometry {
        "visual" => SensedGeometry::Visual,
        "collision" => SensedGeometry::Collision,
        other => {
            return Err(PyValueError::new_err(format!(
                "`geometry` must be \"visual\" or \"collision\", not {other:?}"
            )));
        }
    };
    require_file(path)?;
    let mut given = Vec::new();
    for (name, value) in arguments.into_iter().flatten() {
        given.push((name.extract::<String>()?, value.str()?.extract::<String>()?));
    }
    let mut loaded = released(py, "reading the file", || load_file(path, folders, given))?;
    require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
    if loaded.mesh.is_some() {
        let mesh = released(py, "reading the mesh", || mesh_of(path))?;
        let mesh = mesh.ok_or_else(|| file_error(py, path, "the mesh cannot be read"))?;
        let mut state = SceneState::default();
        state.add(Geometry::Fixed(Arc::new(mesh)), Pose::IDENTITY, 0);
        return Ok(state);
    }
    let Some(mut scene) = loaded.scene.take() else {
        return Err(file_error(py, path, "the file describes no world, robot or mesh"));
    };
    let world = if scene.worlds.is_empty() {
        World { models: std::mem::take(&mut scene.models), ..World::empty("default") }
    } else {
        scene.worlds.swap_remove(0)
    };
    let (state, findings) = released(py, "building the scene", || {
        let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let (scene, findings) = RenderScene::new(&world, geometry, &AssetFiles::default(), threads);
        let rays = scene.rays().clone();
        let count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
        let names = (0..count).map(|instance| name_of(&scene, instance)).collect();
        (SceneState::of_file(rays, names), findings)
    })?;
    require_no_errors(py, &findings, &loaded.sources)?;
    Ok(state)
}

pub(crate) fn load_file(
    path: &Path,
    folders: Vec<PathBuf>,
    arguments: Vec<(String, String)>,
) -> LoadedFile {
    let working_folder = std::env::current_dir().unwrap_or_default();
    let search = Search { folders, working_folder, ..Search::default() };
    search.with_context(true, |context| {
        let context = LoadContext { arguments, ..context.clone() };
        let mut loaded = load(path, &context);
        let given = &context.arguments;
        let unknown: Vec<String> =
            loaded.unknown_arguments(given).into_iter().map(str::to_owned).collect();
        for name in unknown {
            loaded.warn_of_argument(&name);
        }
        if let Some(scene) = &mut loaded.scene {
            settle_images(scene, &loaded.sources, &context, &mut loaded.diagnostics);
        }
        loaded
    })
}

fn mesh_of(path: &Path) -> Option<FixedMesh> {
    let bytes = Machine.read(path).ok()?;
    let mesh = read_mesh(path, &bytes, &Machine)?;
    let mut all = FixedMesh { positions_m: Vec::new(), triangles: Vec::new() };
    for part in mesh.submeshes {
        let first = u32::try_from(all.positions_m.len()).ok()?;
        all.positions_m.extend(part.positions_m);
        all.triangles.extend(part.triangles.iter().map(|corners| corners.map(|it| it + first)));
    }
    Some(all)
}

fn name_of(scene: &RenderScene, instance: u32) -> String {
    let hit =
        Hit { distance_m: 0.0, normal: DVec3::ZERO, instance: InstanceId(instance), primitive: 0 };
    let surface = scene.surface(&hit);
    format!("{}::{}::{}", surface.model, surface.link, surface.name)
}
