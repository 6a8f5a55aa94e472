//! Built-in program `xacro`.

use std::path::{Path, PathBuf};

use crate::{MissingInput, OutsideError, Printed};
use periplus_diagnostics::{Diagnostic, DiagnosticCause, RenderStyle, Severity, SourceMap, render};
use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_resources::Store as _;
use periplus_xml::write_document;

/// Result of `xacro`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Xacro {
    /// Expanded document, empty if written to a file (`-o`); errors, with their positions.
    pub printed: Printed,
    /// Written file.
    pub file: Option<PathBuf>,
}

/// Invalid argument of `xacro`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum XacroUsageError {
    /// There is no file to expand.
    NoFile,
    /// The option `-o` has no value.
    NoOutput,
    /// The option `--deps` is not supported.
    Dependencies,
}

impl std::fmt::Display for XacroUsageError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::NoFile => "no xacro file given",
            Self::NoOutput => "`-o` needs the name of a file",
            Self::Dependencies => "`--deps` is not built in",
        })
    }
}

impl std::error::Error for XacroUsageError {}

impl From<XacroUsageError> for OutsideError {
    fn from(error: XacroUsageError) -> Self {
        Self::InvalidCommand(error.to_string())
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
/// When an argument is invalid.
pub fn xacro(words: &[String], setting: &LoadContext<'_>) -> Result<Xacro, XacroUsageError> {
    let asked = read(words)?;
    let Some(file) = asked.file else { return Err(XacroUsageError::NoFile) };
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
        let printed = Printed { errors, missing, ..Printed::default() };
        return Ok(Xacro { printed, file: None });
    };
    let output = write_document(document);
    let Some(target) = asked.output else {
        let printed = Printed { output, is_success: true, ..Printed::default() };
        return Ok(Xacro { printed, file: None });
    };
    let target = setting.working_folder.join(target);
    if let Some(folder) = target.parent() {
        // As xacro does: creates the folder of the output.
        let _ = std::fs::create_dir_all(folder);
    }
    Ok(match Machine.replace(&target, output.as_bytes()) {
        Ok(()) => Xacro {
            printed: Printed { is_success: true, ..Printed::default() },
            file: Some(target),
        },
        Err(why) => {
            let errors = format!("{} cannot be written: {why}", target.display());
            Xacro { printed: Printed { errors, ..Printed::default() }, file: None }
        }
    })
}

/// Returns true if a missing include file can cause an error: macros, properties and arguments come
/// from there.
fn may_follow(error: &Diagnostic) -> bool {
    error.cause == Some(DiagnosticCause::Undefined)
}

/// Cause of errors that all come from missing files; `None` if there are other errors.
fn missing(errors: &[&Diagnostic]) -> Option<MissingInput> {
    let cause = errors.iter().filter_map(|error| MissingInput::of(error)).max()?;
    errors.iter().all(|error| is_explained(error)).then_some(cause)
}

/// Returns true if an error reports a missing file, or may be caused by one.
fn is_explained(error: &Diagnostic) -> bool {
    MissingInput::of(error).is_some() || may_follow(error)
}

/// Missing files and packages, each with the first position that refers to it.
fn summary(errors: &[&Diagnostic], sources: &SourceMap) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut known: Vec<&str> = Vec::new();
    for error in errors.iter().filter(|error| MissingInput::of(error).is_some()) {
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

fn read(words: &[String]) -> Result<XacroArguments<'_>, XacroUsageError> {
    let mut asked = XacroArguments::default();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "-o" | "--output" => {
                asked.output = Some(words.next().ok_or(XacroUsageError::NoOutput)?);
            }
            "--verbosity" => {
                words.next();
            }
            "--deps" => return Err(XacroUsageError::Dependencies),
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
