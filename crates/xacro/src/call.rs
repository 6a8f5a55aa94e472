//! Macros and their calls.

use std::collections::BTreeSet;
use std::rc::Rc;

use periplus_diagnostics::{ContextId, Diagnostic, Expansion};
use periplus_xml::{Element, Node};
use smol_str::SmolStr;

use crate::evaluate::{Failed, State};
use crate::expand::Output;
use crate::expression::Value;
use crate::literal::literal;
use crate::parameters::{Parameter, parse};
use crate::scopes::{Block, Macro, ScopeId, Symbol};

impl State<'_> {
    /// Reads `<xacro:macro>`.
    pub(crate) fn define_macro(&self, element: &Element, scope: ScopeId) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &["name", "params"])?;
        let name = element.value("name").unwrap_or_default();
        let origin = self.value_origin(element, "name");
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
                    .help("`call` and names with a `.` have a meaning of their own in xacro"),
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
                    .at(self.value_origin(element, "params"))
                    .help("remove one of them"),
                );
            }
        }
        let definition = Macro { name: name.into(), parameters, definition: element.clone() };
        self.scopes.borrow_mut().define(scope, definition);
        Ok(())
    }

    /// `<xacro:call macro="${name}" .../>`: a call whose macro is chosen by a value.
    pub(crate) fn call_by_value(
        &self,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        self.require(element, "macro")?;
        let name = self.attribute(element, "macro", scope)?.unwrap_or_default();
        let mut call = element.clone();
        call.attributes.retain(|attribute| attribute.name != "macro");
        self.call(&name, &call, scope, context, out)
    }

    /// Expands a macro in the place of its call.
    pub(crate) fn call(
        &self,
        name: &str,
        call: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        out: &mut Output<'_>,
    ) -> Result<(), Failed> {
        let found = self.scopes.borrow().find_macro(scope, name);
        let Some((seen_from, callee)) = found else {
            return Err(self.unknown_macro(name, call, scope));
        };
        let inner_context = call.origin.0.map(|span| {
            let span = context.map_or(span, |context| span.within(context));
            let expansion = Expansion::Macro { name: callee.name.to_string(), call: span };
            self.sources.borrow_mut().expand(expansion)
        });
        let symbols = self.bind(&callee, call, scope, context)?;
        let inner = self.scopes.borrow_mut().open(seen_from);
        for (name, symbol) in symbols {
            self.scopes.borrow_mut().set(inner, name, symbol);
        }
        out.adopt_namespaces(&callee.definition);
        let body = &callee.definition.children;
        let result = self.expand_nodes(body, inner, inner_context.or(context), out);
        self.scopes.borrow_mut().close(inner);
        result
    }

    /// The values of a macro's parameters in a call.
    fn bind(
        &self,
        callee: &Macro,
        call: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
    ) -> Result<Vec<(SmolStr, Symbol)>, Failed> {
        let mut symbols = Vec::new();
        let mut open: Vec<&Parameter> = callee.parameters.iter().collect();
        let mut failed = false;
        for attribute in &call.attributes {
            if attribute.name.starts_with("xmlns") {
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
                    .at(self.seen(attribute.origin, context))
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
            let origin = self.seen(attribute.value_origin, context);
            match self.text_value(&attribute.value, origin, scope) {
                Ok(value) => symbols.push((attribute.name.clone(), Symbol::Value(typed(value)))),
                Err(Failed) => failed = true,
            }
        }
        symbols.extend(self.bind_blocks(callee, call, scope, context, &mut open)?);
        let mut missing = Vec::new();
        for parameter in open {
            if parameter.is_required() {
                missing.push(parameter.name.as_str());
                continue;
            }
            match self.default_value(parameter, call, scope, context) {
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
                .at(self.seen(call.origin, context))
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

    fn default_value(
        &self,
        parameter: &Parameter,
        call: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
    ) -> Result<Value, Failed> {
        if parameter.forward {
            if let Some(value) = self.property(scope, &parameter.name)? {
                return Ok(value);
            }
        }
        let origin = self.seen(call.origin, context);
        match &parameter.default {
            Some(default) => self.text_value(default, origin, scope),
            None => Err(self.fail(
                Diagnostic::error(
                    "missing-parameter",
                    format!("there is no property `{}` to pass on", parameter.name),
                )
                .at(origin)
                .help(format!(
                    "give the call {}=\"...\", or define the property before it",
                    parameter.name
                )),
            )),
        }
    }

    /// The child elements of a call, for the macro's block parameters in order.
    fn bind_blocks(
        &self,
        callee: &Macro,
        call: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
        open: &mut Vec<&Parameter>,
    ) -> Result<Vec<(SmolStr, Symbol)>, Failed> {
        let mut expanded = Element::new(call.name.clone());
        self.expand_nodes(&call.children, scope, context, &mut Output::new(&mut expanded))?;
        let mut blocks = expanded.children.into_iter().filter_map(|node| match node {
            Node::Element(element) => Some(element),
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
                    .at(self.seen(call.origin, context))
                    .related(callee.definition.origin, "the macro")
                    .help("put the element between the start and the end of the call"),
                ));
            };
            // `*x` inserts the element, `**x` what is in it.
            let nodes = if parameter.name.starts_with("**") {
                block.children
            } else {
                vec![Node::Element(block)]
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

    fn unknown_macro(&self, name: &str, call: &Element, scope: ScopeId) -> Failed {
        let scopes = self.scopes.borrow();
        let names = scopes.macro_names(scope);
        let directives = crate::expand::DIRECTIVES;
        let known = names.iter().map(String::as_str).chain(directives);
        let mut diagnostic =
            Diagnostic::error("unknown-macro", format!("there is no macro `{name}`"))
                .at(call.origin);
        diagnostic = match periplus_diagnostics::closest(name, known) {
            Some(near) => diagnostic.replace(
                call.name_origin(),
                format!("xacro:{near}"),
                format!("did you mean `xacro:{near}`?"),
            ),
            None => diagnostic.help("define it before the call, or include the file that does"),
        };
        drop(scopes);
        self.fail(diagnostic)
    }
}

/// Text that is a number or a truth value counts as one.
fn typed(value: Value) -> Value {
    match value {
        Value::Str(text) => literal(&text),
        other => other,
    }
}

fn attribute_name(attribute: &periplus_xml::Attribute) -> periplus_diagnostics::Origin {
    periplus_diagnostics::Origin(attribute.origin.0.map(|span| span.part(0, attribute.name.len())))
}
