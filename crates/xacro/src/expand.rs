//! The walk through a document.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{ContextId, Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_resources::{Host, Resolver};
use periplus_xml::{Attribute, Document, Element, Node, SmolStr, Text};

use crate::evaluate::{Failed, State};
use crate::scopes::{ScopeId, Symbol, TOP};

/// The elements that xacro itself knows.
pub(crate) const DIRECTIVES: [&str; 10] = [
    "arg",
    "attribute",
    "call",
    "element",
    "if",
    "include",
    "insert_block",
    "macro",
    "property",
    "unless",
];

/// How deep elements, macros and includes may nest together.
const DEEPEST: usize = 300;

/// How many nodes an expansion may produce or look at.
const MOST_NODES: usize = 3_000_000;

/// Errors after which an expansion gives up: what follows is mostly echo.
const MOST_ERRORS: usize = 30;

/// What an expansion needs to know.
#[derive(Clone)]
pub struct Setting<'a> {
    /// The file that is expanded.
    pub path: PathBuf,
    /// Where the user stands, for `$(cwd)`, and to show paths shorter.
    pub working_folder: PathBuf,
    /// `name:=value` of the command line.
    pub arguments: Vec<(String, String)>,
    /// Files and environment.
    pub host: &'a dyn Host,
    /// Packages and paths.
    pub resolver: &'a Resolver<'a>,
}

impl Setting<'_> {
    /// A path as messages show it.
    pub(crate) fn shown(&self, path: &Path) -> String {
        path.strip_prefix(&self.working_folder).unwrap_or(path).display().to_string()
    }
}

/// What an expansion gives.
#[derive(Clone, Debug)]
pub struct Expanded {
    /// The document without xacro.
    pub document: Document,
    /// The files it read besides the first, in order.
    pub includes: Vec<PathBuf>,
    /// The arguments that it used, with the values they had.
    pub arguments: Vec<(String, String)>,
}

/// Expands a document. When anything is wrong there is an error in `diagnostics`, and no result:
/// half a robot is no robot.
pub fn expand(
    document: &Document,
    setting: Setting<'_>,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Expanded> {
    let errors_before = diagnostics.errors();
    let mut found = Diagnostics::new();
    let state = State::new(setting, sources, &mut found);
    let mut root = Element::new(document.root.name.clone());
    root.origin = document.root.origin;
    let walked = state.expand_root(&document.root, &mut root);
    let includes = state.includes.take();
    let arguments = state.arguments.take().into_iter().collect();
    drop(state);
    diagnostics.append(found);
    if walked.is_err() || diagnostics.errors() > errors_before {
        return None;
    }
    let document =
        Document { before: document.before.clone(), root, after: document.after.clone() };
    Some(Expanded { document, includes, arguments })
}

/// Where expanded nodes go: the content of an element, whose attributes `xacro:attribute` and
/// inherited namespaces may extend.
pub(crate) struct Output<'e> {
    parent: &'e mut Element,
}

impl<'e> Output<'e> {
    pub(crate) fn new(parent: &'e mut Element) -> Self {
        Self { parent }
    }

    fn push(&mut self, node: Node) {
        self.parent.children.push(node);
    }

    fn set_attribute(&mut self, name: &str, value: String, origin: Origin) {
        let value = SmolStr::new(value);
        match self.parent.attributes.iter_mut().find(|attribute| attribute.name == name) {
            Some(attribute) => attribute.value = value,
            None => self.parent.attributes.push(Attribute {
                name: name.into(),
                value,
                origin,
                value_origin: origin,
            }),
        }
    }

    /// Namespaces declared by an included file or a macro are declared around its content.
    pub(crate) fn adopt_namespaces(&mut self, element: &Element) {
        for attribute in &element.attributes {
            let declares = attribute.name.starts_with("xmlns:") && attribute.name != "xmlns:xacro";
            if declares && self.parent.attribute(&attribute.name).is_none() {
                self.parent.attributes.push(attribute.clone());
            }
        }
    }

    /// Comments right before something of xacro's speak of it, and go with it.
    fn drop_comments(&mut self) {
        loop {
            let children = &mut self.parent.children;
            let blank = |node: &Node| {
                matches!(node, Node::Text(text)
                    if text.text.trim().is_empty() && text.text.matches('\n').count() <= 1)
            };
            let skip = usize::from(children.last().is_some_and(blank));
            let Some(index) = children.len().checked_sub(1 + skip) else { return };
            if !matches!(children[index], Node::Comment(_)) {
                return;
            }
            children.remove(index);
        }
    }
}

impl State<'_> {
    fn expand_root(&self, root: &Element, out: &mut Element) -> Result<(), Failed> {
        self.expand_attributes(root, TOP, None, out);
        if let Some(target) = out.attributes.iter().position(|a| a.name == "xacro:targetNamespace")
        {
            let mut attribute = out.attributes.remove(target);
            attribute.name = "xmlns".into();
            out.attributes.push(attribute);
        }
        self.expand_nodes(&root.children, TOP, None, &mut Output::new(out))
    }

    /// Expands nodes into `out`. `context` is how their places are seen; none keeps what they say.
    pub(crate) fn expand_nodes(
        &self,
        nodes: &[Node],
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let mut comments_live = false;
        let mut failed = false;
        for node in nodes {
            self.count_node(node)?;
            match node {
                Node::Element(element) => {
                    comments_live = false;
                    failed |= self.expand_element(element, scope, context, out).is_err();
                }
                Node::Text(text) => {
                    let origin = self.seen(text.origin, context);
                    match self.text(&text.text, origin, scope) {
                        Ok(value) => {
                            comments_live &= value.trim().is_empty();
                            out.push(Node::Text(Text { text: value.into(), origin }));
                        }
                        Err(Failed) => failed = true,
                    }
                }
                Node::Comment(comment) if comment.text.contains("xacro:eval-comments") => {
                    comments_live = !comment.text.contains("xacro:eval-comments:off");
                }
                Node::Comment(comment) if comments_live => {
                    let origin = self.seen(comment.origin, context);
                    match self.text(&comment.text, origin, scope) {
                        Ok(text) => out.push(Node::Comment(Text { text: text.into(), origin })),
                        Err(Failed) => failed = true,
                    }
                }
                Node::Comment(_) | Node::Instruction(_) => out.push(node.clone()),
            }
            if self.diagnostics.borrow().errors() >= MOST_ERRORS {
                return Err(Failed);
            }
        }
        if failed { Err(Failed) } else { Ok(()) }
    }

    fn count_node(&self, node: &Node) -> Result<(), Failed> {
        self.nodes.set(self.nodes.get() + 1);
        if self.nodes.get() <= MOST_NODES {
            return Ok(());
        }
        let origin = node.as_element().map(|element| element.origin).unwrap_or_default();
        Err(self.fail(
            Diagnostic::error(
                "too-large",
                format!("the file expands to more than {MOST_NODES} parts"),
            )
            .at(origin)
            .help("does a macro call itself more and more often?"),
        ))
    }

    fn expand_element(
        &self,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        if self.nesting.get() >= DEEPEST {
            return Err(self.fail(
                Diagnostic::error(
                    "too-deep",
                    format!("elements, macros and includes are nested more than {DEEPEST} deep"),
                )
                .at(self.seen(element.origin, context))
                .help("does a macro call itself without an end? stop it with <xacro:if>"),
            ));
        }
        self.nesting.set(self.nesting.get() + 1);
        let result = match element.name.strip_prefix("xacro:") {
            Some(directive) => self.directive(directive, element, scope, context, out),
            None => self.plain_element(element, element.name.clone(), scope, context, out),
        };
        self.nesting.set(self.nesting.get() - 1);
        result
    }

    fn directive(
        &self,
        directive: &str,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        match directive {
            "element" | "attribute" | "insert_block" => {}
            _ => out.drop_comments(),
        }
        match directive {
            "property" => self.define_property(element, scope, context),
            "macro" => self.define_macro(element, scope),
            "include" => self.include(element, scope, context, out),
            "arg" => self.declare_argument(element, scope),
            "if" | "unless" => {
                self.check_attributes(element, &["value"], &["value"])?;
                let wanted = directive == "if";
                if self.flag(element, "value", scope)? == Some(wanted) {
                    self.expand_nodes(&element.children, scope, context, out)
                } else {
                    Ok(())
                }
            }
            "insert_block" => self.insert_block(element, scope, out),
            "element" => {
                self.require(element, "xacro:name")?;
                let name = self.attribute(element, "xacro:name", scope)?.unwrap_or_default();
                self.named_element(element, &name, scope, context, out)
            }
            "attribute" => {
                self.check_attributes(element, &["name", "value"], &["name", "value"])?;
                let name = self.attribute(element, "name", scope)?.unwrap_or_default();
                let value = self.attribute(element, "value", scope)?.unwrap_or_default();
                let origin = self.seen(element.origin, context);
                self.check_name(&name, origin)?;
                out.set_attribute(&name, value, origin);
                Ok(())
            }
            "call" => self.call_by_value(element, scope, context, out),
            name => self.call(name, element, scope, context, out),
        }
    }

    /// An element whose name is a value; it may turn out to be one of xacro's own.
    fn named_element(
        &self,
        element: &Element,
        name: &str,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_name(name, self.value_origin(element, "xacro:name"))?;
        let mut renamed = element.clone();
        renamed.name = name.into();
        renamed.attributes.retain(|attribute| attribute.name != "xacro:name");
        self.expand_element(&renamed, scope, context, out)
    }

    fn plain_element(
        &self,
        element: &Element,
        name: SmolStr,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let mut expanded = Element::new(name);
        expanded.origin = self.seen(element.origin, context);
        self.expand_attributes(element, scope, context, &mut expanded);
        let result =
            self.expand_nodes(&element.children, scope, context, &mut Output::new(&mut expanded));
        out.push(Node::Element(expanded));
        result
    }

    /// Attributes of a plain element. One that fails has been reported and keeps its text.
    fn expand_attributes(
        &self,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Element,
    ) {
        for attribute in &element.attributes {
            let own =
                attribute.name.starts_with("xacro:") && attribute.name != "xacro:targetNamespace";
            if own || attribute.name == "xmlns:xacro" {
                continue;
            }
            let value_origin = self.seen(attribute.value_origin, context);
            let value = match self.text(&attribute.value, value_origin, scope) {
                Ok(value) => SmolStr::new(value),
                Err(Failed) => attribute.value.clone(),
            };
            let origin = self.seen(attribute.origin, context);
            out.attributes.push(Attribute {
                name: attribute.name.clone(),
                value,
                origin,
                value_origin,
            });
        }
    }

    fn insert_block(
        &self,
        element: &Element,
        scope: ScopeId,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name"])?;
        let name = self.attribute(element, "name", scope)?.unwrap_or_default();
        let block = {
            let scopes = self.scopes.borrow();
            let content = scopes.find(scope, &format!("**{name}"));
            let found = content.or_else(|| scopes.find(scope, &format!("*{name}")));
            match found {
                Some((_, Symbol::Block(block))) => Some(block.clone()),
                _ => None,
            }
        };
        let Some(block) = block else {
            let names = self.scopes.borrow().block_names(scope);
            let origin = self.value_origin(element, "name");
            return Err(self.fail(
                Diagnostic::error("unknown-block", format!("there is no block `{name}`"))
                    .at(origin)
                    .did_you_mean(origin, &name, names.iter().map(String::as_str))
                    .help("a block is a macro's parameter `*name` or `**name`, or a property with elements in it"),
            ));
        };
        self.expand_nodes(&block.nodes, scope, block.context, out)
    }

    fn declare_argument(&self, element: &Element, scope: ScopeId) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name", "default"])?;
        let name = element.value("name").unwrap_or_default().to_owned();
        if self.arguments.borrow().contains_key(&name) {
            return Ok(());
        }
        if let Some(default) = self.attribute(element, "default", scope)? {
            self.arguments.borrow_mut().insert(name, default);
            return Ok(());
        }
        self.argument(&name, self.value_origin(element, "name")).map(drop)
    }

    fn check_name(&self, name: &str, origin: Origin) -> Result<(), Failed> {
        let good = name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ':'));
        let starts = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        if good && starts {
            return Ok(());
        }
        Err(self.fail(
            Diagnostic::error("xml-name", format!("`{name}` cannot be a name in XML"))
                .at(origin)
                .help(
                    "a name starts with a letter and goes on with letters, digits, `_`, `-`, `.`",
                ),
        ))
    }

    /// The value of an attribute as characters.
    pub(crate) fn attribute(
        &self,
        element: &Element,
        name: &str,
        scope: ScopeId,
    ) -> Result<Option<String>, Failed> {
        match element.attribute(name) {
            Some(attribute) => self.text(&attribute.value, attribute.value_origin, scope).map(Some),
            None => Ok(None),
        }
    }

    /// Where the value of an attribute stands.
    pub(crate) fn value_origin(&self, element: &Element, name: &str) -> Origin {
        element.attribute(name).map_or(element.origin, |attribute| attribute.value_origin)
    }

    /// A place as seen in a context.
    pub(crate) fn seen(&self, origin: Origin, context: Option<ContextId>) -> Origin {
        match context {
            Some(context) => Origin(origin.0.map(|span| span.within(context))),
            None => origin,
        }
    }

    pub(crate) fn require(&self, element: &Element, name: &str) -> Result<(), Failed> {
        if element.attribute(name).is_some() {
            return Ok(());
        }
        Err(self.fail(
            Diagnostic::error(
                "missing-attribute",
                format!("`{}` needs the attribute `{name}`", element.name),
            )
            .at(element.origin)
            .help(format!("add {name}=\"...\"")),
        ))
    }

    /// Reports attributes that are missing (and fails) or unknown (and goes on).
    pub(crate) fn check_attributes(
        &self,
        element: &Element,
        required: &[&str],
        known: &[&str],
    ) -> Result<(), Failed> {
        for name in required {
            self.require(element, name)?;
        }
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            if known.contains(&name) || name.starts_with("xmlns:") {
                continue;
            }
            let origin = Origin(attribute.origin.0.map(|span| span.part(0, name.len())));
            self.report(
                Diagnostic::warning(
                    "unknown-attribute",
                    format!("`{}` has no attribute `{name}`", element.name),
                )
                .at(origin)
                .label("not read")
                .did_you_mean(origin, name, known.iter().copied()),
            );
        }
        Ok(())
    }
}
