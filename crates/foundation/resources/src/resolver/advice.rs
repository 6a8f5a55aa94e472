//! Advice for URIs that cannot be resolved.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use periplus_diagnostics::closest;

use super::Resolver;
use crate::host::EntryKind;
use crate::miss::ResolveError;
use crate::places::How;
use crate::surroundings::Surroundings;
use crate::uri::Scheme;

/// Maximum number of unresolved URIs with a suggestion; suggestions for thousands would take too long.
const MAX_SUGGESTIONS: usize = 100;
/// Maximum number of known names that are compared.
const MAX_NAMES: usize = 5_000;

impl Resolver<'_> {
    /// The package or model exists, the file in it does not.
    pub(super) fn without_file(
        &self,
        uri: &str,
        name: &str,
        rest: &str,
        folder: &Path,
        around: &Surroundings,
    ) -> ResolveError {
        let reason = format!("`{name}` is {}, but has no `{rest}`", folder.display());
        let miss = ResolveError::missing(uri, reason);
        match self.nearest_name(folder, rest, around) {
            Some(near) => miss.help(format!("did you mean `{near}`?")),
            None => miss,
        }
    }

    pub(super) fn without_folder(
        &self,
        uri: &str,
        scheme: Scheme,
        name: &str,
        around: &Surroundings,
    ) -> ResolveError {
        let word = scheme.word();
        let reason = format!("there is no {word} `{name}`");
        let miss = match scheme {
            Scheme::Package => ResolveError::missing_package(uri, reason),
            Scheme::Model => ResolveError::missing(uri, reason),
        };
        let known = self.known(around);
        let near = closest(name, known.iter().map(String::as_str).take(MAX_NAMES));
        let miss = match near.filter(|_| self.misses(around) < MAX_SUGGESTIONS) {
            Some(near) => miss.help(format!("did you mean `{word}://{near}`?")),
            None => miss,
        };
        miss.help(format!("name the folder that contains `{name}`: `--resource-path FOLDER`"))
    }

    /// Path with the first missing part replaced by the most similar existing name.
    pub(super) fn nearest_name(
        &self,
        folder: &Path,
        path: &str,
        around: &Surroundings,
    ) -> Option<String> {
        if self.misses(around) >= MAX_SUGGESTIONS {
            return None;
        }
        let mut reached = PathBuf::from(folder);
        let mut parts = path.split('/').enumerate();
        let (at, missing) = parts.find(|(_, part)| {
            reached.push(part);
            self.host.kind(&reached).is_none()
        })?;
        reached.pop();
        let names = self.host.list(&reached);
        let near = closest(missing, names.iter().map(String::as_str).take(MAX_NAMES))?;
        let mut parts: Vec<&str> = path.split('/').collect();
        *parts.get_mut(at)? = near;
        Some(parts.join("/"))
    }

    /// Names of visible packages and models.
    fn known(&self, around: &Surroundings) -> Rc<BTreeSet<String>> {
        if let Some(known) = self.known.borrow().get(&around.id) {
            return known.clone();
        }
        let mut names = BTreeSet::new();
        let own = around.places.iter().filter(|place| place.folder.starts_with(&around.project));
        for place in self.fixed.iter().chain(own) {
            match place.how {
                How::Tree(depth) => {
                    names.extend(self.crawl(&place.folder, depth).packages.keys().cloned());
                }
                How::Children => names.extend(self.folders_in(&place.folder)),
                How::Prefix => names.extend(self.folders_in(&place.folder.join("share"))),
                How::Workspace => {
                    names.extend(self.folders_in(&place.folder));
                    names.extend(self.folders_in(&place.folder.join("models")));
                }
            }
        }
        let names = Rc::new(names);
        self.known.borrow_mut().insert(around.id, names.clone());
        names
    }

    fn folders_in(&self, folder: &Path) -> Vec<String> {
        let mut names = self.host.list(folder);
        names.truncate(MAX_NAMES);
        names.retain(|name| {
            !name.starts_with('.') && self.host.kind(&folder.join(name)) == Some(EntryKind::Folder)
        });
        names
    }
}
