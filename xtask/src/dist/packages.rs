//! Crates of which a program is made, from the lock file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::target::Target;
use crate::step::{Failed, cargo};

/// A crate.
#[derive(Clone, Debug)]
pub(super) struct Package {
    pub(super) id: String,
    pub(super) name: String,
    pub(super) version: String,
    /// Expression of SPDX.
    pub(super) license: String,
    pub(super) authors: Vec<String>,
    pub(super) repository: String,
    pub(super) description: String,
    /// Folder of its sources.
    pub(super) folder: PathBuf,
    /// True for crates of other authors.
    pub(super) is_foreign: bool,
    /// Identifiers of the crates that it needs.
    pub(super) dependencies: Vec<String>,
}

/// Crates of the package `root` for a target.
pub(super) fn of(source: &Path, root: &str, target: &Target) -> Result<Vec<Package>, Failed> {
    of_triple(source, root, target.triple)
}

/// Crates of the package `root`, sorted by name: all that it needs to be built, without what only tests need. Sources of
/// C are dependencies of build scripts.
pub(super) fn of_triple(source: &Path, root: &str, triple: &str) -> Result<Vec<Package>, Failed> {
    let mut command = cargo();
    command.current_dir(source);
    command.args(["metadata", "--locked", "--format-version", "1"]);
    command.args(["--filter-platform", triple]);
    let output = command.output().map_err(|error| Failed(format!("cargo metadata: {error}")))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(Failed(format!("cargo metadata failed: {why}")));
    }
    let metadata = serde_json::from_slice(&output.stdout)
        .map_err(|error| Failed(format!("cargo metadata: {error}")))?;
    reached(&metadata, root)
}

fn reached(metadata: &Value, root: &str) -> Result<Vec<Package>, Failed> {
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut needed: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for node in list(&metadata["resolve"]["nodes"]) {
        let for_build = |dependency: &&Value| list(&dependency["dep_kinds"]).iter().any(not_dev);
        let dependencies = list(&node["deps"]);
        let ids = dependencies.iter().filter(for_build).map(|it| text(&it["pkg"]));
        let mut ids: Vec<String> = ids.collect();
        ids.sort();
        needed.insert(text(&node["id"]), ids);
    }
    let all: BTreeMap<String, Value> =
        list(&metadata["packages"]).into_iter().map(|it| (text(&it["id"]), it)).collect();
    let first = all.values().find(|it| it["name"] == root).map(|it| text(&it["id"]));
    let first = first.ok_or_else(|| Failed(format!("there is no package `{root}`")))?;
    let mut open = vec![first];
    let mut found: BTreeMap<String, Package> = BTreeMap::new();
    while let Some(id) = open.pop() {
        let Some(value) = all.get(&id).filter(|_| !found.contains_key(&id)) else { continue };
        let dependencies = needed.get(&id).cloned().unwrap_or_default();
        open.extend(dependencies.iter().cloned());
        found.insert(id.clone(), package(value, id, dependencies));
    }
    let mut packages: Vec<Package> = found.into_values().collect();
    packages.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Ok(packages)
}

fn not_dev(kind: &Value) -> bool {
    kind["kind"] != "dev"
}

fn package(value: &Value, id: String, dependencies: Vec<String>) -> Package {
    let manifest = PathBuf::from(text(&value["manifest_path"]));
    let authors = value["authors"].as_array().map(Vec::as_slice).unwrap_or_default();
    Package {
        id,
        name: text(&value["name"]),
        version: text(&value["version"]),
        // An old form of `OR`.
        license: text(&value["license"]).replace('/', " OR "),
        authors: authors.iter().map(text).collect(),
        repository: text(&value["repository"]),
        description: text(&value["description"]),
        folder: manifest.parent().unwrap_or(&manifest).to_path_buf(),
        is_foreign: !value["source"].is_null(),
        dependencies,
    }
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

#[test]
fn what_only_tests_need_is_left_out() {
    let package = |name: &str, source: Option<&str>| {
        serde_json::json!({ "id": name, "name": name, "version": "1.0.0", "license": "MIT/Apache-2.0",
            "source": source, "manifest_path": format!("/{name}/Cargo.toml"), "authors": [] })
    };
    let needs = |name: &str, kind: Option<&str>| serde_json::json!({ "pkg": name, "dep_kinds": [{ "kind": kind }] });
    let metadata = serde_json::json!({
        "packages": [package("app", None), package("lib", Some("r")), package("c", Some("r")), package("t", Some("r"))],
        "resolve": { "nodes": [
            { "id": "app", "deps": [needs("lib", None), needs("t", Some("dev"))] },
            { "id": "lib", "deps": [needs("c", Some("build"))] },
        ] },
    });
    let found = reached(&metadata, "app").unwrap();
    let names: Vec<_> = found.iter().map(|it| (it.name.as_str(), it.is_foreign)).collect();
    assert_eq!(names, [("app", false), ("c", true), ("lib", true)]);
    assert_eq!(found[2].license, "MIT OR Apache-2.0");
}
