//! Environment hooks of ROS 2 packages: variables that sourcing an installed workspace would set.
//!
//! Packages install `*.dsv` and `*.sh` files (`ament_environment_hooks`); in a source tree they are
//! templates, `*.dsv.in` and `*.sh.in`. Format of a line in a `.dsv`: `OPERATION;VARIABLE;VALUE...`
//! (colcon, `prepend-non-duplicate` and its relatives), with values relative to the install prefix.

use std::path::Path;

use crate::host::Host;
use crate::places::SEARCH_VARIABLES;

/// Folders of a package with its hooks, in source trees and installed.
const FOLDERS: [&str; 5] = ["hooks", "env-hooks", "env_hooks", "environment", "hook"];

/// Maximum number of hooks of a package that are read.
const MAX_HOOKS: usize = 32;

/// Folders that the hooks of a package add to the search paths of Gazebo, with `${prefix}` for the
/// package's own folder.
pub(crate) fn paths(host: &dyn Host, package: &Path, name: &str) -> Vec<String> {
    let mut paths = Vec::new();
    for folder in FOLDERS.map(|folder| package.join(folder)) {
        for file in host.list(&folder).into_iter().take(MAX_HOOKS) {
            let template = file.strip_suffix(".in").unwrap_or(&file);
            let values = match template.rsplit_once('.') {
                Some((_, "dsv")) => of_dsv as fn(&str) -> Option<(&str, Vec<&str>)>,
                Some((_, "sh")) => of_shell,
                _ => continue,
            };
            let Ok(bytes) = host.read(&folder.join(&file)) else { continue };
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let entries = text.lines().filter_map(values);
            for (_, values) in entries.filter(|(name, _)| SEARCH_VARIABLES.contains(name)) {
                let found = values.into_iter().filter_map(|value| in_package(value, name));
                for path in found.collect::<Vec<_>>() {
                    if !paths.contains(&path) {
                        paths.push(path);
                    }
                }
            }
        }
    }
    paths
}

/// Variable and values of a line of a `.dsv` file.
fn of_dsv(line: &str) -> Option<(&str, Vec<&str>)> {
    let mut words = line.trim().split(';');
    let operation = words.next()?;
    let is_path = ["prepend", "append", "set"].iter().any(|start| operation.starts_with(start));
    let variable = words.next()?;
    is_path.then(|| (variable, words.collect()))
}

/// Variable and value of `ament_prepend_unique_value NAME "VALUE"` and similar functions.
fn of_shell(line: &str) -> Option<(&str, Vec<&str>)> {
    let mut words = line.split_whitespace();
    let is_path = matches!(
        words.next()?,
        "ament_prepend_unique_value" | "ament_append_unique_value" | "ament_append_value"
    );
    let (variable, value) = (words.next()?, words.next()?.trim_matches(['"', '\'']));
    let value = ["$AMENT_CURRENT_PREFIX/", "${AMENT_CURRENT_PREFIX}/"]
        .iter()
        .find_map(|prefix| value.strip_prefix(prefix))?;
    is_path.then(|| (variable, vec![value]))
}

/// Converts a folder below the install prefix to one of the package: `share/NAME` is its own folder.
fn in_package(value: &str, name: &str) -> Option<String> {
    let value = value.trim().replace("@PROJECT_NAME@", name).replace("${PROJECT_NAME}", name);
    let under = value.trim_end_matches('/').strip_prefix("share")?;
    let own = format!("/{name}");
    match under {
        "" => Some("${prefix}/..".to_owned()),
        _ if under == own => Some("${prefix}".to_owned()),
        _ => Some(format!(
            "${{prefix}}{}",
            under.strip_prefix(&own)?.strip_prefix('/').map(|rest| format!("/{rest}"))?
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MemoryHost;

    fn check(file: &str, text: &str, expected: &[&str]) {
        let host = MemoryHost::new().with_file(format!("/w/bot/{file}"), text);
        assert_eq!(paths(&host, Path::new("/w/bot"), "bot"), expected, "{file}: {text}");
    }

    #[test]
    fn templates_and_installed_hooks_name_folders_of_the_package() {
        let line = "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH;share/@PROJECT_NAME@/models";
        check("hooks/bot.dsv.in", line, &["${prefix}/models"]);
        check("environment/bot.dsv", "append-non-duplicate;SDF_PATH;share/bot", &["${prefix}"]);
        let shell = "ament_prepend_unique_value GAZEBO_MODEL_PATH \"$AMENT_CURRENT_PREFIX/share\"";
        check("env-hooks/bot.sh.in", shell, &["${prefix}/.."]);
    }

    #[test]
    fn other_variables_and_other_packages_are_left_alone() {
        check("hooks/a.dsv.in", "prepend-non-duplicate;PATH;share/bot/bin", &[]);
        check("hooks/a.dsv.in", "prepend-non-duplicate;SDF_PATH;share/bottle/models", &[]);
        check("hooks/a.txt", "prepend-non-duplicate;SDF_PATH;share/bot", &[]);
        check("other/a.dsv", "prepend-non-duplicate;SDF_PATH;share/bot", &[]);
    }
}
