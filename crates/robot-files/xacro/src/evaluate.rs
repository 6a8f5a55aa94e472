//! Texts to values.

use std::ops::Range;
use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Origin, Span};
use smol_str::SmolStr;

use crate::literal::typed;
use crate::names::Names;
use crate::scopes::{LazyText, ScopeId, Symbol};
use crate::state::{Failed, Resolving, State};
use crate::text::{Piece, pieces};
use periplus_python_expr::{
    Expression, ExpressionDialect, ExpressionError, ExpressionErrorKind, Value, evaluate,
};

/// Maximum number of properties listed in the error about a circular definition.
const MAX_LISTED_PROPERTIES: usize = 5;

/// Maximum nesting depth of properties that refer to properties, and of texts in texts.
const MAX_DEPTH: usize = 100;

/// Maximum length of one text [bytes].
const MAX_TEXT_BYTES: usize = 16 << 20;

/// Maximum length of all texts of an expansion together [bytes].
const MAX_TOTAL_TEXT_BYTES: usize = 128 << 20;

impl State<'_> {
    /// Value of a text: that of its only expression or extension, or else the concatenation of its pieces.
    #[inline(never)]
    pub(crate) fn text_value(
        &self,
        text: &str,
        origin: Origin,
        scope: ScopeId,
    ) -> Result<Value, Failed> {
        if !text.contains('$') {
            return Ok(Value::text(text));
        }
        if self.depth.get() >= MAX_DEPTH {
            return Err(self.give_up(
                Diagnostic::error(
                    "too-deep",
                    format!("properties and texts refer to each other more than {MAX_DEPTH} deep"),
                )
                .at(origin)
                .help("does a property refer to itself?"),
            ));
        }
        self.depth.set(self.depth.get() + 1);
        let outer_place = self.place.replace(origin);
        let value = self.pieces_value(text, origin, scope);
        self.place.set(outer_place);
        self.depth.set(self.depth.get() - 1);
        value
    }

    /// The value of a text as characters.
    #[inline(never)]
    pub(crate) fn text(
        &self,
        text: &str,
        origin: Origin,
        scope: ScopeId,
    ) -> Result<Rc<str>, Failed> {
        if !text.contains('$') {
            return Ok(text.into());
        }
        let value = self.text_value(text, origin, scope)?;
        self.characters(&value, origin)
    }

    /// Value as characters of a text of the document. Avoids the copy if the text holds no expression.
    #[inline(never)]
    pub(crate) fn tree_text(
        &self,
        text: &SmolStr,
        origin: Origin,
        scope: ScopeId,
    ) -> Result<SmolStr, Failed> {
        if !text.contains('$') {
            return Ok(text.clone());
        }
        let characters = self.text(text, origin, scope)?;
        self.write(0, characters.len(), origin)?;
        Ok(SmolStr::new(characters))
    }

    /// Counts bytes that are added to a text of `so_far` bytes.
    #[inline(never)]
    fn write(&self, so_far: usize, bytes: usize, origin: Origin) -> Result<(), Failed> {
        self.written.set(self.written.get() + bytes);
        if so_far + bytes <= MAX_TEXT_BYTES && self.written.get() <= MAX_TOTAL_TEXT_BYTES {
            return Ok(());
        }
        let message = "this text becomes longer than 16 MiB, or all texts than 128 MiB";
        let help = "does a property repeat another that repeats another?";
        Err(self.give_up(Diagnostic::error("too-long", message).at(origin).help(help)))
    }

    /// A value as characters, as Python's `str` gives them.
    #[inline(never)]
    pub(crate) fn characters(&self, value: &Value, origin: Origin) -> Result<Rc<str>, Failed> {
        if let Value::Str(text) = value {
            return Ok(text.clone());
        }
        let mut budget = self.budget.take();
        let text = value.to_text(&mut budget);
        self.budget.replace(budget);
        text.map(Rc::from).map_err(|error| self.expression_failed(error, origin, ""))
    }

    #[inline(never)]
    fn pieces_value(&self, text: &str, origin: Origin, scope: ScopeId) -> Result<Value, Failed> {
        let cut = pieces(text);
        let mut joined = String::new();
        let alone = cut.len() == 1;
        for piece in cut {
            let value = match piece {
                Piece::Plain(range) => Value::text(&text[range]),
                Piece::Expression(range) => {
                    let place = part(origin, text, &range);
                    self.expression_value(&text[range], place, scope, ExpressionDialect::Xacro)?
                }
                Piece::Extension(range) => {
                    let place = part(origin, text, &range);
                    Value::text(self.extension(&text[range], place, scope)?)
                }
                Piece::Unclosed(range) => {
                    let bracket = if text[range.start..].starts_with("${") { '}' } else { ')' };
                    return Err(self.fail(
                        Diagnostic::error(
                            "unclosed-expression",
                            format!("`{}` is not closed", &text[range.start..range.start + 2]),
                        )
                        .at(part(origin, text, &range))
                        .help(format!(
                            "write `{bracket}` where it ends, or `$$` for a dollar sign"
                        )),
                    ));
                }
            };
            if alone {
                return Ok(value);
            }
            let characters = self.characters(&value, origin)?;
            self.write(joined.len(), characters.len(), origin)?;
            joined.push_str(&characters);
        }
        Ok(Value::text(joined))
    }

    /// Value of the content of `${...}`.
    #[inline(never)]
    pub(crate) fn expression_value(
        &self,
        text: &str,
        origin: Origin,
        scope: ScopeId,
        dialect: ExpressionDialect,
    ) -> Result<Value, Failed> {
        // Extensions inside an expression are put in as text before it is parsed.
        let replaced = self.text(text, origin, scope)?;
        let outcome = Expression::parse(&replaced).and_then(|expression| {
            let names = Names { state: self, scope, dialect };
            let mut budget = self.budget.take();
            let value = evaluate(&expression, &names, &mut budget);
            self.budget.replace(budget);
            value
        });
        outcome.map_err(|error| {
            let place = if *replaced == *text { part(origin, text, &error.range) } else { origin };
            self.expression_failed(error, place, &replaced)
        })
    }

    #[inline(never)]
    fn expression_failed(&self, error: ExpressionError, place: Origin, text: &str) -> Failed {
        // A property that failed while it was evaluated has reported the error.
        if error.kind == ExpressionErrorKind::Reported {
            return Failed;
        }
        // No evaluation that costs a step can succeed after this.
        if self.budget.borrow().steps_left() == 0 {
            self.given_up.set(true);
        }
        let mut diagnostic = Diagnostic::error("expression", error.message).at(place);
        if error.kind == ExpressionErrorKind::UndefinedName {
            diagnostic = diagnostic.caused_by(DiagnosticCause::Undefined);
        }
        if !text.is_empty() {
            diagnostic = diagnostic.note(format!("in the expression `{}`", shorten(text)));
        }
        if let Some(help) = error.help {
            diagnostic = diagnostic.help(help);
        }
        self.fail(diagnostic)
    }

    /// Value of a property, evaluated on first use.
    pub(crate) fn property(&self, scope: ScopeId, name: &str) -> Result<Option<Value>, Failed> {
        let found = {
            let scopes = self.scopes.borrow();
            scopes.find(scope, name).map(|(holder, symbol)| (holder, symbol.clone()))
        };
        match found {
            Some((holder, symbol)) => self.symbol_value(holder, name, symbol).map(Some),
            None => Ok(None),
        }
    }

    pub(crate) fn symbol_value(
        &self,
        holder: ScopeId,
        name: &str,
        symbol: Symbol,
    ) -> Result<Value, Failed> {
        match symbol {
            Symbol::Value(value) => Ok(value),
            Symbol::Lazy(lazy) => self.resolve(holder, name, &lazy),
            Symbol::Namespace(_) => Ok(Value::Namespace(Rc::from(name))),
            Symbol::Block(_) => Ok(Value::None),
        }
    }

    fn resolve(&self, holder: ScopeId, name: &str, lazy: &LazyText) -> Result<Value, Failed> {
        let is_this = |other: &Resolving| other.holder == holder && other.name == name;
        let first = self.resolving.borrow().iter().position(is_this);
        if let Some(first) = first {
            let resolving = self.resolving.borrow();
            let mut diagnostic =
                Diagnostic::error("circular-property", format!("`{name}` is defined by itself"))
                    .at(lazy.origin);
            for other in resolving[first + 1..].iter().take(MAX_LISTED_PROPERTIES) {
                diagnostic = diagnostic.related(other.origin, format!("through `{}`", other.name));
            }
            return Err(self.fail(diagnostic.help(
                "give one of them a value, or set lazy_eval=\"false\" to use the value so far",
            )));
        }
        self.resolving.borrow_mut().push(Resolving {
            holder,
            name: name.into(),
            origin: lazy.origin,
        });
        let value = self.text_value(&lazy.text, lazy.origin, holder);
        self.resolving.borrow_mut().pop();
        let value = typed(value?);
        let symbol = Symbol::Value(value.clone());
        self.scopes.borrow_mut().set(holder, name.into(), symbol);
        Ok(value)
    }
}

fn shorten(text: &str) -> String {
    match text.char_indices().nth(80) {
        Some((cut, _)) => format!("{}...", &text[..cut]),
        None => text.to_owned(),
    }
}

/// Origin of a part of a text, if the text is in its file unchanged.
pub(crate) fn part(origin: Origin, text: &str, range: &Range<usize>) -> Origin {
    let narrowed = |span: Span| {
        let plain = (span.end - span.start) as usize == text.len();
        if plain { span.part(range.start, range.end) } else { span }
    };
    Origin(origin.0.map(narrowed))
}
