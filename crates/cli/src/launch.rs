//! `periplus launch`.

mod outside;
mod python;
mod show;

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap, closest};
use periplus_host::Machine;
use periplus_launch::{Plan, Request, plan};
use periplus_resources::{Host as _, Kind, Resolver};

use crate::options::{SearchOptions, split};
use crate::terminal::{self, working_folder};

/// Read a launch file of ROS 1 or ROS 2 and say what it starts
///
/// Takes XML of roslaunch, and XML, YAML and Python of ROS 2, with no ROS on the machine; files in Python
/// are evaluated by the python3 that is found on the PATH.
#[derive(Debug, Args)]
pub(crate) struct LaunchOptions {
    /// A launch file, or a package and the name of one in it; then `name:=value`
    #[arg(required = true, value_name = "PACKAGE FILE|FILE|NAME:=VALUE")]
    words: Vec<String>,
    /// List the arguments that the file takes, and start nothing
    #[arg(short, long, visible_alias = "show-arguments")]
    show_args: bool,
    /// Print the plan as JSON, and start nothing
    #[arg(short, long, conflicts_with = "show_args")]
    print: bool,
    #[command(flatten)]
    search: SearchOptions,
}

pub(crate) fn run(options: &LaunchOptions) -> io::Result<ExitCode> {
    let (words, arguments) = split(&options.words);
    let host = Machine;
    let here = working_folder();
    let folders: Vec<PathBuf> =
        options.search.resource_path.iter().map(|folder| here.join(folder)).collect();
    let resolver = Resolver::new(&host, &folders);
    let mut sources = SourceMap::new();
    let file = match file(&words, &resolver, &here) {
        Ok(file) => file,
        Err(wrong) => {
            let mut found = Diagnostics::new();
            found.push(*wrong);
            terminal::diagnostics(&mut anstream::stderr().lock(), &found, &sources)?;
            return Ok(ExitCode::FAILURE);
        }
    };
    let mut outside = outside::Programs::new(&resolver, &here, options.print);
    let request =
        Request { file, arguments, host: &host, resolver: &resolver, outside: &mut outside };
    let (plan, found) = plan(request, &mut sources);
    terminal::diagnostics(&mut anstream::stderr().lock(), &found, &sources)?;
    let mut out = anstream::AutoStream::auto(io::stdout().lock());
    if options.show_args {
        // A file whose arguments are not all given has told of them up to there.
        show::arguments(&mut out, &plan)?;
        let is_told = found.iter().all(|finding| {
            finding.code == "launch-argument"
                || finding.severity != periplus_diagnostics::Severity::Error
        });
        return Ok(if is_told { ExitCode::SUCCESS } else { ExitCode::FAILURE });
    }
    if found.has_errors() {
        return Ok(ExitCode::FAILURE);
    }
    if options.print {
        print(&mut out, &plan)?;
        return Ok(ExitCode::SUCCESS);
    }
    show::steps(&mut out, &plan)?;
    Ok(ExitCode::SUCCESS)
}

fn print(out: &mut dyn io::Write, plan: &Plan) -> io::Result<()> {
    let text = serde_json::to_string_pretty(plan).map_err(io::Error::other)?;
    writeln!(out, "{text}")
}

/// The file that is meant: one by its path, or by the name of a package and its own.
fn file(
    words: &[PathBuf],
    resolver: &Resolver<'_>,
    here: &Path,
) -> Result<PathBuf, Box<Diagnostic>> {
    match words {
        [file] => {
            let path = here.join(file);
            if Machine.kind(&path) == Some(Kind::File) {
                return Ok(path);
            }
            Err(Diagnostic::error("launch-file", format!("there is no file {}", file.display()))
                .help("give the path of a launch file, or a package and the name of a file in it")
                .into())
        }
        [package, name] => {
            let package = package.display().to_string();
            let folder = resolver
                .find_package(&package, &here.join("launch"))
                .map_err(|miss| miss.into_diagnostic(periplus_diagnostics::Origin::default()))?;
            let mut files = Vec::new();
            collect(&folder, name, 0, &mut files);
            match files.as_slice() {
                [file] => Ok(file.clone()),
                [] => Err(missing(&folder, &package, name).into()),
                several => {
                    let shown: Vec<_> =
                        several.iter().map(|file| file.display().to_string()).collect();
                    Err(Diagnostic::error(
                        "launch-file",
                        format!("the package `{package}` has several files {}", name.display()),
                    )
                    .note(shown.join(", "))
                    .help("give the path of the one that is meant")
                    .into())
                }
            }
        }
        _ => Err(Diagnostic::error(
            "launch-file",
            "a launch takes one file, or a package and a file",
        )
        .help("arguments of the file are written `name:=value`")
        .into()),
    }
}

/// How deep files of a package are looked for.
const DEEPEST: usize = 8;

/// The files of a name in a folder and below.
fn collect(folder: &Path, name: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    let own = folder.join(name);
    if Machine.kind(&own) == Some(Kind::File) {
        files.push(own);
    }
    if depth == DEEPEST {
        return;
    }
    for entry in Machine.list(folder).iter().filter(|entry| !entry.starts_with('.')) {
        let inner = folder.join(entry);
        if Machine.kind(&inner) == Some(Kind::Folder) {
            collect(&inner, name, depth + 1, files);
        }
    }
}

fn missing(folder: &Path, package: &str, name: &Path) -> Diagnostic {
    let launches = Machine.list(&folder.join("launch"));
    let name = name.display().to_string();
    let finding = Diagnostic::error(
        "launch-file",
        format!("the package `{package}` ({}) has no file `{name}`", folder.display()),
    );
    match closest(&name, launches.iter().map(String::as_str)) {
        Some(near) => finding.help(format!("did you mean `{near}`?")),
        None if launches.is_empty() => finding,
        None => finding.note(format!("it has {}", launches.join(", "))),
    }
}
