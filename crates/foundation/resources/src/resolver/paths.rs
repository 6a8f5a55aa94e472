//! Absolute and relative paths, and the Fuel cache.

use std::path::{Path, PathBuf};

use super::Resolver;
use crate::fuel::FuelUri;
use crate::layout::in_sources;
use crate::miss::ResolveError;
use crate::places::How;
use crate::surroundings::Surroundings;
use crate::uri::percent_decoded;

impl Resolver<'_> {
    /// Resolves an absolute path, or one relative to the referring file's folder or, as in Gazebo, to any
    /// resource path.
    pub(super) fn path(
        &self,
        uri: &str,
        path: &str,
        around: &Surroundings,
    ) -> Result<PathBuf, ResolveError> {
        if Path::new(path).is_absolute() {
            return self.first(uri, path, vec![PathBuf::from("/")], around).map_err(
                |miss| match miss.kind {
                    kind if kind.is_missing() => miss.help(
                        "absolute paths hold on one machine only; \
                         `package://NAME/path/in/it` holds on all",
                    ),
                    _ => miss,
                },
            );
        }
        let folders = around.folders.iter().chain(self.fixed_folders()).cloned().collect();
        self.first(uri, path, folders, around)
    }

    /// Resolves a relative path without a base: Gazebo Classic searched `GAZEBO_RESOURCE_PATH` for
    /// `media/...`, other programs the folder of the package.
    pub(super) fn loose(
        &self,
        uri: &str,
        path: &str,
        around: &Surroundings,
    ) -> Result<PathBuf, ResolveError> {
        let exports = self.exports(around);
        let own = around.upward.iter().filter(|up| up.starts_with(&around.project));
        let mut folders: Vec<PathBuf> = Vec::new();
        let all = around.folders.iter().chain(self.fixed_folders()).chain(own);
        for folder in all.chain(exports.iter().map(|place| &place.folder)) {
            if !folders.contains(folder) {
                folders.push(folder.clone());
            }
        }
        self.first(uri, path, folders, around)
    }

    pub(super) fn fuel(
        &self,
        uri: &str,
        wanted: &FuelUri,
        around: &Surroundings,
    ) -> Result<PathBuf, ResolveError> {
        match wanted.find(self.host, &self.fuel_caches) {
            Ok(folder) if wanted.rest.is_empty() => self
                .fenced(&folder, None, around)
                .ok_or_else(|| ResolveError::outside(uri, &folder)),
            Ok(folder) => self.first(uri, &wanted.rest, vec![folder], around),
            Err(tried) => {
                let sort = if wanted.is_world() { "world" } else { "model" };
                let mut miss =
                    ResolveError::missing(uri, format!("the {sort} is not in the Fuel cache"))
                        .help(format!("fetch it once: `gz fuel download -u {}`", wanted.address()));
                miss.tried = tried;
                Err(miss)
            }
        }
    }

    fn fixed_folders(&self) -> impl Iterator<Item = &PathBuf> {
        let is_path = |how| matches!(how, How::Children | How::Workspace);
        self.fixed.iter().filter(move |place| is_path(place.how)).map(|place| &place.folder)
    }

    /// First of `folders` in which `path` exists.
    fn first(
        &self,
        uri: &str,
        path: &str,
        folders: Vec<PathBuf>,
        around: &Surroundings,
    ) -> Result<PathBuf, ResolveError> {
        let decoded = percent_decoded(path);
        let mut tried = Vec::new();
        let mut refused = None;
        for folder in &folders {
            for path in std::iter::once(path).chain(decoded.as_deref()) {
                let mut target = folder.join(path);
                if self.host.kind(&target).is_none() {
                    match in_sources(self.host, &target) {
                        Some(source) => target = source,
                        None => {
                            tried.push(target);
                            continue;
                        }
                    }
                }
                match self.fenced(&target, None, around) {
                    Some(target) => return Ok(target),
                    None => {
                        refused.get_or_insert(target);
                    }
                }
            }
        }
        if let Some(refused) = refused {
            return Err(ResolveError::outside(uri, &refused));
        }
        let mut miss = ResolveError::missing(uri, "there is no such file");
        if let Some(name) =
            folders.first().and_then(|folder| self.nearest_name(folder, path, around))
        {
            miss = miss.help(format!("did you mean `{name}`?"));
        }
        miss.tried = tried;
        Err(miss)
    }
}
