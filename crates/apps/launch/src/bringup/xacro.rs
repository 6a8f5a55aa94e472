//! The program `xacro`, built in.

use std::path::{Path, PathBuf};

use crate::{MissingInput, Printed};
use periplus_diagnostics::{Diagnostic, Severity, SourceMap, Style, render};
use periplus_loader::{Setting, load};
use periplus_os::Machine;
use periplus_resources::Store as _;
use periplus_xml::write_document;

/// What `xacro` printed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Xacro {
    /// The expanded document; empty where it was written to a file (`-o`).
    pub output: String,
    /// Errors, with their positions.
    pub errors: String,
    /// False where nothing could be expanded or written.
    pub is_success: bool,
    /// The cause of a failure that only an absent file or package has.
    pub missing: Option<MissingInput>,
    /// The file that was written.
    pub file: Option<PathBuf>,
}

impl From<Xacro> for Printed {
    fn from(Xacro { output, errors, is_success, missing, file: _ }: Xacro) -> Self {
        Self { output, errors, is_success, missing }
    }
}

/// The words of a command line, read.
#[derive(Debug, Default, PartialEq)]
struct Asked<'a> {
    file: Option<&'a str>,
    output: Option<&'a str>,
    arguments: Vec<(String, String)>,
}

/// Runs `xacro FILE [-o OUTPUT] name:=value ...`, with relative paths from the working folder of the
/// setting.
///
/// # Errors
/// Words that cannot be understood.
pub fn xacro(words: &[String], setting: &Setting<'_>) -> Result<Xacro, String> {
    let asked = read(words)?;
    let Some(file) = asked.file else { return Err("xacro is given no file".into()) };
    let setting = Setting { arguments: asked.arguments, open_meshes: false, ..setting.clone() };
    let loaded = load(Path::new(file), &setting);
    // Only what keeps it from being expanded: the rest is reported when the robot is loaded.
    let Some(document) = &loaded.document else {
        let mut errors: Vec<&Diagnostic> =
            loaded.diagnostics.iter().filter(|one| one.severity == Severity::Error).collect();
        // A message shows the first ones only.
        errors.sort_by_key(|error| is_explained(error));
        let missing = missing(&errors);
        let errors = match missing {
            Some(_) => summary(&errors, &loaded.sources),
            None => errors.iter().map(|one| render(one, &loaded.sources, Style::Plain)).collect(),
        };
        return Ok(Xacro { errors, missing, ..Xacro::default() });
    };
    let output = write_document(document);
    let Some(target) = asked.output else {
        return Ok(Xacro { output, is_success: true, ..Xacro::default() });
    };
    let target = setting.working_folder.join(target);
    if let Some(folder) = target.parent() {
        // As xacro does: the folder of the output is made.
        let _ = std::fs::create_dir_all(folder);
    }
    Ok(match Machine.replace(&target, output.as_bytes()) {
        Ok(()) => Xacro { is_success: true, file: Some(target), ..Xacro::default() },
        Err(why) => {
            let errors = format!("{} cannot be written: {why}", target.display());
            Xacro { errors, ..Xacro::default() }
        }
    })
}

/// The kind of absent input that an error reports; none for any other error.
fn missing_input(error: &Diagnostic) -> Option<MissingInput> {
    match error.code {
        "missing-resource" if error.message.contains("there is no package") => {
            Some(MissingInput::Package)
        }
        "missing-resource" => Some(MissingInput::File),
        "unreadable-file" if error.message.ends_with("there is no such file") => {
            Some(MissingInput::File)
        }
        _ => None,
    }
}

/// Whether an absent include file can cause an error: macros, properties and arguments come from there.
fn may_follow(error: &Diagnostic) -> bool {
    match error.code {
        "unknown-macro" | "undefined-argument" => true,
        "expression" => error.message.ends_with("is not defined"),
        _ => false,
    }
}

/// The cause of errors that all come from absent files; none where something else is wrong too.
fn missing(errors: &[&Diagnostic]) -> Option<MissingInput> {
    let cause = errors.iter().filter_map(|error| missing_input(error)).max()?;
    errors.iter().all(|error| is_explained(error)).then_some(cause)
}

/// Whether an error reports an absent file, or may come of one.
fn is_explained(error: &Diagnostic) -> bool {
    missing_input(error).is_some() || may_follow(error)
}

/// The absent files and packages, each with the first place that names it.
fn summary(errors: &[&Diagnostic], sources: &SourceMap) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut known: Vec<&str> = Vec::new();
    for error in errors.iter().filter(|error| missing_input(error).is_some()) {
        if known.contains(&error.message.as_str()) {
            continue;
        }
        known.push(&error.message);
        let place = error.span.map(|span| {
            let (file, position) = sources.locate(span);
            format!("{file}:{}:{}: ", position.line, position.column)
        });
        lines.push(format!("{}{}", place.unwrap_or_default(), error.message));
    }
    let rest = lines.len().saturating_sub(MOST_SHOWN);
    lines.truncate(MOST_SHOWN);
    if rest > 0 {
        lines.push(format!("and {rest} more"));
    }
    let follow = errors.iter().filter(|error| may_follow(error)).count();
    if follow > 0 {
        lines.push(format!(
            "{follow} undefined macros, properties or arguments may come from there"
        ));
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// The most absent files that one message lists.
const MOST_SHOWN: usize = 8;

fn read(words: &[String]) -> Result<Asked<'_>, String> {
    let mut asked = Asked::default();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "-o" | "--output" => {
                asked.output = Some(words.next().ok_or("`-o` needs the name of a file")?);
            }
            "--verbosity" => {
                words.next();
            }
            "--deps" => return Err("`--deps` is not built in".into()),
            word if word.starts_with("--output=") => asked.output = word.split('=').nth(1),
            word if word.starts_with("-o") => asked.output = Some(&word[2..]),
            // Options of old: `--inorder` is what everybody has today.
            word if word.starts_with('-') => {}
            word => match word.split_once(":=") {
                Some((name, value)) => asked.arguments.push((name.to_owned(), value.to_owned())),
                None => asked.file = Some(word),
            },
        }
    }
    Ok(asked)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_output_is_not_the_input() {
        let words: Vec<String> =
            ["-o", "/tmp/a.sdf", "headless:=True", "a.sdf.xacro"].map(str::to_owned).into();
        let asked = read(&words).unwrap();
        assert_eq!((asked.file, asked.output), (Some("a.sdf.xacro"), Some("/tmp/a.sdf")));
        assert_eq!(asked.arguments, [("headless".to_owned(), "True".to_owned())]);
        assert!(read(&["-o".to_owned()]).is_err());
    }
}
