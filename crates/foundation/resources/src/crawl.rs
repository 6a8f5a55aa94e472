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
const IGNORE_MARKS: [&str; 3] = ["COLCON_IGNORE", CATKIN_MARK, "AMENT_IGNORE"];
/// The only one of them that catkin reads. Branches of both generations hide their packages of ROS 1 from colcon.
const CATKIN_MARK: &str = "CATKIN_IGNORE";
/// Files that make a folder a package: of catkin, ament and colcon, and of rosbuild.
const MANIFESTS: [&str; 2] = ["package.xml", "manifest.xml"];

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
            let is_ignored = IGNORE_MARKS.into_iter().any(holds);
            let manifest =
                MANIFESTS.into_iter().any(holds).then(|| manifest::in_folder(host, &folder));
            if let Some(manifest) = manifest.flatten() {
                // As in colcon and catkin, a package contains no other packages.
                if !is_ignored || (manifest.is_ros1 && !holds(CATKIN_MARK)) {
                    note_package(host, &folder, manifest, &mut found);
                }
                continue;
            }
            if is_ignored {
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

/// Adds a package.
fn note_package(host: &dyn Host, folder: &Path, mut manifest: PackageManifest, found: &mut Crawl) {
    manifest.gazebo_paths.extend(hooks::paths(host, folder, &manifest.name));
    found.packages.entry(manifest.name.clone()).or_default().push(folder.to_path_buf());
    if !manifest.gazebo_paths.is_empty() {
        found.exports.push((folder.to_path_buf(), manifest));
    }
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

    #[test]
    fn catkin_reads_its_own_marker_alone() {
        let ros1 = |name: &str| {
            format!(
                "<package><name>{name}</name><buildtool_depend>catkin</buildtool_depend></package>"
            )
        };
        let host = MemoryHost::new()
            .with_file("/w/shown/package.xml", ros1("shown"))
            .with_file("/w/shown/COLCON_IGNORE", "")
            .with_file("/w/hidden/package.xml", ros1("hidden"))
            .with_file("/w/hidden/CATKIN_IGNORE", "");
        let found = crawl(&host, Path::new("/w"), 3);
        assert_eq!(found.packages.keys().collect::<Vec<_>>(), ["shown"]);
    }

    #[test]
    fn a_package_of_rosbuild_has_the_name_of_its_folder() {
        let host = MemoryHost::new()
            .with_file("/w/basics/manifest.xml", "<package><description>x</description></package>")
            .with_file("/w/models/manifest.xml", "<gazebo><models/></gazebo>");
        let found = crawl(&host, Path::new("/w"), 3);
        assert_eq!(found.packages.keys().collect::<Vec<_>>(), ["basics"]);
    }
}
