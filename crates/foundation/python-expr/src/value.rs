//! The values expressions work on. They never change once made: what Python would change in place is refused.

mod dict;

pub use dict::Dict;

use std::rc::Rc;

use super::callable::Callable;
use super::error::{Outcome, fail};
use super::globals::Module;
use super::iterator::IteratorHandle;
use super::number::Number;

/// How deep lists may lie in lists. Comparing, printing and dropping a value recurse that far.
const MAX_DEPTH: u32 = 100;

/// A Python value.
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
    List(List),
    /// `tuple`.
    Tuple(Rc<Sequence>),
    /// `dict`; also what `load_yaml` and `dotify` give.
    Dict(DictHandle),
    /// `set` and `frozenset`; iterates in order of insertion, where Python's order is arbitrary.
    Set(Rc<Dict>),
    /// `range`.
    Range(Range),
    /// What `dict.keys()`, `.values()` and `.items()` give.
    View(View),
    /// A generator, or what `map`, `zip` and the like give: can be walked through once.
    Iterator(IteratorHandle),
    /// A lambda, a built-in or host function, or a type.
    Function(Callable),
    /// `math`, `python` or `xacro`.
    Module(Module),
    /// A namespace of the caller's, whose members [`Scope::member`](super::Scope::member) knows.
    Namespace(Rc<str>),
}

/// The elements of a list or tuple.
#[derive(Debug)]
pub struct Sequence {
    items: Vec<Value>,
    depth: u32,
}

/// A list.
#[derive(Debug, Clone)]
pub struct List {
    pub(super) items: Rc<Sequence>,
    /// Whether the list came out of a dotted dict, so that its elements are dotted too.
    pub(super) is_dotted: bool,
}

/// A dict.
#[derive(Debug, Clone)]
pub struct DictHandle {
    pub(super) dict: Rc<Dict>,
    /// Whether `d.key` works as `d['key']` does.
    pub(super) is_dotted: bool,
}

/// The integers `start`, `start + step`, ... before `stop`.
#[derive(Debug, Clone, Copy)]
pub struct Range {
    pub(super) start: i128,
    pub(super) stop: i128,
    pub(super) step: i128,
    pub(super) length: i128,
}

/// A view of a dict.
#[derive(Debug, Clone)]
pub struct View {
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

    /// The elements.
    pub fn items(&self) -> &[Value] {
        &self.items
    }
}

impl std::ops::Deref for List {
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

/// The depth of a value that holds these, unless that is too deep.
pub(super) fn depth_around<'a>(items: impl Iterator<Item = &'a Value>) -> Outcome<u32> {
    let depth = 1 + items.map(Value::depth).max().unwrap_or(0);
    if depth > MAX_DEPTH {
        return fail(format!(
            "lists, dicts or functions are nested more than {MAX_DEPTH} levels deep"
        ));
    }
    Ok(depth)
}

impl Range {
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

    /// A list; an error if it nests too deeply.
    pub fn list(items: Vec<Value>) -> Outcome<Self> {
        Ok(Self::List(List { items: Sequence::new(items)?, is_dotted: false }))
    }

    /// A tuple; an error if it nests too deeply.
    pub fn tuple(items: Vec<Value>) -> Outcome<Self> {
        Ok(Self::Tuple(Sequence::new(items)?))
    }

    /// A dict; an error if it nests too deeply or a key cannot be one. The last of equal keys wins.
    pub fn dict(entries: Vec<(Value, Value)>) -> Outcome<Self> {
        let mut dict = Dict::default();
        for (key, value) in entries {
            dict.insert(key, value)?;
        }
        Ok(Self::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
    }

    /// The same dict or list with `d.key` working as `d['key']`, in dicts inside too; other values unchanged.
    /// What `xacro.load_yaml` gives needs this.
    pub fn dotted(self) -> Self {
        match self {
            Self::List(list) => Self::List(List { is_dotted: true, ..list }),
            Self::Dict(dict) => Self::Dict(DictHandle { is_dotted: true, ..dict }),
            other => other,
        }
    }

    /// A function of the caller's: calling it asks [`Scope::call_host`](super::Scope::call_host) by this name.
    pub fn host_function(name: impl Into<Rc<str>>) -> Self {
        Self::Function(Callable::Host(name.into()))
    }

    /// Whether `if` takes the value as true.
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

    /// The number arithmetic takes the value for.
    pub(super) fn number(&self) -> Option<Number> {
        match self {
            Self::Bool(value) => Some(Number::Int(i128::from(*value))),
            Self::Int(value) => Some(Number::Int(*value)),
            Self::Float(value) => Some(Number::Float(*value)),
            _ => None,
        }
    }

    /// The integer the value is where one is needed, as an index or a count.
    pub(super) fn integer(&self) -> Outcome<i128> {
        match self.number() {
            Some(Number::Int(int)) => Ok(int),
            _ => fail(format!("an integer is needed here, not `{}`", self.type_name())),
        }
    }

    /// The float the value is where a real number is needed.
    pub(super) fn real(&self) -> Outcome<f64> {
        match self.number() {
            Some(number) => Ok(number.to_float()),
            None => fail(format!("a number is needed here, not `{}`", self.type_name())),
        }
    }

    /// How deep values lie in this one.
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

    /// An element taken out of a dotted container.
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
