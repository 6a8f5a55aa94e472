//! Programs and files for launch files that are evaluated.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use periplus_diagnostics::{Severity, Style, render};
use periplus_formats::{Setting, load};
use periplus_host::Machine;
use periplus_launch::{Interpreter, Outside, Printed};
use periplus_resources::{Resolver, Store as _};
use periplus_xml::write_document;

use super::python::Python;

/// The machine as launch files see it.
pub(super) struct Programs<'a> {
    resolver: &'a Resolver<'a>,
    working_folder: PathBuf,
    /// A folder of this launch's own, once a file is in it.
    scratch: Option<PathBuf>,
    files: usize,
    /// Whether files that were made stay: a plan that was printed names them.
    is_kept: bool,
}

impl Drop for Programs<'_> {
    fn drop(&mut self) {
        if let Some(folder) = self.scratch.take().filter(|_| !self.is_kept) {
            let _ = std::fs::remove_dir_all(folder);
        }
    }
}

impl<'a> Programs<'a> {
    pub(super) fn new(resolver: &'a Resolver<'a>, working_folder: &Path, is_kept: bool) -> Self {
        let working_folder = working_folder.to_path_buf();
        Self { resolver, working_folder, scratch: None, files: 0, is_kept }
    }

    /// What `xacro FILE name:=value` prints: it is built in.
    fn xacro(&self, words: &[String]) -> Result<Printed, String> {
        let mut arguments = Vec::new();
        let mut file = None;
        for word in words {
            match word.split_once(":=") {
                Some((name, value)) => arguments.push((name.to_owned(), value.to_owned())),
                // Options of old: `--inorder` is what everybody has today.
                None if word.starts_with('-') => {}
                None => file = Some(word),
            }
        }
        let Some(file) = file else { return Err("xacro is given no file".into()) };
        let setting = Setting {
            host: &Machine,
            resolver: self.resolver,
            working_folder: self.working_folder.clone(),
            arguments,
            open_meshes: false,
        };
        let loaded = load(Path::new(file), &setting);
        let mut errors = String::new();
        // Only what keeps it from being expanded: the rest is told when the robot is loaded.
        let document = loaded.document.as_ref();
        if document.is_none() {
            for finding in loaded.diagnostics.iter().filter(|f| f.severity == Severity::Error) {
                errors += &render(finding, &loaded.sources, Style::Plain);
            }
        }
        Ok(Printed {
            output: document.map(write_document).unwrap_or_default(),
            is_success: document.is_some(),
            errors,
        })
    }
}

impl Outside for Programs<'_> {
    fn run(&mut self, words: &[String]) -> Result<Printed, String> {
        let [program, rest @ ..] = words else { return Err("no program is named".into()) };
        let name = program.rsplit('/').next().unwrap_or_default();
        if matches!(name, "xacro" | "xacro.py") {
            return self.xacro(rest);
        }
        let ran = Command::new(program).args(rest).stdin(Stdio::null()).output();
        let ran = ran.map_err(|error| error.to_string())?;
        Ok(Printed {
            output: String::from_utf8_lossy(&ran.stdout).into_owned(),
            errors: String::from_utf8_lossy(&ran.stderr).into_owned(),
            is_success: ran.status.success(),
        })
    }

    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, String> {
        let folder = match &self.scratch {
            Some(folder) => folder.clone(),
            None => {
                let folder =
                    std::env::temp_dir().join(format!("periplus_launch_{}", std::process::id()));
                std::fs::create_dir_all(&folder)
                    .map_err(|error| periplus_diagnostics::plain_words(&error))?;
                self.scratch.insert(folder).clone()
            }
        };
        self.files += 1;
        let path = folder.join(format!("{}_{name}", self.files));
        Machine.replace(&path, text.as_bytes())?;
        Ok(path)
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, String> {
        Ok(Box::new(Python::start()?))
    }
}
