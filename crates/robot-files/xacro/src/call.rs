//! Macros and their calls.

use std::collections::BTreeSet;
use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Expansion, Origin};
use periplus_xml::{Attribute, Element, XmlNode};
use smol_str::SmolStr;

use crate::attributes::value_origin;
use crate::evaluate::part;
use crate::frame::Frame;
use crate::literal::typed;
use crate::output::Output;
use crate::parameters::{Parameter, parse};
use crate::scopes::{Block, Macro, Symbol};
use crate::state::{Failed, State};
use periplus_python_expr::Value;

/// Budget cost of a macro call, in elements.
const NODES_PER_CALL: usize = 4;

impl State<'_> {
    /// Reads `<xacro:macro>`.
    #[inline(never)]
    pub(crate) fn define_macro(&self, element: &Element, frame: Frame) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name", "params"], frame)?;
        let name = element.value("name").unwrap_or_default();
        let origin = value_origin(element, "name", frame);
        let name = match name.strip_prefix("xacro:") {
            Some(rest) => {
                self.report(
                    Diagnostic::warning("macro-name", "a macro is named without `xacro:`")
                        .at(origin)
                        .replace(origin, rest, "write the name alone"),
                );
                rest
            }
            None => name,
        };
        if name == "call" || name.contains('.') {
            return Err(self.fail(
                Diagnostic::error("macro-name", format!("`{name}` cannot be the name of a macro"))
                    .at(origin)
                    .help("`call` and names with a `.` have a special meaning in xacro"),
            ));
        }
        let parameters = parse(element.value("params").unwrap_or_default());
        let mut seen = BTreeSet::new();
        for parameter in &parameters {
            if !seen.insert(&parameter.name) {
                self.report(
                    Diagnostic::warning(
                        "repeated-parameter",
                        format!("the macro `{name}` has the parameter `{}` twice", parameter.name),
                    )
                    .at(value_origin(element, "params", frame))
                    .help("remove one of them"),
                );
            }
        }
        self.count_copy(element)?;
        let definition = Macro { name: name.into(), parameters, definition: element.clone() };
        self.scopes.borrow_mut().define(frame.scope, definition);
        Ok(())
    }

    /// `<xacro:call macro="${name}" .../>`: a call whose macro is chosen by a value.
    #[inline(never)]
    pub(crate) fn call_by_value(
        &self,
        element: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.require(element, "macro", frame)?;
        let name = self.attribute(element, "macro", frame)?.unwrap_or_default();
        self.call(&name, element, frame, out)
    }

    /// Expands a macro at its call.
    #[inline(never)]
    pub(crate) fn call(
        &self,
        name: &str,
        call: &Element,
        frame: Frame,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.count(NODES_PER_CALL, frame.seen(call.origin))?;
        let found = self.scopes.borrow().find_macro(frame.scope, name);
        let Some((seen_from, callee)) = found else {
            return Err(self.unknown_macro(name, call, frame));
        };
        let context = frame.seen(call.origin).0.map(|span| {
            let expansion = Expansion::Macro { name: callee.name.to_string(), call: span };
            self.sources.borrow_mut().expand(expansion)
        });
        let context = context.or(frame.context);
        let symbols = self.bind(&callee, call, frame, Frame { context, ..frame })?;
        let inner = self.scopes.borrow_mut().open(seen_from);
        for (name, symbol) in symbols {
            self.scopes.borrow_mut().set(inner, name, symbol);
        }
        self.adopt_namespaces(&callee.definition, frame, out);
        let body = &callee.definition.children;
        let result = self.expand_nodes(body, Frame { scope: inner, context }, out);
        self.scopes.borrow_mut().close(inner);
        result
    }

    /// Returns the values of the macro's parameters in a call. Defaults are written in the macro but
    /// evaluated with the caller's names: `defaults` holds their source locations.
    #[inline(never)]
    fn bind(
        &self,
        callee: &Macro,
        call: &Element,
        frame: Frame,
        defaults: Frame,
    ) -> Result<Vec<(SmolStr, Symbol)>, Failed> {
        let mut symbols = Vec::new();
        let mut open: Vec<&Parameter> = callee.parameters.iter().collect();
        let mut failed = false;
        for attribute in &call.attributes {
            let chooses_macro = call.name == "xacro:call" && attribute.name == "macro";
            if attribute.name.starts_with("xmlns") || chooses_macro {
                continue;
            }
            let Some(index) = open.iter().position(|parameter| parameter.name == attribute.name)
            else {
                let names = callee.parameters.iter().map(|parameter| parameter.name.as_str());
                self.report(
                    Diagnostic::error(
                        "unknown-parameter",
                        format!(
                            "the macro `{}` has no parameter `{}`",
                            callee.name, attribute.name
                        ),
                    )
                    .at(frame.seen(attribute.origin))
                    .related(callee.definition.origin, "the macro")
                    .did_you_mean(
                        attribute_name(attribute),
                        &attribute.name,
                        names,
                    ),
                );
                failed = true;
                continue;
            };
            open.remove(index);
            let origin = frame.seen(attribute.value_origin);
            match self.text_value(&attribute.value, origin, frame.scope) {
                Ok(value) => symbols.push((attribute.name.clone(), Symbol::Value(typed(value)))),
                Err(Failed) => failed = true,
            }
        }
        symbols.extend(self.bind_blocks(callee, call, frame, &mut open)?);
        let mut missing = Vec::new();
        for parameter in open {
            if parameter.is_required() {
                missing.push(parameter.name.as_str());
                continue;
            }
            match self.default_value(parameter, callee, call, defaults) {
                Ok(value) => symbols.push((parameter.name.clone(), Symbol::Value(typed(value)))),
                Err(Failed) => failed = true,
            }
        }
        if !missing.is_empty() {
            return Err(self.fail(
                Diagnostic::error(
                    "missing-parameter",
                    format!("the call of `{}` leaves out `{}`", callee.name, missing.join("`, `")),
                )
                .at(frame.seen(call.origin))
                .related(callee.definition.origin, "the macro")
                .help(format!(
                    "add {}",
                    missing
                        .iter()
                        .map(|name| format!("{name}=\"...\""))
                        .collect::<Vec<_>>()
                        .join(" ")
                )),
            ));
        }
        if failed { Err(Failed) } else { Ok(symbols) }
    }

    #[inline(never)]
    fn default_value(
        &self,
        parameter: &Parameter,
        callee: &Macro,
        call: &Element,
        frame: Frame,
    ) -> Result<Value, Failed> {
        if parameter.forward
            && let Some(value) = self.property(frame.scope, &parameter.name)?
        {
            return Ok(value);
        }
        let params = callee.definition.value("params").unwrap_or_default();
        let params_origin = value_origin(&callee.definition, "params", frame);
        let origin = part(params_origin, params, &parameter.default_range());
        match &parameter.default {
            Some(default) => self.text_value(default, origin, frame.scope),
            None => Err(self.fail(
                Diagnostic::error(
                    "missing-parameter",
                    format!(
                        "the call of `{}` leaves out `{name}`, and there is no property `{name}` to pass on",
                        callee.name,
                        name = parameter.name
                    ),
                )
                .at(call.origin)
                .related(callee.definition.origin, "the macro")
                .help(format!(
                    "add {}=\"...\", or define the property before the call",
                    parameter.name
                )),
            )),
        }
    }

    /// The child elements of a call, for the macro's block parameters in order.
    #[inline(never)]
    fn bind_blocks(
        &self,
        callee: &Macro,
        call: &Element,
        frame: Frame,
        open: &mut Vec<&Parameter>,
    ) -> Result<Vec<(SmolStr, Symbol)>, Failed> {
        let mut expanded = Element::new(call.name.clone());
        self.expand_nodes(&call.children, frame, &mut Output::new(&mut expanded))?;
        self.check_loose_text(callee, &expanded, frame);
        let mut blocks = expanded.children.into_iter().filter_map(|node| match node {
            XmlNode::Element(element) => Some(element),
            _ => None,
        });
        let mut symbols = Vec::new();
        for parameter in open.iter().filter(|parameter| parameter.is_block()) {
            let Some(block) = blocks.next() else {
                return Err(self.fail(
                    Diagnostic::error(
                        "missing-block",
                        format!(
                            "the call of `{}` has no element for `{}`",
                            callee.name, parameter.name
                        ),
                    )
                    .at(frame.seen(call.origin))
                    .related(callee.definition.origin, "the macro")
                    .help("put the element between the start and the end of the call"),
                ));
            };
            // `*x` inserts the element, `**x` what is in it.
            let nodes = if parameter.name.starts_with("**") {
                block.children
            } else {
                vec![XmlNode::Element(block)]
            };
            let block = Block { nodes: Rc::new(nodes), context: None };
            symbols.push((parameter.name.clone(), Symbol::Block(block)));
        }
        open.retain(|parameter| !parameter.is_block());
        if let Some(unused) = blocks.next() {
            return Err(self.fail(
                Diagnostic::error(
                    "unused-block",
                    format!("the macro `{}` does not take this `{}`", callee.name, unused.name),
                )
                .at(unused.origin)
                .related(callee.definition.origin, "the macro")
                .help("remove it, or add a parameter `*name` to the macro"),
            ));
        }
        Ok(symbols)
    }

    /// Warns about text between the blocks of a call, which is ignored.
    #[inline(never)]
    fn check_loose_text(&self, callee: &Macro, call: &Element, frame: Frame) {
        let loose = call.children.iter().find_map(|node| match node {
            XmlNode::Text(text) if !text.text.trim().is_empty() => Some(text.origin),
            _ => None,
        });
        if let Some(origin) = loose {
            self.report(
                Diagnostic::warning(
                    "unread-content",
                    format!("the macro `{}` takes elements, this text is not read", callee.name),
                )
                .at(origin)
                .related(frame.seen(callee.definition.origin), "the macro")
                .help("pass text as a parameter, or put it into an element"),
            );
        }
    }

    #[inline(never)]
    fn unknown_macro(&self, name: &str, call: &Element, frame: Frame) -> Failed {
        let scopes = self.scopes.borrow();
        let names = scopes.macro_names(frame.scope);
        let directives = crate::expand::DIRECTIVES;
        let known = names.iter().map(String::as_str).chain(directives);
        let mut diagnostic =
            Diagnostic::error("unknown-macro", format!("there is no macro `{name}`"))
                .caused_by(DiagnosticCause::Undefined)
                .at(frame.seen(call.origin));
        diagnostic = match periplus_diagnostics::closest(name, known) {
            Some(near) => diagnostic.replace(
                call.name_origin(),
                format!("xacro:{near}"),
                format!("did you mean `xacro:{near}`?"),
            ),
            None => diagnostic,
        }
        .help("define it before the call, or include the file that does");
        drop(scopes);
        self.fail(diagnostic)
    }
}

fn attribute_name(attribute: &Attribute) -> Origin {
    Origin(attribute.origin.0.map(|span| span.part(0, attribute.name.len())))
}
