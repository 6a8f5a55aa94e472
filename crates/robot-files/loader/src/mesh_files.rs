//! Mesh files: references in a scene, and files loaded directly.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap, closest};
use periplus_meshes::{MeshFormat, read};
use periplus_resources::Host;
use periplus_scene::{MeshShape, Scene, Shape};
use serde::Serialize;

use crate::setting::{LoadContext, mentioned_in, shown};
use crate::shapes::for_each_shape;

/// Content of a mesh file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshSummary {
    /// `Stl`, `Obj`, `Collada` or `Gltf`.
    pub format: String,
    /// Names of its parts, in order.
    pub submeshes: Vec<String>,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Extent along x, y, z [m].
    pub size_m: [f64; 3],
}

/// Returns true if a path has the extension of a mesh file.
pub(crate) fn is_mesh(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    ["stl", "obj", "dae", "gltf", "glb"].iter().any(|known| extension.eq_ignore_ascii_case(known))
}

/// Loads a mesh file directly.
pub(crate) fn summarise(
    path: &Path,
    bytes: &[u8],
    setting: &LoadContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<MeshSummary> {
    let name = shown(path, &setting.working_folder);
    match open(path, bytes, setting.host) {
        Ok((summary, notes)) => {
            for note in notes {
                diagnostics.push(Diagnostic::hint("mesh", format!("`{name}`: {note}")));
            }
            Some(summary)
        }
        Err((message, help)) => {
            diagnostics.push(Diagnostic::error("mesh", format!("`{name}`: {message}")).help(help));
            None
        }
    }
}

/// Resolves and checks the files of the meshes and heightmaps of a scene. A missing or broken file is a
/// warning: the rest of the scene is still usable.
pub(crate) fn resolve(
    scene: &mut Scene,
    setting: &LoadContext<'_>,
    sources: &SourceMap,
    diagnostics: &mut Diagnostics,
) {
    let mut look = Look { setting, sources, diagnostics, seen: BTreeMap::new() };
    for_each_shape(scene, &mut |shape, origin| look.shape(shape, origin));
}

type Parts = Result<Vec<String>, ()>;

struct Look<'l, 'a> {
    setting: &'l LoadContext<'a>,
    sources: &'l SourceMap,
    diagnostics: &'l mut Diagnostics,
    /// Parts of each file; a broken one has been reported.
    seen: BTreeMap<PathBuf, Parts>,
}

impl Look<'_, '_> {
    fn shape(&mut self, shape: &mut Shape, origin: Origin) {
        match shape {
            Shape::Mesh(mesh) => self.mesh(mesh),
            Shape::Heightmap(heightmap) => heightmap.path = self.find(&heightmap.uri, origin),
            Shape::Image(image) => image.path = self.find(&image.uri, origin),
            _ => {}
        }
    }

    fn mesh(&mut self, mesh: &mut MeshShape) {
        mesh.path = self.find(&mesh.uri, mesh.origin);
        let Some(path) = mesh.path.clone().filter(|_| self.setting.open_meshes) else { return };
        if !self.seen.contains_key(&path) {
            let parts = self.open(&path, mesh.origin);
            self.seen.insert(path.clone(), parts);
        }
        let (Some(Ok(parts)), Some(part)) = (self.seen.get(&path), &mesh.submesh) else { return };
        if !parts.contains(part) {
            let mut diagnostic = Diagnostic::warning(
                "unknown-submesh",
                format!("`{}` has no part named `{part}`", mesh.uri),
            )
            .at(mesh.origin)
            .note(format!("its parts are: {}", parts.join(", ")));
            if let Some(near) = closest(part, parts.iter().map(String::as_str)) {
                diagnostic = diagnostic.help(format!("did you mean `{near}`?"));
            }
            self.diagnostics.push(diagnostic);
        }
    }

    fn open(&mut self, path: &Path, origin: Origin) -> Parts {
        let name = shown(path, &self.setting.working_folder);
        let opened = match self.setting.host.read(path) {
            Ok(bytes) => open(path, &bytes, self.setting.host),
            Err(error) => Err((error.to_string(), "check the file".to_owned())),
        };
        match opened {
            Ok((summary, notes)) => {
                for note in notes {
                    let hint = Diagnostic::hint("mesh", format!("`{name}`: {note}"));
                    self.diagnostics.push(hint.at(origin));
                }
                Ok(summary.submeshes)
            }
            Err((message, help)) => {
                let diagnostic = Diagnostic::warning("mesh", format!("`{name}`: {message}"));
                self.diagnostics.push(diagnostic.at(origin).help(help));
                Err(())
            }
        }
    }

    fn find(&mut self, uri: &str, origin: Origin) -> Option<PathBuf> {
        if uri.is_empty() {
            return None;
        }
        let from = mentioned_in(origin, self.sources, &self.setting.working_folder);
        match self.setting.resolver.resolve(uri, &from) {
            Ok(path) => Some(path),
            Err(miss) => {
                let mut diagnostic = miss.into_diagnostic(origin);
                // The model works without it, with fewer visuals or collisions.
                diagnostic.severity = periplus_diagnostics::Severity::Warning;
                self.diagnostics.push(diagnostic);
                None
            }
        }
    }
}

type OpenedMesh = Result<(MeshSummary, Vec<String>), (String, String)>;

fn open(path: &Path, bytes: &[u8], host: &dyn Host) -> OpenedMesh {
    let (format, mesh) = parse(path, bytes, host)?;
    let summary = MeshSummary {
        format: format!("{format:?}"),
        submeshes: mesh.submeshes.iter().map(|part| part.name.clone()).collect(),
        triangles: mesh.triangle_count(),
        vertices: mesh.vertex_count(),
        size_m: mesh.bounds().map(|bounds| bounds.size_m()).unwrap_or_default(),
    };
    let notes = mesh.notes.iter().map(|note| match note.count {
        1 => note.message.clone(),
        count => format!("{} ({count} times)", note.message),
    });
    Ok((summary, notes.collect()))
}

/// Triangles of a mesh file; `None` for a broken one, which [`crate::load`] reports.
#[must_use]
pub fn read_mesh(path: &Path, bytes: &[u8], host: &dyn Host) -> Option<periplus_meshes::Mesh> {
    parse(path, bytes, host).ok().map(|(_, mesh)| mesh)
}

/// Reads a file that a mesh refers to, such as a texture. It must be in the folder of the mesh or below,
/// because a downloaded mesh is not trusted.
#[must_use]
pub fn read_beside(mesh: &Path, name: &str, host: &dyn Host) -> Option<Vec<u8>> {
    let plain = Path::new(name)
        .components()
        .all(|part| matches!(part, std::path::Component::Normal(_) | std::path::Component::CurDir));
    let folder = mesh.parent().unwrap_or(Path::new(""));
    if plain { host.read(&folder.join(name)).ok() } else { None }
}

type ParsedMesh = Result<(MeshFormat, periplus_meshes::Mesh), (String, String)>;

fn parse(path: &Path, bytes: &[u8], host: &dyn Host) -> ParsedMesh {
    let mut side_files = |name: &str| read_beside(path, name, host);
    MeshFormat::from_path_and_bytes(&path.to_string_lossy(), bytes)
        .and_then(|format| read(bytes, format, &mut side_files).map(|mesh| (format, mesh)))
        .map_err(|error| {
            let place = error.place.map(|place| format!("{place}: ")).unwrap_or_default();
            (format!("{place}{}", error.message), error.help)
        })
}
