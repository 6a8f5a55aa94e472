//! Access restrictions: a file may refer only to files inside the resource paths.

use std::path::{Path, PathBuf};

use super::Resolver;
use crate::host::EntryKind;
use crate::surroundings::Surroundings;

impl Resolver<'_> {
    /// Returns true if a canonical path is inside the folders that the referring file may access.
    pub(super) fn inside(&self, path: &Path, around: &Surroundings) -> bool {
        // An empty path, from a host without folders, would be a prefix of every path.
        let project = &around.project;
        (path.starts_with(project) && !project.as_os_str().is_empty())
            || self.roots.iter().any(|root| path.starts_with(root))
            || {
                let granted = self.granted.borrow();
                path.ancestors().any(|up| granted.contains(up))
            }
    }

    /// Canonical path of a folder found for a package or model name, if access is allowed: it is inside, it
    /// contains the referring file, or its own manifest has the name. A link with the name of a model that
    /// points to `/etc` has no such manifest.
    pub(super) fn accepted(
        &self,
        folder: &Path,
        name: &str,
        around: &Surroundings,
    ) -> Option<PathBuf> {
        let canonical = self.host.canonical(folder)?;
        if self.inside(&canonical, around) {
            return Some(canonical);
        }
        let is_around = canonical.file_name().is_some_and(|own| own == name)
            && around.eponyms.contains(&canonical);
        let is_model = || self.host.kind(&canonical.join("model.config")) == Some(EntryKind::File);
        if !is_around && self.manifest(&canonical).name != name && !is_model() {
            return None;
        }
        self.grant(canonical.clone());
        Some(canonical)
    }

    /// Canonical path of an existing target, if access is allowed. `name` is the package in which it was
    /// searched.
    pub(super) fn fenced(
        &self,
        target: &Path,
        name: Option<&str>,
        around: &Surroundings,
    ) -> Option<PathBuf> {
        let canonical = self.host.canonical(target)?;
        if self.inside(&canonical, around) {
            return Some(canonical);
        }
        // `colcon build --symlink-install` fills the install folder with links to the sources: these point
        // outside, but into the same package.
        let sought = match name {
            Some(name) => name.to_owned(),
            None => {
                let folder = self.host.canonical(target.parent()?)?;
                let (_, name) = self.package_around(&folder)?;
                self.inside(&folder, around).then_some(name)?
            }
        };
        let (source, name) = self.package_around(&canonical)?;
        if name != sought {
            return None;
        }
        self.grant(source);
        Some(canonical)
    }

    /// Nearest package folder at or above a canonical path, with its name.
    pub(super) fn package_around(&self, path: &Path) -> Option<(PathBuf, String)> {
        path.ancestors().take(8).find_map(|up| {
            let name = self.manifest(up).name.clone();
            (!name.is_empty()).then(|| (up.to_path_buf(), name))
        })
    }
}
