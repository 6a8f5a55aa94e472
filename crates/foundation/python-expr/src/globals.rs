//! Built-in names.

use super::arithmetic_functions::ARITHMETIC;
use super::builtins::{COLLECTIONS, XACRO};
use super::callable::{Builtin, Callable};
use super::conversion::CONVERSIONS;
use super::error::{ExpressionError, Outcome, fail};
use super::maths;
use super::suggest::closest;
use super::value::Value;

/// Set of built-in names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExpressionDialect {
    /// Names of `${...}`.
    Xacro,
    /// Names of `$(eval ...)`: Python's own built-in functions, `true` and `false`, and the members of
    /// `math` without prefix.
    SubstitutionArgs,
}

/// Namespace of built-in functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Module {
    /// `math`.
    Math,
    /// `python`.
    Python,
    /// `xacro`.
    Xacro,
}

impl Module {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Math => "math",
            Self::Python => "python",
            Self::Xacro => "xacro",
        }
    }
}

/// Built-in names of `${...}` without a namespace, except those of `math`.
const BARE: &[&str] =
    &["list", "dict", "map", "len", "str", "float", "int", "bool", "min", "max", "round"];
/// Deprecated names with their replacements.
const DEPRECATED: &[(&str, &str)] = &[
    ("sorted", "python.sorted"),
    ("range", "python.range"),
    ("load_yaml", "xacro.load_yaml"),
    ("abs_filename", "xacro.abs_filename"),
    ("dotify", "xacro.dotify"),
];
/// Members of `python`; the other functions are for `$(eval ...)` only.
const PYTHON: &[&str] = &[
    "list",
    "dict",
    "map",
    "len",
    "str",
    "float",
    "int",
    "bool",
    "min",
    "max",
    "round",
    "sorted",
    "range",
    "abs",
    "all",
    "any",
    "divmod",
    "enumerate",
    "filter",
    "frozenset",
    "isinstance",
    "ord",
    "repr",
    "reversed",
    "set",
    "sum",
    "tuple",
    "type",
    "zip",
];
/// Members of `python` in xacro that are not supported here.
const UNSUPPORTED: &[&str] = &["complex", "hash", "issubclass", "slice", "vars"];
/// Functions of `xacro` that the caller provides.
const HOST: &[(&str, &str)] = &[
    ("load_yaml", "xacro.load_yaml"),
    ("abs_filename", "xacro.abs_filename"),
    ("arg", "xacro.arg"),
    ("message", "xacro.message"),
    ("warning", "xacro.warning"),
    ("error", "xacro.error"),
    ("print_location", "xacro.print_location"),
];

pub(super) struct Global {
    pub(super) value: Outcome<Value>,
    /// Replacement, for names that xacro deprecates.
    pub(super) deprecated_for: Option<&'static str>,
}

/// Python function or type with this name.
pub(super) fn python_builtin(name: &str) -> Option<&'static Builtin> {
    [COLLECTIONS, CONVERSIONS, ARITHMETIC]
        .into_iter()
        .flatten()
        .find(|builtin| builtin.name == name)
}

fn python_value(name: &str) -> Option<Value> {
    python_builtin(name).map(|builtin| Value::Function(Callable::Builtin(builtin)))
}

fn xacro_value(name: &str) -> Option<Value> {
    let host =
        HOST.iter().find(|(short, _)| *short == name).map(|(_, full)| Value::host_function(*full));
    host.or_else(|| {
        XACRO
            .iter()
            .find(|builtin| builtin.name == name)
            .map(|builtin| Value::Function(Callable::Builtin(builtin)))
    })
}

/// Value of a bare name.
pub(super) fn lookup(dialect: ExpressionDialect, name: &str) -> Option<Global> {
    let plain = |value| Global { value: Ok(value), deprecated_for: None };
    match dialect {
        ExpressionDialect::Xacro => {
            if let Some((_, replacement)) = DEPRECATED.iter().find(|(short, _)| *short == name) {
                let value = if replacement.starts_with("python") {
                    python_value(name)
                } else {
                    xacro_value(name)
                };
                return value
                    .map(|value| Global { value: Ok(value), deprecated_for: Some(replacement) });
            }
            let module = [Module::Math, Module::Python, Module::Xacro]
                .into_iter()
                .find(|module| module.name() == name)
                .map(Value::Module);
            let bare = || if BARE.contains(&name) { python_value(name) } else { None };
            module.or_else(bare).or_else(|| maths::member(name)).map(plain)
        }
        ExpressionDialect::SubstitutionArgs => match name {
            "true" => Some(plain(Value::Bool(true))),
            "false" => Some(plain(Value::Bool(false))),
            _ => maths::member(name).or_else(|| python_value(name)).map(plain),
        },
    }
}

/// `module.name`.
pub(super) fn member(module: Module, name: &str) -> Outcome<Value> {
    let found = match module {
        Module::Math => maths::member(name),
        Module::Python if UNSUPPORTED.contains(&name) => {
            return fail(format!("`python.{name}` is not supported"));
        }
        Module::Python if PYTHON.contains(&name) => python_value(name),
        Module::Python => None,
        Module::Xacro => xacro_value(name),
    };
    found.ok_or_else(|| {
        let known = member_names(module);
        let guess = closest(name, known.into_iter())
            .map(|found| format!("; did you mean `{}.{found}`?", module.name()))
            .unwrap_or_default();
        ExpressionError::new(format!("`{}` has no `{name}`{guess}", module.name()))
    })
}

fn member_names(module: Module) -> Vec<&'static str> {
    match module {
        Module::Math => maths::names(),
        Module::Python => PYTHON.to_vec(),
        Module::Xacro => HOST
            .iter()
            .map(|(short, _)| *short)
            .chain(XACRO.iter().map(|builtin| builtin.name))
            .collect(),
    }
}

/// All bare names, for suggestions.
pub(super) fn names(dialect: ExpressionDialect) -> Vec<&'static str> {
    let mut names = maths::names();
    match dialect {
        ExpressionDialect::Xacro => {
            names.extend(BARE.iter().chain(&["math", "python", "xacro", "True", "False", "None"]));
        }
        ExpressionDialect::SubstitutionArgs => {
            names.extend(
                [COLLECTIONS, CONVERSIONS, ARITHMETIC]
                    .into_iter()
                    .flatten()
                    .map(|builtin| builtin.name),
            );
            names.extend(["true", "false", "None"]);
        }
    }
    names
}

/// Replacement for a bare name of other languages or of Python itself.
pub(super) fn hint(dialect: ExpressionDialect, name: &str) -> Option<String> {
    match (dialect, name) {
        (ExpressionDialect::Xacro, "true") => Some("write `True`".to_owned()),
        (ExpressionDialect::Xacro, "false") => Some("write `False`".to_owned()),
        (_, "none" | "null") => Some("write `None`".to_owned()),
        (ExpressionDialect::Xacro, _) if PYTHON.contains(&name) => {
            Some(format!("xacro has it as `python.{name}`"))
        }
        (ExpressionDialect::Xacro, _)
            if XACRO.iter().any(|builtin| builtin.name == name)
                || HOST.iter().any(|(short, _)| *short == name) =>
        {
            Some(format!("xacro has it as `xacro.{name}`"))
        }
        (ExpressionDialect::SubstitutionArgs, "math") => {
            Some("here the functions of `math` are used without it: `sin(...)`".to_owned())
        }
        _ => None,
    }
}
