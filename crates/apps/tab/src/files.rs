//! List of the files of a session.
#![expect(clippy::disallowed_methods, reason = "a tab is an edge: the page asks for its files")]

use std::io;
use std::path::Path;

use periplus_os::fs;
use serde_json::{Value, json};

/// Files below a folder in the order of their paths, as a JSON list of objects with `path` and `bytes`.
///
/// # Errors
/// When the folder cannot be read.
pub fn list(folder: &Path) -> io::Result<Vec<u8>> {
    let mut found = Vec::new();
    collect(folder, &mut found)?;
    found.sort();
    let files: Vec<Value> =
        found.iter().map(|(path, bytes)| json!({"path": path, "bytes": bytes})).collect();
    Ok(serde_json::to_vec(&files)?)
}

fn collect(folder: &Path, found: &mut Vec<(String, u64)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if fs::is_dir(&path) {
            collect(&path, found)?;
        } else {
            let bytes = fs::metadata(&path)?.len();
            found.push((path.to_string_lossy().into_owned(), bytes));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_all_folders_are_listed() {
        let root = fs::temp_dir().join(format!("periplus-tab-files-{}", periplus_os::process_id()));
        let _ = fs::remove_dir_all(&root);
        fs::create_dir_all(root.join("maps/old")).unwrap();
        fs::write(root.join("maps/old/a.pgm"), [1, 2, 3]).unwrap();
        fs::write(root.join("b.yaml"), "x").unwrap();
        let listed: Value = serde_json::from_slice(&list(&root).unwrap()).unwrap();
        let path = |name: &str| root.join(name).to_string_lossy().into_owned();
        let expected = json!([
            {"path": path("b.yaml"), "bytes": 1},
            {"path": path("maps/old/a.pgm"), "bytes": 3}
        ]);
        assert_eq!(listed, expected);
        fs::remove_dir_all(&root).unwrap();
    }
}
