//! Files of trees: the main file, its includes, and the trees that they define.

use std::collections::BTreeMap;
use std::fmt;

use periplus_diagnostics::{
    ContextId, Diagnostic, Diagnostics, Expansion, Origin, SourceMap, Span,
};
use periplus_xml::Element;

use crate::blackboard::Blackboard;
use crate::{BehaviorTree, NodeRegistry};
use crate::{build, check};

/// Maximum number of files that a file of trees includes, directly and through others.
pub const MAX_INCLUDE_COUNT: usize = 100;
/// Maximum nesting of included files.
pub const MAX_INCLUDE_DEPTH: usize = 16;

/// Version of the XML format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeFormat {
    /// BehaviorTree.CPP 3, which Nav2 of Humble uses: no attribute `BTCPP_format`.
    V3,
    /// BehaviorTree.CPP 4.
    V4,
}

/// File that a tree includes, for the caller to resolve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeInclude<'a> {
    /// Attribute `path`.
    pub path: &'a str,
    /// Attribute `ros_pkg`: the package in whose `share` folder the path is.
    pub package: Option<&'a str>,
    /// Name of the file that includes it; relative paths are relative to its folder.
    pub from: &'a str,
}

/// Included file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IncludedTree {
    /// Full name: it identifies the file, and it is the name in messages.
    pub name: String,
    /// Content.
    pub text: String,
}

/// Reason for which a file cannot be included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TreeIncludeError {
    /// Files are not available, as in [`TreeFiles::parse`].
    Unavailable,
    /// The file or its package does not exist or cannot be read; the reason, in words.
    Unreadable(String),
}

impl fmt::Display for TreeIncludeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unavailable => f.write_str("includes are not available here"),
            Self::Unreadable(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for TreeIncludeError {}

/// Definition of one tree.
#[derive(Clone, Debug)]
pub(crate) struct TreeDefinition {
    pub(crate) id: String,
    /// Root node.
    pub(crate) root: Element,
    pub(crate) format: TreeFormat,
    pub(crate) origin: Origin,
}

/// Port of a subtree by its model: the default, if any.
pub(crate) type SubTreePorts = BTreeMap<String, Option<String>>;

/// Files of trees after reading and checking.
#[derive(Debug)]
pub struct TreeFiles {
    /// Texts, for the rendering of findings.
    pub sources: SourceMap,
    /// Findings. With errors there are no trees.
    pub diagnostics: Diagnostics,
    pub(crate) trees: Vec<TreeDefinition>,
    pub(crate) models: BTreeMap<String, SubTreePorts>,
    main: Option<(String, Origin)>,
    root: Origin,
}

impl TreeFiles {
    /// Reads and checks a file without includes.
    #[must_use]
    pub fn parse(name: &str, text: &str, registry: &NodeRegistry) -> Self {
        Self::load(name, text, registry, &mut |_| Err(TreeIncludeError::Unavailable))
    }

    /// Reads and checks a file with its includes. `include` returns the file, or the reason why there is
    /// none.
    pub fn load(
        name: &str,
        text: &str,
        registry: &NodeRegistry,
        include: &mut dyn FnMut(&TreeInclude<'_>) -> Result<IncludedTree, TreeIncludeError>,
    ) -> Self {
        let files = Self {
            sources: SourceMap::new(),
            diagnostics: Diagnostics::new(),
            trees: Vec::new(),
            models: BTreeMap::new(),
            main: None,
            root: Origin::default(),
        };
        let mut reader = Reader { files, include, count: 0, open: Vec::new() };
        reader.read(name, text, None);
        let mut files = reader.files;
        check::check_trees(&files.trees, registry, &mut files.diagnostics);
        files.check_main();
        files
    }

    /// IDs of the trees, in the order of their definition.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        self.trees.iter().map(|tree| tree.id.as_str())
    }

    /// ID of the tree that is executed if none is named: `main_tree_to_execute`, or the only tree.
    #[must_use]
    pub fn main_id(&self) -> Option<&str> {
        match (&self.main, &self.trees[..]) {
            (Some((id, _)), _) => Some(id),
            (None, [only]) => Some(&only.id),
            _ => None,
        }
    }

    /// Creates an executable tree by its ID; an empty ID is the main tree. The values in `blackboard` are
    /// the initial values of its root.
    ///
    /// # Errors
    /// The findings of the files if there are errors, or those of this tree: an unknown ID, entries that
    /// are used with two types, recursive or too many subtrees.
    pub fn tree(
        &self,
        id: &str,
        registry: &NodeRegistry,
        blackboard: Blackboard,
    ) -> Result<BehaviorTree, Diagnostics> {
        if self.diagnostics.has_errors() {
            return Err(self.diagnostics.clone());
        }
        let mut diagnostics = Diagnostics::new();
        let id = if id.is_empty() { self.main_id().unwrap_or_default() } else { id };
        let Some(tree) = self.find(id) else {
            let known: Vec<&str> = self.ids().collect();
            let message = format!("there is no tree `{id}`; known trees: {}", known.join(", "));
            diagnostics.push(Diagnostic::error("unknown-tree", message).at(self.root));
            return Err(diagnostics);
        };
        build::build(self, tree, registry, blackboard.values_only(), &mut diagnostics)
            .ok_or(diagnostics)
    }

    /// Definition of an ID; the last one, if there are several.
    pub(crate) fn find(&self, id: &str) -> Option<&TreeDefinition> {
        self.trees.iter().rev().find(|tree| tree.id == id)
    }

    fn check_main(&mut self) {
        let finding = match &self.main {
            Some((id, origin)) if self.find(id).is_none() => {
                let message = format!("there is no tree `{id}`");
                let known = self.trees.iter().map(|tree| tree.id.as_str());
                let finding = Diagnostic::error("unknown-tree", message).at(*origin);
                Some(finding.did_you_mean(*origin, id, known))
            }
            None if self.trees.len() > 1 => {
                let message = "the file defines several trees, and none is the main one";
                let help =
                    "add an attribute `main_tree_to_execute` with the ID of a tree to <root>";
                Some(Diagnostic::error("no-main-tree", message).at(self.root).help(help))
            }
            None if self.trees.is_empty() && !self.diagnostics.has_errors() => {
                let message = "the file defines no <BehaviorTree>";
                Some(Diagnostic::error("no-main-tree", message).at(self.root))
            }
            _ => None,
        };
        self.diagnostics.extend(finding);
    }
}

struct Reader<'a> {
    files: TreeFiles,
    include: &'a mut dyn FnMut(&TreeInclude<'_>) -> Result<IncludedTree, TreeIncludeError>,
    count: usize,
    /// Names of the files that are being read, outermost first.
    open: Vec<String>,
}

impl Reader<'_> {
    fn report(&mut self, finding: Diagnostic) {
        self.files.diagnostics.push(finding);
    }

    fn read(&mut self, name: &str, text: &str, included_at: Option<Span>) {
        let file = self.files.sources.add(name, text);
        let context = included_at
            .map_or(ContextId::ROOT, |at| self.files.sources.expand(Expansion::Include { at }));
        let parsed = periplus_xml::parse(file, &self.files.sources, &mut self.files.diagnostics);
        let Some(mut document) = parsed else { return };
        if included_at.is_some() {
            document.root.see_through(context);
        }
        let root = &document.root;
        if root.name != "root" {
            let message = format!("the outermost element is <{}>, and not <root>", root.name);
            self.report(Diagnostic::error("no-root", message).at(root.name_origin()));
            return;
        }
        let format = match root.attribute("BTCPP_format") {
            None => TreeFormat::V3,
            Some(attribute) if attribute.value.trim() == "4" => TreeFormat::V4,
            Some(attribute) => {
                let message = format!("unknown format `{}`", attribute.value);
                let help = "formats are 4 and, without the attribute, 3";
                let finding = Diagnostic::error("unknown-format", message);
                self.report(finding.at(attribute.value_origin).help(help));
                return;
            }
        };
        self.open.push(name.to_owned());
        for element in root.named("include") {
            self.read_include(element);
        }
        for model in root.named("TreeNodesModel").flat_map(|models| models.named("SubTree")) {
            self.read_model(model);
        }
        for element in root.elements() {
            match &*element.name {
                "include" | "TreeNodesModel" => {}
                "BehaviorTree" => self.read_tree(element, format),
                other => {
                    let message = format!("unknown element <{other}> in <root>");
                    let known = ["BehaviorTree", "include", "TreeNodesModel"];
                    let finding = Diagnostic::warning("unknown-element", message);
                    let at = element.name_origin();
                    self.report(finding.at(at).did_you_mean(at, other, known));
                }
            }
        }
        self.open.pop();
        if included_at.is_none() {
            self.files.root = root.name_origin();
            self.files.main = root
                .attribute("main_tree_to_execute")
                .map(|attribute| (attribute.value.to_string(), attribute.value_origin));
        }
    }

    fn read_include(&mut self, element: &Element) {
        let fault = |message: String| Diagnostic::error("include", message).at(element.origin);
        let Some(path) = element.value("path") else {
            self.report(fault("<include> needs an attribute `path`".to_owned()));
            return;
        };
        self.count += 1;
        if self.count > MAX_INCLUDE_COUNT || self.open.len() >= MAX_INCLUDE_DEPTH {
            self.report(fault(format!(
                "too many included files: at most {MAX_INCLUDE_COUNT}, nested at most {MAX_INCLUDE_DEPTH} deep"
            )));
            return;
        }
        let from = self.open.last().cloned().unwrap_or_default();
        let package = element.value("ros_pkg");
        match (self.include)(&TreeInclude { path, package, from: &from }) {
            Ok(included) if self.open.contains(&included.name) => {
                self.report(fault(format!("`{path}` includes itself")));
            }
            Ok(included) => self.read(&included.name, &included.text, element.origin.0),
            Err(reason) => self.report(fault(format!("cannot include `{path}`: {reason}"))),
        }
    }

    fn read_model(&mut self, element: &Element) {
        let Some(id) = element.value("ID") else { return };
        let ports = element.elements().filter_map(|port| {
            let name = port.value("name")?;
            Some((name.to_owned(), port.value("default").map(str::to_owned)))
        });
        let ports = ports.collect();
        self.files.models.insert(id.to_owned(), ports);
    }

    fn read_tree(&mut self, element: &Element, format: TreeFormat) {
        let id = match element.value("ID") {
            Some("") | None => format!("BehaviorTree_{}", self.files.trees.len()),
            Some(id) => id.to_owned(),
        };
        if let Some(earlier) = self.files.find(&id).map(|tree| tree.origin) {
            let message =
                format!("the tree `{id}` is defined twice; the second definition is used");
            let finding = Diagnostic::warning("repeated-tree", message).at(element.origin);
            self.report(finding.related(earlier, "first definition"));
        }
        let mut roots = element.elements();
        match (roots.next(), roots.next()) {
            (Some(root), None) => {
                let tree =
                    TreeDefinition { id, root: root.clone(), format, origin: element.origin };
                self.files.trees.push(tree);
            }
            (None, _) => {
                let message = format!("the tree `{id}` is empty: it needs one node");
                self.report(Diagnostic::error("child-count", message).at(element.origin));
            }
            (Some(_), Some(second)) => {
                let message = format!("the tree `{id}` has more than one root node");
                let help = "put its nodes into a control node such as <Sequence>";
                let finding = Diagnostic::error("child-count", message);
                self.report(finding.at(second.name_origin()).help(help));
            }
        }
    }
}
