//! Files that a page may read: parts of the loaded models.

use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::{Host as _, Resolver};
use periplus_web::foxglove::protocol::AssetError;

use crate::terminal;

/// File types of models. All other files of a project are private.
const KINDS: [&str; 24] = [
    "bin", "bmp", "config", "dae", "gif", "glb", "gltf", "jpeg", "jpg", "material", "mtl", "obj",
    "pgm", "ply", "png", "sdf", "stl", "svg", "tga", "tif", "tiff", "urdf", "world", "xacro",
];

/// A path of a missing file so deep that its surroundings are empty.
const MISSING_FILE: &str = "/.periplus/no/file/was/loaded/so/nothing/is/around/it";

/// Returns files by URI, with the same access rules as for references in the loaded files.
pub(super) fn fetch(
    files: &[PathBuf],
    resource_path: &[PathBuf],
) -> impl Fn(&str) -> Result<Vec<u8>, AssetError> + Send + Sync + use<> {
    let here = terminal::working_folder();
    let folders: Vec<PathBuf> = resource_path.iter().map(|folder| here.join(folder)).collect();
    let mut from: Vec<PathBuf> = files.iter().map(|file| here.join(file)).collect();
    // The surroundings of a file at the root of the disk would be the whole disk.
    from.retain(|file| file.parent().is_some_and(|folder| folder.parent().is_some()));
    if from.is_empty() {
        // Nothing was loaded: only packages and models of the environment are accessible.
        from.push(PathBuf::from(MISSING_FILE));
    }
    move |uri| {
        // A new resolver for each request: it caches, and files change.
        let resolver = Resolver::new(&Machine, &folders);
        let mut missed = None;
        for file in &from {
            match resolver.resolve(uri, file) {
                Ok(path) => return read(uri, &path),
                Err(miss) => missed = missed.or(Some(miss.to_string())),
            }
        }
        Err(missed.unwrap_or_default().into())
    }
}

fn read(uri: &str, path: &Path) -> Result<Vec<u8>, AssetError> {
    let kind = path.extension().map(|kind| kind.to_string_lossy().to_ascii_lowercase());
    if !kind.as_deref().is_some_and(|kind| KINDS.contains(&kind)) {
        let reason = "only meshes, images and descriptions are served";
        return Err(format!("access to `{uri}` denied: {reason}").into());
    }
    Machine.read(path).map_err(|error| format!("`{uri}`: {error}").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Project with a package, and a private file beside it.
    fn project(name: &str) -> PathBuf {
        let root =
            std::env::temp_dir().join(format!("periplus-assets-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&root);
        let put = |path: &str, text: &str| {
            let path = root.join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, text).expect("a file");
        };
        put("ws/.git/config", "[core]");
        put("ws/arm/package.xml", "<package><name>arm</name></package>");
        put("ws/arm/meshes/hand.stl", "solid hand");
        put("ws/arm/secret.key", "key");
        put("ws/room.world", "<sdf/>");
        put("secret.stl", "solid secret");
        #[cfg(unix)]
        std::os::unix::fs::symlink(root.join("secret.stl"), root.join("ws/arm/meshes/out.stl"))
            .expect("a link");
        root
    }

    #[test]
    fn only_what_models_are_made_of_and_only_from_the_project() {
        let root = project("inside");
        let fetch = fetch(&[root.join("ws/room.world")], &[]);
        assert_eq!(fetch("package://arm/meshes/hand.stl"), Ok(b"solid hand".to_vec()));
        let hand = root.join("ws/arm/meshes/hand.stl");
        assert_eq!(fetch(&format!("file://{}", hand.display())), Ok(b"solid hand".to_vec()));
        let outside = format!("file://{}/secret.stl", root.display());
        for uri in [
            "package://arm/../../secret.stl",
            "package://arm/meshes/../../../secret.stl",
            "package://arm/%2e%2e/%2e%2e/secret.stl",
            "package://arm/meshes/out.stl",
            "package://../secret.stl",
            "package:///etc/passwd",
            "model://arm/../../secret.stl",
            "../secret.stl",
            outside.as_str(),
            "file:///etc/passwd",
            "file:///dev/zero",
            "file://../../secret.stl",
            "http://127.0.0.1:1/x.stl",
            "package://arm/secret.key",
            "package://arm/package.xml",
            "package://arm",
            "",
            "package://arm/meshes/hand.stl\0.png",
        ] {
            assert!(fetch(uri).is_err(), "{uri}");
        }
        let _ = std::fs::remove_dir_all(root);
    }

    #[test]
    fn without_a_file_nothing_lies_around_it() {
        let root = project("nothing");
        let fetch = fetch(&[], &[]);
        let hand = root.join("ws/arm/meshes/hand.stl");
        assert!(fetch(&format!("file://{}", hand.display())).is_err());
        let at_the_root = super::fetch(&[PathBuf::from("/room.world")], &[]);
        assert!(at_the_root(&format!("file://{}", hand.display())).is_err());
        let _ = std::fs::remove_dir_all(root);
    }
}
