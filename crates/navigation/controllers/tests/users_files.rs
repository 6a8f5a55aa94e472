//! Stock files of Nav2 and files of users load without a wrong complaint.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a test that reads files"
)]

use std::fs;
use std::path::{Path, PathBuf};

use periplus_controllers::{
    GivenParameters, PluginSetup, ProgressChecker, create_controller, create_goal_checker,
    create_path_handler,
};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, Severity, SourceMap};
use periplus_params::Given;
use periplus_yaml::{YamlNode, YamlValue};

/// Right complaints: leftovers of a rotation shim in a group of DWB.
const RIGHT: [&str; 5] = [
    "DWB has no parameter `angular_dist_threshold`",
    "DWB has no parameter `forward_sampling_distance`",
    "DWB has no parameter `rotate_to_heading_angular_vel`",
    "DWB has no parameter `max_angular_accel`",
    "DWB has no parameter `simulate_ahead_time`",
];

fn written(value: &YamlNode) -> Option<String> {
    match &value.value {
        YamlValue::Scalar { text, .. } => Some(text.clone()),
        YamlValue::List(list) => {
            let items: Vec<String> = list.iter().filter_map(written).collect();
            Some(format!("[{}]", items.join(", ")))
        }
        YamlValue::Map(_) => None,
    }
}

fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<(String, String)>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let Some(key) = key.text() else { continue };
        let name = if prefix.is_empty() { key.to_owned() } else { format!("{prefix}.{key}") };
        match written(value) {
            Some(text) => flat.push((name, text)),
            None => flatten(value, &name, flat),
        }
    }
}

fn controller_server(root: &YamlNode) -> Vec<(String, String)> {
    let mut flat = Vec::new();
    if let Some(parameters) =
        root.get("controller_server").and_then(|node| node.get("ros__parameters"))
    {
        flatten(parameters, "", &mut flat);
    }
    flat
}

fn names(parameters: &[(String, String)], lists: &[&str]) -> Vec<String> {
    let list = parameters.iter().find(|(name, _)| lists.contains(&name.as_str()));
    let text = list.map(|(_, text)| text.trim_matches(['[', ']'])).unwrap_or_default();
    text.split(", ").filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

/// Creates all plugins of a file, and returns the number of them.
fn check(path: &Path, release: Nav2Release) -> usize {
    let text = fs::read_to_string(path).unwrap();
    let mut sources = SourceMap::new();
    let file = sources.add(path.to_string_lossy(), text);
    let root = periplus_yaml::parse(file, &sources).unwrap().unwrap();
    let parameters = controller_server(&root);
    let given: Vec<Given<'_>> =
        parameters.iter().map(|(name, text)| Given::new(name, text.as_str())).collect();
    let mut diagnostics = Diagnostics::new();
    let mut count = 0;
    let kinds: [(&[&str], u8); 4] = [
        (&["controller_plugins"], 0),
        (&["goal_checker_plugins"], 1),
        (&["progress_checker_plugins", "progress_checker_plugin"], 2),
        (&["path_handler_plugins"], 3),
    ];
    for (lists, kind) in kinds {
        for name in names(&parameters, lists) {
            let setup = PluginSetup {
                release,
                given: GivenParameters::of_group(&given, &name),
                ..PluginSetup::new(&name)
            };
            let Some(class) = setup.given.text("plugin").map(str::to_owned) else { continue };
            let is_created = match kind {
                0 if !periplus_controllers::controller_classes().any(|known| known == class) => {
                    assert!(class.contains("MPPI"), "{}: {class}", path.display());
                    continue;
                }
                0 => create_controller(&class, &setup, &mut diagnostics).is_some(),
                1 => create_goal_checker(&class, &setup, &mut diagnostics).is_some(),
                2 => ProgressChecker::create(&class, &setup, &mut diagnostics).is_some(),
                _ => create_path_handler(&class, &setup, &mut diagnostics).is_some(),
            };
            assert!(is_created, "{}: `{name}`: {diagnostics:?}", path.display());
            count += 1;
        }
    }
    for finding in diagnostics.iter().filter(|finding| finding.severity > Severity::Hint) {
        let is_right =
            path.ends_with("linorobot2.yaml") && RIGHT.contains(&finding.message.as_str());
        assert!(is_right, "{}: {}", path.display(), finding.message);
    }
    count
}

fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/nav").join(folder);
    let Ok(entries) = fs::read_dir(&root) else {
        println!("SKIPPED: there are no files in {}", root.display());
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

#[test]
fn stock_files_load() {
    for path in files("bringup") {
        let release = match path.to_string_lossy() {
            name if name.contains("humble") => Nav2Release::Humble,
            name if name.contains("jazzy") => Nav2Release::Jazzy,
            _ => Nav2Release::Main,
        };
        let count = check(&path, release);
        assert!(count >= 2, "{}: {count} plugins", path.display());
    }
}

#[test]
fn files_of_users_load() {
    for path in files("params") {
        let count = check(&path, Nav2Release::Jazzy);
        assert!(count >= 2, "{}: {count} plugins", path.display());
    }
}
