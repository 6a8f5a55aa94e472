//! Resolution of URIs.

mod advice;
mod fence;
mod model_file;
mod named;
mod paths;

#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use crate::crawl::Crawl;
use crate::host::Host;
use crate::manifest::PackageManifest;
use crate::miss::{ResolveError, ResolveErrorKind};
use crate::places::{self, How, Place};
use crate::surroundings::{Surroundings, surroundings};
use crate::uri::{self, Scheme, Uri};
use crate::{crawl, fuel, manifest};

/// Maximum number of different unresolved URIs of one file; after that no more are searched, as a hostile
/// file may contain a million.
const MAX_CACHED_MISSES: usize = 2_000;

/// Resolves the URIs in robot and world files. Accesses the machine only through a [`Host`], and each entry
/// once; create a new resolver to see changes.
///
/// # Search order
/// For `package://name/rest` and `model://name/rest` alike, in this order:
/// 1. each `--resource-path`: as the folder itself, `name`, `models/name`, `src/name` in it, and
///    any package of that name a few folders below;
/// 2. the [`SEARCH_VARIABLES`](crate::SEARCH_VARIABLES), `ROS_PACKAGE_PATH` (also below its entries), `AMENT_PREFIX_PATH`
///    (in `share`), and `~/.gazebo/models`;
/// 3. upward from the mentioning file, to the repository around it or 8 folders, each folder as
///    under 1;
/// 4. the `gazebo_model_path` that the packages found in this search export, and the search paths that
///    their environment hooks would set.
///
/// # Access restrictions
/// Files outside the resource paths, the referring file's project, and resolved packages or models are
/// refused: a downloaded world cannot read the rest of the machine, neither by `..` nor by links.
pub struct Resolver<'h> {
    host: &'h dyn Host,
    fixed: Vec<Place>,
    fuel_caches: Vec<PathBuf>,
    /// Canonical folders whose content any file may refer to.
    roots: Vec<PathBuf>,
    /// Resolved packages and models outside the roots.
    granted: RefCell<BTreeSet<PathBuf>>,
    around: RefCell<BTreeMap<PathBuf, Rc<Surroundings>>>,
    answers: RefCell<BTreeMap<(usize, String), Result<PathBuf, ResolveError>>>,
    looks: RefCell<BTreeMap<(Place, String), Rc<named::Look>>>,
    crawls: RefCell<BTreeMap<(PathBuf, usize), Rc<Crawl>>>,
    manifests: RefCell<BTreeMap<PathBuf, Rc<PackageManifest>>>,
    model_files: RefCell<BTreeMap<PathBuf, Result<PathBuf, ResolveError>>>,
    exports: RefCell<BTreeMap<usize, Rc<Vec<Place>>>>,
    known: RefCell<BTreeMap<usize, Rc<BTreeSet<String>>>>,
    /// Number of unresolved URIs by referring file.
    misses: RefCell<BTreeMap<usize, usize>>,
    /// Advice of the caller about missing targets, in addition to the resolver's own.
    advice: Option<String>,
}

impl<'h> Resolver<'h> {
    /// Returns a resolver for the `--resource-path` folders in `extra` and the environment variables.
    #[must_use]
    pub fn new(host: &'h dyn Host, extra: &[PathBuf]) -> Self {
        let fixed = places::fixed(host, extra);
        let fuel_caches = fuel::caches(host);
        let folders = fixed.iter().map(|place| &place.folder).chain(&fuel_caches);
        let mut roots: Vec<PathBuf> = folders.filter_map(|folder| host.canonical(folder)).collect();
        roots.sort();
        roots.dedup();
        Self {
            host,
            fixed,
            fuel_caches,
            roots,
            granted: RefCell::default(),
            around: RefCell::default(),
            answers: RefCell::default(),
            looks: RefCell::default(),
            crawls: RefCell::default(),
            manifests: RefCell::default(),
            model_files: RefCell::default(),
            exports: RefCell::default(),
            known: RefCell::default(),
            misses: RefCell::default(),
            advice: None,
        }
    }

    /// Adds advice to the message about each missing target: the caller knows the source of the search
    /// paths.
    #[must_use]
    pub fn advising(mut self, advice: Option<String>) -> Self {
        self.advice = advice;
        self
    }

    /// Advice added by [`Resolver::advising`].
    #[must_use]
    pub fn advice(&self) -> Option<&str> {
        self.advice.as_deref()
    }

    /// Canonical path of the file or folder that `uri` refers to in the file `from`.
    ///
    /// # Errors
    /// If the target does not exist or is outside the resource paths.
    pub fn resolve(&self, uri: &str, from: &Path) -> Result<PathBuf, ResolveError> {
        let around = self.surroundings(from);
        let key = (around.id, uri.to_owned());
        if let Some(answer) = self.answers.borrow().get(&key) {
            return answer.clone();
        }
        if self.misses(&around) >= MAX_CACHED_MISSES {
            let reason = format!(
                "{MAX_CACHED_MISSES} other URIs of this file could not be resolved, so it was not searched"
            );
            return Err(ResolveError::missing(uri, reason));
        }
        let answer = self.look_up(uri, &around).map_err(|miss| match &self.advice {
            Some(advice) if miss.kind.is_missing() => miss.help(advice.clone()),
            _ => miss,
        });
        if answer.is_err() {
            *self.misses.borrow_mut().entry(around.id).or_default() += 1;
        }
        self.answers.borrow_mut().insert(key, answer.clone());
        answer
    }

    /// Folder of a ROS package, for xacro's `$(find name)` and `package://name`.
    ///
    /// # Errors
    /// If it is not found; lists the searched paths.
    pub fn find_package(&self, name: &str, from: &Path) -> Result<PathBuf, ResolveError> {
        self.find(Scheme::Package, name, from)
    }

    /// Folder of a model, for `model://name`. See [`Resolver::model_file`] for the file in it.
    ///
    /// # Errors
    /// If it is not found; lists the searched paths.
    pub fn find_model(&self, name: &str, from: &Path) -> Result<PathBuf, ResolveError> {
        self.find(Scheme::Model, name, from)
    }

    /// ROS packages that are visible to the file `from`, by name, with their folders.
    #[must_use]
    pub fn packages(&self, from: &Path) -> BTreeMap<String, PathBuf> {
        let around = self.surroundings(from);
        let mut packages = BTreeMap::new();
        for place in self.fixed.iter().chain(&around.places) {
            let crawl = match place.how {
                How::Tree(depth) => self.crawl(&place.folder, depth),
                How::Prefix => self.crawl(&place.folder.join("share"), 1),
                How::Workspace => {
                    let name = self.manifest(&place.folder).name.clone();
                    if !name.is_empty() {
                        packages.entry(name).or_insert_with(|| place.folder.clone());
                    }
                    continue;
                }
                How::Children => continue,
            };
            for (name, folders) in &crawl.packages {
                if let Some(folder) = folders.first() {
                    packages.entry(name.clone()).or_insert_with(|| folder.clone());
                }
            }
        }
        packages
    }

    fn find(&self, scheme: Scheme, name: &str, from: &Path) -> Result<PathBuf, ResolveError> {
        self.resolve(&format!("{}://{}", scheme.word(), name.trim()), from)
    }

    fn look_up(&self, uri: &str, around: &Surroundings) -> Result<PathBuf, ResolveError> {
        match uri::parse(uri)? {
            Uri::Named { scheme, name, rest } => self.named(uri, scheme, &name, &rest, around),
            Uri::Path(path) => self.path(uri, &path, around),
            Uri::Loose(path) => self.loose(uri, &path, around),
            Uri::Fuel(wanted) => self.fuel(uri, &wanted, around),
        }
    }

    fn surroundings(&self, from: &Path) -> Rc<Surroundings> {
        if let Some(known) = self.around.borrow().get(from) {
            return known.clone();
        }
        let mut around = self.around.borrow_mut();
        let made = Rc::new(surroundings(self.host, from, around.len()));
        around.insert(from.to_path_buf(), made.clone());
        made
    }

    fn misses(&self, around: &Surroundings) -> usize {
        self.misses.borrow().get(&around.id).copied().unwrap_or(0)
    }

    fn crawl(&self, folder: &Path, depth: usize) -> Rc<Crawl> {
        let key = (folder.to_path_buf(), depth);
        if let Some(known) = self.crawls.borrow().get(&key) {
            return known.clone();
        }
        let made = Rc::new(crawl::crawl(self.host, folder, depth));
        self.crawls.borrow_mut().insert(key, made.clone());
        made
    }

    /// Content of a folder's `package.xml`; empty if it has none.
    fn manifest(&self, folder: &Path) -> Rc<PackageManifest> {
        if let Some(known) = self.manifests.borrow().get(folder) {
            return known.clone();
        }
        let bytes = self.host.read(&folder.join("package.xml")).unwrap_or_default();
        let made = Rc::new(manifest::package(&bytes));
        self.manifests.borrow_mut().insert(folder.to_path_buf(), made.clone());
        made
    }

    /// Discards cached results that a newly granted folder may change.
    fn grant(&self, folder: PathBuf) {
        if self.granted.borrow_mut().insert(folder) {
            let refused = |answer: &Result<PathBuf, ResolveError>| matches!(answer, Err(miss) if miss.kind == ResolveErrorKind::Outside);
            self.answers.borrow_mut().retain(|_, answer| !refused(answer));
        }
    }
}
