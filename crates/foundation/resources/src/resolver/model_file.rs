//! Main file of a model folder.

use std::path::{Path, PathBuf};

use super::Resolver;
use crate::host::EntryKind;
use crate::manifest;
use crate::miss::ResolveError;

/// Newest supported version of SDF.
const NEWEST: (u32, u32) = (1, 12);

impl Resolver<'_> {
    /// Description file in a model folder: the entry of `model.config` with the highest version up to 1.12,
    /// as in libsdformat; without such an entry `model.sdf`, `NAME.sdf`, `model.urdf` or `NAME.urdf`.
    ///
    /// # Errors
    /// If there is none; lists the files that were tried.
    pub fn model_file(&self, folder: &Path) -> Result<PathBuf, ResolveError> {
        if let Some(known) = self.model_files.borrow().get(folder) {
            return known.clone();
        }
        let found = self.seek_model_file(folder);
        self.model_files.borrow_mut().insert(folder.to_path_buf(), found.clone());
        found
    }

    fn seek_model_file(&self, folder: &Path) -> Result<PathBuf, ResolveError> {
        let uri = folder.display().to_string();
        let canonical = self.host.canonical(folder).unwrap_or_else(|| folder.to_path_buf());
        let config = folder.join("model.config");
        let entries = self.host.read(&config).map(|bytes| manifest::model_config(&bytes));
        let has_config = entries.is_ok();
        let mut entries = entries.unwrap_or_default();
        let newest_offered = entries.iter().map(|entry| entry.version).max();
        entries.retain(|entry| entry.version <= NEWEST);
        if let (Some((major, minor)), true) = (newest_offered, entries.is_empty()) {
            let reason = format!(
                "its model.config offers SDF {major}.{minor} and nothing older; \
                 up to {}.{} is read",
                NEWEST.0, NEWEST.1
            );
            return Err(ResolveError::missing(&uri, reason).tried(config));
        }
        // Highest version first; of equal ones the first in the file.
        entries.sort_by_key(|entry| std::cmp::Reverse(entry.version));
        let name = canonical.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let usual = ["model.sdf".into(), format!("{name}.sdf"), "model.urdf".into()];
        let usual = usual.into_iter().chain([format!("{name}.urdf")]);
        let mut miss = ResolveError::missing(&uri, "no file in it is a model");
        miss.tried.push(config);
        for file in entries.into_iter().take(1).map(|entry| entry.file).chain(usual) {
            let target = folder.join(&file);
            if self.host.kind(&target) != Some(EntryKind::File) {
                if !miss.tried.contains(&target) {
                    miss.tried.push(target);
                }
                continue;
            }
            // An entry outside the folder is refused, except for that of a package installed as links to
            // its sources.
            let package = |path: &Path| self.package_around(path).map(|(_, name)| name);
            let belongs = |target: &PathBuf| {
                target.starts_with(&canonical)
                    || package(target).is_some_and(|name| package(&canonical) == Some(name))
            };
            return match self.host.canonical(&target).filter(belongs) {
                Some(target) => Ok(target),
                None => Err(ResolveError::outside(&uri, &target)),
            };
        }
        let help = if has_config {
            "write `<sdf version=\"1.9\">FILE</sdf>` into its model.config"
        } else {
            "add a model.config with `<sdf version=\"1.9\">FILE</sdf>`"
        };
        Err(miss.help(help))
    }
}
