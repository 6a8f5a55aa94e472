//! Paths without `.` and `..`.

use std::path::{Component, Path, PathBuf};

/// Returns the path without `.` and `..`; links are not followed. Each `..` removes the part before it.
///
/// ```
/// use std::path::Path;
///
/// use periplus_resources::without_dots;
///
/// assert_eq!(without_dots(Path::new("/a/b/../c/./d")), Path::new("/a/c/d"));
/// ```
#[must_use]
pub fn without_dots(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                out.pop();
            }
            other => out.push(other),
        }
    }
    out
}
