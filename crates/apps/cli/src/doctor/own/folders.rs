//! Folders of robots and worlds, and search paths of the environment.

use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::{EntryKind, Host, SEARCH_VARIABLES};

use super::SelfCheck;
use crate::terminal;

/// Folders of examples in the sources and in archives.
const EXAMPLES: [&str; 2] = ["robots", "worlds"];

/// Search paths of ROS, beside those of Gazebo.
const ROS_VARIABLES: [&str; 2] = ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"];

pub(super) fn all() -> [SelfCheck; 2] {
    let program = crate::own_command::own_command().first().map(PathBuf::from);
    let beside = program.as_deref().and_then(Path::parent).map(Path::to_path_buf);
    let mut starts = vec![terminal::working_folder()];
    starts.extend(beside);
    [examples(&Machine, &starts), search_paths(&Machine)]
}

/// Robots and worlds of the archive or the sources: in the working folder or above it, or beside the program.
fn examples(host: &dyn Host, starts: &[PathBuf]) -> SelfCheck {
    let is_folder = |path: &Path| host.kind(path) == Some(EntryKind::Folder);
    let has_all = |folder: &&Path| EXAMPLES.iter().all(|name| is_folder(&folder.join(name)));
    let found = starts.iter().flat_map(|start| start.ancestors()).find(has_all);
    match found {
        Some(folder) => {
            SelfCheck::ok("examples", format!("robots and worlds in {}", folder.display()))
        }
        None => SelfCheck::ok(
            "examples",
            "no folder with robots and worlds here or above; `periplus demo` and `periplus new` need none",
        ),
    }
}

/// Entries of search paths that are no folders.
fn search_paths(host: &dyn Host) -> SelfCheck {
    let (mut count, mut missing) = (0, Vec::new());
    for name in SEARCH_VARIABLES.into_iter().chain(ROS_VARIABLES) {
        let value = host.variable(name).unwrap_or_default();
        for folder in std::env::split_paths(&value).filter(|it| !it.as_os_str().is_empty()) {
            count += 1;
            if host.kind(&folder) != Some(EntryKind::Folder) {
                missing.push(format!("{} ({name})", folder.display()));
            }
        }
    }
    match (count, missing.len()) {
        (0, _) => SelfCheck::ok("search paths", "none are set, and none are needed"),
        (_, 0) => SelfCheck::ok("search paths", format!("all {count} folders exist")),
        _ => SelfCheck::warning(
            "search paths",
            format!("{} of {count} folders do not exist: {}", missing.len(), missing.join(", ")),
            "correct the variables, or remove the folders from them",
        ),
    }
}

#[cfg(test)]
mod tests {
    use periplus_resources::MemoryHost;

    use super::super::CheckStatus;
    use super::*;

    #[test]
    fn examples_are_found_above_the_working_folder() {
        let host =
            MemoryHost::new().with_file("/p/robots/a.urdf", "").with_file("/p/worlds/b.sdf", "");
        let check = examples(&host, &["/p/my/folder".into()]);
        assert!(check.found.ends_with(" in /p"), "{check:?}");
        let check = examples(&host, &["/elsewhere".into()]);
        assert!(check.found.starts_with("no folder"), "{check:?}");
    }

    #[cfg(unix)]
    #[test]
    fn a_mistyped_search_path_is_reported() {
        let host = MemoryHost::new().with_file("/models/box/model.sdf", "");
        let set = |value| host.clone().with_variable("GAZEBO_MODEL_PATH", value);
        assert_eq!(search_paths(&set("/models")).status, CheckStatus::Ok);
        let check = search_paths(&set("/models:/modles"));
        assert_eq!(check.status, CheckStatus::Warning);
        assert!(check.found.starts_with("1 of 2 folders do not exist: /modles "), "{check:?}");
    }
}
