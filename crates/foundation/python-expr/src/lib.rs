//! A safe evaluator of Python expressions: the part of the language that robot descriptions, launch files
//! and filters of messages use, with Python 3's results.
//!
//! Deliberate differences from Python:
//! - Integers have 128 bits; larger ones are an error.
//! - Values are immutable: `list.append` and similar methods are refused.
//! - Work, memory and nesting are bounded by a [`Budget`].
//! - Only listed attributes exist, none with a double underscore.
//! - A lambda captures the values of comprehension variables at its creation; Python uses the last ones.
//! - No complex numbers, bytes, `:=`, `await` and `yield`.
//!
//! Built-in names follow xacro 2.1.1 (`create_global_symbols` in its `__init__.py`) and, for `$(eval ...)`,
//! its `substitution_args.py`.
//!
//! ```
//! use periplus_python_expr::{Budget, EmptyScope, Expression, Value, evaluate};
//!
//! let expression = Expression::parse("max([2 * x for x in range(4)]) + int('1')")?;
//! let value = evaluate(&expression, &EmptyScope, &mut Budget::default())?;
//! assert!(matches!(value, Value::Int(7)));
//!
//! let endless = Expression::parse("sum(x for x in range(10 ** 12))")?;
//! assert!(evaluate(&endless, &EmptyScope, &mut Budget::default()).is_err());
//! # Ok::<(), periplus_python_expr::ExpressionError>(())
//! ```

mod arithmetic_functions;
mod ast;
mod budget;
mod builtins;
mod callable;
mod compare;
mod conversion;
mod error;
mod format_float;
mod format_spec;
mod globals;
mod interpreter;
mod iterator;
mod literal;
mod maths;
mod methods;
mod number;
mod operators;
mod parser;
mod percent;
mod subscript;
mod suggest;
mod text;
mod text_methods;
mod token;
mod value;

use std::ops::Range;
use std::rc::Rc;

pub use budget::Budget;
pub use callable::Callable;
pub use error::{ExpressionError, ExpressionErrorKind};
pub use globals::{ExpressionDialect, Module};
pub use iterator::IteratorHandle;
pub use value::{
    Dict, DictHandle, DictView, PythonList, PythonRange as RangeValue, Sequence, Value,
};

/// Parsed expression.
#[derive(Debug, Clone)]
pub struct Expression {
    node: Rc<ast::Node>,
    text: Rc<str>,
}

impl Expression {
    /// Parses the text inside `${...}`, or after `$(eval`. Surrounding blanks are ignored.
    ///
    /// # Errors
    /// If the text is not a Python expression or not a supported one; with the range in `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        let whole = 0..text.len();
        let node = parser::parse(text).map_err(|error| error.at(&whole))?;
        Ok(Self { node: Rc::new(node), text: text.into() })
    }

    /// Source text.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Names visible to an expression: the caller's properties and functions.
pub trait Scope {
    /// Returns the value of a name, before the built-in names are searched; `None` if the caller does not
    /// define it. May evaluate other expressions with the same budget. The range of an error is replaced by
    /// that of the name.
    ///
    /// # Errors
    /// If the value cannot be computed.
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError>;

    /// All names that `lookup` resolves, for suggestions.
    fn names(&self) -> Vec<String>;

    /// Returns a member of a namespace that `lookup` returned as [`Value::Namespace`].
    ///
    /// # Errors
    /// If the value cannot be computed.
    fn member(
        &self,
        _namespace: &str,
        _name: &str,
        _budget: &mut Budget,
    ) -> Result<Option<Value>, ExpressionError> {
        Ok(None)
    }

    /// All names that `member` resolves in the namespace, for suggestions.
    fn member_names(&self, _namespace: &str) -> Vec<String> {
        Vec::new()
    }

    /// Calls a function of the caller: one that `lookup` returned as [`Value::host_function`], or one of
    /// `xacro.load_yaml`, `xacro.abs_filename`, `xacro.arg`, `xacro.message`, `xacro.warning`,
    /// `xacro.error` and `xacro.print_location` by that full name. `None` if there is no such function.
    fn call_host(
        &self,
        _function: &str,
        _arguments: &[Value],
        _keywords: &[(Rc<str>, Value)],
        _budget: &mut Budget,
    ) -> Option<Result<Value, ExpressionError>> {
        None
    }

    /// Set of built-in names.
    fn dialect(&self) -> ExpressionDialect {
        ExpressionDialect::Xacro
    }

    /// Called for each built-in name that xacro deprecates, with its replacement.
    fn deprecated(&self, _name: &str, _replacement: &str, _range: Range<usize>) {}
}

/// Returns true if a name is built into `${...}`: `pi`, `sin`, `len`.
pub fn is_built_in(name: &str) -> bool {
    matches!(name, "True" | "False" | "None")
        || globals::lookup(ExpressionDialect::Xacro, name).is_some()
}

/// Scope without names.
#[derive(Debug, Clone, Copy, Default)]
pub struct EmptyScope;

impl Scope for EmptyScope {
    fn lookup(&self, _name: &str, _budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        Ok(None)
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Evaluates an expression.
///
/// # Errors
/// If Python would raise an exception, or the budget is exceeded; with the range in the expression.
pub fn evaluate(
    expression: &Expression,
    scope: &dyn Scope,
    budget: &mut Budget,
) -> Result<Value, ExpressionError> {
    let mut interpreter = interpreter::Interpreter::new(scope, budget, expression.text.clone());
    interpreter
        .evaluate(&expression.node, &None)
        .map_err(|error| error.at(&(0..expression.text.len())))
}
