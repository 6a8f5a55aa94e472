//! The places where packages and models are looked for, in their order.

use std::path::{Path, PathBuf};

use crate::host::Host;

/// A folder and how it is searched.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    pub(crate) folder: PathBuf,
    pub(crate) how: How,
}

/// How a folder is searched for a package or model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum How {
    /// As a path of Gazebo's: `FOLDER/name`.
    Children,
    /// As an install prefix: `FOLDER/share/name`.
    Prefix,
    /// As a workspace: itself, and `name`, `models/name`, `src/name` in it.
    Workspace,
    /// All folders to a depth, for a `package.xml` with the name.
    Tree(usize),
}

/// Variables of the environment whose entries are searched as Gazebo searches them: `ENTRY/name`.
pub const SEARCH_VARIABLES: [&str; 7] = [
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
    "GZ_FILE_PATH",
    "IGN_FILE_PATH",
];

/// How deep packages lie below an entry of `ROS_PACKAGE_PATH`.
const ROS_DEPTH: usize = 4;
/// How deep packages lie below a folder above the mentioning file.
const UPWARD_DEPTH: usize = 3;
/// How deep packages lie below the folder of a workspace: clone, group, stack, package.
const WORKSPACE_DEPTH: usize = 5;

/// The places that do not depend on who asks: `--resource-path`, then the variables.
pub(crate) fn fixed(host: &dyn Host, extra: &[PathBuf]) -> Vec<Place> {
    let mut places = Vec::new();
    let mut add = |folder: PathBuf, how| {
        // What does not exist stays in the list: whoever mistyped it shall see it among the
        // places tried.
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
    // Where Classic keeps the models it fetched; it always looks there.
    if let Some(home) = host.variable("HOME").filter(|home| !home.is_empty()) {
        let models = Path::new(&home).join(".gazebo/models");
        if host.kind(&models).is_some() {
            add(models, How::Children);
        }
    }
    places
}

/// The places upward from a mentioning file, given its folder and those above it.
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
        // Not through the whole machine, nor through /usr or /home because a file lies there.
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
