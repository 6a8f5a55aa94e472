//! The program `xacro`, built in.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Severity, Style, render};
use periplus_formats::{Setting, load};
use periplus_host::Machine;
use periplus_resources::Store as _;
use periplus_sim::Search;
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
    /// The file that was written.
    pub file: Option<PathBuf>,
}

/// The words of a command line, read.
#[derive(Debug, Default, PartialEq)]
struct Asked<'a> {
    file: Option<&'a str>,
    output: Option<&'a str>,
    arguments: Vec<(String, String)>,
}

/// Runs `xacro FILE [-o OUTPUT] name:=value ...`, with relative paths from the working folder of the
/// search.
///
/// # Errors
/// Words that cannot be understood.
pub fn xacro(words: &[String], search: &Search) -> Result<Xacro, String> {
    let asked = read(words)?;
    let Some(file) = asked.file else { return Err("xacro is given no file".into()) };
    let host = search.host();
    let resolver = search.resolver(&host);
    let setting = Setting {
        host: &host,
        resolver: &resolver,
        working_folder: search.working_folder.clone(),
        arguments: asked.arguments,
        open_meshes: false,
    };
    let loaded = load(Path::new(file), &setting);
    // Only what keeps it from being expanded: the rest is reported when the robot is loaded.
    let Some(document) = &loaded.document else {
        let errors = loaded.diagnostics.iter().filter(|one| one.severity == Severity::Error);
        let errors = errors.map(|one| render(one, &loaded.sources, Style::Plain)).collect();
        return Ok(Xacro { errors, ..Xacro::default() });
    };
    let output = write_document(document);
    let Some(target) = asked.output else {
        return Ok(Xacro { output, is_success: true, ..Xacro::default() });
    };
    let target = search.working_folder.join(target);
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
