//! Machine with a modified environment.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, FileReadError, Host};

use crate::Machine;

/// [`Machine`] as seen by a program with a modified environment.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// Variables that differ from those of the machine; `None` for a removed one.
    pub variables: BTreeMap<String, Option<String>>,
}

impl Host for Overlay {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        Machine.read(path)
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        Machine.kind(path)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        Machine.list(folder)
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        Machine.canonical(path)
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
        let host = Overlay { variables };
        assert_eq!(host.variable("PATH"), None);
        assert_eq!(host.variable("SDF_PATH").as_deref(), Some("/models"));
        assert_eq!(Overlay::default().variable("PATH"), Machine.variable("PATH"));
    }
}
