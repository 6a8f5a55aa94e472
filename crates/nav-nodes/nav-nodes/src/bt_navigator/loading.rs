//! Loading of trees from files, folders and the built-in ones.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_behavior_tree::{
    BehaviorTree, Blackboard, IncludedTree, NodeRegistry, TreeFiles, TreeInclude, TreeIncludeError,
};
use periplus_diagnostics::{Diagnostics, Severity, SourceMap};
use periplus_resources::Resolver;

use super::default_trees::built_in_tree;
use super::shared::Shared;
use crate::Files;

/// Source of trees.
pub(super) struct TreeLoader {
    pub(super) files: Arc<dyn Files>,
    pub(super) registry: NodeRegistry,
}

impl TreeLoader {
    /// Loads a tree by the name of a file, which ends with `.xml`, or by an ID that a file in the search
    /// directories defines. A file that does not exist may be a built-in one.
    ///
    /// # Errors
    /// All errors, each with file, line and column.
    pub(super) fn load(
        &self,
        shared: &Shared,
        name: &str,
        blackboard: Blackboard,
    ) -> Result<BehaviorTree, Vec<String>> {
        let files = if name.ends_with(".xml") {
            self.load_file(shared, name)?
        } else {
            self.load_directories(shared, name)?
        };
        // A file that is named as a whole has a main tree.
        let id = if name.ends_with(".xml") { "" } else { name };
        files
            .tree(id, &self.registry, blackboard)
            .map_err(|findings| located(&files.sources, &findings))
    }

    fn load_file(&self, shared: &Shared, name: &str) -> Result<TreeFiles, Vec<String>> {
        let path = Path::new(name);
        let file_name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let text = match self.files.read(path) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) => match built_in_tree(shared.release, file_name) {
                Some(text) => text.into_owned(),
                None => return Err(vec![format!("cannot read `{name}`: {error}")]),
            },
        };
        let others = self.search(shared, Some(path));
        if others.is_empty() {
            return Ok(TreeFiles::load(name, &text, &self.registry, &mut |it| self.include(it)));
        }
        // Subtrees may be defined in the search directories.
        let own = TreeFiles::load(name, &text, &self.registry, &mut |it| self.include(it));
        let Some(main) = own.main_id().map(str::to_owned) else { return Ok(own) };
        Ok(self.join(&main, others.iter().map(PathBuf::as_path).chain([path]), Some((name, &text))))
    }

    fn load_directories(&self, shared: &Shared, id: &str) -> Result<TreeFiles, Vec<String>> {
        let others = self.search(shared, None);
        if others.is_empty() {
            let message = format!(
                "`{id}` is neither a file (`.xml`) nor a tree in a folder of `bt_search_directories`"
            );
            return Err(vec![message]);
        }
        Ok(self.join(id, others.iter().map(PathBuf::as_path), None))
    }

    /// Files with trees in the search directories, apart from one.
    fn search(&self, shared: &Shared, except: Option<&Path>) -> Vec<PathBuf> {
        let folders = shared.params.bt_search_directories.iter();
        let files = folders.flat_map(|folder| {
            let folder = PathBuf::from(folder);
            let names = self.files.list(&folder).into_iter();
            names.filter(|name| name.ends_with(".xml")).map(move |name| folder.join(name))
        });
        files.filter(|path| Some(path.as_path()) != except).collect()
    }

    /// Reads several files as one; later definitions of a tree replace earlier ones.
    fn join<'a>(
        &self,
        main: &str,
        paths: impl Iterator<Item = &'a Path>,
        given: Option<(&str, &str)>,
    ) -> TreeFiles {
        let includes: String =
            paths.map(|path| format!("<include path=\"{}\"/>\n", path.display())).collect();
        let text =
            format!("<root BTCPP_format=\"4\" main_tree_to_execute=\"{main}\">\n{includes}</root>");
        TreeFiles::load("bt_search_directories", &text, &self.registry, &mut |it| match given {
            Some((name, text)) if it.path == name => {
                Ok(IncludedTree { name: name.to_owned(), text: text.to_owned() })
            }
            _ => self.include(it),
        })
    }

    fn include(&self, include: &TreeInclude<'_>) -> Result<IncludedTree, TreeIncludeError> {
        let unreadable = TreeIncludeError::Unreadable;
        let from = Path::new(include.from);
        let path = match include.package.filter(|_| !Path::new(include.path).is_absolute()) {
            Some(package) => {
                let resolver = Resolver::new(&*self.files, &[]);
                let folder = resolver.find_package(package, from);
                folder.map_err(|error| unreadable(error.to_string()))?.join(include.path)
            }
            None => from.parent().unwrap_or(Path::new("")).join(include.path),
        };
        let bytes = self.files.read(&path).map_err(|error| unreadable(error.to_string()))?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        Ok(IncludedTree { name: path.display().to_string(), text })
    }
}

/// Errors as `file:line:column: message`.
fn located(sources: &SourceMap, findings: &Diagnostics) -> Vec<String> {
    let errors = findings.iter().filter(|finding| finding.severity == Severity::Error);
    let line = |finding: &periplus_diagnostics::Diagnostic| {
        let mut text = match finding.span.filter(|span| sources.holds(*span)) {
            Some(span) => {
                let (file, at) = sources.locate(span);
                format!("{file}:{}:{}: {}", at.line, at.column, finding.message)
            }
            None => finding.message.clone(),
        };
        let replacement = finding.replacement.as_ref().map(|it| &it.message);
        for help in replacement.into_iter().chain(&finding.help) {
            text = format!("{text}; {help}");
        }
        text
    };
    errors.map(line).collect()
}
