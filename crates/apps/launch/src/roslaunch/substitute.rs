//! `$(...)` of ROS 1.

use std::rc::Rc;

use periplus_diagnostics::{Diagnostic, Origin};
use periplus_python_expr::{
    Budget, Expression, ExpressionDialect, ExpressionError, Scope as Names, Value, evaluate,
};
use periplus_xml::Attribute;

use super::{Loader, Scope, wrong_at};
use crate::evaluate::Outcome;
use crate::perform::MAX_TEXT_BYTES;
use crate::suggest::Suggest as _;

/// Limits of work and memory for one expression.
const MAX_STEPS: u64 = 100_000;
const MAX_BYTES: u64 = 1 << 20;

impl Loader<'_, '_> {
    /// Resolves an attribute.
    pub(super) fn resolved(&mut self, attribute: &Attribute, scope: &Scope) -> Outcome<String> {
        self.resolved_text(&attribute.value, &attribute.value_origin, scope)
    }

    /// Resolves a text.
    pub(super) fn resolved_text(
        &mut self,
        text: &str,
        origin: &Origin,
        scope: &Scope,
    ) -> Outcome<String> {
        // An expression is the whole value, and may contain brackets.
        if let Some(expression) =
            text.trim().strip_prefix("$(eval ").and_then(|rest| rest.strip_suffix(')'))
        {
            return self.evaluated(expression, origin, scope);
        }
        let mut whole = String::new();
        let mut rest = text;
        while let Some(from) = rest.find("$(") {
            whole.push_str(&rest[..from]);
            let Some(to) = rest[from..].find(')') else {
                return Err(wrong_at("launch-substitution", "unclosed `$(`".into(), origin));
            };
            let words: Vec<&str> = rest[from + 2..from + to].split_whitespace().collect();
            whole.push_str(&self.substitution(&words, origin, scope)?);
            rest = &rest[from + to + 1..];
            if whole.len() > MAX_TEXT_BYTES {
                let message = format!("a text has more than {MAX_TEXT_BYTES} bytes");
                return Err(wrong_at("launch-size", message, origin));
            }
        }
        whole.push_str(rest);
        Ok(whole)
    }

    fn substitution(&mut self, words: &[&str], origin: &Origin, scope: &Scope) -> Outcome<String> {
        match words {
            ["arg", name] => self.argument_value(name, scope).ok_or_else(|| {
                let known = scope.arguments.keys().map(String::as_str);
                Diagnostic::error(
                    "launch-argument",
                    format!("the argument `{name}` is not declared before this line"),
                )
                .at(*origin)
                .suggest(name, known)
                .help(format!(
                    "pass `{name}:=VALUE`, or declare it before: \
                     `<arg name=\"{name}\" default=\"...\"/>`"
                ))
                .into()
            }),
            ["find", package] => Ok(self.evaluation.package(package, false)),
            ["env", name] => self.variable(name, scope).ok_or_else(|| {
                Diagnostic::error(
                    "launch-environment",
                    format!("the environment variable `{name}` is not set"),
                )
                .at(*origin)
                .help(format!(
                    "set it for the launch, `{name}=VALUE periplus launch ...`, or write \
                     `$(optenv {name} VALUE)`"
                ))
                .into()
            }),
            ["optenv", name, default @ ..] => {
                Ok(self.variable(name, scope).unwrap_or_else(|| default.join(" ")))
            }
            ["anon", name] => Ok(self.anonymous(name)),
            ["dirname"] => Ok(folder(scope)),
            ["eval", ..] => Err(wrong_at(
                "launch-substitution",
                "`$(eval ...)` must be the whole value".into(),
                origin,
            )),
            [name @ ("var" | "find-pkg-share" | "find-pkg-prefix"), ..] => {
                let instead = if *name == "var" { "arg" } else { "find" };
                Err(Diagnostic::error(
                    "launch-substitution",
                    format!("`$({name} ...)` is ROS 2, and this is a ROS 1 launch file"),
                )
                .at(*origin)
                .help(format!("write `$({instead} ...)`"))
                .into())
            }
            _ => {
                let name = words.first().copied().unwrap_or_default();
                Err(Diagnostic::error(
                    "launch-substitution",
                    format!("unknown substitution `$({})`", words.join(" ")),
                )
                .at(*origin)
                .suggest(name, ["anon", "arg", "dirname", "env", "eval", "find", "optenv"])
                .into())
            }
        }
    }

    fn evaluated(&mut self, expression: &str, origin: &Origin, scope: &Scope) -> Outcome<String> {
        let mut budget = Budget::new(MAX_STEPS, MAX_BYTES);
        let names = Arguments { loader: std::cell::RefCell::new(self), scope };
        Expression::parse(expression)
            .and_then(|parsed| evaluate(&parsed, &names, &mut budget))
            .and_then(|value| value.to_text(&mut budget))
            .map_err(|error| {
                let mut wrong = Diagnostic::error(
                    "launch-expression",
                    format!("cannot evaluate `{expression}`: {}", error.message),
                )
                .at(*origin);
                if let Some(help) = error.help {
                    wrong = wrong.help(help);
                }
                wrong.into()
            })
    }

    fn argument_value(&self, name: &str, scope: &Scope) -> Option<String> {
        // Values of the command line or the including file are available even without a
        // declaration.
        scope.arguments.get(name).or_else(|| scope.given.get(name)).cloned()
    }

    fn variable(&self, name: &str, scope: &Scope) -> Option<String> {
        match scope.environment.get(name) {
            Some(value) => value.clone(),
            None => self.evaluation.context.variable(name, self.evaluation.host),
        }
    }

    fn anonymous(&mut self, name: &str) -> String {
        if let Some(known) = self.anonymous.get(name) {
            return known.clone();
        }
        let made = self.evaluation.anonymous(name);
        self.anonymous.insert(name.to_owned(), made.clone());
        made
    }
}

fn folder(scope: &Scope) -> String {
    scope.file.parent().map(|folder| folder.display().to_string()).unwrap_or_default()
}

/// Names in `$(eval ...)`: arguments, and functions for the other substitutions.
struct Arguments<'s, 'l, 'o, 'e> {
    loader: std::cell::RefCell<&'s mut Loader<'o, 'e>>,
    scope: &'l Scope,
}

const FUNCTIONS: [&str; 6] = ["arg", "env", "optenv", "find", "anon", "dirname"];

impl Names for Arguments<'_, '_, '_, '_> {
    fn lookup(&self, name: &str, _budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        if FUNCTIONS.contains(&name) {
            return Ok(Some(Value::host_function(name)));
        }
        Ok(self.scope.arguments.get(name).map(|text| converted(text)))
    }

    fn names(&self) -> Vec<String> {
        self.scope.arguments.keys().cloned().collect()
    }

    fn dialect(&self) -> ExpressionDialect {
        ExpressionDialect::SubstitutionArgs
    }

    fn call_host(
        &self,
        function: &str,
        arguments: &[Value],
        _keywords: &[(Rc<str>, Value)],
        budget: &mut Budget,
    ) -> Option<Result<Value, ExpressionError>> {
        if !FUNCTIONS.contains(&function) {
            return None;
        }
        let texts: Vec<String> = arguments
            .iter()
            .filter_map(|argument| match argument {
                Value::Str(text) => Some(text.to_string()),
                other => other.to_text(budget).ok(),
            })
            .collect();
        let mut words = vec![function];
        words.extend(texts.iter().map(String::as_str));
        let mut loader = self.loader.borrow_mut();
        Some(match loader.substitution(&words, &Origin::default(), self.scope) {
            Ok(text) => Ok(converted(&text)),
            Err(wrong) => Err(ExpressionError::new(wrong.message.clone())),
        })
    }
}

/// Argument in an expression: converted to a number or Boolean if it looks like one, as in
/// roslaunch.
fn converted(text: &str) -> Value {
    if let Ok(integer) = text.parse::<i128>() {
        return Value::Int(integer);
    }
    if let Ok(number) = text.parse::<f64>() {
        return Value::Float(number);
    }
    match text.to_lowercase().as_str() {
        "true" => Value::Bool(true),
        "false" => Value::Bool(false),
        _ => Value::Str(text.into()),
    }
}
