//! Names visible to expressions: properties, namespaces, and functions that need more than their arguments.

use std::ops::Range;
use std::rc::Rc;

use periplus_diagnostics::Diagnostic;

use crate::literal::automatic;
use crate::scopes::{ScopeId, Symbol};
use crate::state::{Failed, State};
use periplus_python_expr::{
    Budget, ExpressionDialect, ExpressionError, ExpressionErrorKind, Scope, Value,
};

/// Error that has been reported as a diagnostic.
fn reported(_: Failed) -> ExpressionError {
    ExpressionError::new(String::new()).with_kind(ExpressionErrorKind::Reported)
}

/// Functions that `$(eval ...)` has in addition to Python's.
const EVAL_FUNCTIONS: [&str; 5] =
    ["eval.arg", "eval.env", "eval.optenv", "eval.find", "eval.dirname"];

/// Names visible to an expression.
pub(crate) struct Names<'s, 'a> {
    pub(crate) state: &'s State<'a>,
    pub(crate) scope: ScopeId,
    pub(crate) dialect: ExpressionDialect,
}

impl Scope for Names<'_, '_> {
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        if self.dialect == ExpressionDialect::SubstitutionArgs {
            // `$(eval ...)` sees arguments and its own functions, no properties.
            if let Some(function) = EVAL_FUNCTIONS.iter().find(|full| full[5..] == *name) {
                return Ok(Some(Value::host_function(*function)));
            }
            // In the reference all of its built-in names win over properties. For these names that would
            // change results silently.
            if matches!(name, "e" | "pi" | "tau" | "inf" | "nan" | "true" | "false") {
                return Ok(None);
            }
            self.state.known_arguments.borrow_mut().insert(name.to_owned());
            let argument = self.state.arguments.borrow().get(name).cloned();
            return Ok(argument.map(|text| automatic(&text)));
        }
        let find = || self.state.property(self.scope, name);
        self.state.with_budget(budget, find).map_err(reported)
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
                self.state.with_budget(budget, value).map(Some).map_err(reported)
            }
            None => Ok(None),
        }
    }

    fn names(&self) -> Vec<String> {
        if self.dialect == ExpressionDialect::SubstitutionArgs {
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

    fn dialect(&self) -> ExpressionDialect {
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
    /// Scope named by `a` or `a.b`.
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
    /// Calls a function that needs more than its arguments: files, arguments of the file, messages.
    fn host_function(
        &self,
        function: &str,
        arguments: &[Value],
    ) -> Option<Result<Value, ExpressionError>> {
        let name = function.strip_prefix("xacro.").unwrap_or(function);
        let place = self.place.get();
        let plain =
            |message: String| ExpressionError { range: 0..0, ..ExpressionError::new(message) };
        let words: Result<Vec<Rc<str>>, Failed> =
            arguments.iter().map(|argument| self.characters(argument, place)).collect();
        let words = match words {
            Ok(words) => words,
            Err(failed) => return Some(Err(reported(failed))),
        };
        let said = || words.join(" ");
        Some(match (name, words.as_slice()) {
            ("load_yaml", [file]) => self.load_yaml(file, place).map_err(reported),
            ("abs_filename", [file]) => {
                Ok(Value::text(self.folder().join(&**file).to_string_lossy()))
            }
            ("eval.arg", [name]) => {
                self.argument(name, place).map(|text| automatic(&text)).map_err(reported)
            }
            ("eval.env" | "eval.optenv" | "eval.find" | "eval.dirname", words) => {
                let command = [&name[5..]].into_iter().chain(words.iter().map(|word| &**word));
                let words = command.collect::<Vec<_>>();
                self.substitution(&words, place).map(Value::text).map_err(reported)
            }
            ("arg", [name]) => self.argument(name, place).map(Value::text).map_err(reported),
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
            ("fatal", _) => Err(reported(self.fail(Diagnostic::error("fatal", said()).at(place)))),
            ("load_yaml" | "abs_filename" | "arg" | "eval.arg", _) => {
                Err(plain(format!("`{function}` takes one argument, not {}", arguments.len())))
            }
            _ => return None,
        })
    }
}
