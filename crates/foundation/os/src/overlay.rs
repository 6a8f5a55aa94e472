//! Machine with a modified environment and modified files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, FileReadError, Host};

use crate::Machine;

/// [`Machine`] as seen by a program with a modified environment, and with texts in place of some files, which need
/// not exist.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// Variables that differ from those of the machine; `None` for a removed one.
    pub variables: BTreeMap<String, Option<String>>,
    /// Texts of files by their paths, which are canonical or name no file of the machine.
    pub texts: BTreeMap<PathBuf, String>,
}

impl Overlay {
    /// Replaces a file.
    #[must_use]
    pub fn with_text(mut self, path: PathBuf, text: String) -> Self {
        self.texts.insert(path, text);
        self
    }

    fn text(&self, path: &Path) -> Option<&String> {
        if self.texts.is_empty() {
            return None;
        }
        self.texts.get(path).or_else(|| self.texts.get(&Machine.canonical(path)?))
    }
}

impl Host for Overlay {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match self.text(path) {
            Some(text) => Ok(text.clone().into_bytes()),
            None => Machine.read(path),
        }
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        match self.texts.get(path) {
            Some(_) => Some(EntryKind::File),
            None => Machine.kind(path),
        }
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        Machine.list(folder)
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        match self.texts.get(path) {
            Some(_) => Some(path.to_owned()),
            None => Machine.canonical(path),
        }
    }

    fn variable(&self, name: &str) -> Option<String> {
        match self.variables.get(name) {
            Some(changed) => changed.clone(),
            None => Machine.variable(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_variables_go_before_those_of_the_machine() {
        let changed = [("PATH", None), ("SDF_PATH", Some("/models".to_owned()))];
        let variables = changed.map(|(name, value)| (name.to_owned(), value)).into();
        let host = Overlay { variables, ..Overlay::default() };
        assert_eq!(host.variable("PATH"), None);
        assert_eq!(host.variable("SDF_PATH").as_deref(), Some("/models"));
        assert_eq!(Overlay::default().variable("PATH"), Machine.variable("PATH"));
    }

    #[test]
    fn a_text_is_read_in_place_of_a_file() {
        let path = PathBuf::from("/no such folder/robot.urdf");
        let host = Overlay::default().with_text(path.clone(), "<robot/>".to_owned());
        assert_eq!(host.read(&path).expect("the text"), b"<robot/>");
        assert_eq!(host.kind(&path), Some(EntryKind::File));
        assert_eq!(host.canonical(&path), Some(path));
        assert!(host.read(Path::new("/no such folder/other.urdf")).is_err());
    }
}
