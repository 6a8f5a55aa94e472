//! Resolution of SDF includes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics, Expansion, Origin, SourceMap};
use periplus_resources::{EntryKind, ResolveError, Resolver};
use periplus_sdf::{IncludeResolver, IncludeTarget};

use crate::documents::{model_of, read_xml};
use crate::setting::{LoadContext, mentioned_in, shown};

/// Opens the targets of `<include>` elements, each file once.
pub(crate) struct Files<'s, 'a> {
    setting: &'s LoadContext<'a>,
    opened: BTreeMap<PathBuf, IncludeTarget>,
    order: Vec<PathBuf>,
}

impl<'s, 'a> Files<'s, 'a> {
    pub(crate) fn new(setting: &'s LoadContext<'a>) -> Self {
        Self { setting, opened: BTreeMap::new(), order: Vec::new() }
    }

    /// Files that were opened, in order.
    pub(crate) fn into_paths(self) -> Vec<PathBuf> {
        self.order
    }

    fn read(
        &self,
        path: &Path,
        from: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> IncludeTarget {
        let bytes = match self.setting.host.read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let name = shown(path, &self.setting.working_folder);
                let message = format!("`{name}` cannot be read: {error}");
                let finding = Diagnostic::error("unreadable-file", message);
                diagnostics.push(finding.caused_by(error.cause()).at(from));
                return IncludeTarget::Broken;
            }
        };
        let Some(mut document) = read_xml(path, &bytes, self.setting, sources, diagnostics) else {
            return IncludeTarget::Broken;
        };
        // A file that is included several times is read once; its findings refer to the first include.
        if let Some(at) = from.0 {
            document.root.see_through(sources.expand(Expansion::Include { at }));
        }
        let key = path.to_string_lossy().into_owned();
        if document.root.local_name() != "robot" {
            return IncludeTarget::Sdf { document: Arc::new(document), key };
        }
        match periplus_urdf::read(&document, diagnostics) {
            Some(robot) => {
                let model = Box::new(model_of(&robot, sources, diagnostics));
                IncludeTarget::Model { model, key }
            }
            None => IncludeTarget::Broken,
        }
    }
}

/// Resolves the target of an include. A path that does not exist may be the name of a model: Gazebo
/// searches the model folders for `<uri>NAME</uri>` and `<uri>file://NAME</uri>` too.
fn resolve_model(resolver: &Resolver<'_>, uri: &str, from: &Path) -> Result<PathBuf, ResolveError> {
    resolver.resolve(uri, from).or_else(|miss| {
        let bare = uri.trim().strip_prefix("file://").unwrap_or(uri.trim());
        let is_name = !bare.contains("://") && !bare.starts_with(['/', '.']);
        if !miss.kind.is_missing() || !is_name {
            return Err(miss);
        }
        resolver.resolve(&format!("model://{bare}"), from).map_err(|mut by_name| {
            by_name.uri = miss.uri;
            by_name.tried.splice(0..0, miss.tried);
            by_name
        })
    })
}

impl IncludeResolver for Files<'_, '_> {
    fn open(
        &mut self,
        uri: &str,
        from: Origin,
        sources: &mut SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> IncludeTarget {
        let mentioned_in = mentioned_in(from, sources, &self.setting.working_folder);
        let resolver = self.setting.resolver;
        let found = resolve_model(resolver, uri, &mentioned_in).and_then(|path| {
            match self.setting.host.kind(&path) {
                Some(EntryKind::Folder) => resolver.model_file(&path),
                _ => Ok(path),
            }
        });
        let path = match found {
            Ok(path) => path,
            Err(miss) => {
                let tried = miss.tried.iter();
                let tried = tried.map(|place| shown(place, &self.setting.working_folder)).collect();
                let advice = self.setting.resolver.advice().map(str::to_owned);
                return IncludeTarget::Missing { tried, advice };
            }
        };
        if let Some(opened) = self.opened.get(&path) {
            return opened.clone();
        }
        let opened = self.read(&path, from, sources, diagnostics);
        self.opened.insert(path.clone(), opened.clone());
        self.order.push(path);
        opened
    }
}
