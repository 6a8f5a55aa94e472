//! Location of a referring file: its folders, its project, and the folders above.

use std::path::{Path, PathBuf};

use crate::host::{EntryKind, Host};
use crate::places::{self, Place};

/// Maximum number of folders in the upward search.
const MAX_PARENT_FOLDERS: usize = 8;

/// Folders visible to a file that contains URIs. All paths are canonical where possible.
#[derive(Debug)]
pub(crate) struct Surroundings {
    /// Index within one resolver.
    pub(crate) id: usize,
    /// Folder of the file as named, then (if the file is a link) that of the file itself.
    pub(crate) folders: Vec<PathBuf>,
    /// Project folder; relative paths may not leave it.
    pub(crate) project: PathBuf,
    /// The file's folder and those above it, nearest first, up to the repository.
    pub(crate) upward: Vec<PathBuf>,
    /// Those of `upward` whose folder name alone identifies the package around the file; not a home folder
    /// or one above it.
    pub(crate) eponyms: Vec<PathBuf>,
    /// Search paths for packages and models above the file.
    pub(crate) places: Vec<Place>,
}

pub(crate) fn surroundings(host: &dyn Host, from: &Path, id: usize) -> Surroundings {
    let canonical = |path: &Path| host.canonical(path).unwrap_or_else(|| path.to_path_buf());
    let parent = |path: &Path| match path.parent() {
        None => path.to_path_buf(),
        Some(parent) if parent.as_os_str().is_empty() => PathBuf::from("."),
        Some(parent) => parent.to_path_buf(),
    };
    let (named, real) = match host.kind(from) {
        Some(EntryKind::Folder) => (canonical(from), canonical(from)),
        _ => (canonical(&parent(from)), parent(&canonical(from))),
    };
    let real = canonical(&real);
    let (project, upward) = project(host, &real);
    let mut folders = vec![named, real.clone()];
    folders.dedup();
    let home = home(host);
    let places = places::upward(&upward, &project, &workspaces(host, &real, home.as_deref()));
    let holds_home = |up: &Path| home.as_ref().is_some_and(|home| home.starts_with(up));
    let may_be_named = |up: &&PathBuf| up.components().count() > 2 && !holds_home(up);
    let eponyms = upward.iter().filter(may_be_named).cloned().collect();
    Surroundings { id, folders, project, upward, eponyms, places }
}

fn home(host: &dyn Host) -> Option<PathBuf> {
    let home = host.variable("HOME").filter(|home| !home.is_empty())?;
    Some(host.canonical(Path::new(&home)).unwrap_or_else(|| home.into()))
}

/// Project of a folder: the repository around it, else the folder that contains its package or model, else
/// the folder above it; and the folders to search upward.
fn project(host: &dyn Host, folder: &Path) -> (PathBuf, Vec<PathBuf>) {
    let mut upward: Vec<PathBuf> =
        folder.ancestors().take(MAX_PARENT_FOLDERS).map(Path::to_path_buf).collect();
    let holding = |mark: &str| upward.iter().position(|up| host.kind(&up.join(mark)).is_some());
    if let Some(level) = holding(".git") {
        upward.truncate(level + 1);
        return (upward[level].clone(), upward);
    }
    let home = home(host);
    let above = |up: &Path| {
        // Folders next to a home folder, or anywhere on the machine, have no common project.
        let is_home = home.as_deref() == Some(up);
        up.parent().filter(|above| above.parent().is_some() && !is_home).unwrap_or(up).to_path_buf()
    };
    let owner = holding("package.xml").or_else(|| holding("model.config"));
    let project = above(owner.map_or(folder, |level| &upward[level]));
    (project, upward)
}

/// Folders that a build tool creates next to `src`.
const BUILT: [&str; 6] = ["install", "devel", "build", "log", ".catkin_workspace", ".catkin_tools"];

/// Source folders of the workspaces around a folder, nearest first: each `src` above it, and each folder
/// with build output. Clones next to each other there are visible to each other, as in colcon and catkin.
fn workspaces(host: &dyn Host, folder: &Path, home: Option<&Path>) -> Vec<PathBuf> {
    // A home folder is not a workspace, nor is a system folder.
    let may_be = |up: &&Path| up.components().count() > 2 && Some(*up) != home;
    let is_workspace = |up: &&Path| {
        let is_src = up.file_name().is_some_and(|name| name == "src");
        let built = BUILT.iter().filter(|name| host.kind(&up.join(name)).is_some()).count();
        // A repository may have its own `build`; a workspace has at least two of them.
        is_src || built >= 2
    };
    let above = folder.ancestors().take(MAX_PARENT_FOLDERS);
    above.filter(may_be).filter(is_workspace).map(Path::to_path_buf).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MemoryHost;

    fn check(files: &[&str], from: &str, project: &str) {
        let host = files.iter().fold(MemoryHost::new(), |host, file| host.with_file(file, ""));
        let host = host.with_file(from, "").with_variable("HOME", "/home/ada");
        assert_eq!(surroundings(&host, Path::new(from), 0).project, Path::new(project));
    }

    #[test]
    fn the_project_is_the_repository_else_around_the_package_else_around_the_file() {
        check(&["/w/r/.git/HEAD", "/w/r/p/package.xml"], "/w/r/p/urdf/a.urdf", "/w/r");
        check(&["/w/r/p/package.xml"], "/w/r/p/urdf/a.urdf", "/w/r");
        check(&["/w/models/m/model.config"], "/w/models/m/model.sdf", "/w/models");
        check(&[], "/w/r/p/urdf/a.urdf", "/w/r/p");
        check(&[], "/home/ada/a.urdf", "/home/ada");
        check(&[], "/w/a.urdf", "/w");
    }
}
