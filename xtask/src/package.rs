//! `cargo xtask package`: whether every library can be packaged, with its README and its metadata,
//! and with every file that its code includes.

use std::fs;
use std::path::{Component, Path, PathBuf};

use serde_json::Value;

use crate::step::{Failed, cargo, run};

/// Packages all libraries without building them.
///
/// # Errors
/// When a package is incomplete, or cargo refuses it.
pub(crate) fn check() -> Result<(), Failed> {
    let metadata = output(&["metadata", "--no-deps", "--format-version", "1"])?;
    let metadata: Value = serde_json::from_str(&metadata)
        .map_err(|error| Failed(format!("cargo metadata is not JSON: {error}")))?;
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mut faults = Vec::new();
    let mut command = cargo();
    command.args(["package", "--workspace", "--no-verify", "--allow-dirty", "--quiet"]);
    for package in packages {
        let name = package["name"].as_str().unwrap_or_default();
        // An empty list of registries is `publish = false`.
        if package["publish"].as_array().is_some_and(Vec::is_empty) {
            command.args(["--exclude", name]);
            continue;
        }
        let manifest = Path::new(package["manifest_path"].as_str().unwrap_or_default());
        let folder = manifest.parent().unwrap_or(manifest);
        let listed = output(&["package", "--list", "--allow-dirty", "--package", name])?;
        let listed: Vec<&str> = listed.lines().collect();
        let mut found = faults_of_metadata(package);
        for file in listed.iter().filter(|file| file.ends_with(".rs")) {
            let text = fs::read_to_string(folder.join(file)).unwrap_or_default();
            found.extend(faults_of_includes(file, &text, &listed));
        }
        faults.extend(found.into_iter().map(|fault| format!("{name}: {fault}")));
    }
    if !faults.is_empty() {
        return Err(Failed(faults.join("\n       ")));
    }
    run(&mut command, "see the error of cargo above")
}

/// The standard output of cargo.
fn output(arguments: &[&str]) -> Result<String, Failed> {
    let failed = |why: String| Failed(format!("cargo {} failed: {why}", arguments.join(" ")));
    let output = cargo().args(arguments).output().map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Missing metadata, and dependencies of tests that cargo would have to find in a registry.
fn faults_of_metadata(package: &Value) -> Vec<String> {
    let mut faults = Vec::new();
    for field in ["description", "license", "readme"] {
        if package[field].as_str().is_none_or(str::is_empty) {
            faults.push(format!("add `{field}` to its Cargo.toml"));
        }
    }
    for field in ["keywords", "categories"] {
        if package[field].as_array().is_none_or(Vec::is_empty) {
            faults.push(format!("add `{field}` to its Cargo.toml"));
        }
    }
    for dependency in package["dependencies"].as_array().into_iter().flatten() {
        let is_own = dependency["path"].is_string() && dependency["kind"] == "dev";
        if is_own && dependency["req"] != "*" {
            let name = dependency["name"].as_str().unwrap_or_default();
            faults.push(format!(
                "name {name} in [dev-dependencies] by `path` alone: with a version, cargo needs it \
                 in the registry before this package"
            ));
        }
    }
    faults
}

/// Files that the code of a package includes although they are not in it.
fn faults_of_includes(file: &str, text: &str, listed: &[&str]) -> Vec<String> {
    let mut faults = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let Some(at) = ["include_str!(", "include_bytes!(", "include!("]
            .iter()
            .find_map(|name| line.find(name).map(|at| at + name.len()))
        else {
            continue;
        };
        let argument = line[at..].trim_start();
        // Other arguments are put together by macros: `OUT_DIR`, the folder of the package.
        let Some(path) = argument.strip_prefix('"').and_then(|rest| rest.split('"').next()) else {
            if argument.contains("../") {
                faults.push(format!("{file}:{}: {argument} leaves the package", number + 1));
            }
            continue;
        };
        let folder = Path::new(file).parent().unwrap_or(Path::new(""));
        let included = plain(&folder.join(path));
        if !included.as_deref().is_some_and(|path| listed.contains(&path)) {
            faults.push(format!(
                "{file}:{}: `{path}` is not in the package: move it there, or add it to `include` \
                 in Cargo.toml",
                number + 1
            ));
        }
    }
    faults
}

/// A path below the folder of the package without `..`; none if it leaves the folder.
fn plain(path: &Path) -> Option<String> {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir if parts.pop() => {}
            Component::ParentDir => return None,
            Component::Normal(name) => parts.push(name),
            _ => {}
        }
    }
    Some(parts.to_string_lossy().replace('\\', "/"))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn included_files_are_in_the_package() {
        let listed = ["src/a/b.rs", "src/a/c.txt", "data/d.txt"];
        let faults = |text| faults_of_includes("src/a/b.rs", text, &listed);
        let fine = "include_str!(\"c.txt\")\ninclude_bytes!(\"../../data/d.txt\")\n\
                    include!(concat!(env!(\"OUT_DIR\"), \"/e.rs\"))";
        assert_eq!(faults(fine), Vec::<String>::new());
        assert_eq!(faults("x\ninclude_str!(\"../../../d.txt\")").len(), 1);
        assert!(
            faults("x\ninclude_str!(\"missing.txt\")")[0].starts_with("src/a/b.rs:2: `missing")
        );
        assert_eq!(faults("include_str!(concat!(\"../../../../\", $path))").len(), 1);
    }

    #[test]
    fn metadata_is_complete() {
        let mut package = json!({
            "description": "x", "license": "x", "readme": "README.md", "keywords": ["x"],
            "categories": ["x"],
            "dependencies": [{"name": "own", "path": "/x", "kind": "dev", "req": "*"}],
        });
        assert_eq!(faults_of_metadata(&package), Vec::<String>::new());
        package["dependencies"][0]["req"] = json!("^0.1.0");
        package["readme"] = json!(null);
        package["keywords"] = json!([]);
        assert_eq!(faults_of_metadata(&package).len(), 3);
    }
}
