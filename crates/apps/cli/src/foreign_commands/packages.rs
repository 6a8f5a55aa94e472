//! Search for packages.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::{EntryKind, Host as _};

use crate::terminal::working_folder;

/// Maximum depth of the search.
const MAX_DEPTH: usize = 6;

/// Output folders of colcon, catkin and others, and folders that never contain packages.
const IGNORED_FOLDERS: [&str; 7] =
    ["build", "install", "log", "devel", "target", "node_modules", "venv"];

/// Lists the packages under the working folder and on the paths of the environment, one per line.
pub(super) fn list(out: &mut dyn Write) -> io::Result<()> {
    let here = working_folder();
    let mut found = Vec::new();
    collect(&here, 0, &mut found);
    for variable in ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"] {
        let paths = Machine.variable(variable).unwrap_or_default();
        for path in std::env::split_paths(&paths) {
            collect(&path, 0, &mut found);
        }
    }
    found.sort();
    found.dedup();
    if found.is_empty() {
        return writeln!(out, "(no package.xml under {})", here.display());
    }
    for (name, folder) in found {
        let shown = folder.strip_prefix(&here).unwrap_or(&folder);
        let shown = if shown.as_os_str().is_empty() { Path::new(".") } else { shown };
        writeln!(out, "{name}  {}", shown.display())?;
    }
    Ok(())
}

fn collect(folder: &Path, depth: usize, found: &mut Vec<(String, PathBuf)>) {
    let manifest = folder.join("package.xml");
    if Machine.kind(&manifest) == Some(EntryKind::File) {
        let text = Machine.read(&manifest).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        if let Some(name) = name_in(&text) {
            found.push((name.to_owned(), folder.to_path_buf()));
        }
        // Packages are not nested.
        return;
    }
    if depth == MAX_DEPTH {
        return;
    }
    for entry in Machine.list(folder) {
        if entry.starts_with('.') || IGNORED_FOLDERS.contains(&entry.as_str()) {
            continue;
        }
        let inner = folder.join(&entry);
        if Machine.kind(&inner) == Some(EntryKind::Folder) {
            collect(&inner, depth + 1, found);
        }
    }
}

/// Package name of a manifest.
fn name_in(manifest: &str) -> Option<&str> {
    let (_, rest) = manifest.split_once("<name>")?;
    let name = rest.split_once("</name>")?.0.trim();
    (!name.is_empty()).then_some(name)
}

#[test]
fn a_manifest_names_its_package() {
    assert_eq!(name_in("<package><name> sam_bot </name></package>"), Some("sam_bot"));
    assert_eq!(name_in("<package/>"), None);
}
