//! `cargo xtask package`: checks that every library can be packaged, with its README, its metadata
//! and every file that its code includes, and that its front page has a short example.

use std::fs;
use std::path::{Component, Path, PathBuf};

use serde_json::Value;

use crate::step::{Failed, cargo, metadata, run};

/// Maximum number of lines of an example on the front page of a library, without blank and hidden ones.
const MAX_EXAMPLE_LINES: usize = 15;

/// Packages all libraries without building them.
///
/// # Errors
/// When a package is incomplete, or cargo refuses it.
pub(crate) fn check() -> Result<(), Failed> {
    let metadata = metadata()?;
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mut faults = Vec::new();
    let mut command = cargo();
    command.args(["package", "--workspace", "--no-verify", "--allow-dirty", "--quiet"]);
    for package in packages {
        let name = package["name"].as_str().unwrap_or_default();
        if !is_published(package) {
            command.args(["--exclude", name]);
            continue;
        }
        let manifest = Path::new(package["manifest_path"].as_str().unwrap_or_default());
        let folder = manifest.parent().unwrap_or(manifest);
        let listed = output(&["package", "--list", "--allow-dirty", "--package", name])?;
        let listed: Vec<&str> = listed.lines().collect();
        let mut found = faults_of_metadata(package);
        found.extend(faults_of_front_page(package));
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

/// True if a package is a library for a registry.
fn is_published(package: &Value) -> bool {
    // An empty list of registries is `publish = false`.
    package["publish"].as_array().is_none_or(|registries| !registries.is_empty())
}

/// A missing example on the front page of a library, and examples that are too long.
fn faults_of_front_page(package: &Value) -> Vec<String> {
    let targets = package["targets"].as_array().map(Vec::as_slice).unwrap_or_default();
    let is_library = |target: &&Value| {
        let kinds = target["kind"].as_array().map(Vec::as_slice).unwrap_or_default();
        kinds.iter().any(|kind| kind == "lib" || kind == "proc-macro")
    };
    let Some(path) = targets.iter().find(is_library).and_then(|it| it["src_path"].as_str()) else {
        return Vec::new();
    };
    match fs::read_to_string(path) {
        Ok(text) => faults_of_examples(&text),
        Err(error) => vec![format!("cannot read `{path}`: {error}")],
    }
}

/// The faults of the examples in the documentation of a crate.
fn faults_of_examples(text: &str) -> Vec<String> {
    let examples = examples(text);
    if examples.is_empty() {
        return vec![format!(
            "add an example of at most {MAX_EXAMPLE_LINES} lines, with a check of its result, to the \
             documentation (`//!`) of src/lib.rs"
        )];
    }
    let long = examples.into_iter().filter(|it| it.lines > MAX_EXAMPLE_LINES);
    let fault = |it: Example| {
        format!(
            "src/lib.rs:{}: the example has {} lines: shorten it to {MAX_EXAMPLE_LINES}",
            it.line, it.lines
        )
    };
    long.map(fault).collect()
}

/// An example in the documentation of a crate.
#[derive(Debug, PartialEq, Eq)]
struct Example {
    /// Line of its beginning, from 1.
    line: usize,
    /// Number of lines, without blank and hidden ones.
    lines: usize,
}

/// The examples that rustdoc compiles. A fence may depend on a feature:
/// `#![cfg_attr(feature = "x", doc = "```no_run")]`.
fn examples(text: &str) -> Vec<Example> {
    let mut found = Vec::new();
    let mut open: Option<(bool, Example)> = None;
    for (number, line) in text.lines().enumerate() {
        let conditional =
            line.strip_prefix("#![cfg_attr(").and_then(|it| it.split("doc = \"").nth(1));
        let Some(line) = line.strip_prefix("//!").or(conditional).map(str::trim) else { continue };
        let Some(tag) = line.strip_prefix("```") else {
            if let Some((_, example)) = &mut open {
                example.lines +=
                    usize::from(!line.is_empty() && line != "#" && !line.starts_with("# "));
            }
            continue;
        };
        if conditional.is_none()
            && let Some((is_compiled, example)) = open.take()
        {
            found.extend(is_compiled.then_some(example));
            continue;
        }
        let tag = tag.trim_end_matches("\")]");
        let is_compiled = matches!(tag, "" | "rust" | "no_run" | "should_panic");
        let is_compiled = is_compiled || open.is_some_and(|it| it.0);
        open = Some((is_compiled, Example { line: number + 1, lines: 0 }));
    }
    found
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
    fn examples_are_short() {
        let of = |lines: usize| format!("//! ```\n{}//! ```\n", "//! let x = 1;\n".repeat(lines));
        assert_eq!(faults_of_examples(&of(15)), Vec::<String>::new());
        assert_eq!(
            faults_of_examples(&format!("//! Text.\n//!\n{}", of(16))),
            ["src/lib.rs:3: the example has 16 lines: shorten it to 15"]
        );
        // Blank and hidden lines do not count.
        let hidden = of(15).replace("x = 1;\n", "x = 1;\n//!\n//! # fn hidden() {}\n");
        assert_eq!(faults_of_examples(&hidden), Vec::<String>::new());
    }

    #[test]
    fn examples_are_compiled() {
        for tag in ["```text", "```console", "```ignore"] {
            let text = format!("//! {tag}\n//! x\n//! ```\n");
            assert_eq!(faults_of_examples(&text).len(), 1, "{tag}");
        }
        assert_eq!(faults_of_examples("//! Text.\n\nmod a;\n").len(), 1);
        let conditional = "#![cfg_attr(feature = \"a\", doc = \"```no_run\")]\n\
                           #![cfg_attr(not(feature = \"a\"), doc = \"```ignore\")]\n\
                           //! let x = 1;\n//! ```\n";
        assert_eq!(examples(conditional), [Example { line: 2, lines: 1 }]);
    }

    #[test]
    fn every_library_has_a_short_example() {
        let metadata = metadata().unwrap();
        let packages = metadata["packages"].as_array().unwrap().iter();
        let published: Vec<&Value> = packages.filter(|package| is_published(package)).collect();
        assert!(published.len() > 30, "{} libraries found", published.len());
        for package in published {
            assert_eq!(faults_of_front_page(package), Vec::<String>::new(), "{}", package["name"]);
        }
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
