//! Expansion of the elements of a document.

use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap};
use periplus_xml::{Attribute, Document, Element, SmolStr, Text, XmlNode};

use crate::attributes::value_origin;
use crate::frame::Frame;
use crate::output::Output;
use crate::scopes::{Symbol, TOP};
use crate::setting::XacroContext;
use crate::state::{Failed, State};

/// Elements defined by xacro itself.
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

/// Maximum nesting depth of elements, macros and includes.
///
/// The recursive functions and their callees are `#[inline(never)]`: otherwise the locals of all of them
/// would take stack space at each level. A stack of 1 MiB is enough.
const MAX_DEPTH: usize = 300;

/// Maximum number of nodes that an expansion visits, copies included.
const MAX_NODES: usize = 1_000_000;

/// Result of an expansion.
#[derive(Clone, Debug)]
pub struct Expanded {
    /// The document without xacro.
    pub document: Document,
    /// Files that it read besides the first, in order.
    pub includes: Vec<PathBuf>,
    /// The arguments that it used, with the values they had.
    pub arguments: Vec<(String, String)>,
    /// Names of the arguments that it declares or reads.
    pub known_arguments: Vec<String>,
}

/// Expands a document. Returns `None` if there is any error in `diagnostics`: an incomplete robot is of no
/// use.
pub fn expand(
    document: &Document,
    setting: XacroContext<'_>,
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
    let known_arguments = state.known_arguments.take().into_iter().collect();
    drop(state);
    diagnostics.append(found);
    if walked.is_err() || diagnostics.errors() > errors_before {
        return None;
    }
    let document =
        Document { before: document.before.clone(), root, after: document.after.clone() };
    Some(Expanded { document, includes, arguments, known_arguments })
}

impl State<'_> {
    /// Declares the namespaces of an included file or a macro around its content.
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
        nodes: &[XmlNode],
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let mut comments_live = false;
        let mut failed = false;
        for node in nodes {
            self.count_node(node, frame)?;
            match node {
                XmlNode::Element(element) => {
                    comments_live = false;
                    failed |= self.expand_element(element, frame, out).is_err();
                }
                XmlNode::Text(text) => {
                    let origin = frame.seen(text.origin);
                    match self.tree_text(&text.text, origin, frame.scope) {
                        Ok(text) => {
                            comments_live &= text.trim().is_empty();
                            out.push(XmlNode::Text(Text { text, origin }));
                        }
                        Err(Failed) => failed = true,
                    }
                }
                XmlNode::Comment(comment) if comment.text.contains("xacro:eval-comments") => {
                    comments_live = !comment.text.contains("xacro:eval-comments:off");
                }
                XmlNode::Comment(comment) if comments_live => {
                    let origin = frame.seen(comment.origin);
                    match self.tree_text(&comment.text, origin, frame.scope) {
                        Ok(text) => out.push(XmlNode::Comment(Text { text, origin })),
                        Err(Failed) => failed = true,
                    }
                }
                XmlNode::Comment(_) | XmlNode::Instruction(_) => out.push(node.clone()),
            }
            if self.has_given_up() {
                return Err(Failed);
            }
        }
        if failed { Err(Failed) } else { Ok(()) }
    }

    fn count_node(&self, node: &XmlNode, frame: Frame) -> Result<(), Failed> {
        let origin = match node {
            XmlNode::Element(element) => element.origin,
            XmlNode::Text(text) | XmlNode::Comment(text) | XmlNode::Instruction(text) => {
                text.origin
            }
        };
        self.count(1, frame.seen(origin))
    }

    /// Adds the cost of copying an element to the budget.
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
        if self.parts.get() <= MAX_NODES {
            return Ok(());
        }
        Err(self.give_up(
            Diagnostic::error(
                "too-large",
                format!("the file expands to more than {MAX_NODES} parts"),
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
        if self.nesting.get() >= MAX_DEPTH {
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
                format!("elements, macros and includes are nested more than {MAX_DEPTH} deep"),
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

    /// Expands an element whose name is a value. The result can be one of xacro's own elements.
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
        out.push(XmlNode::Element(expanded));
        result
    }

    /// Expands the attributes of a plain element. An attribute that fails keeps its text; the error is
    /// reported.
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
        self.known_arguments.borrow_mut().insert(name.clone());
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
                    "a name starts with a letter and continues with letters, digits, `_`, `-`, `.`",
                ),
        ))
    }
}
