//! Files that the runs of a sweep read, and the copy of them on which the runs work.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use periplus_os::{FileLog, Machine};
use periplus_resources::Host as _;
use periplus_scenarios::below_root;
use periplus_session::files;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::error::SweepError;

/// Folders of the system, in which nothing belongs to a scenario.
const SYSTEM_FOLDERS: [&str; 3] = ["/proc", "/sys", "/dev"];

/// Separator of the folders in an environment variable such as `GZ_SIM_RESOURCE_PATH`.
const PATH_SEPARATOR: char = if cfg!(windows) { ';' } else { ':' };

/// A file that a run reads.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct InputFile {
    /// Absolute path.
    pub path: PathBuf,
    /// SHA-256 of the content, in hexadecimal digits.
    pub sha256: String,
}

/// Files, folders and environment variables that the runs of a sweep use.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SweepInputs {
    /// Files that are read, sorted.
    pub files: Vec<InputFile>,
    /// Files that only have to exist, sorted.
    pub seen: BTreeSet<PathBuf>,
    /// Folders, sorted.
    pub folders: BTreeSet<PathBuf>,
    /// Environment variables with their values; `None` for one that is not set.
    pub environment: BTreeMap<String, Option<String>>,
}

impl SweepInputs {
    /// Inputs of a log of file accesses, with the contents that the files have now.
    ///
    /// # Errors
    /// A file that can no longer be read.
    pub(crate) fn of_log(log: FileLog) -> Result<(Self, Vec<Vec<u8>>), SweepError> {
        let is_own = |path: &PathBuf| SYSTEM_FOLDERS.iter().all(|folder| !path.starts_with(folder));
        let (mut inputs, mut contents) = (Vec::new(), Vec::new());
        for path in log.read.into_iter().filter(is_own) {
            let content = files::read(&path)?;
            inputs.push(InputFile { sha256: sha256(&content), path });
            contents.push(content);
        }
        let inputs = Self {
            files: inputs,
            seen: log.seen.into_iter().filter(is_own).collect(),
            folders: log.folders.into_iter().filter(is_own).collect(),
            environment: log.variables,
        };
        Ok((inputs, contents))
    }

    /// Name of the folder with the copy: it changes with every content.
    #[must_use]
    pub fn tree_name(&self) -> String {
        let mut text = String::new();
        for InputFile { path, sha256 } in &self.files {
            text.push_str(&format!("{sha256} {}\n", path.display()));
        }
        for path in self.seen.iter().chain(&self.folders) {
            text.push_str(&format!("{}\n", path.display()));
        }
        sha256(text.as_bytes())[..TREE_NAME_DIGITS].to_owned()
    }

    /// Writes the copy below `tree`, unless it exists.
    ///
    /// # Errors
    /// A failed write.
    pub(crate) fn write_tree(&self, tree: &Path, contents: &[Vec<u8>]) -> Result<(), SweepError> {
        if Machine.kind(tree).is_some() {
            return Ok(());
        }
        let part = tree.with_extension(format!("{}.part", std::process::id()));
        for folder in &self.folders {
            files::make_folder(&part.join(below_root(folder)))?;
        }
        let empty = Vec::new();
        let seen = self.seen.iter().map(|path| (path, &empty));
        let read = self.files.iter().map(|file| &file.path).zip(contents);
        for (path, content) in seen.chain(read) {
            let to = part.join(below_root(path));
            files::make_folder(to.parent().unwrap_or(&part))?;
            files::write(&to, content)?;
        }
        files::make_folder(&part)?;
        if std::fs::rename(&part, tree).is_err() && Machine.kind(tree).is_none() {
            let message = format!("cannot rename {} to {}", part.display(), tree.display());
            return Err(SweepError::Failed(message));
        }
        // Another process may have been faster.
        let _ = std::fs::remove_dir_all(&part);
        Ok(())
    }

    /// Environment variables for a run on the copy: paths below `tree` in place of existing paths.
    #[must_use]
    pub(crate) fn environment_in(&self, tree: &Path) -> BTreeMap<String, Option<String>> {
        let known = |path: &Path| {
            self.folders.contains(path)
                || self.seen.contains(path)
                || self.files.iter().any(|file| file.path == path)
                || self
                    .folders
                    .range(path.to_owned()..)
                    .next()
                    .is_some_and(|it| it.starts_with(path))
        };
        let moved = |entry: &str| {
            let path = periplus_os::plain(Path::new(entry));
            if Path::new(entry).is_absolute() && known(&path) {
                tree.join(below_root(&path)).to_string_lossy().into_owned()
            } else {
                entry.to_owned()
            }
        };
        let value = |text: &String| {
            let entries: Vec<String> = text.split(PATH_SEPARATOR).map(moved).collect();
            entries.join(&PATH_SEPARATOR.to_string())
        };
        let variables = self.environment.iter();
        variables.map(|(name, text)| (name.clone(), text.as_ref().map(value))).collect()
    }

    /// Environment variables that are no paths of this machine: results may depend on their values.
    pub(crate) fn plain_variables(&self) -> impl Iterator<Item = (&String, &String)> {
        self.environment.iter().filter_map(|(name, value)| {
            let value = value.as_ref()?;
            let is_path = |entry: &str| entry.is_empty() || Path::new(entry).is_absolute();
            (!value.split(PATH_SEPARATOR).all(is_path)).then_some((name, value))
        })
    }
}

/// Number of hexadecimal digits in the name of a copy.
const TREE_NAME_DIGITS: usize = 16;

/// SHA-256 in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Path of a file relative to a folder, with `/`, so that it is the same on every machine.
pub(crate) fn relative(path: &Path, folder: &Path) -> String {
    let (to, from): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (path.components().collect(), folder.components().collect());
    let common = to.iter().zip(&from).take_while(|(a, b)| a == b).count();
    let up = from[common..].iter().map(|_| "..".to_owned());
    let down = to[common..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_is_that_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), expected);
    }

    #[cfg(unix)]
    #[test]
    fn paths_are_relative_to_a_folder() {
        let of = |path: &str| relative(Path::new(path), Path::new("/a/b"));
        assert_eq!(of("/a/b/c.yaml"), "c.yaml");
        assert_eq!(of("/a/x/y.sdf"), "../x/y.sdf");
        assert_eq!(of("/z"), "../../z");
    }

    #[cfg(unix)]
    #[test]
    fn known_folders_in_variables_are_moved() {
        let value = |text: &str| Some(text.to_owned());
        let inputs = SweepInputs {
            folders: [PathBuf::from("/opt/models/x")].into(),
            environment: [
                ("PATHS".to_owned(), value("/opt/models:/none")),
                ("PREFIX".to_owned(), value("robot1")),
                ("UNSET".to_owned(), None),
            ]
            .into(),
            ..SweepInputs::default()
        };
        let moved = inputs.environment_in(Path::new("/tree"));
        assert_eq!(moved["PATHS"], value("/tree/opt/models:/none"));
        assert_eq!([&moved["PREFIX"], &moved["UNSET"]], [&value("robot1"), &None]);
        let plain: Vec<_> = inputs.plain_variables().map(|(name, _)| name.as_str()).collect();
        assert_eq!(plain, ["PREFIX"]);
    }
}
