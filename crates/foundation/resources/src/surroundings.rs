//! Where a mentioning file lies: its folders, its project, and what is above.

use std::path::{Path, PathBuf};

use crate::host::{Host, Kind};
use crate::places::{self, Place};

/// The search upward stops after this many folders.
const MOST_LEVELS: usize = 8;

/// What a file that mentions URIs can see around itself. All paths are canonical where possible.
#[derive(Debug)]
pub(crate) struct Surroundings {
    /// Distinguishes the surroundings of one resolver.
    pub(crate) id: usize,
    /// The file's folder as named, then (when the file is a link) that of the file itself.
    pub(crate) folders: Vec<PathBuf>,
    /// The folder whose content belongs together; relative paths may not leave it.
    pub(crate) project: PathBuf,
    /// The file's folder and those above it, nearest first, up to the repository.
    pub(crate) upward: Vec<PathBuf>,
    /// Those of `upward` that may be named as the package around the file by their folder's name
    /// alone; not someone's home, or what is above it.
    pub(crate) eponyms: Vec<PathBuf>,
    /// Where to look upward for packages and models.
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
        Some(Kind::Folder) => (canonical(from), canonical(from)),
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

/// The project of a folder: the repository around it, else the folder that holds its package or
/// model, else the folder above it; and the folders to search upward.
fn project(host: &dyn Host, folder: &Path) -> (PathBuf, Vec<PathBuf>) {
    let mut upward: Vec<PathBuf> =
        folder.ancestors().take(MOST_LEVELS).map(Path::to_path_buf).collect();
    let holding = |mark: &str| upward.iter().position(|up| host.kind(&up.join(mark)).is_some());
    if let Some(level) = holding(".git") {
        upward.truncate(level + 1);
        return (upward[level].clone(), upward);
    }
    let home = home(host);
    let above = |up: &Path| {
        // What lies beside someone's home, or anywhere on the machine, is not of one project.
        let is_home = home.as_deref() == Some(up);
        up.parent().filter(|above| above.parent().is_some() && !is_home).unwrap_or(up).to_path_buf()
    };
    let owner = holding("package.xml").or_else(|| holding("model.config"));
    let project = above(owner.map_or(folder, |level| &upward[level]));
    (project, upward)
}

/// Folders that a build tool writes beside `src`.
const BUILT: [&str; 6] = ["install", "devel", "build", "log", ".catkin_workspace", ".catkin_tools"];

/// The folders of sources of the workspaces around a folder, nearest first: each `src` above it, and
/// each folder in which something was built. Clones that lie beside each other there see each other, as
/// for colcon and catkin.
fn workspaces(host: &dyn Host, folder: &Path, home: Option<&Path>) -> Vec<PathBuf> {
    // Nobody's home is a workspace, nor is a folder of the system's.
    let may_be = |up: &&Path| up.components().count() > 2 && Some(*up) != home;
    let is_workspace = |up: &&Path| {
        let is_src = up.file_name().is_some_and(|name| name == "src");
        let built = BUILT.iter().filter(|name| host.kind(&up.join(name)).is_some()).count();
        // A repository has a `build` of its own; a workspace has two of them at least.
        is_src || built >= 2
    };
    let above = folder.ancestors().take(MOST_LEVELS);
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
