//! What a file may name: nothing outside the resource paths.

use std::path::{Path, PathBuf};

use super::Resolver;
use crate::host::Kind;
use crate::surroundings::Surroundings;

impl Resolver<'_> {
    /// Whether a canonical path lies where the mentioning file may look.
    pub(super) fn inside(&self, path: &Path, around: &Surroundings) -> bool {
        // An empty path, from a host that knows no folders, would be the start of every path.
        let project = &around.project;
        (path.starts_with(project) && !project.as_os_str().is_empty())
            || self.roots.iter().any(|root| path.starts_with(root))
            || {
                let granted = self.granted.borrow();
                path.ancestors().any(|up| granted.contains(up))
            }
    }

    /// The canonical form of a folder that a package or model name led to, if it may be used:
    /// it lies inside, it holds the mentioning file, or it says itself that it is what was sought.
    /// A link named like a model that leads to `/etc` says nothing of the kind.
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
        let is_model = || self.host.kind(&canonical.join("model.config")) == Some(Kind::File);
        if !is_around && self.manifest(&canonical).name != name && !is_model() {
            return None;
        }
        self.grant(canonical.clone());
        Some(canonical)
    }

    /// The canonical form of a path to something that stands there, if it may be named. `name` is
    /// the package in which it was sought.
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
        // `colcon build --symlink-install` fills the install folder with links to the sources:
        // these lead out, but into the same package.
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

    /// The nearest folder above (or at) a canonical path that is a package, and its name.
    pub(super) fn package_around(&self, path: &Path) -> Option<(PathBuf, String)> {
        path.ancestors().take(8).find_map(|up| {
            let name = self.manifest(up).name.clone();
            (!name.is_empty()).then(|| (up.to_path_buf(), name))
        })
    }
}
