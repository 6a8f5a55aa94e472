//! Search for ROS packages in a tree of folders.

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};

use crate::hooks;
use crate::host::{EntryKind, Host};
use crate::manifest::{self, PackageManifest};

/// Maximum number of folders that a crawl visits.
const MAX_FOLDERS: usize = 4_000;
/// Maximum number of names that a crawl checks.
const MAX_NAMES: usize = 50_000;

/// Folders without sources.
const SKIPPED: [&str; 5] = ["build", "install", "log", "node_modules", "target"];
/// Files that exclude a folder from ROS's own tools.
const IGNORE_MARKS: [&str; 3] = ["COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"];

/// Packages below a folder.
#[derive(Debug, Default)]
pub(crate) struct Crawl {
    /// Folders by package name, nearest first, then by name.
    pub(crate) packages: BTreeMap<String, Vec<PathBuf>>,
    /// Folders and the exports of their packages.
    pub(crate) exports: Vec<(PathBuf, PackageManifest)>,
    /// True if a limit ended the crawl.
    pub(crate) cut_short: bool,
}

/// Finds all packages at most `depth` folders below `top`, `top` itself not counted. Breadth first, in the
/// order of names.
pub(crate) fn crawl(host: &dyn Host, top: &Path, depth: usize) -> Crawl {
    let mut found = Crawl::default();
    let mut waiting = VecDeque::from([(top.to_path_buf(), 0)]);
    let (mut folders, mut asked) = (0, 0);
    while let Some((folder, level)) = waiting.pop_front() {
        folders += 1;
        let names = host.list(&folder);
        asked += names.len();
        if folders > MAX_FOLDERS || asked > MAX_NAMES {
            found.cut_short = true;
            break;
        }
        let holds = |wanted: &str| names.iter().any(|name| name == wanted);
        if level > 0 {
            if IGNORE_MARKS.into_iter().any(holds) {
                continue;
            }
            // As in colcon and catkin, a package contains no other packages.
            if holds("package.xml") && note_package(host, &folder, &mut found) {
                continue;
            }
        }
        if level == depth {
            continue;
        }
        let inner = names
            .iter()
            .filter(|name| !name.starts_with('.') && !SKIPPED.contains(&name.as_str()))
            .map(|name| folder.join(name))
            .filter(|path| host.kind(path) == Some(EntryKind::Folder));
        waiting.extend(inner.map(|path| (path, level + 1)));
    }
    found
}

/// Returns true for a folder whose `package.xml` has a name.
fn note_package(host: &dyn Host, folder: &Path, found: &mut Crawl) -> bool {
    let Ok(bytes) = host.read(&folder.join("package.xml")) else { return false };
    let mut manifest = manifest::package(&bytes);
    if manifest.name.is_empty() {
        return false;
    }
    manifest.gazebo_paths.extend(hooks::paths(host, folder, &manifest.name));
    found.packages.entry(manifest.name.clone()).or_default().push(folder.to_path_buf());
    if !manifest.gazebo_paths.is_empty() {
        found.exports.push((folder.to_path_buf(), manifest));
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MemoryHost;

    #[test]
    fn packages_are_found_by_their_own_name_to_a_depth() {
        let manifest = "<package><name>bot</name></package>";
        let host = MemoryHost::new()
            .with_file("/w/z/package.xml", manifest)
            .with_file("/w/a/b/package.xml", manifest)
            .with_file("/w/a/b/c/d/package.xml", manifest)
            .with_file("/w/install/bot/package.xml", manifest)
            .with_file("/w/old/COLCON_IGNORE", "")
            .with_file("/w/old/package.xml", manifest)
            .with_file("/w/z/inner/package.xml", manifest);
        let found = crawl(&host, Path::new("/w"), 3);
        assert_eq!(found.packages["bot"], [Path::new("/w/z"), Path::new("/w/a/b")]);
        assert!(!found.cut_short);
    }
}
