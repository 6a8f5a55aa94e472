//! The suite of scenarios in the folder `scenarios`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, build_program, root, run};

/// Scenarios that are repeated: one of mapping, costmaps and navigation each, and two with faults.
const REPEATED: [&str; 5] = [
    "mapping_demo_room",
    "localization_moved_furniture",
    "costmap_box_appears",
    "navigation_demo_room",
    "navigation_lost_scans",
];

/// End of the names of scenarios.
const ENDING: &str = ".scenario.yaml";

/// Runs the suite, or with several repetitions five scenarios of it, each that many times.
pub(crate) fn suite(repeat: u32, only: Option<&str>) -> Result<(), Failed> {
    build_program()?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| root().join("target"));
    let folder = root().join("scenarios");
    let entries = fs::read_dir(&folder).map_err(|error| Failed(error.to_string()))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|path| is_chosen(path, repeat, only));
    files.sort();
    if files.is_empty() {
        return Err(Failed("no scenario has such a name".to_owned()));
    }
    let mut program = Command::new(target.join("release/periplus"));
    program.arg("scenario").args(&files).arg("--repeat").arg(repeat.to_string());
    program.arg("--artifacts").arg(target.join("scenario-artifacts")).current_dir(root());
    run(&mut program, "the artifacts are in target/scenario-artifacts")
}

fn is_chosen(path: &Path, repeat: u32, only: Option<&str>) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let Some(name) = name.strip_suffix(ENDING) else { return false };
    (repeat == 1 || REPEATED.contains(&name)) && only.is_none_or(|part| name.contains(part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repeated_scenarios_exist() {
        for name in REPEATED {
            assert!(root().join("scenarios").join(format!("{name}{ENDING}")).is_file(), "{name}");
        }
    }
}
