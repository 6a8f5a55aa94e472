//! Texts to values.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap, Span};
use smol_str::SmolStr;

use crate::expand::{MOST_ERRORS, Setting};
use crate::expression::{Budget, Dialect, Expression, ExpressionError, Scope, Value, evaluate};
use crate::literal::{automatic, typed};
use crate::scopes::{LazyText, ScopeId, Scopes, Symbol};
use crate::text::{Piece, pieces};

/// How far properties may refer to properties, and texts hold texts.
const DEEPEST: usize = 100;

/// Steps that all expressions of a file may take together; the PR2, as large as robots get, takes
/// some ten thousand.
const MOST_STEPS: u64 = 1_000_000;

/// Bytes of values that all expressions of a file may make together.
const MOST_BYTES: u64 = 256 << 20;

/// How long a text may become [bytes].
const LONGEST: usize = 16 << 20;

/// How much text an expansion may put together [bytes].
const MOST_TEXT: usize = 128 << 20;

/// What is shared by all of an expansion.
pub(crate) struct State<'a> {
    pub(crate) setting: Setting<'a>,
    pub(crate) sources: RefCell<&'a mut SourceMap>,
    pub(crate) diagnostics: RefCell<&'a mut Diagnostics>,
    pub(crate) scopes: RefCell<Scopes>,
    pub(crate) arguments: RefCell<BTreeMap<String, String>>,
    /// The files being read, outermost first.
    pub(crate) files: RefCell<Vec<PathBuf>>,
    pub(crate) includes: RefCell<Vec<PathBuf>>,
    /// Lazy properties being evaluated, outermost first.
    resolving: RefCell<Vec<Resolving>>,
    depth: Cell<usize>,
    pub(crate) budget: RefCell<Budget>,
    /// Nodes looked at so far.
    pub(crate) parts: Cell<usize>,
    /// Elements, macros and includes that are open.
    pub(crate) nesting: Cell<usize>,
    /// Bytes of text put together so far.
    written: Cell<usize>,
    /// Bytes of files read so far.
    pub(crate) read: Cell<usize>,
    /// YAML files read so far.
    pub(crate) yaml: RefCell<BTreeMap<PathBuf, Value>>,
    /// Whether going on makes no sense: a limit was reached.
    given_up: Cell<bool>,
    /// The place of the text being evaluated: where warnings from within expressions belong.
    place: Cell<Origin>,
}

/// A lazy property that is being evaluated.
struct Resolving {
    holder: ScopeId,
    name: SmolStr,
    origin: Origin,
}

/// Of the properties that define each other in a circle, so many are shown.
const MOST_SHOWN_IN_CIRCLE: usize = 5;

/// An evaluation failed, and a diagnostic says so.
#[derive(Debug)]
pub(crate) struct Failed;

impl<'a> State<'a> {
    pub(crate) fn new(
        setting: Setting<'a>,
        sources: &'a mut SourceMap,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        let arguments = setting.arguments.iter().cloned().collect();
        let file = setting.path.clone();
        Self {
            setting,
            sources: RefCell::new(sources),
            diagnostics: RefCell::new(diagnostics),
            scopes: RefCell::new(Scopes::new()),
            arguments: RefCell::new(arguments),
            files: RefCell::new(vec![file]),
            includes: RefCell::default(),
            resolving: RefCell::default(),
            depth: Cell::new(0),
            budget: RefCell::new(Budget::new(MOST_STEPS, MOST_BYTES)),
            parts: Cell::new(0),
            nesting: Cell::new(0),
            written: Cell::new(0),
            read: Cell::new(0),
            yaml: RefCell::default(),
            given_up: Cell::new(false),
            place: Cell::new(Origin::default()),
        }
    }

    pub(crate) fn report(&self, diagnostic: Diagnostic) {
        self.diagnostics.borrow_mut().push(diagnostic);
    }

    /// Reports an error and gives the token of failure.
    #[inline(never)]
    pub(crate) fn fail(&self, diagnostic: Diagnostic) -> Failed {
        self.report(diagnostic);
        Failed
    }

    /// Reports an error after which the whole expansion ends: a limit was reached, and what comes
    /// next would reach it again.
    #[inline(never)]
    pub(crate) fn give_up(&self, diagnostic: Diagnostic) -> Failed {
        self.given_up.set(true);
        self.fail(diagnostic)
    }

    /// Whether the expansion shall end here.
    pub(crate) fn has_given_up(&self) -> bool {
        self.given_up.get() || self.diagnostics.borrow().errors() >= MOST_ERRORS
    }

    /// The value of a text: that of its one expression or extension, or else all pieces put
    /// together.
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
        if self.depth.get() >= DEEPEST {
            return Err(self.give_up(
                Diagnostic::error(
                    "too-deep",
                    format!("properties and texts refer to each other more than {DEEPEST} deep"),
                )
                .at(origin)
                .help("does a property lead back to itself?"),
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

    /// The same of a text that stands in the tree, which most often needs no copy.
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
        if so_far + bytes <= LONGEST && self.written.get() <= MOST_TEXT {
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
                    self.expression_value(&text[range], place, scope, Dialect::Xacro)?
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

    /// The value of what stands in `${` and `}`.
    #[inline(never)]
    pub(crate) fn expression_value(
        &self,
        text: &str,
        origin: Origin,
        scope: ScopeId,
        dialect: Dialect,
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
        // A property that failed inside has said so itself.
        if error.message == ALREADY_SAID {
            return Failed;
        }
        // Nothing that costs a step can succeed any more.
        if self.budget.borrow().steps_left() == 0 {
            self.given_up.set(true);
        }
        let mut diagnostic = Diagnostic::error("expression", error.message).at(place);
        if !text.is_empty() {
            diagnostic = diagnostic.note(format!("in the expression `{}`", shorten(text)));
        }
        if let Some(help) = error.help {
            diagnostic = diagnostic.help(help);
        }
        self.fail(diagnostic)
    }

    /// The value of a property, evaluated now if nobody asked before.
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

    fn symbol_value(&self, holder: ScopeId, name: &str, symbol: Symbol) -> Result<Value, Failed> {
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
            for other in resolving[first + 1..].iter().take(MOST_SHOWN_IN_CIRCLE) {
                diagnostic =
                    diagnostic.related(other.origin, format!("by way of `{}`", other.name));
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

    /// Runs something that may evaluate texts, on the budget of the expression that asked for it.
    fn with_budget<T>(&self, budget: &mut Budget, run: impl FnOnce() -> T) -> T {
        self.budget.replace(std::mem::take(budget));
        let result = run();
        *budget = self.budget.take();
        result
    }

    /// The folder that relative names in the file being read start from.
    pub(crate) fn folder(&self) -> PathBuf {
        let files = self.files.borrow();
        files.last().and_then(|file| file.parent()).map(PathBuf::from).unwrap_or_default()
    }
}

/// The message of an error that a diagnostic has told already.
const ALREADY_SAID: &str = "\0";

fn already_said(_: Failed) -> ExpressionError {
    ExpressionError { message: ALREADY_SAID.into(), range: 0..0, help: None }
}

fn shorten(text: &str) -> String {
    match text.char_indices().nth(80) {
        Some((cut, _)) => format!("{}...", &text[..cut]),
        None => text.to_owned(),
    }
}

/// The place of a part of a text, if the text stands in its file as it is.
pub(crate) fn part(origin: Origin, text: &str, range: &Range<usize>) -> Origin {
    let narrowed = |span: Span| {
        let plain = (span.end - span.start) as usize == text.len();
        if plain { span.part(range.start, range.end) } else { span }
    };
    Origin(origin.0.map(narrowed))
}

/// Functions that `$(eval ...)` has besides Python's.
const EVAL_FUNCTIONS: [&str; 5] =
    ["eval.arg", "eval.env", "eval.optenv", "eval.find", "eval.dirname"];

/// The names an expression sees.
struct Names<'s, 'a> {
    state: &'s State<'a>,
    scope: ScopeId,
    dialect: Dialect,
}

impl Scope for Names<'_, '_> {
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        if self.dialect == Dialect::SubstitutionArgs {
            // `$(eval ...)` sees arguments and functions of its own, not properties.
            if let Some(function) = EVAL_FUNCTIONS.iter().find(|full| full[5..] == *name) {
                return Ok(Some(Value::host_function(*function)));
            }
            // In the reference all of its own names win; these would change results silently.
            if matches!(name, "e" | "pi" | "tau" | "inf" | "nan" | "true" | "false") {
                return Ok(None);
            }
            let argument = self.state.arguments.borrow().get(name).cloned();
            return Ok(argument.map(|text| automatic(&text)));
        }
        let find = || self.state.property(self.scope, name);
        self.state.with_budget(budget, find).map_err(already_said)
    }

    fn member(
        &self,
        namespace: &str,
        name: &str,
        budget: &mut Budget,
    ) -> Result<Option<Value>, ExpressionError> {
        let Some(id) = self.namespace(namespace) else { return Ok(None) };
        let symbol = self.state.scopes.borrow().member(id, name).cloned();
        match symbol {
            Some(Symbol::Namespace(_)) => {
                Ok(Some(Value::Namespace(format!("{namespace}.{name}").into())))
            }
            Some(symbol) => {
                let value = || self.state.symbol_value(id, name, symbol);
                self.state.with_budget(budget, value).map(Some).map_err(already_said)
            }
            None => Ok(None),
        }
    }

    fn names(&self) -> Vec<String> {
        if self.dialect == Dialect::SubstitutionArgs {
            return self.state.arguments.borrow().keys().cloned().collect();
        }
        self.state.scopes.borrow().names(self.scope)
    }

    fn member_names(&self, namespace: &str) -> Vec<String> {
        let scopes = self.state.scopes.borrow();
        self.namespace(namespace).map(|id| scopes.member_names(id)).unwrap_or_default()
    }

    fn call_host(
        &self,
        function: &str,
        arguments: &[Value],
        _keywords: &[(Rc<str>, Value)],
        budget: &mut Budget,
    ) -> Option<Result<Value, ExpressionError>> {
        let call = || self.state.host_function(function, arguments);
        self.state.with_budget(budget, call)
    }

    fn dialect(&self) -> Dialect {
        self.dialect
    }

    fn deprecated(&self, name: &str, replacement: &str, _range: Range<usize>) {
        self.state.report(
            Diagnostic::hint("deprecated-name", format!("`{name}` is deprecated"))
                .at(self.state.place.get())
                .help(format!("write `{replacement}`")),
        );
    }
}

impl Names<'_, '_> {
    /// The scope behind `a` or `a.b`.
    fn namespace(&self, path: &str) -> Option<ScopeId> {
        let scopes = self.state.scopes.borrow();
        let mut steps = path.split('.');
        let Symbol::Namespace(mut at) = *scopes.find(self.scope, steps.next()?)?.1 else {
            return None;
        };
        for step in steps {
            let Symbol::Namespace(inner) = *scopes.member(at, step)? else { return None };
            at = inner;
        }
        Some(at)
    }
}

impl State<'_> {
    /// Functions that ask more than their arguments: files, arguments, messages.
    fn host_function(
        &self,
        function: &str,
        arguments: &[Value],
    ) -> Option<Result<Value, ExpressionError>> {
        let name = function.strip_prefix("xacro.").unwrap_or(function);
        let place = self.place.get();
        let plain = |message: String| ExpressionError { message, range: 0..0, help: None };
        let words: Result<Vec<Rc<str>>, Failed> =
            arguments.iter().map(|argument| self.characters(argument, place)).collect();
        let words = match words {
            Ok(words) => words,
            Err(failed) => return Some(Err(already_said(failed))),
        };
        let said = || words.join(" ");
        Some(match (name, words.as_slice()) {
            ("load_yaml", [file]) => self.load_yaml(file, place).map_err(already_said),
            ("abs_filename", [file]) => {
                Ok(Value::text(self.folder().join(&**file).to_string_lossy()))
            }
            ("eval.arg", [name]) => {
                self.argument(name, place).map(|text| automatic(&text)).map_err(already_said)
            }
            ("eval.env" | "eval.optenv" | "eval.find" | "eval.dirname", words) => {
                let command = [&name[5..]].into_iter().chain(words.iter().map(|word| &**word));
                let words = command.collect::<Vec<_>>();
                self.substitution(&words, place).map(Value::text).map_err(already_said)
            }
            ("arg", [name]) => self.argument(name, place).map(Value::text).map_err(already_said),
            ("message" | "print_location", _) => {
                self.report(Diagnostic::hint("message", said()).at(place));
                Ok(Value::text(""))
            }
            ("warning", _) => {
                self.report(Diagnostic::warning("message", said()).at(place));
                Ok(Value::text(""))
            }
            ("error", _) => {
                self.report(Diagnostic::error("message", said()).at(place));
                Ok(Value::text(""))
            }
            ("fatal", _) => {
                Err(already_said(self.fail(Diagnostic::error("fatal", said()).at(place))))
            }
            ("load_yaml" | "abs_filename" | "arg" | "eval.arg", _) => {
                Err(plain(format!("`{function}` takes one argument, not {}", arguments.len())))
            }
            _ => return None,
        })
    }
}
