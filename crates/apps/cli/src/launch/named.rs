//! The launch file that is named on the command line, by its path or by its package and name.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_bringup::{STOOD_FOR, stands_for};
use periplus_diagnostics::{Diagnostic, closest};
use periplus_os::Machine;
use periplus_resources::{Host as _, Kind, Resolver};

/// The meaning of the words that name a launch file.
pub(super) enum Found {
    /// A launch file.
    File(PathBuf),
    /// One of a package that is not here, for which something stands.
    StandIn(String),
}

/// Depth to which files of a package are looked for.
const DEEPEST: usize = 8;

/// Most launch files that a message lists.
const MOST_LISTED: usize = 20;

/// The file that is meant: one by its path, or by the name of a package and its own.
pub(super) fn file(
    words: &[PathBuf],
    resolver: &Resolver<'_>,
    here: &Path,
) -> Result<Found, Box<Diagnostic>> {
    match words {
        [file] => {
            let path = here.join(file);
            if Machine.kind(&path) == Some(Kind::File) {
                return Ok(Found::File(path));
            }
            Err(no_file(file, resolver, here).into())
        }
        [package, name] => {
            let package = package.display().to_string();
            let file = name.display().to_string();
            let folder = match resolver.find_package(&package, &here.join("launch")) {
                Ok(folder) => folder,
                Err(_) if stands_for(&package, &file) => {
                    return Ok(Found::StandIn(format!("package://{package}/launch/{file}")));
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
                    Err(error(format!("the package `{package}` has several files {file}"))
                        .note(shown.join(", "))
                        .help("give the path of the one that is meant")
                        .into())
                }
            }
        }
        _ => Err(error("a launch takes one file, or a package and a file")
            .help("arguments of the file are written `name:=value`")
            .into()),
    }
}

fn error(message: impl Into<String>) -> Diagnostic {
    Diagnostic::error("launch-file", message)
}

/// Calls a function for each file in a folder and below.
fn walk(folder: &Path, depth: usize, visit: &mut dyn FnMut(&Path)) {
    for entry in Machine.list(folder).iter().filter(|entry| !entry.starts_with('.')) {
        let inner = folder.join(entry);
        match Machine.kind(&inner) {
            Some(Kind::File) => visit(&inner),
            Some(Kind::Folder) if depth < DEEPEST => walk(&inner, depth + 1, visit),
            _ => {}
        }
    }
}

/// The names of the launch files in a folder and below, sorted.
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

/// True for the usual names of launch files; in a folder `launch`, for all that can be one.
fn is_launch_file(name: &str, is_in_launch: bool) -> bool {
    let Some((stem, extension)) = name.rsplit_once('.') else { return false };
    match extension {
        "launch" => true,
        "py" | "xml" => stem.ends_with("launch") || (is_in_launch && stem != "__init__"),
        "yaml" | "yml" => stem.ends_with("launch"),
        _ => false,
    }
}

/// A single word at which no file is: a package perhaps, or a slip.
fn no_file(file: &Path, resolver: &Resolver<'_>, here: &Path) -> Diagnostic {
    let name = file.display().to_string();
    let path = here.join(file);
    let is_folder = Machine.kind(&path) == Some(Kind::Folder);
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
        let wrong = error(format!("`{name}` is a package, and it is not on this machine"));
        return one_of(wrong, &format!("periplus launch {name} FILE"), &files)
            .note("these launch files are built in")
            .help(format!("name the folder that holds `{name}`: `--resource-path FOLDER`"));
    }
    let wrong = error(format!("there is no file {name}"));
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

/// A package that is not here, with a file that nothing stands for.
fn no_package(
    package: &str,
    file: &str,
    tried: &[PathBuf],
    resolver: &Resolver<'_>,
    here: &Path,
) -> Diagnostic {
    let elsewhere = format!("name the folder that holds `{package}`: `--resource-path FOLDER`");
    if let Some(files) = built_in(package) {
        let wrong = error(format!(
            "the package `{package}` is not on this machine, and its file `{file}` is not built in"
        ));
        let wrong = match closest(file, files.iter().map(String::as_str)) {
            Some(near) => wrong.help(format!("did you mean `{near}`?")),
            None => wrong,
        };
        return wrong.note(format!("built in are {}", files.join(", "))).help(elsewhere);
    }
    let mut wrong = error(format!("there is no package `{package}`"));
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

/// A package without a file.
fn not_in_package(folder: &Path, package: &str, name: &str) -> Diagnostic {
    let files = launch_files(folder);
    let finding =
        error(format!("the package `{package}` ({}) has no file `{name}`", folder.display()));
    match closest(name, files.iter().map(String::as_str)) {
        Some(near) => finding.help(format!("did you mean `{near}`?")),
        None => listed(finding, &files),
    }
}

/// The launch files for which something stands, of a package that is not here.
fn built_in(package: &str) -> Option<Vec<String>> {
    let (_, files) = STOOD_FOR.iter().find(|(name, _)| *name == package)?;
    Some(files.iter().map(|file| (*file).to_owned()).collect())
}

/// The packages that can be launched from a folder, with the launch files of each where they are known
/// already.
fn packages(resolver: &Resolver<'_>, here: &Path) -> BTreeMap<String, Option<PathBuf>> {
    let mut all: BTreeMap<_, _> =
        STOOD_FOR.iter().map(|(name, _)| ((*name).to_owned(), None)).collect();
    let seen = resolver.packages(&here.join("launch")).into_iter();
    all.extend(seen.map(|(name, folder)| (name, Some(folder))));
    all
}

/// The package that was probably meant, with its launch files: one whose name differs by a slip, or one
/// of the same robot (`bot` for `bot_description` or the other way round).
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

/// The advice to take another package, with its file of the same or nearly the same name.
fn propose(wrong: Diagnostic, package: &str, file: Option<&str>, files: &[String]) -> Diagnostic {
    let known = || files.iter().map(String::as_str);
    let same = file
        .and_then(|file| known().find(|known| *known == file).or_else(|| closest(file, known())));
    match same.or(if let [only] = files { Some(only) } else { None }) {
        Some(file) => wrong.help(format!("did you mean `periplus launch {package} {file}`?")),
        None => listed(wrong.help(format!("did you mean the package `{package}`?")), files),
    }
}

/// The advice to choose one of several launch files.
fn one_of(wrong: Diagnostic, usage: &str, files: &[String]) -> Diagnostic {
    if files.is_empty() {
        return wrong.note("there is no launch file in it");
    }
    listed(wrong, files).help(format!("name one of its launch files: `{usage}`"))
}

/// A list of launch files, cut where it is long.
fn listed(wrong: Diagnostic, files: &[String]) -> Diagnostic {
    match files {
        [] => wrong,
        files if files.len() > MOST_LISTED => wrong.note(format!(
            "it has {} and {} others",
            files[..MOST_LISTED].join(", "),
            files.len() - MOST_LISTED
        )),
        files => wrong.note(format!("it has {}", files.join(", "))),
    }
}
