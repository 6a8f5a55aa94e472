//! Files that a page may have: what the models in a run are made of.

use std::path::{Path, PathBuf};

use periplus_host::Machine;
use periplus_resources::{Host as _, Resolver};

use crate::terminal;

/// What models are made of. A project holds much else that is nobody's business.
const KINDS: [&str; 24] = [
    "bin", "bmp", "config", "dae", "gif", "glb", "gltf", "jpeg", "jpg", "material", "mtl", "obj",
    "pgm", "ply", "png", "sdf", "stl", "svg", "tga", "tif", "tiff", "urdf", "world", "xacro",
];

/// Gives files by their URI as the loaded files themselves could name them, through the same fence.
pub(super) fn fetch(
    files: Vec<PathBuf>,
    resource_path: Vec<PathBuf>,
) -> impl Fn(&str) -> Result<Vec<u8>, String> + Send + Sync {
    let here = terminal::working_folder();
    let folders: Vec<PathBuf> = resource_path.iter().map(|folder| here.join(folder)).collect();
    let mut from: Vec<PathBuf> = files.iter().map(|file| here.join(file)).collect();
    if from.is_empty() {
        // Nothing was loaded: only packages and models that the environment names.
        from.push(PathBuf::from("/"));
    }
    move |uri| {
        // A new one each time: it keeps what it has seen, and files change.
        let resolver = Resolver::new(&Machine, &folders);
        let mut missed = None;
        for file in &from {
            match resolver.resolve(uri, file) {
                Ok(path) => return read(uri, &path),
                Err(miss) => missed = missed.or(Some(miss.to_string())),
            }
        }
        Err(missed.unwrap_or_default())
    }
}

fn read(uri: &str, path: &Path) -> Result<Vec<u8>, String> {
    let kind = path.extension().map(|kind| kind.to_string_lossy().to_ascii_lowercase());
    if !kind.as_deref().is_some_and(|kind| KINDS.contains(&kind)) {
        return Err(format!("`{uri}` is no mesh, picture or description; only these are given"));
    }
    Machine.read(path).map_err(|error| format!("`{uri}`: {error}"))
}
