//! A safe evaluator of Python expressions: the part of the language that robot descriptions, launch files
//! and filters of messages use, with Python 3's results.
//!
//! What differs from Python on purpose:
//! - Integers have 128 bits; larger ones are an error.
//! - Values never change: `list.append` and the like are refused.
//! - Work, memory and nesting are bounded by a [`Budget`].
//! - Only listed attributes exist, none with a double underscore.
//! - A lambda keeps the values of comprehension variables from when it was made, Python the last ones.
//! - No complex numbers, bytes, `:=`, `await` and `yield`.
//!
//! The names that exist without the caller's doing follow xacro 2.1.1 (`create_global_symbols` in its
//! `__init__.py`) and, for `$(eval ...)`, its `substitution_args.py`.

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
pub use error::ExpressionError;
pub use globals::{Dialect, Module};
pub use iterator::IteratorHandle;
pub use value::{Dict, DictHandle, List, Range as RangeValue, Sequence, Value, View};

/// A parsed expression.
#[derive(Debug, Clone)]
pub struct Expression {
    node: Rc<ast::Node>,
    text: Rc<str>,
}

impl Expression {
    /// Parses the text between `${` and `}`, or behind `$(eval`. Blanks around it do not matter.
    ///
    /// # Errors
    /// Where the text is no Python expression, or one that is not supported; with the place in `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        let whole = 0..text.len();
        let node = parser::parse(text).map_err(|error| error.at(&whole))?;
        Ok(Self { node: Rc::new(node), text: text.into() })
    }

    /// The text it was parsed from.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// What the names in an expression mean: the caller's properties and functions.
pub trait Scope {
    /// The value of a name, before the built-in names are asked; `None` if it is none of the caller's. May
    /// evaluate other expressions with the same budget. The place in an error is replaced by the name's.
    ///
    /// # Errors
    /// Whatever prevents the value from being known.
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError>;

    /// All names `lookup` knows, for "did you mean".
    fn names(&self) -> Vec<String>;

    /// A member of a namespace that `lookup` gave as [`Value::Namespace`].
    ///
    /// # Errors
    /// Whatever prevents the value from being known.
    fn member(
        &self,
        _namespace: &str,
        _name: &str,
        _budget: &mut Budget,
    ) -> Result<Option<Value>, ExpressionError> {
        Ok(None)
    }

    /// All names `member` knows in the namespace, for "did you mean".
    fn member_names(&self, _namespace: &str) -> Vec<String> {
        Vec::new()
    }

    /// Calls a function of the caller's: one that `lookup` gave as [`Value::host_function`], or one of
    /// `xacro.load_yaml`, `xacro.abs_filename`, `xacro.arg`, `xacro.message`, `xacro.warning`, `xacro.error` and
    /// `xacro.print_location` by that full name. `None` if there is no such function.
    fn call_host(
        &self,
        _function: &str,
        _arguments: &[Value],
        _keywords: &[(Rc<str>, Value)],
        _budget: &mut Budget,
    ) -> Option<Result<Value, ExpressionError>> {
        None
    }

    /// Which built-in names there are.
    fn dialect(&self) -> Dialect {
        Dialect::Xacro
    }

    /// Is told that an expression uses a built-in name xacro deprecates, with the name to use instead.
    fn deprecated(&self, _name: &str, _replacement: &str, _range: Range<usize>) {}
}

/// Whether a name has a meaning in `${...}` that nobody gave it: `pi`, `sin`, `len`.
pub fn is_built_in(name: &str) -> bool {
    matches!(name, "True" | "False" | "None") || globals::lookup(Dialect::Xacro, name).is_some()
}

/// A scope without names.
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

/// The value of an expression.
///
/// # Errors
/// As Python would raise an exception, or where the budget does not last; with the place in the expression.
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
