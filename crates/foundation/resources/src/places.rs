//! Search paths of packages and models, in order.

use std::path::{Path, PathBuf};

use crate::host::Host;

/// Folder and its type of search.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    pub(crate) folder: PathBuf,
    pub(crate) how: How,
}

/// Type of search in a folder for a package or model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum How {
    /// As a path of Gazebo: `FOLDER/name`.
    Children,
    /// As an install prefix: `FOLDER/share/name`.
    Prefix,
    /// As a workspace: the folder itself, and `name`, `models/name`, `src/name` in it.
    Workspace,
    /// All folders up to a depth, for a `package.xml` with the name.
    Tree(usize),
}

/// Environment variables whose entries are searched as in Gazebo: `ENTRY/name`.
pub const SEARCH_VARIABLES: [&str; 7] = [
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
    "GZ_FILE_PATH",
    "IGN_FILE_PATH",
];

/// Maximum depth of packages below an entry of `ROS_PACKAGE_PATH`.
const ROS_DEPTH: usize = 4;
/// Maximum depth of packages below a folder above the referring file.
const UPWARD_DEPTH: usize = 3;
/// Maximum depth of packages below the folder of a workspace: clone, group, stack, package.
const WORKSPACE_DEPTH: usize = 5;

/// Search paths that do not depend on the referring file: `--resource-path`, then the variables.
pub(crate) fn fixed(host: &dyn Host, extra: &[PathBuf]) -> Vec<Place> {
    let mut places = Vec::new();
    let mut add = |folder: PathBuf, how| {
        // Folders that do not exist stay in the list, so that a mistyped one is shown among the searched
        // paths.
        let folder = host.canonical(&folder).unwrap_or(folder);
        let place = Place { folder, how };
        if !places.contains(&place) {
            places.push(place);
        }
    };
    for folder in extra {
        add(folder.clone(), How::Workspace);
        add(folder.clone(), How::Tree(WORKSPACE_DEPTH));
    }
    let entries = |variable: &str| -> Vec<PathBuf> {
        let value = host.variable(variable).unwrap_or_default();
        value.split(':').filter(|entry| !entry.is_empty()).map(PathBuf::from).collect()
    };
    for variable in SEARCH_VARIABLES {
        for folder in entries(variable) {
            add(folder, How::Children);
        }
    }
    for folder in entries("ROS_PACKAGE_PATH") {
        add(folder.clone(), How::Workspace);
        add(folder, How::Tree(ROS_DEPTH));
    }
    for folder in entries("AMENT_PREFIX_PATH") {
        add(folder, How::Prefix);
    }
    // Gazebo Classic keeps downloaded models here and always searches it.
    if let Some(home) = host.variable("HOME").filter(|home| !home.is_empty()) {
        let models = Path::new(&home).join(".gazebo/models");
        if host.kind(&models).is_some() {
            add(models, How::Children);
        }
    }
    places
}

/// Search paths above a referring file, given its folder and the folders above it.
pub(crate) fn upward(folders: &[PathBuf], project: &Path, workspaces: &[PathBuf]) -> Vec<Place> {
    let mut places = Vec::new();
    for folder in folders {
        let depth = folder.components().count().saturating_sub(1);
        let place = |how| Place { folder: folder.clone(), how };
        let outside = !folder.starts_with(project);
        if outside && depth == 0 {
            continue;
        }
        places.push(place(How::Workspace));
        // Not the whole machine, nor /usr or /home because a file is in it.
        if depth > usize::from(outside) {
            let is_workspace = workspaces.contains(folder);
            let depth = if is_workspace { WORKSPACE_DEPTH } else { UPWARD_DEPTH };
            places.push(place(How::Tree(depth)));
        }
    }
    for folder in workspaces.iter().filter(|folder| !folders.contains(folder)) {
        let place = |how| Place { folder: folder.clone(), how };
        places.extend([place(How::Workspace), place(How::Tree(WORKSPACE_DEPTH))]);
    }
    places
}
