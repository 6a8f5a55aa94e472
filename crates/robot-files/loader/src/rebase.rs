//! Relative URIs for another folder.

use std::path::{Component, Path, PathBuf};

use periplus_diagnostics::{Origin, SourceMap};
use periplus_resources::without_dots;
use periplus_scene::{Scene, Shape};

use crate::setting::mentioned_in;
use crate::shapes::for_each_shape;

/// Rewrites the relative URIs of meshes and images for a file to be written to `folder`. Each is relative
/// to the file that contains it, and a conversion puts all of them into one file.
pub fn rebase(scene: &mut Scene, sources: &SourceMap, working_folder: &Path, folder: &Path) {
    let rebase = Rebase { sources, working_folder, folder };
    for_each_shape(scene, &mut |shape, _| match shape {
        Shape::Mesh(mesh) => rebase.uri(&mut mesh.uri, mesh.origin),
        Shape::Heightmap(heightmap) => rebase.uri(&mut heightmap.uri, heightmap.origin),
        Shape::Image(image) => rebase.uri(&mut image.uri, image.origin),
        _ => {}
    });
}

struct Rebase<'a> {
    sources: &'a SourceMap,
    working_folder: &'a Path,
    folder: &'a Path,
}

impl Rebase<'_> {
    fn uri(&self, uri: &mut String, origin: Origin) {
        if origin.0.is_none()
            || uri.is_empty()
            || uri.contains("://")
            || Path::new(uri.as_str()).is_absolute()
        {
            return;
        }
        let mentioned_in = mentioned_in(origin, self.sources, self.working_folder);
        let Some(from) = mentioned_in.parent() else { return };
        if without_dots(from) == without_dots(self.folder) {
            return;
        }
        let target = without_dots(&from.join(uri.as_str()));
        *uri = relative(&target, &without_dots(self.folder)).display().to_string();
    }
}

/// Relative path from a folder to a file.
fn relative(file: &Path, folder: &Path) -> PathBuf {
    let shared = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(file.components().skip(shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_from_one_folder_to_another() {
        let way = |file: &str, folder: &str| relative(Path::new(file), Path::new(folder));
        assert_eq!(way("/a/b/m.stl", "/a/b"), PathBuf::from("m.stl"));
        assert_eq!(way("/a/models/cup/m.stl", "/a/worlds"), PathBuf::from("../models/cup/m.stl"));
        assert_eq!(without_dots(Path::new("/a/b/../c/./d")), PathBuf::from("/a/c/d"));
    }
}
