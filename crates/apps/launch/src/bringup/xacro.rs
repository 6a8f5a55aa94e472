//! Built-in program `xacro`.

use std::path::{Path, PathBuf};

use crate::{MissingInput, Printed};
use periplus_diagnostics::{Diagnostic, RenderStyle, Severity, SourceMap, render};
use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_resources::Store as _;
use periplus_xml::write_document;

/// Result of `xacro`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Xacro {
    /// Expanded document; empty if written to a file (`-o`).
    pub output: String,
    /// Errors, with their positions.
    pub errors: String,
    /// False if expansion or writing failed.
    pub is_success: bool,
    /// Missing input that caused the failure, if that is the only cause.
    pub missing: Option<MissingInput>,
    /// Written file.
    pub file: Option<PathBuf>,
}

impl From<Xacro> for Printed {
    fn from(Xacro { output, errors, is_success, missing, file: _ }: Xacro) -> Self {
        Self { output, errors, is_success, missing }
    }
}

/// Parsed command line.
#[derive(Debug, Default, PartialEq)]
struct XacroArguments<'a> {
    file: Option<&'a str>,
    output: Option<&'a str>,
    arguments: Vec<(String, String)>,
}

/// Runs `xacro FILE [-o OUTPUT] name:=value ...`, with paths relative to the working folder of the
/// setting.
///
/// # Errors
/// A message with the invalid argument.
pub fn xacro(words: &[String], setting: &LoadContext<'_>) -> Result<Xacro, String> {
    let asked = read(words)?;
    let Some(file) = asked.file else { return Err("no xacro file given".into()) };
    let setting = LoadContext { arguments: asked.arguments, open_meshes: false, ..setting.clone() };
    let loaded = load(Path::new(file), &setting);
    // Only errors that prevent expansion: the rest is reported when the robot is loaded.
    let Some(document) = &loaded.document else {
        let mut errors: Vec<&Diagnostic> =
            loaded.diagnostics.iter().filter(|one| one.severity == Severity::Error).collect();
        // A message shows the first ones only.
        errors.sort_by_key(|error| is_explained(error));
        let missing = missing(&errors);
        let errors = match missing {
            Some(_) => summary(&errors, &loaded.sources),
            None => {
                errors.iter().map(|one| render(one, &loaded.sources, RenderStyle::Plain)).collect()
            }
        };
        return Ok(Xacro { errors, missing, ..Xacro::default() });
    };
    let output = write_document(document);
    let Some(target) = asked.output else {
        return Ok(Xacro { output, is_success: true, ..Xacro::default() });
    };
    let target = setting.working_folder.join(target);
    if let Some(folder) = target.parent() {
        // As xacro does: creates the folder of the output.
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

/// Kind of missing input of an error; `None` for any other error.
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

/// Returns true if a missing include file can cause an error: macros, properties and arguments come
/// from there.
fn may_follow(error: &Diagnostic) -> bool {
    match error.code {
        "unknown-macro" | "undefined-argument" => true,
        "expression" => error.message.ends_with("is not defined"),
        _ => false,
    }
}

/// Cause of errors that all come from missing files; `None` if there are other errors.
fn missing(errors: &[&Diagnostic]) -> Option<MissingInput> {
    let cause = errors.iter().filter_map(|error| missing_input(error)).max()?;
    errors.iter().all(|error| is_explained(error)).then_some(cause)
}

/// Returns true if an error reports a missing file, or may be caused by one.
fn is_explained(error: &Diagnostic) -> bool {
    missing_input(error).is_some() || may_follow(error)
}

/// Missing files and packages, each with the first position that refers to it.
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
    let rest = lines.len().saturating_sub(MAX_LISTED);
    lines.truncate(MAX_LISTED);
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

/// Maximum number of missing files in a message.
const MAX_LISTED: usize = 8;

fn read(words: &[String]) -> Result<XacroArguments<'_>, String> {
    let mut asked = XacroArguments::default();
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
            // Obsolete options: `--inorder` is the default today.
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
