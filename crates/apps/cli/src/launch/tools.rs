//! Built-in programs that launch files expect on the PATH: `xacro`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_launch::bringup::xacro;
use periplus_os::Machine;
use periplus_resources::Host as _;

use crate::error::CliError;
use crate::terminal;

/// Argument that makes this program act as `xacro`. Not a command for users.
pub(crate) const XACRO_VERB: &str = "__xacro";

/// Number of folder names that are tried.
#[cfg(unix)]
const MAX_FOLDERS: u32 = 1000;

/// Private folder with these programs. It is last on the PATH, after installed ones, and is removed
/// on drop.
pub(super) struct Tools {
    folder: PathBuf,
}

impl Tools {
    /// Creates the folder; `None` where it cannot be created, or where scripts are not executable.
    pub(super) fn make(resource_path: &[PathBuf]) -> Option<Self> {
        let own = crate::own_command::own_command();
        if own.is_empty() {
            return None;
        }
        let here = terminal::working_folder();
        let folders = resource_path.iter().map(|folder| here.join(folder));
        let mut words = own.to_vec();
        words.push(XACRO_VERB.to_owned());
        words.push(resource_path.len().to_string());
        words.extend(folders.map(|folder| folder.display().to_string()));
        let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
        let script = format!("#!/bin/sh\nexec {} \"$@\"\n", words.join(" "));
        let tools = Self { folder: private_folder()? };
        for name in ["xacro", "xacro.py"] {
            program(&tools.folder.join(name), &script)?;
        }
        Some(tools)
    }

    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// PATH of this process, with the folder at its end.
    pub(super) fn path(&self) -> OsString {
        let mut path = OsString::from(Machine.variable("PATH").unwrap_or_default());
        if !path.is_empty() {
            path.push(":");
        }
        path.push(&self.folder);
        path
    }
}

impl Drop for Tools {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// Quotes a word for the shell.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// Creates a new folder that other users cannot write to.
#[cfg(unix)]
fn private_folder() -> Option<PathBuf> {
    use std::os::unix::fs::DirBuilderExt as _;
    let own = std::process::id();
    let mut builder = std::fs::DirBuilder::new();
    builder.mode(0o700);
    (0..MAX_FOLDERS)
        .map(|number| std::env::temp_dir().join(format!("periplus_tools_{own}_{number}")))
        .find(|folder| builder.create(folder).is_ok())
}

#[cfg(not(unix))]
fn private_folder() -> Option<PathBuf> {
    None
}

#[cfg(unix)]
fn program(path: &Path, text: &str) -> Option<()> {
    use std::io::Write as _;
    use std::os::unix::fs::OpenOptionsExt as _;
    let mut options = std::fs::OpenOptions::new();
    let mut file = options.write(true).create_new(true).mode(0o700).open(path).ok()?;
    file.write_all(text.as_bytes()).ok()
}

#[cfg(not(unix))]
fn program(_path: &Path, _text: &str) -> Option<()> {
    None
}

/// Runs `xacro`: `N FOLDER...`, the folders searched for packages, followed by the arguments of the
/// command.
pub(crate) fn run_xacro(words: &[String]) -> Result<ExitCode, CliError> {
    let (count, words) = match words.split_first() {
        Some((count, words)) => (count.parse().unwrap_or(0).min(words.len()), words),
        None => (0, words),
    };
    let (folders, words) = words.split_at(count);
    let folders: Vec<PathBuf> = folders.iter().map(PathBuf::from).collect();
    let search = terminal::search(&folders);
    let done = search.with_context(false, |context| xacro(words, context));
    let printed = done.map_err(|error| CliError::usage(error.to_string()))?.printed;
    std::io::Write::write_all(&mut std::io::stdout().lock(), printed.output.as_bytes())?;
    std::io::Write::write_all(&mut std::io::stderr().lock(), printed.errors.as_bytes())?;
    Ok(if printed.is_success { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
