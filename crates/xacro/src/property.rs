//! `<xacro:property>`.

use std::rc::Rc;

use periplus_diagnostics::{ContextId, Diagnostic};
use periplus_xml::Element;
use smol_str::SmolStr;

use crate::evaluate::{Failed, State};
use crate::expression::{Budget, EmptyScope, Expression, Value, evaluate};
use crate::literal::{condition, is_name, literal};
use crate::scopes::{Block, LazyText, ScopeId, Symbol};

const ATTRIBUTES: [&str; 6] = ["name", "value", "default", "remove", "scope", "lazy_eval"];

impl State<'_> {
    /// Defines, redefines or removes a property, or a block of elements.
    pub(crate) fn define_property(
        &self,
        element: &Element,
        scope: ScopeId,
        context: Option<ContextId>,
    ) -> Result<(), Failed> {
        self.check_attributes(element, &["name"], &ATTRIBUTES)?;
        let name_origin = self.value_origin(element, "name");
        let name = self.attribute(element, "name", scope)?.unwrap_or_default();
        if !is_name(&name) || name.starts_with("__") {
            return Err(self.fail(
                Diagnostic::error(
                    "property-name",
                    format!("`{name}` cannot be the name of a property"),
                )
                .at(name_origin)
                .help("a name is letters, digits and `_`, starts with a letter, and is no word of Python's"),
            ));
        }
        let remove = self.flag(element, "remove", scope)?.unwrap_or(false);
        let value = element.attribute("value");
        let default = element.attribute("default");
        if usize::from(value.is_some()) + usize::from(default.is_some()) + usize::from(remove) > 1 {
            return Err(self.fail(
                Diagnostic::error(
                    "property-attributes",
                    format!("`{name}` has more than one of value, default and remove"),
                )
                .at(element.origin)
                .help("keep one of them"),
            ));
        }
        if remove && self.scopes.borrow().find(scope, &name).is_some() {
            self.scopes.borrow_mut().remove(scope, &name);
            return Ok(());
        }
        if default.is_some() && self.is_defined(scope, &name) {
            return Ok(());
        }
        let Some(given) = value.or(default) else {
            let nodes = Rc::new(element.children.clone());
            let block = Symbol::Block(Block { nodes, context });
            self.scopes.borrow_mut().set(scope, SmolStr::new(format!("**{name}")), block);
            return Ok(());
        };
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
        let lazy = self.flag(element, "lazy_eval", scope)?.unwrap_or(true);
        let target = match self.attribute(element, "scope", scope)?.as_deref() {
            None | Some("local") => None,
            Some("global") => Some(crate::scopes::TOP),
            Some("parent") => match self.scopes.borrow().parent(scope) {
                Some(parent) => Some(parent),
                None => {
                    self.report(
                        Diagnostic::warning(
                            "no-parent-scope",
                            format!("`{name}` is not defined: outside of macros there is no parent scope"),
                        )
                        .at(self.value_origin(element, "scope"))
                        .help("remove the attribute"),
                    );
                    return Ok(());
                }
            },
            Some(other) => {
                return Err(self.fail(
                    Diagnostic::error("property-scope", format!("`{other}` is not a scope"))
                        .at(self.value_origin(element, "scope"))
                        .help("write `parent` or `global`, or leave it out"),
                ));
            }
        };
        let symbol = match literal(&given.value) {
            // Text may hold expressions: those of this scope are evaluated when someone asks.
            Value::Str(text) if lazy && target.is_none() && text.contains('$') => {
                let text = SmolStr::new(&*text);
                Symbol::Lazy(Rc::new(LazyText {
                    text,
                    origin: self.seen(given.value_origin, context),
                }))
            }
            Value::Str(_) if given.value.contains('$') => {
                let origin = self.seen(given.value_origin, context);
                Symbol::Value(match self.text_value(&given.value, origin, scope)? {
                    Value::Str(text) => literal(&text),
                    other => other,
                })
            }
            value => Symbol::Value(value),
        };
        self.scopes.borrow_mut().set(target.unwrap_or(scope), name.into(), symbol);
        Ok(())
    }

    fn is_defined(&self, scope: ScopeId, name: &str) -> bool {
        self.scopes.borrow().find(scope, name).is_some() || is_built_in(name)
    }

    /// A truth value in an attribute.
    pub(crate) fn flag(
        &self,
        element: &Element,
        name: &str,
        scope: ScopeId,
    ) -> Result<Option<bool>, Failed> {
        let Some(attribute) = element.attribute(name) else { return Ok(None) };
        let value = self.text_value(&attribute.value, attribute.value_origin, scope)?;
        match condition(&value) {
            Some(truth) => Ok(Some(truth)),
            None => Err(self.fail(
                Diagnostic::error(
                    "condition",
                    format!(
                        "`{}` is neither true nor false",
                        self.characters(&value, attribute.value_origin)?
                    ),
                )
                .at(attribute.value_origin)
                .help("write true, false, 1 or 0, or compare: ${x == 'a'}"),
            )),
        }
    }
}

/// Whether xacro itself gives a name a meaning: `pi`, `sin`, `len`.
fn is_built_in(name: &str) -> bool {
    let Ok(expression) = Expression::parse(name) else { return false };
    evaluate(&expression, &EmptyScope, &mut Budget::new(10, 1_000)).is_ok()
}
