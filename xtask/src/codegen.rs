//! Rust code for the messages, from the texts in `crates/messages/msgs/interfaces`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_rosidl::{InterfaceDialect, InterfaceKind, Registry, TypeName, parse, rust};

use crate::step::{Failed, root};

/// Writes generated files that differ; with `check` it only fails if one differs.
///
/// # Errors
/// When a text is wrong, a file cannot be read or written, or the check finds a difference.
pub(crate) fn run(check: bool) -> Result<(), Failed> {
    let source = root().join("crates/messages/msgs/src");
    let wanted = generate()?;
    let mut stale = Vec::new();
    for (path, code) in &wanted {
        if fs::read_to_string(source.join(path)).ok().as_ref() != Some(code) {
            stale.push(path.clone());
        }
    }
    let gone: Vec<PathBuf> = files(&source.join("generated"), "rs")?
        .into_iter()
        .filter(|path| !wanted.contains_key(path.strip_prefix(&source).unwrap_or(path)))
        .collect();
    if check {
        let names = stale.iter().chain(&gone).map(|path| path.display().to_string());
        let names: Vec<String> = names.collect();
        let help = "run `cargo xtask codegen`";
        return if names.is_empty() {
            Ok(())
        } else {
            Err(Failed(format!("generated files are out of date: {}: {help}", names.join(", "))))
        };
    }
    fs::create_dir_all(source.join("generated")).map_err(|error| failed(&source, &error))?;
    for path in stale {
        let to = source.join(&path);
        fs::write(&to, &wanted[&path]).map_err(|error| failed(&to, &error))?;
        println!("wrote {}", path.display());
    }
    for path in gone {
        fs::remove_file(&path).map_err(|error| failed(&path, &error))?;
        println!("removed {}", path.display());
    }
    Ok(())
}

/// The texts of all types, as ROS 2 Jazzy has them.
const ALL: &str = "interfaces";

/// Folders with the texts of types that have other fields in another distribution, and the suffix of
/// the modules of these: `nav2_msgs_humble` has all of `nav2_msgs`, with its own form of some types.
const VARIANTS: [(&str, &str); 2] = [("interfaces_humble", "humble"), ("interfaces_main", "main")];

/// The files of the crate's `src` that the texts ask for.
fn generate() -> Result<BTreeMap<PathBuf, String>, Failed> {
    let mut registry = Registry::new();
    let paths = read(ALL, &mut registry)?;
    let packages: BTreeSet<String> =
        registry.interfaces().map(|interface| interface.name.package.clone()).collect();
    let mut wanted = BTreeMap::new();
    for package in &packages {
        let code = rust::package(&registry, package).map_err(|error| Failed(error.to_string()))?;
        wanted.insert(PathBuf::from(format!("generated/{package}.rs")), code);
    }
    let mut modules = packages;
    for (folder, suffix) in VARIANTS {
        for (package, code) in variants(&registry, folder)? {
            let module = format!("{package}_{suffix}");
            wanted.insert(PathBuf::from(format!("generated/{module}.rs")), code);
            modules.insert(module);
        }
    }
    wanted.insert("generated.rs".into(), index(&registry, &modules, &paths));
    Ok(wanted)
}

/// Packages with types of another form, and the code of these.
fn variants(common: &Registry, folder: &str) -> Result<Vec<(String, String)>, Failed> {
    let mut registry = common.clone();
    let paths = read(folder, &mut registry)?;
    let packages: BTreeSet<&str> = paths.iter().filter_map(|path| path.split('/').next()).collect();
    let code = |package: &str| {
        let is_variant = |name: &TypeName| {
            name.package == package
                && paths.iter().any(|path| path.starts_with(&format!("{name}.")))
        };
        rust::variants(&registry, &format!("{folder}/{package}"), is_variant)
            .map_err(|error| Failed(error.to_string()))
    };
    packages.iter().map(|package| Ok(((*package).to_owned(), code(package)?))).collect()
}

fn index(registry: &Registry, modules: &BTreeSet<String>, paths: &[String]) -> String {
    let mut code =
        String::from("//! All packages and their texts. Made by `cargo xtask codegen`.\n\n");
    for module in modules {
        let _ = writeln!(code, "pub mod {module};");
    }
    code.push_str("\ncrate::sources! {\n");
    for path in paths {
        let _ = writeln!(code, "    {path:?}");
    }
    code.push_str("}\n\ncrate::list_messages! {\n");
    for interface in registry.interfaces() {
        for definition in rust::structs(registry, interface) {
            let name = &definition.name;
            let _ = writeln!(code, "    {}::{}", name.package, rust::type_name(name));
        }
    }
    code.push_str("}\n\ncrate::list_services! {\n");
    for interface in registry.interfaces().filter(|one| one.name.kind == InterfaceKind::Service) {
        let name = &interface.name;
        let _ = writeln!(code, "    {}::{}", name.package, rust::type_name(name));
    }
    code.push_str("}\n");
    code
}

/// Adds the texts of a folder of the crate; their paths in it.
fn read(folder: &str, registry: &mut Registry) -> Result<Vec<String>, Failed> {
    let place = format!("crates/messages/msgs/{folder}");
    let folder = &root().join(&place);
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let mut paths = Vec::new();
    for kind in [InterfaceKind::Message, InterfaceKind::Service, InterfaceKind::Action] {
        paths.extend(files(folder, kind.word())?);
    }
    paths.sort();
    let mut names = Vec::new();
    for path in paths {
        let name = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
        let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem);
        let Some(r#type) = TypeName::read(stem) else {
            return Err(Failed(format!("{name} is not package/kind/Name.kind")));
        };
        let text = fs::read_to_string(&path).map_err(|error| failed(&path, &error))?;
        let file = sources.add(format!("{place}/{name}"), text);
        if let Some(one) = parse(&r#type, file, &sources, InterfaceDialect::Ros2, &mut diagnostics)
        {
            registry.add(one);
        }
        names.push(name);
    }
    registry.check(&mut diagnostics);
    if diagnostics.is_empty() {
        return Ok(names);
    }
    let findings = diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain));
    Err(Failed(findings.collect::<Vec<_>>().join("\n")))
}

/// All files below a folder with such an ending.
fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, Failed> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return Ok(found) };
    for entry in entries {
        let path = entry.map_err(|error| failed(folder, &error))?.path();
        if path.is_dir() {
            found.extend(files(&path, ending)?);
        } else if path.extension().is_some_and(|extension| extension == ending) {
            found.push(path);
        }
    }
    Ok(found)
}

fn failed(path: &Path, error: &std::io::Error) -> Failed {
    Failed(format!("{}: {error}", path.display()))
}

#[test]
fn generated_code_is_what_the_texts_say() {
    if let Err(Failed(why)) = run(true) {
        panic!("{why}");
    }
}
