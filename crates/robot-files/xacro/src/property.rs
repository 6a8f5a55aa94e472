//! `<xacro:property>`.

use std::rc::Rc;

use periplus_diagnostics::Diagnostic;
use periplus_xml::{Attribute, Element};
use smol_str::SmolStr;

use crate::attributes::value_origin;
use crate::frame::Frame;
use crate::literal::{condition, is_name, literal, typed};
use crate::scopes::{Block, LazyText, ScopeId, Symbol, TOP};
use crate::state::{Failed, State};
use periplus_python_expr::{Value, is_built_in};

const ATTRIBUTES: [&str; 6] = ["name", "value", "default", "remove", "scope", "lazy_eval"];

impl State<'_> {
    /// Defines, redefines or removes a property, or a block of elements.
    #[inline(never)]
    pub(crate) fn define_property(&self, element: &Element, frame: Frame) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &ATTRIBUTES, frame)?;
        let name_origin = value_origin(element, "name", frame);
        let name = self.attribute(element, "name", frame)?.unwrap_or_default();
        if !is_name(&name) || name.starts_with("__") {
            let mut diagnostic = Diagnostic::error(
                "property-name",
                format!("`{name}` cannot be the name of a property"),
            )
            .at(name_origin)
            .help("a name is letters, digits and `_`, starts with a letter, and is not a Python keyword");
            let repaired = name.replace(['-', '.', ' '], "_");
            let is_written = element.value("name") == Some(&name);
            if is_written && is_name(&repaired) && !repaired.starts_with("__") {
                diagnostic = diagnostic.replace(name_origin, repaired, "this would do");
            }
            return Err(self.fail(diagnostic));
        }
        let remove = self.flag(element, "remove", frame)?.unwrap_or(false);
        let value = element.attribute("value");
        let default = element.attribute("default");
        if usize::from(value.is_some()) + usize::from(default.is_some()) + usize::from(remove) > 1 {
            return Err(self.fail(
                Diagnostic::error(
                    "property-attributes",
                    format!("`{name}` has more than one of value, default and remove"),
                )
                .at(frame.seen(element.origin))
                .help("keep one of them"),
            ));
        }
        if remove && self.scopes.borrow().find(frame.scope, &name).is_some() {
            self.scopes.borrow_mut().remove(frame.scope, &name);
            return Ok(());
        }
        if default.is_some() && self.is_defined(frame.scope, &name) {
            return Ok(());
        }
        let given = value.or(default);
        if given.is_some() {
            self.check_childless(element, frame);
        }
        if is_built_in(&name) {
            self.report(
                Diagnostic::warning(
                    "redefines-built-in",
                    format!("the property `{name}` hides xacro's own `{name}`"),
                )
                .at(name_origin)
                .help("choose another name"),
            );
        }
        let target = self.property_scope(element, &name, frame)?;
        let is_local = element.value("scope").is_none_or(|scope| scope == "local");
        let Some(target) = target else { return Ok(()) };
        let Some(given) = given else {
            self.count_copy(element)?;
            let nodes = Rc::new(element.children.clone());
            let block = Symbol::Block(Block { nodes, context: frame.context });
            self.scopes.borrow_mut().set(target, SmolStr::new(format!("**{name}")), block);
            return Ok(());
        };
        let is_lazy = self.flag(element, "lazy_eval", frame)?.unwrap_or(true) && is_local;
        let symbol = self.property_symbol(given, is_lazy, frame)?;
        self.scopes.borrow_mut().set(target, SmolStr::new(name), symbol);
        Ok(())
    }

    /// Scope in which a property is defined; `None`, with a warning, if there is no such scope.
    #[inline(never)]
    fn property_scope(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<Option<ScopeId>, Failed> {
        let origin = value_origin(element, "scope", frame);
        match self.attribute(element, "scope", frame)?.as_deref() {
            None | Some("local") => Ok(Some(frame.scope)),
            Some("global") => Ok(Some(TOP)),
            Some("parent") => {
                let parent = self.scopes.borrow().parent(frame.scope);
                if parent.is_none() {
                    self.report(
                        Diagnostic::warning(
                            "no-parent-scope",
                            format!("`{name}` is not defined: outside of macros there is no parent scope"),
                        )
                        .at(origin)
                        .help("remove the attribute `scope`"),
                    );
                }
                Ok(parent)
            }
            Some(other) => Err(self.fail(
                Diagnostic::error("property-scope", format!("`{other}` is not a scope"))
                    .at(origin)
                    .help("write `parent` or `global`, or leave it out"),
            )),
        }
    }

    #[inline(never)]
    fn property_symbol(
        &self,
        given: &Attribute,
        is_lazy: bool,
        frame: Frame,
    ) -> Result<Symbol, Failed> {
        let origin = frame.seen(given.value_origin);
        Ok(match literal(&given.value) {
            // Text may hold expressions, which are evaluated on first use.
            Value::Str(text) if is_lazy && text.contains('$') => {
                Symbol::Lazy(Rc::new(LazyText { text: SmolStr::new(text), origin }))
            }
            Value::Str(_) if given.value.contains('$') => {
                Symbol::Value(typed(self.text_value(&given.value, origin, frame.scope)?))
            }
            // The reference parses such a text twice, so a lazy '007' in quotes becomes a number.
            value if is_lazy => Symbol::Value(typed(value)),
            value => Symbol::Value(value),
        })
    }

    fn is_defined(&self, scope: ScopeId, name: &str) -> bool {
        self.scopes.borrow().find(scope, name).is_some() || is_built_in(name)
    }

    /// Truth value of an attribute.
    #[inline(never)]
    pub(crate) fn flag(
        &self,
        element: &Element,
        name: &str,
        frame: Frame,
    ) -> Result<Option<bool>, Failed> {
        let Some(attribute) = element.attribute(name) else { return Ok(None) };
        let origin = frame.seen(attribute.value_origin);
        let value = self.text_value(&attribute.value, origin, frame.scope)?;
        match condition(&value) {
            Some(truth) => Ok(Some(truth)),
            None => Err(self.fail(
                Diagnostic::error(
                    "condition",
                    format!("`{}` is neither true nor false", self.characters(&value, origin)?),
                )
                .at(origin)
                .help("write true, false, 1 or 0, or compare: ${x == 'a'}"),
            )),
        }
    }
}
