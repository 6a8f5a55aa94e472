//! `package://name/rest` and `model://name/rest`.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::Resolver;
use crate::host::EntryKind;
use crate::layout::in_sources;
use crate::miss::ResolveError;
use crate::places::{How, Place};
use crate::surroundings::Surroundings;
use crate::uri::{Scheme, percent_decoded};

/// Result of one search path for one name.
#[derive(Debug, Default)]
pub(super) struct Look {
    /// Folders that exist.
    found: Vec<PathBuf>,
    /// Folders that do not.
    tried: Vec<PathBuf>,
    cut_short: bool,
}

/// State of the search for a name.
#[derive(Debug, Default)]
struct Search {
    /// Folders of that name, in which the rest of the URI was searched.
    folders: Vec<PathBuf>,
    tried: Vec<PathBuf>,
    /// Existing target that is outside.
    refused: Option<PathBuf>,
    cut_short: Option<PathBuf>,
}

impl Resolver<'_> {
    pub(super) fn named(
        &self,
        uri: &str,
        scheme: Scheme,
        name: &str,
        rest: &str,
        around: &Surroundings,
    ) -> Result<PathBuf, ResolveError> {
        let mut search = Search::default();
        let decoded = percent_decoded(name);
        let is_name = |name: &str| !matches!(name, "" | "." | "..") && !name.contains('/');
        for name in std::iter::once(name).chain(decoded.as_deref().filter(|name| is_name(name))) {
            let found = match rest {
                "" => self.folder(scheme, name, around, &mut search),
                _ => self.in_folder(name, rest, around, &mut search),
            };
            if let Some(found) = found {
                return Ok(found);
            }
        }
        let mut miss = match (&search.refused, search.folders.first()) {
            (Some(refused), _) => return Err(ResolveError::outside(uri, refused)),
            (None, Some(folder)) => self.without_file(uri, name, rest, folder, around),
            (None, None) => self.without_folder(uri, scheme, name, around),
        };
        miss.tried = search.tried;
        if let Some(folder) = search.cut_short {
            let folder = folder.display();
            miss = miss
                .help(format!("there are too many folders below {folder} to search all of them"));
        }
        Err(miss)
    }

    /// Best folder of a name: one whose manifest has the name, else the first. A repository with the same
    /// name as a package in it has no such manifest.
    fn folder(
        &self,
        scheme: Scheme,
        name: &str,
        around: &Surroundings,
        search: &mut Search,
    ) -> Option<PathBuf> {
        let mut first = None;
        for look in self.looks(name, around) {
            search.note(&look, |folder| folder.to_path_buf());
            for folder in &look.found {
                let Some(folder) = self.accepted(folder, name, around) else {
                    search.refused.get_or_insert_with(|| folder.clone());
                    continue;
                };
                let says_so = match scheme {
                    Scheme::Package => self.manifest(&folder).name == name,
                    Scheme::Model => self.model_file(&folder).is_ok(),
                };
                if says_so {
                    return Some(folder);
                }
                first.get_or_insert(folder);
            }
        }
        first
    }

    /// First existing file of that path in any folder of that name.
    fn in_folder(
        &self,
        name: &str,
        rest: &str,
        around: &Surroundings,
        search: &mut Search,
    ) -> Option<PathBuf> {
        let decoded = percent_decoded(rest);
        for look in self.looks(name, around) {
            search.note(&look, |folder| folder.join(rest));
            for found in &look.found {
                let Some(folder) = self.accepted(found, name, around) else {
                    search.refused.get_or_insert_with(|| found.clone());
                    continue;
                };
                for rest in std::iter::once(rest).chain(decoded.as_deref()) {
                    let mut target = folder.join(rest);
                    if self.host.kind(&target).is_none() {
                        match in_sources(self.host, &target) {
                            Some(source) => target = source,
                            None => {
                                if !search.tried.contains(&target) {
                                    search.tried.push(target);
                                }
                                continue;
                            }
                        }
                    }
                    match self.fenced(&target, Some(name), around) {
                        Some(target) => return Some(target),
                        None => {
                            search.refused.get_or_insert(target);
                        }
                    }
                }
                if !search.folders.contains(&folder) {
                    search.folders.push(folder);
                }
            }
        }
        None
    }

    /// Results of the search paths for a name, in order; each is searched only if the previous ones had no
    /// result.
    fn looks<'a>(
        &'a self,
        name: &'a str,
        around: &'a Surroundings,
    ) -> impl Iterator<Item = Rc<Look>> + 'a {
        let exports = std::iter::once_with(|| self.exports(around).as_ref().clone()).flatten();
        let places = self.fixed.iter().chain(&around.places).cloned().chain(exports);
        places.map(move |place| self.look(&place, name))
    }

    fn look(&self, place: &Place, name: &str) -> Rc<Look> {
        let key = (place.clone(), name.to_owned());
        if let Some(known) = self.looks.borrow().get(&key) {
            return known.clone();
        }
        let folder = &place.folder;
        let mut look = Look::default();
        let wanted = match place.how {
            How::Children => vec![folder.join(name)],
            How::Prefix => vec![folder.join("share").join(name)],
            How::Workspace => {
                let is_it = folder.file_name().is_some_and(|own| own == name)
                    || self.manifest(folder).name == name;
                let within = ["", "models", "src"].map(|middle| folder.join(middle).join(name));
                is_it.then(|| folder.clone()).into_iter().chain(within).collect()
            }
            How::Tree(depth) => {
                let crawl = self.crawl(folder, depth);
                look.cut_short = crawl.cut_short;
                let packages = crawl.packages.get(name).cloned();
                packages.unwrap_or_else(|| vec![folder.join("**").join(name)])
            }
        };
        let exists = |path: &PathBuf| self.host.kind(path) == Some(EntryKind::Folder);
        (look.found, look.tried) = wanted.into_iter().partition(exists);
        let look = Rc::new(look);
        self.looks.borrow_mut().insert(key, look.clone());
        look
    }

    /// Folders that packages export for Gazebo (`<gazebo_ros gazebo_model_path="..."/>`), of all visible
    /// packages.
    pub(super) fn exports(&self, around: &Surroundings) -> Rc<Vec<Place>> {
        if let Some(known) = self.exports.borrow().get(&around.id) {
            return known.clone();
        }
        let mut places: Vec<Place> = Vec::new();
        for place in self.fixed.iter().chain(&around.places) {
            let crawl = match place.how {
                How::Tree(depth) => self.crawl(&place.folder, depth),
                How::Prefix => self.crawl(&place.folder.join("share"), 1),
                How::Children | How::Workspace => continue,
            };
            for (package, manifest) in &crawl.exports {
                for path in &manifest.gazebo_paths {
                    let path = path.replace("${prefix}", &package.to_string_lossy());
                    let Some(folder) = self.host.canonical(Path::new(&path)) else { continue };
                    let place = Place { folder, how: How::Children };
                    if !places.contains(&place) {
                        places.push(place);
                    }
                }
            }
        }
        let places = Rc::new(places);
        self.exports.borrow_mut().insert(around.id, places.clone());
        places
    }
}

impl Search {
    fn note(&mut self, look: &Look, shown: impl Fn(&Path) -> PathBuf) {
        for folder in &look.tried {
            let place = shown(folder);
            if !self.tried.contains(&place) {
                self.tried.push(place);
            }
            if look.cut_short && self.cut_short.is_none() {
                self.cut_short = folder.ancestors().nth(2).map(Path::to_path_buf);
            }
        }
    }
}
