//! The syntax tree of an expression.

use std::ops::Range;
use std::rc::Rc;

use super::value::Value;

/// Part of the expression with its byte range in the text.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) kind: Kind,
    pub(super) range: Range<usize>,
}

#[derive(Debug)]
pub(super) enum Kind {
    Constant(Value),
    Name(Rc<str>),
    Format(Vec<Piece>),
    List(Vec<Item>),
    Tuple(Vec<Item>),
    Set(Vec<Item>),
    Dict(Vec<Entry>),
    Comprehension(Rc<Comprehension>),
    Lambda(Rc<Lambda>),
    Conditional(Box<Conditional>),
    And(Vec<Node>),
    Or(Vec<Node>),
    Not(Box<Node>),
    /// Distinguishes `(a < b) < c` from `a < b < c`.
    Parenthesized(Box<Node>),
    /// `a < b <= c`.
    Comparison(Box<Node>, Vec<(Comparison, Node)>),
    /// Operators of one precedence, left to right. Flat, so that a long sum does not nest.
    Chain(Box<Node>, Vec<(Binary, Node)>),
    Power(Box<(Node, Node)>),
    Unary(Unary, Box<Node>),
    Attribute(Box<Node>, Rc<str>),
    Subscript(Box<Node>, Box<Index>),
    Call(Box<Node>, Vec<Argument>),
}

/// Part of an f-string.
#[derive(Debug)]
pub(super) enum Piece {
    Text(Rc<str>),
    Field { value: Node, conversion: Option<char>, format: Vec<Piece> },
}

/// Element of a display or a positional argument; `*` unpacks it.
#[derive(Debug)]
pub(super) struct Item {
    pub(super) node: Node,
    pub(super) spread: bool,
}

#[derive(Debug)]
pub(super) enum Entry {
    Pair(Node, Node),
    Spread(Node),
}

#[derive(Debug)]
pub(super) enum Argument {
    Positional(Item),
    Keyword(Rc<str>, Node),
    SpreadKeywords(Node),
}

#[derive(Debug)]
pub(super) struct Conditional {
    pub(super) then: Node,
    pub(super) condition: Node,
    pub(super) otherwise: Node,
}

#[derive(Debug)]
pub(super) enum Index {
    Item(Node),
    Slice { start: Option<Node>, stop: Option<Node>, step: Option<Node> },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    List,
    Set,
    Dict,
    Generator,
}

#[derive(Debug)]
pub(super) struct Comprehension {
    pub(super) shape: Shape,
    /// Element, or key of a dict entry.
    pub(super) element: Node,
    /// Value of a dict entry.
    pub(super) value: Option<Node>,
    pub(super) clauses: Vec<Clause>,
}

/// `for target in iterable if condition if condition`.
#[derive(Debug)]
pub(super) struct Clause {
    pub(super) target: Target,
    pub(super) iterable: Node,
    pub(super) conditions: Vec<Node>,
}

#[derive(Debug)]
pub(super) enum Target {
    Name(Rc<str>),
    Tuple(Vec<Target>),
}

#[derive(Debug)]
pub(super) struct Lambda {
    pub(super) parameters: Vec<Parameter>,
    pub(super) body: Node,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ParameterKind {
    Positional,
    Rest,
    KeywordOnly,
    RestKeywords,
}

#[derive(Debug)]
pub(super) struct Parameter {
    pub(super) name: Rc<str>,
    pub(super) kind: ParameterKind,
    pub(super) default: Option<Node>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unary {
    Minus,
    Plus,
    Invert,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    FloorDivide,
    Modulo,
    Power,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRight,
}

impl Binary {
    /// Operator as written.
    pub(super) fn sign(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::FloorDivide => "//",
            Self::Modulo => "%",
            Self::Power => "**",
            Self::And => "&",
            Self::Or => "|",
            Self::Xor => "^",
            Self::ShiftLeft => "<<",
            Self::ShiftRight => ">>",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    In,
    NotIn,
    Is,
    IsNot,
}
