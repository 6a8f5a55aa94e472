//! Callable values, and the arguments of calls.

use std::fmt;
use std::rc::Rc;

use super::ast::Lambda;
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::{Frame, Interpreter};
use super::value::Value;

/// Callable value.
#[derive(Clone)]
pub enum Callable {
    #[doc(hidden)]
    Builtin(&'static Builtin),
    #[doc(hidden)]
    Method(Rc<Bound>),
    #[doc(hidden)]
    Lambda(Rc<LambdaFunction>),
    /// Function of the caller, by its name.
    Host(Rc<str>),
}

/// Function implemented in Rust.
pub struct Builtin {
    pub(super) name: &'static str,
    /// True for a type, such as `int`.
    pub(super) is_type: bool,
    pub(super) call: fn(&mut Interpreter<'_>, Arguments) -> Outcome<Value>,
}

/// Method with its object.
pub struct Bound {
    pub(super) object: Value,
    pub(super) name: Rc<str>,
}

/// Lambda with the values that it captured.
pub struct LambdaFunction {
    pub(super) lambda: Rc<Lambda>,
    pub(super) defaults: Vec<Option<Value>>,
    pub(super) frame: Option<Rc<Frame>>,
    /// Text that contains it: errors inside a lambda of another expression are located at the call.
    pub(super) source: Rc<str>,
    pub(super) depth: u32,
}

impl Callable {
    /// Name, if it has one.
    pub(super) fn name(&self) -> Option<Rc<str>> {
        match self {
            Self::Builtin(builtin) => Some(builtin.name.into()),
            Self::Method(method) => Some(method.name.clone()),
            Self::Lambda(_) => None,
            Self::Host(name) => Some(name.clone()),
        }
    }

    pub(super) fn describe(&self) -> String {
        match self {
            Self::Builtin(builtin) if builtin.is_type => format!("<class '{}'>", builtin.name),
            Self::Builtin(builtin) => format!("<built-in function {}>", builtin.name),
            Self::Method(method) => {
                format!("<built-in method {} of {} object>", method.name, method.object.type_name())
            }
            Self::Lambda(_) => "<function <lambda>>".to_owned(),
            Self::Host(name) => format!("<function {name}>"),
        }
    }

    pub(super) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Builtin(a), Self::Builtin(b)) => std::ptr::eq(*a, *b),
            (Self::Method(a), Self::Method(b)) => Rc::ptr_eq(a, b),
            (Self::Lambda(a), Self::Lambda(b)) => Rc::ptr_eq(a, b),
            (Self::Host(a), Self::Host(b)) => a == b,
            _ => false,
        }
    }

    pub(super) fn depth(&self) -> u32 {
        match self {
            Self::Builtin(_) | Self::Host(_) => 0,
            Self::Method(method) => method.object.depth() + 1,
            Self::Lambda(closure) => closure.depth,
        }
    }
}

impl fmt::Debug for Callable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.describe())
    }
}

/// Evaluated arguments of a call.
#[derive(Debug, Default)]
pub(super) struct Arguments {
    pub(super) positional: Vec<Value>,
    pub(super) keywords: Vec<(Rc<str>, Value)>,
}

impl Arguments {
    pub(super) fn positional(positional: Vec<Value>) -> Self {
        Self { positional, keywords: Vec::new() }
    }

    /// Removes and returns a keyword-only argument.
    pub(super) fn keyword(&mut self, name: &str) -> Option<Value> {
        let index = self.keywords.iter().position(|(keyword, _)| &**keyword == name)?;
        Some(self.keywords.remove(index).1)
    }

    /// Arguments in the order of these parameters, of which the first `required` are required.
    pub(super) fn bind<const N: usize>(
        self,
        function: &str,
        parameters: [&str; N],
        required: usize,
    ) -> Outcome<[Option<Value>; N]> {
        let given = self.positional.len();
        if given > N {
            return Err(arity(function, required, N, given));
        }
        let mut bound = [const { None }; N];
        for (slot, value) in bound.iter_mut().zip(self.positional) {
            *slot = Some(value);
        }
        for (name, value) in self.keywords {
            match parameters.iter().position(|parameter| *parameter == &*name) {
                Some(index) if bound[index].is_none() => bound[index] = Some(value),
                Some(_) => return fail(format!("`{function}` gets the argument `{name}` twice")),
                None => return fail(format!("`{function}` has no argument `{name}`")),
            }
        }
        if bound.iter().take(required).any(Option::is_none) {
            return Err(arity(function, required, N, bound.iter().flatten().count()));
        }
        Ok(bound)
    }

    /// As [`Arguments::bind`], with required positional-only parameters.
    pub(super) fn exactly<const N: usize>(self, function: &str) -> Outcome<[Value; N]> {
        if let Some((name, _)) = self.keywords.first() {
            return fail(format!("`{function}` has no argument `{name}`"));
        }
        let given = self.positional.len();
        self.positional.try_into().map_err(|_| arity(function, N, N, given))
    }

    /// Any number of positional arguments.
    pub(super) fn all(self, function: &str) -> Outcome<Vec<Value>> {
        match self.keywords.first() {
            Some((name, _)) => fail(format!("`{function}` has no argument `{name}`")),
            None => Ok(self.positional),
        }
    }
}

fn arity(function: &str, required: usize, most: usize, given: usize) -> ExpressionError {
    let wanted =
        if required == most { required.to_string() } else { format!("{required} to {most}") };
    ExpressionError::new(format!(
        "`{function}` takes {wanted} argument{}, not {given}",
        if most == 1 { "" } else { "s" }
    ))
}
