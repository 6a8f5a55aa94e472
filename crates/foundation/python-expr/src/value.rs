//! Values of expressions. They are immutable: operations that change a value in Python are refused.

mod dict;

pub use dict::Dict;

use std::rc::Rc;

use super::callable::Callable;
use super::error::{Outcome, fail};
use super::globals::Module;
use super::iterator::IteratorHandle;
use super::number::Number;

/// Maximum nesting depth of lists. Comparison, printing and drop are recursive.
const MAX_DEPTH: u32 = 100;

/// Python value.
#[derive(Debug, Clone)]
pub enum Value {
    /// `None`.
    None,
    /// `bool`.
    Bool(bool),
    /// `int`, bounded to 128 bits.
    Int(i128),
    /// `float`.
    Float(f64),
    /// `str`.
    Str(Rc<str>),
    /// `list`.
    List(PythonList),
    /// `tuple`.
    Tuple(Rc<Sequence>),
    /// `dict`, also the result of `load_yaml` and `dotify`.
    Dict(DictHandle),
    /// `set` and `frozenset`; iterates in insertion order, while Python's order is arbitrary.
    Set(Rc<Dict>),
    /// `range`.
    Range(PythonRange),
    /// Result of `dict.keys()`, `.values()` and `.items()`.
    View(DictView),
    /// Generator, or the result of `map`, `zip` and similar functions: can be iterated once.
    Iterator(IteratorHandle),
    /// Lambda, built-in or host function, or type.
    Function(Callable),
    /// `math`, `python` or `xacro`.
    Module(Module),
    /// Namespace of the caller, whose members are resolved by [`Scope::member`](super::Scope::member).
    Namespace(Rc<str>),
}

/// Elements of a list or tuple.
#[derive(Debug)]
pub struct Sequence {
    items: Vec<Value>,
    depth: u32,
}

/// A list.
#[derive(Debug, Clone)]
pub struct PythonList {
    pub(super) items: Rc<Sequence>,
    /// True if the list is from a dotted dict, so that its elements are dotted too.
    pub(super) is_dotted: bool,
}

/// A dict.
#[derive(Debug, Clone)]
pub struct DictHandle {
    pub(super) dict: Rc<Dict>,
    /// True if `d.key` is equivalent to `d['key']`.
    pub(super) is_dotted: bool,
}

/// Integers `start`, `start + step`, ... before `stop`.
#[derive(Debug, Clone, Copy)]
pub struct PythonRange {
    pub(super) start: i128,
    pub(super) stop: i128,
    pub(super) step: i128,
    pub(super) length: i128,
}

/// View of a dict.
#[derive(Debug, Clone)]
pub struct DictView {
    pub(super) kind: ViewKind,
    pub(super) dict: Rc<Dict>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ViewKind {
    Keys,
    Values,
    Items,
}

impl Sequence {
    pub(super) fn new(items: Vec<Value>) -> Outcome<Rc<Self>> {
        let depth = depth_around(items.iter())?;
        Ok(Rc::new(Self { items, depth }))
    }

    /// Elements.
    pub fn items(&self) -> &[Value] {
        &self.items
    }
}

impl std::ops::Deref for PythonList {
    type Target = [Value];

    fn deref(&self) -> &[Value] {
        &self.items.items
    }
}

impl std::ops::Deref for DictHandle {
    type Target = Dict;

    fn deref(&self) -> &Dict {
        &self.dict
    }
}

/// Depth of a value with these elements; an error if it is too deep.
pub(super) fn depth_around<'a>(items: impl Iterator<Item = &'a Value>) -> Outcome<u32> {
    let depth = 1 + items.map(Value::depth).max().unwrap_or(0);
    if depth > MAX_DEPTH {
        return fail(format!(
            "lists, dicts or functions are nested more than {MAX_DEPTH} levels deep"
        ));
    }
    Ok(depth)
}

impl PythonRange {
    pub(super) fn new(start: i128, stop: i128, step: i128) -> Outcome<Self> {
        if step == 0 {
            return fail("the step of a range must not be zero");
        }
        let distance = if step > 0 { stop.checked_sub(start) } else { start.checked_sub(stop) };
        let length = match distance {
            Some(distance) if distance <= 0 => 0,
            Some(distance) => {
                (distance - 1) / step.checked_abs().ok_or_else(super::number::too_large)? + 1
            }
            None => return Err(super::number::too_large()),
        };
        Ok(Self { start, stop, step, length })
    }

    pub(super) fn nth(&self, index: i128) -> i128 {
        self.start + index * self.step
    }
}

impl Value {
    /// A string.
    pub fn text(text: impl Into<Rc<str>>) -> Self {
        Self::Str(text.into())
    }

    /// Returns a list; an error if it is nested too deeply.
    pub fn list(items: Vec<Value>) -> Outcome<Self> {
        Ok(Self::List(PythonList { items: Sequence::new(items)?, is_dotted: false }))
    }

    /// Returns a tuple; an error if it is nested too deeply.
    pub fn tuple(items: Vec<Value>) -> Outcome<Self> {
        Ok(Self::Tuple(Sequence::new(items)?))
    }

    /// Returns a dict; an error if it is nested too deeply or a key is not hashable. The last of equal keys
    /// wins.
    pub fn dict(entries: Vec<(Value, Value)>) -> Outcome<Self> {
        let mut dict = Dict::default();
        for (key, value) in entries {
            dict.insert(key, value)?;
        }
        Ok(Self::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
    }

    /// Returns the same dict or list with `d.key` equivalent to `d['key']`, in nested dicts too; other
    /// values are unchanged. Used for the results of `xacro.load_yaml`.
    pub fn dotted(self) -> Self {
        match self {
            Self::List(list) => Self::List(PythonList { is_dotted: true, ..list }),
            Self::Dict(dict) => Self::Dict(DictHandle { is_dotted: true, ..dict }),
            other => other,
        }
    }

    /// Returns a function of the caller: a call of it invokes [`Scope::call_host`](super::Scope::call_host)
    /// with this name.
    pub fn host_function(name: impl Into<Rc<str>>) -> Self {
        Self::Function(Callable::Host(name.into()))
    }

    /// Truth value.
    pub fn is_true(&self) -> bool {
        match self {
            Self::None => false,
            Self::Bool(value) => *value,
            Self::Int(value) => *value != 0,
            Self::Float(value) => *value != 0.0,
            Self::Str(text) => !text.is_empty(),
            Self::List(list) => !list.is_empty(),
            Self::Tuple(items) => !items.items.is_empty(),
            Self::Dict(dict) => !dict.entries().is_empty(),
            Self::Set(set) => !set.entries().is_empty(),
            Self::Range(range) => range.length != 0,
            Self::View(view) => !view.dict.entries().is_empty(),
            Self::Iterator(_) | Self::Function(_) | Self::Module(_) | Self::Namespace(_) => true,
        }
    }

    /// Python's name of the type.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::None => "NoneType",
            Self::Bool(_) => "bool",
            Self::Int(_) => "int",
            Self::Float(_) => "float",
            Self::Str(_) => "str",
            Self::List(_) => "list",
            Self::Tuple(_) => "tuple",
            Self::Dict(_) => "dict",
            Self::Set(_) => "set",
            Self::Range(_) => "range",
            Self::View(view) => match view.kind {
                ViewKind::Keys => "dict_keys",
                ViewKind::Values => "dict_values",
                ViewKind::Items => "dict_items",
            },
            Self::Iterator(_) => "generator",
            Self::Function(_) => "function",
            Self::Module(_) | Self::Namespace(_) => "namespace",
        }
    }

    /// Number of the value in arithmetic.
    pub(super) fn number(&self) -> Option<Number> {
        match self {
            Self::Bool(value) => Some(Number::Int(i128::from(*value))),
            Self::Int(value) => Some(Number::Int(*value)),
            Self::Float(value) => Some(Number::Float(*value)),
            _ => None,
        }
    }

    /// Integer of the value, for an index or a count.
    pub(super) fn integer(&self) -> Outcome<i128> {
        match self.number() {
            Some(Number::Int(int)) => Ok(int),
            _ => fail(format!("an integer is needed here, not `{}`", self.type_name())),
        }
    }

    /// Float of the value, for a real number.
    pub(super) fn real(&self) -> Outcome<f64> {
        match self.number() {
            Some(number) => Ok(number.to_float()),
            None => fail(format!("a number is needed here, not `{}`", self.type_name())),
        }
    }

    /// Nesting depth of the value.
    pub(super) fn depth(&self) -> u32 {
        match self {
            Self::List(list) => list.items.depth,
            Self::Tuple(items) => items.depth,
            Self::Dict(dict) => dict.dict.depth(),
            Self::Set(set) => set.depth(),
            Self::View(view) => view.dict.depth(),
            Self::Iterator(iterator) => iterator.depth(),
            Self::Function(function) => function.depth(),
            _ => 0,
        }
    }

    /// Element of a dotted container.
    pub(super) fn dotted_if(self, is_dotted: bool) -> Self {
        if is_dotted { self.dotted() } else { self }
    }
}

impl From<Number> for Value {
    fn from(number: Number) -> Self {
        match number {
            Number::Int(int) => Self::Int(int),
            Number::Float(float) => Self::Float(float),
        }
    }
}
