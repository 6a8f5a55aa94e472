//! The walk through a document.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use periplus_diagnostics::{ContextId, Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_resources::{Host, Resolver};
use periplus_xml::{Attribute, Document, Element, Node, SmolStr, Text};

use crate::evaluate::{Failed, State};
use crate::scopes::{ScopeId, Symbol, TOP};

/// Where an expansion stands: the names it sees, and how it came there.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// Where names are looked up.
    pub(crate) scope: ScopeId,
    /// The macro call or include; none keeps what places say of theirs.
    pub(crate) context: Option<ContextId>,
}

impl Frame {
    /// A place as seen from here.
    pub(crate) fn seen(self, origin: Origin) -> Origin {
        match self.context {
            Some(context) => Origin(origin.0.map(|span| span.within(context))),
            None => origin,
        }
    }
}

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
///
/// What takes part in the recursion, and what that calls, is `#[inline(never)]`: else the locals of
/// all of it would stand on the stack once a level. A thread with 1 MiB must do.
const DEEPEST: usize = 300;

/// How many nodes an expansion may look at, those it copies included.
const MOST_PARTS: usize = 1_000_000;

/// Errors after which an expansion gives up: what follows is mostly echo.
pub(crate) const MOST_ERRORS: usize = 30;

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
        match path.strip_prefix(&self.working_folder) {
            Ok(rest) if rest.as_os_str().is_empty() => ".".into(),
            Ok(rest) => rest.display().to_string(),
            Err(_) => path.display().to_string(),
        }
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
    /// How many children no directive that follows takes comments from.
    settled: usize,
}

impl<'e> Output<'e> {
    pub(crate) fn new(parent: &'e mut Element) -> Self {
        Self { parent, settled: 0 }
    }

    fn push(&mut self, node: Node) {
        self.parent.children.push(node);
    }

    #[inline(never)]
    fn set_attribute(&mut self, name: &str, value: &str, origin: Origin) {
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

    /// What was put out so far keeps its comments.
    fn settle(&mut self) {
        self.settled = self.parent.children.len();
    }

    /// Comments right before something of xacro's speak of it, and go with it.
    #[inline(never)]
    fn drop_comments(&mut self) {
        let children = &mut self.parent.children;
        let blank = |node: &Node| {
            matches!(node, Node::Text(text)
                if text.text.trim().is_empty() && text.text.matches('\n').count() <= 1)
        };
        let mut before = children.len();
        loop {
            if before > self.settled && blank(&children[before - 1]) {
                before -= 1;
            }
            if before <= self.settled || !matches!(children[before - 1], Node::Comment(_)) {
                return;
            }
            before -= 1;
            children.remove(before);
        }
    }
}

impl State<'_> {
    /// Namespaces declared by an included file or a macro are declared around its content.
    #[inline(never)]
    pub(crate) fn adopt_namespaces(&self, element: &Element, frame: Frame, out: &mut Output<'_>) {
        for attribute in &element.attributes {
            if !attribute.name.starts_with("xmlns:") || attribute.name == "xmlns:xacro" {
                continue;
            }
            match out.parent.attribute(&attribute.name) {
                None => out.parent.attributes.push(attribute.clone()),
                Some(earlier) if earlier.value != attribute.value => self.report(
                    Diagnostic::warning(
                        "namespace-conflict",
                        format!("`{}` is declared as something else already", attribute.name),
                    )
                    .at(frame.seen(attribute.origin))
                    .related(earlier.origin, "this declaration holds")
                    .help("use another prefix in one of the files"),
                ),
                Some(_) => {}
            }
        }
    }

    fn expand_root(&self, root: &Element, out: &mut Element) -> Result<(), Failed> {
        let frame = Frame { scope: TOP, context: None };
        self.expand_attributes(root, frame, out);
        if let Some(target) = out.attributes.iter().position(|a| a.name == "xacro:targetNamespace")
        {
            let mut attribute = out.attributes.remove(target);
            attribute.name = "xmlns".into();
            out.attributes.push(attribute);
        }
        self.expand_nodes(&root.children, frame, &mut Output::new(out))
    }

    /// Expands nodes into `out`.
    #[inline(never)]
    pub(crate) fn expand_nodes(
        &self,
        nodes: &[Node],
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let mut comments_live = false;
        let mut failed = false;
        for node in nodes {
            self.count_node(node, frame)?;
            match node {
                Node::Element(element) => {
                    comments_live = false;
                    failed |= self.expand_element(element, frame, out).is_err();
                }
                Node::Text(text) => {
                    let origin = frame.seen(text.origin);
                    match self.tree_text(&text.text, origin, frame.scope) {
                        Ok(text) => {
                            comments_live &= text.trim().is_empty();
                            out.push(Node::Text(Text { text, origin }));
                        }
                        Err(Failed) => failed = true,
                    }
                }
                Node::Comment(comment) if comment.text.contains("xacro:eval-comments") => {
                    comments_live = !comment.text.contains("xacro:eval-comments:off");
                }
                Node::Comment(comment) if comments_live => {
                    let origin = frame.seen(comment.origin);
                    match self.tree_text(&comment.text, origin, frame.scope) {
                        Ok(text) => out.push(Node::Comment(Text { text, origin })),
                        Err(Failed) => failed = true,
                    }
                }
                Node::Comment(_) | Node::Instruction(_) => out.push(node.clone()),
            }
            if self.has_given_up() {
                return Err(Failed);
            }
        }
        if failed { Err(Failed) } else { Ok(()) }
    }

    fn count_node(&self, node: &Node, frame: Frame) -> Result<(), Failed> {
        let origin = match node {
            Node::Element(element) => element.origin,
            Node::Text(text) | Node::Comment(text) | Node::Instruction(text) => text.origin,
        };
        self.count(1, frame.seen(origin))
    }

    /// Counts what a copy of an element costs.
    pub(crate) fn count_copy(&self, element: &Element) -> Result<(), Failed> {
        fn parts(element: &Element) -> usize {
            let attributes = element.attributes.len();
            1 + attributes + element.children.len() + element.elements().map(parts).sum::<usize>()
        }
        self.count(parts(element), element.origin)
    }

    #[inline(never)]
    pub(crate) fn count(&self, parts: usize, origin: Origin) -> Result<(), Failed> {
        self.parts.set(self.parts.get() + parts);
        if self.parts.get() <= MOST_PARTS {
            return Ok(());
        }
        Err(self.give_up(
            Diagnostic::error(
                "too-large",
                format!("the file expands to more than {MOST_PARTS} parts"),
            )
            .at(origin)
            .help("does a macro call itself more and more often?"),
        ))
    }

    fn expand_element(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        if self.nesting.get() >= DEEPEST {
            return Err(self.too_deep(frame.seen(element.origin)));
        }
        self.nesting.set(self.nesting.get() + 1);
        let result = match element.name.strip_prefix("xacro:") {
            Some(directive) => self.directive(directive, element, frame, out),
            None => self.plain_element(element, element.name.clone(), frame, out),
        };
        self.nesting.set(self.nesting.get() - 1);
        result
    }

    #[cold]
    #[inline(never)]
    fn too_deep(&self, origin: Origin) -> Failed {
        self.give_up(
            Diagnostic::error(
                "too-deep",
                format!("elements, macros and includes are nested more than {DEEPEST} deep"),
            )
            .at(origin)
            .help("does a macro call itself without an end? stop it with <xacro:if>"),
        )
    }

    #[inline(never)]
    fn directive(
        &self,
        directive: &str,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        match directive {
            "element" | "attribute" | "insert_block" => {}
            _ => out.drop_comments(),
        }
        out.settle();
        let result = match directive {
            "property" => self.define_property(element, frame),
            "macro" => self.define_macro(element, frame),
            "include" => self.include(element, frame, out),
            "arg" => self.declare_argument(element, frame),
            "if" | "unless" => self.conditional(element, directive == "if", frame, out),
            "insert_block" => self.insert_block(element, frame, out),
            "element" => self.named_element(element, frame, out),
            "attribute" => self.set_attribute(element, frame, out),
            "call" => self.call_by_value(element, frame, out),
            name => self.call(name, element, frame, out),
        };
        out.settle();
        result
    }

    #[inline(never)]
    fn conditional(
        &self,
        element: &Element,
        wanted: bool,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["value"], &["value"], frame)?;
        if self.flag(element, "value", frame)? == Some(wanted) {
            self.expand_nodes(&element.children, frame, out)
        } else {
            Ok(())
        }
    }

    /// `<xacro:attribute>`: an attribute of the element around it.
    fn set_attribute(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["name", "value"], &["name", "value"], frame)?;
        self.check_childless(element, frame);
        let name = self.attribute(element, "name", frame)?.unwrap_or_default();
        let value = self.attribute(element, "value", frame)?.unwrap_or_default();
        self.check_name(&name, value_origin(element, "name", frame))?;
        out.set_attribute(&name, &value, frame.seen(element.origin));
        Ok(())
    }

    /// An element whose name is a value; it may turn out to be one of xacro's own.
    #[inline(never)]
    fn named_element(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.require(element, "xacro:name", frame)?;
        let name = self.attribute(element, "xacro:name", frame)?.unwrap_or_default();
        self.check_name(&name, value_origin(element, "xacro:name", frame))?;
        if !name.starts_with("xacro:") {
            return self.plain_element(element, SmolStr::new(name), frame, out);
        }
        self.count_copy(element)?;
        let mut renamed = element.clone();
        renamed.name = SmolStr::new(name);
        renamed.attributes.retain(|attribute| attribute.name != "xacro:name");
        self.expand_element(&renamed, frame, out)
    }

    #[inline(never)]
    fn plain_element(
        &self,
        element: &Element,
        name: SmolStr,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let mut expanded = Element::new(name);
        expanded.origin = frame.seen(element.origin);
        self.expand_attributes(element, frame, &mut expanded);
        let result = self.expand_nodes(&element.children, frame, &mut Output::new(&mut expanded));
        out.push(Node::Element(expanded));
        result
    }

    /// Attributes of a plain element. One that fails has been reported and keeps its text.
    #[inline(never)]
    fn expand_attributes(&self, element: &Element, frame: Frame, out: &mut Element) {
        for attribute in &element.attributes {
            let own =
                attribute.name.starts_with("xacro:") && attribute.name != "xacro:targetNamespace";
            if own || attribute.name == "xmlns:xacro" {
                continue;
            }
            let value_origin = frame.seen(attribute.value_origin);
            let value = self
                .tree_text(&attribute.value, value_origin, frame.scope)
                .unwrap_or_else(|Failed| attribute.value.clone());
            let origin = frame.seen(attribute.origin);
            out.attributes.push(Attribute {
                name: attribute.name.clone(),
                value,
                origin,
                value_origin,
            });
        }
    }

    #[inline(never)]
    fn insert_block(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name"], frame)?;
        self.check_childless(element, frame);
        let name = self.attribute(element, "name", frame)?.unwrap_or_default();
        let block = {
            let scopes = self.scopes.borrow();
            let content = scopes.find(frame.scope, &format!("**{name}"));
            let found = content.or_else(|| scopes.find(frame.scope, &format!("*{name}")));
            match found {
                Some((_, Symbol::Block(block))) => Some(block.clone()),
                _ => None,
            }
        };
        let Some(block) = block else {
            let names = self.scopes.borrow().block_names(frame.scope);
            let origin = value_origin(element, "name", frame);
            return Err(self.fail(
                Diagnostic::error("unknown-block", format!("there is no block `{name}`"))
                    .at(origin)
                    .did_you_mean(origin, &name, names.iter().map(String::as_str))
                    .help("a block is a macro's parameter `*name` or `**name`, or a property with elements in it"),
            ));
        };
        self.expand_nodes(&block.nodes, Frame { context: block.context, ..frame }, out)
    }

    #[inline(never)]
    fn declare_argument(&self, element: &Element, frame: Frame) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name", "default"], frame)?;
        self.check_childless(element, frame);
        let name = element.value("name").unwrap_or_default().to_owned();
        if self.arguments.borrow().contains_key(&name) {
            return Ok(());
        }
        if let Some(default) = self.attribute(element, "default", frame)? {
            self.arguments.borrow_mut().insert(name, default.to_string());
            return Ok(());
        }
        self.argument(&name, value_origin(element, "name", frame)).map(drop)
    }

    #[inline(never)]
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
    #[inline(never)]
    pub(crate) fn attribute(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<Option<Rc<str>>, Failed> {
        let Some(attribute) = element.attribute(name) else { return Ok(None) };
        self.text(&attribute.value, frame.seen(attribute.value_origin), frame.scope).map(Some)
    }

    /// Warns of what stands in an element whose content nobody reads.
    #[inline(never)]
    pub(crate) fn check_childless(&self, element: &Element, frame: Frame) {
        let unread = element.children.iter().find_map(|node| match node {
            Node::Element(child) => Some(child.origin),
            Node::Text(text) if !text.text.trim().is_empty() => Some(text.origin),
            _ => None,
        });
        if let Some(origin) = unread {
            self.report(
                Diagnostic::warning(
                    "unread-content",
                    format!("the content of `{}` is not read", element.name),
                )
                .at(frame.seen(origin))
                .related(frame.seen(element.origin), "the element")
                .help("remove it, or move it outside"),
            );
        }
    }

    #[inline(never)]
    pub(crate) fn require(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<(), Failed> {
        if element.attribute(name).is_some() {
            return Ok(());
        }
        Err(self.fail(
            Diagnostic::error(
                "missing-attribute",
                format!("`{}` needs the attribute `{name}`", element.name),
            )
            .at(frame.seen(element.origin))
            .help(format!("add {name}=\"...\"")),
        ))
    }

    /// Reports attributes that are missing (and fails) or unknown (and goes on).
    #[inline(never)]
    pub(crate) fn check_attributes(
        &self,
        element: &Element,
        required: &[&str],
        known: &[&str],
        frame: Frame,
    ) -> Result<(), Failed> {
        for name in required {
            self.require(element, name, frame)?;
        }
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            if known.contains(&name) || name.starts_with("xmlns:") {
                continue;
            }
            let origin = frame.seen(attribute.origin);
            let origin = Origin(origin.0.map(|span| span.part(0, name.len())));
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

/// Where the value of an attribute stands.
pub(crate) fn value_origin(element: &Element, name: &str, frame: Frame) -> Origin {
    let origin = element.attribute(name).map(|attribute| attribute.value_origin);
    frame.seen(origin.unwrap_or(element.origin))
}
