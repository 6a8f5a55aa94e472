//! Resolution of the launch file on the command line, by path or by package and name.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, closest};
use periplus_launch::bringup::{REPLACED_LAUNCH_FILES, has_replacement};
use periplus_os::Machine;
use periplus_resources::{EntryKind, Host as _, Resolver};

/// Launch file that the command line names.
pub(super) enum Found {
    /// A launch file.
    File(PathBuf),
    /// Missing launch file of a missing package, with a built-in replacement.
    Replacement(String),
}

/// Maximum depth of the search for files of a package.
const MAX_DEPTH: usize = 8;

/// Maximum number of launch files that a message lists.
const MAX_LISTED: usize = 20;

/// Resolves a launch file by its path, or by package and file name.
pub(super) fn file(
    words: &[PathBuf],
    resolver: &Resolver<'_>,
    here: &Path,
) -> Result<Found, Box<Diagnostic>> {
    match words {
        [file] => {
            let path = here.join(file);
            if Machine.kind(&path) == Some(EntryKind::File) {
                return Ok(Found::File(path));
            }
            Err(no_file(file, resolver, here).into())
        }
        [package, name] => {
            let package = package.display().to_string();
            let file = name.display().to_string();
            let folder = match resolver.find_package(&package, &here.join("launch")) {
                Ok(folder) => folder,
                Err(_) if has_replacement(&package, &file) => {
                    return Ok(Found::Replacement(format!("package://{package}/launch/{file}")));
                }
                Err(miss) => {
                    return Err(no_package(&package, &file, &miss.tried, resolver, here).into());
                }
            };
            let mut files = Vec::new();
            walk(&folder, 0, &mut |path| {
                if path.ends_with(name) {
                    files.push(path.to_owned());
                }
            });
            match files.as_slice() {
                [file] => Ok(Found::File(file.clone())),
                [] => Err(not_in_package(&folder, &package, &file).into()),
                several => {
                    let shown: Vec<_> =
                        several.iter().map(|file| file.display().to_string()).collect();
                    Err(error(format!("the package `{package}` has several files named `{file}`"))
                        .note(shown.join(", "))
                        .help("give the path of one of them")
                        .into())
                }
            }
        }
        _ => Err(error("expected one launch file, or a package and a launch file")
            .help("arguments of the file are written `name:=value`")
            .into()),
    }
}

fn error(message: impl Into<String>) -> Diagnostic {
    Diagnostic::error("launch-file", message)
}

/// Calls a function for each file in a folder and its subfolders.
fn walk(folder: &Path, depth: usize, visit: &mut dyn FnMut(&Path)) {
    for entry in Machine.list(folder).iter().filter(|entry| !entry.starts_with('.')) {
        let inner = folder.join(entry);
        match Machine.kind(&inner) {
            Some(EntryKind::File) => visit(&inner),
            Some(EntryKind::Folder) if depth < MAX_DEPTH => walk(&inner, depth + 1, visit),
            _ => {}
        }
    }
}

/// Sorted names of the launch files in a folder and its subfolders.
fn launch_files(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    walk(folder, 0, &mut |path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_in_launch = path.parent().is_some_and(|parent| parent.ends_with("launch"));
        if is_launch_file(&name, is_in_launch) {
            names.push(name);
        }
    });
    names.sort();
    names.dedup();
    names
}

/// Returns true for common names of launch files; in a folder `launch`, for every suitable
/// extension.
fn is_launch_file(name: &str, is_in_launch: bool) -> bool {
    let Some((stem, extension)) = name.rsplit_once('.') else { return false };
    match extension {
        "launch" => true,
        "py" | "xml" => stem.ends_with("launch") || (is_in_launch && stem != "__init__"),
        "yaml" | "yml" => stem.ends_with("launch"),
        _ => false,
    }
}

/// Diagnostic for a single word that is not a file: a package or a typing error.
fn no_file(file: &Path, resolver: &Resolver<'_>, here: &Path) -> Diagnostic {
    let name = file.display().to_string();
    let path = here.join(file);
    let is_folder = Machine.kind(&path) == Some(EntryKind::Folder);
    let package = resolver.find_package(&name, &here.join("launch")).ok();
    if let Some(folder) = package {
        let files = launch_files(&folder);
        let wrong = error(format!("`{name}` is a package ({})", folder.display()));
        return one_of(wrong, &format!("periplus launch {name} FILE"), &files);
    }
    if is_folder {
        let wrong = error(format!("{name} is a folder"));
        return one_of(wrong, "periplus launch PATH", &launch_files(&path));
    }
    if let Some(files) = built_in(&name) {
        let wrong = error(format!("`{name}` is a package that is not on this machine"));
        return one_of(wrong, &format!("periplus launch {name} FILE"), &files)
            .note("these launch files are built in")
            .help(format!("give the folder that contains `{name}`: `--resource-path FOLDER`"));
    }
    let wrong = error(format!("file {name} does not exist"));
    let near = crate::paths::advice(file);
    if !near.is_empty() {
        return wrong.help(near.trim_start_matches("; "));
    }
    match related(&name, &packages(resolver, here)) {
        Some((package, files)) => propose(wrong, &package, None, &files),
        None => {
            wrong.help("give the path of a launch file, or a package and the name of a file in it")
        }
    }
}

/// Diagnostic for a package that is not here, with a file that is not built in.
fn no_package(
    package: &str,
    file: &str,
    tried: &[PathBuf],
    resolver: &Resolver<'_>,
    here: &Path,
) -> Diagnostic {
    let elsewhere = format!("give the folder that contains `{package}`: `--resource-path FOLDER`");
    if let Some(files) = built_in(package) {
        let wrong = error(format!(
            "the package `{package}` is not on this machine, and its file `{file}` is not built in"
        ));
        let wrong = match closest(file, files.iter().map(String::as_str)) {
            Some(near) => wrong.help(format!("did you mean `{near}`?")),
            None => wrong,
        };
        return wrong.note(format!("built-in launch files: {}", files.join(", "))).help(elsewhere);
    }
    let mut wrong = error(format!("package `{package}` was not found"));
    if !tried.is_empty() {
        let places = tried.iter().map(|place| format!("\n  {}", place.display()));
        wrong = wrong.note(format!("tried{}", places.collect::<String>()));
    }
    let wrong = match related(package, &packages(resolver, here)) {
        Some((near, files)) => propose(wrong, &near, Some(file), &files),
        None => wrong,
    };
    wrong.help(elsewhere)
}

/// Diagnostic for a package without the file.
fn not_in_package(folder: &Path, package: &str, name: &str) -> Diagnostic {
    let files = launch_files(folder);
    let finding =
        error(format!("the package `{package}` ({}) has no file `{name}`", folder.display()));
    match closest(name, files.iter().map(String::as_str)) {
        Some(near) => finding.help(format!("did you mean `{near}`?")),
        None => listed(finding, &files),
    }
}

/// Built-in launch files that replace those of a missing package.
fn built_in(package: &str) -> Option<Vec<String>> {
    let (_, files) = REPLACED_LAUNCH_FILES.iter().find(|(name, _)| *name == package)?;
    Some(files.iter().map(|file| (*file).to_owned()).collect())
}

/// Packages that can be launched from a folder, with their folders where known.
fn packages(resolver: &Resolver<'_>, here: &Path) -> BTreeMap<String, Option<PathBuf>> {
    let mut all: BTreeMap<_, _> =
        REPLACED_LAUNCH_FILES.iter().map(|(name, _)| ((*name).to_owned(), None)).collect();
    let seen = resolver.packages(&here.join("launch")).into_iter();
    all.extend(seen.map(|(name, folder)| (name, Some(folder))));
    all
}

/// Package that was probably meant, with its launch files: a similar name, or one of the same robot
/// (`bot` for `bot_description` or the reverse).
fn related(
    name: &str,
    packages: &BTreeMap<String, Option<PathBuf>>,
) -> Option<(String, Vec<String>)> {
    let known = || packages.keys().map(String::as_str);
    let begins = |long: &str, short: &str| {
        long.strip_prefix(short).is_some_and(|rest| rest.starts_with('_'))
    };
    let of_one_robot = || {
        known()
            .filter(|other| begins(name, other) || begins(other, name))
            .min_by_key(|other| other.len().abs_diff(name.len()))
    };
    let near = closest(name, known()).or_else(of_one_robot)?;
    let files = match packages.get(near)? {
        Some(folder) => launch_files(folder),
        None => built_in(near)?,
    };
    Some((near.to_owned(), files))
}

/// Suggests another package, with its file of the same or a similar name.
fn propose(wrong: Diagnostic, package: &str, file: Option<&str>, files: &[String]) -> Diagnostic {
    let known = || files.iter().map(String::as_str);
    let same = file
        .and_then(|file| known().find(|known| *known == file).or_else(|| closest(file, known())));
    match same.or(if let [only] = files { Some(only) } else { None }) {
        Some(file) => wrong.help(format!("did you mean `periplus launch {package} {file}`?")),
        None => listed(wrong.help(format!("did you mean the package `{package}`?")), files),
    }
}

/// Suggests to choose one of several launch files.
fn one_of(wrong: Diagnostic, usage: &str, files: &[String]) -> Diagnostic {
    if files.is_empty() {
        return wrong.note("it has no launch files");
    }
    listed(wrong, files).help(format!("give one of its launch files: `{usage}`"))
}

/// Adds a list of launch files, truncated when long.
fn listed(wrong: Diagnostic, files: &[String]) -> Diagnostic {
    match files {
        [] => wrong,
        files if files.len() > MAX_LISTED => wrong.note(format!(
            "its launch files are {} and {} others",
            files[..MAX_LISTED].join(", "),
            files.len() - MAX_LISTED
        )),
        files => wrong.note(format!("its launch files are {}", files.join(", "))),
    }
}
