//! Insertable models.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::{EntryKind, Host};
use serde_json::json;

/// Maximum number of searched folders; a resource path may contain a whole disk.
const MAX_FOLDER_COUNT: usize = 20_000;

/// Gazebo's environment variables for model folders.
const VARIABLES: [&str; 4] =
    ["GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH", "GAZEBO_MODEL_PATH"];

/// Returns a list of `{"name", "uri", "path"}` as JSON, by name: every model in the folders and on
/// the paths of the environment. The first of equal names counts, as for `model://`.
pub(super) fn models(folders: &[PathBuf]) -> String {
    let named = VARIABLES.iter().filter_map(|name| Machine.variable(name));
    let named: Vec<PathBuf> =
        named.flat_map(|value| std::env::split_paths(&value).collect::<Vec<_>>()).collect();
    let home = Machine.variable("HOME").map(|home| Path::new(&home).join(".gazebo/models"));
    let mut found: BTreeMap<String, PathBuf> = BTreeMap::new();
    let mut looks = 0;
    for folder in folders.iter().chain(&named).chain(&home) {
        look(folder, &mut found, &mut looks, 2);
        look(&folder.join("models"), &mut found, &mut looks, 1);
    }
    let list = found.iter().map(|(name, path)| {
        json!({"name": name, "uri": format!("model://{name}"), "path": path.display().to_string()})
    });
    json!({"models": list.collect::<Vec<_>>()}).to_string()
}

fn look(folder: &Path, found: &mut BTreeMap<String, PathBuf>, looks: &mut usize, depth: usize) {
    *looks += 1;
    if *looks > MAX_FOLDER_COUNT {
        return;
    }
    if Machine.kind(&folder.join("model.config")) == Some(EntryKind::File) {
        if let Some(name) = folder.file_name() {
            let name = name.to_string_lossy().into_owned();
            found.entry(name).or_insert_with(|| folder.to_path_buf());
        }
        return;
    }
    if depth == 0 {
        return;
    }
    for name in Machine.list(folder) {
        let inner = folder.join(&name);
        if !name.starts_with('.') && Machine.kind(&inner) == Some(EntryKind::Folder) {
            look(&inner, found, looks, depth - 1);
        }
    }
}
