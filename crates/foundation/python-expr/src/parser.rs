//! Recursive descent parser for Python's grammar of expressions.

mod collection;
mod format_string;

use std::ops::Range;
use std::rc::Rc;

use super::ast::{
    Argument, Binary, Comparison, Conditional, Index, Item, Kind, Lambda, Node, Parameter,
    ParameterKind, Unary,
};
use super::error::{ExpressionError, Outcome};
use super::literal::unescape;
use super::token::{Placed, Token, tokenize};
use super::value::Value;

/// Maximum nesting depth of brackets, lambdas and prefix operators, limited by the stack.
const MAX_NESTING: u32 = 80;

const KEYWORDS: &[&str] = &[
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue",
    "def", "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import",
    "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try", "while",
    "with", "yield",
];

/// Parses the whole text.
pub(super) fn parse(text: &str) -> Outcome<Node> {
    let mut parser = Parser::new(text, 0..text.len(), 0)?;
    let node = parser.tuple_or_expression()?;
    parser.expect_end()?;
    Ok(node)
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Placed>,
    next: usize,
    nesting: u32,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str, within: Range<usize>, nesting: u32) -> Outcome<Self> {
        Ok(Self { text, tokens: tokenize(text, within)?, next: 0, nesting })
    }

    fn peek(&self) -> &Placed {
        // The last token is `End`, and the position never exceeds it.
        &self.tokens[self.next]
    }

    fn advance(&mut self) -> Range<usize> {
        let range = self.peek().range.clone();
        if self.peek().token != Token::End {
            self.next += 1;
        }
        range
    }

    fn is_sign(&self, sign: &str) -> bool {
        matches!(&self.peek().token, Token::Sign(found) if *found == sign)
    }

    fn is_word(&self, word: &str) -> bool {
        self.peek().token == Token::Name && &self.text[self.peek().range.clone()] == word
    }

    fn take_sign(&mut self, sign: &str) -> bool {
        let found = self.is_sign(sign);
        if found {
            self.next += 1;
        }
        found
    }

    fn take_word(&mut self, word: &str) -> bool {
        let found = self.is_word(word);
        if found {
            self.next += 1;
        }
        found
    }

    fn end_of_last(&self) -> usize {
        self.next.checked_sub(1).map_or(0, |last| self.tokens[last].range.end)
    }

    /// Error of an unexpected token.
    fn expected(&self, wanted: &str) -> ExpressionError {
        let found = self.peek();
        let written = &self.text[found.range.clone()];
        let error = match found.token {
            Token::End if self.next == 0 => ExpressionError::new("the expression is empty"),
            Token::End => {
                ExpressionError::new(format!("the expression ends where {wanted} is needed"))
            }
            _ => ExpressionError::new(format!(
                "expected {wanted}, found `{}`",
                written.escape_debug()
            )),
        };
        let error = match hint(written) {
            Some(help) => error.with_help(help),
            None => error,
        };
        error.at(&found.range)
    }

    fn expect_sign(&mut self, sign: &str) -> Outcome<()> {
        if self.take_sign(sign) { Ok(()) } else { Err(self.expected(&format!("`{sign}`"))) }
    }

    fn expect_end(&self) -> Outcome<()> {
        if self.peek().token == Token::End {
            Ok(())
        } else {
            Err(self.expected("an operator or the end"))
        }
    }

    fn expect_name(&mut self) -> Outcome<Rc<str>> {
        let found = self.peek();
        let name = &self.text[found.range.clone()];
        if found.token != Token::Name || KEYWORDS.contains(&name) {
            return Err(self.expected("a name"));
        }
        if name.starts_with("__") {
            return Err(ExpressionError::new(format!(
                "the name `{name}` starts with a double underscore"
            ))
            .with_help("such names are closed to expressions, as in xacro")
            .at(&found.range));
        }
        let name = name.into();
        self.next += 1;
        Ok(name)
    }

    /// Parses one level deeper, up to the limit.
    fn nested<T>(&mut self, parse: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        if self.nesting >= MAX_NESTING {
            return Err(ExpressionError::new(format!(
                "the expression nests more than {MAX_NESTING} levels deep"
            ))
            .at(&self.peek().range));
        }
        self.nesting += 1;
        let result = parse(self);
        self.nesting -= 1;
        result
    }

    /// Conditional, lambda or expression of higher precedence.
    fn expression(&mut self) -> Outcome<Node> {
        if self.is_word("lambda") {
            return self.nested(Self::lambda);
        }
        let then = self.operators(Level::Or)?;
        if !self.take_word("if") {
            return Ok(then);
        }
        let condition = self.operators(Level::Or)?;
        if !self.take_word("else") {
            return Err(self.expected("`else`"));
        }
        let otherwise = self.nested(Self::expression)?;
        let range = then.range.start..otherwise.range.end;
        Ok(Node {
            kind: Kind::Conditional(Box::new(Conditional { then, condition, otherwise })),
            range,
        })
    }

    fn lambda(&mut self) -> Outcome<Node> {
        let start = self.advance().start;
        let mut parameters: Vec<Parameter> = Vec::new();
        let mut keyword_only = false;
        while !self.is_sign(":") {
            if self.take_sign("**") {
                let name = self.expect_name()?;
                parameters.push(Parameter {
                    name,
                    kind: ParameterKind::RestKeywords,
                    default: None,
                });
                self.take_sign(",");
                break;
            }
            if !keyword_only && self.take_sign("*") {
                keyword_only = true;
                if !self.is_sign(",") {
                    let name = self.expect_name()?;
                    parameters.push(Parameter { name, kind: ParameterKind::Rest, default: None });
                }
            } else {
                let place = self.peek().range.clone();
                let name = self.expect_name()?;
                if parameters.iter().any(|parameter| parameter.name == name) {
                    return Err(ExpressionError::new(format!(
                        "the lambda has two parameters `{name}`"
                    ))
                    .at(&place));
                }
                let default =
                    if self.take_sign("=") { Some(self.nested(Self::expression)?) } else { None };
                let optional_before =
                    parameters.last().is_some_and(|parameter| parameter.default.is_some());
                if default.is_none() && optional_before && !keyword_only {
                    return Err(ExpressionError::new(format!("the parameter `{name}` needs a default too, since the one before it has one")).at(&place));
                }
                let kind = if keyword_only {
                    ParameterKind::KeywordOnly
                } else {
                    ParameterKind::Positional
                };
                parameters.push(Parameter { name, kind, default });
            }
            if !self.take_sign(",") {
                break;
            }
        }
        self.expect_sign(":")?;
        let body = self.nested(Self::expression)?;
        let range = start..body.range.end;
        Ok(Node { kind: Kind::Lambda(Rc::new(Lambda { parameters, body })), range })
    }

    /// Operators of at least this precedence, by precedence climbing.
    fn operators(&mut self, level: Level) -> Outcome<Node> {
        let mut left = if level <= Level::Not && self.is_word("not") {
            self.nested(Self::not)?
        } else {
            self.unary()?
        };
        while let Some((operator, own_level, tokens)) = self.operator() {
            if own_level < level {
                break;
            }
            self.next += tokens;
            let right = self.operators(own_level.tighter())?;
            left = join(left, operator, right);
        }
        Ok(left)
    }

    fn not(&mut self) -> Outcome<Node> {
        let start = self.advance().start;
        let operand = self.operators(Level::Not)?;
        let range = start..operand.range.end;
        Ok(Node { kind: Kind::Not(Box::new(operand)), range })
    }

    /// Next infix operator with its precedence and number of tokens.
    fn operator(&self) -> Option<(Infix, Level, usize)> {
        let (infix, level) = match &self.peek().token {
            Token::Sign(sign) => match *sign {
                "<" => (Infix::Comparison(Comparison::Less), Level::Comparison),
                "<=" => (Infix::Comparison(Comparison::LessEqual), Level::Comparison),
                ">" => (Infix::Comparison(Comparison::Greater), Level::Comparison),
                ">=" => (Infix::Comparison(Comparison::GreaterEqual), Level::Comparison),
                "==" => (Infix::Comparison(Comparison::Equal), Level::Comparison),
                "!=" => (Infix::Comparison(Comparison::NotEqual), Level::Comparison),
                "|" => (Infix::Binary(Binary::Or), Level::BitOr),
                "^" => (Infix::Binary(Binary::Xor), Level::BitXor),
                "&" => (Infix::Binary(Binary::And), Level::BitAnd),
                "<<" => (Infix::Binary(Binary::ShiftLeft), Level::Shift),
                ">>" => (Infix::Binary(Binary::ShiftRight), Level::Shift),
                "+" => (Infix::Binary(Binary::Add), Level::Sum),
                "-" => (Infix::Binary(Binary::Subtract), Level::Sum),
                "*" => (Infix::Binary(Binary::Multiply), Level::Product),
                "/" => (Infix::Binary(Binary::Divide), Level::Product),
                "//" => (Infix::Binary(Binary::FloorDivide), Level::Product),
                "%" => (Infix::Binary(Binary::Modulo), Level::Product),
                _ => return None,
            },
            Token::Name => match &self.text[self.peek().range.clone()] {
                "or" => (Infix::Or, Level::Or),
                "and" => (Infix::And, Level::And),
                "in" => (Infix::Comparison(Comparison::In), Level::Comparison),
                "is" if self.is_word_at(1, "not") => {
                    return Some((Infix::Comparison(Comparison::IsNot), Level::Comparison, 2));
                }
                "is" => (Infix::Comparison(Comparison::Is), Level::Comparison),
                "not" if self.is_word_at(1, "in") => {
                    return Some((Infix::Comparison(Comparison::NotIn), Level::Comparison, 2));
                }
                _ => return None,
            },
            _ => return None,
        };
        Some((infix, level, 1))
    }

    fn is_word_at(&self, offset: usize, word: &str) -> bool {
        self.tokens.get(self.next + offset).is_some_and(|placed| {
            placed.token == Token::Name && &self.text[placed.range.clone()] == word
        })
    }

    fn unary(&mut self) -> Outcome<Node> {
        let operator = match &self.peek().token {
            Token::Sign("-") => Unary::Minus,
            Token::Sign("+") => Unary::Plus,
            Token::Sign("~") => Unary::Invert,
            _ => return self.power(),
        };
        let start = self.advance().start;
        let operand = self.nested(Self::unary)?;
        let range = start..operand.range.end;
        Ok(Node { kind: Kind::Unary(operator, Box::new(operand)), range })
    }

    fn power(&mut self) -> Outcome<Node> {
        let base = self.postfix()?;
        if !self.take_sign("**") {
            return Ok(base);
        }
        let exponent = self.nested(Self::unary)?;
        let range = base.range.start..exponent.range.end;
        Ok(Node { kind: Kind::Power(Box::new((base, exponent))), range })
    }

    /// Attributes, subscripts and calls after an atom.
    fn postfix(&mut self) -> Outcome<Node> {
        let mut node = self.atom()?;
        let mut links = 0;
        while let Token::Sign(sign @ ("." | "[" | "(")) = self.peek().token {
            links += 1;
            if links > MAX_NESTING {
                return Err(ExpressionError::new(format!(
                    "more than {MAX_NESTING} calls, subscripts or attributes in a row"
                ))
                .at(&self.peek().range));
            }
            self.next += 1;
            let start = node.range.start;
            let kind = match sign {
                "." => Kind::Attribute(Box::new(node), self.expect_name()?),
                "[" => {
                    let index = self.nested(Self::index)?;
                    self.expect_sign("]")?;
                    Kind::Subscript(Box::new(node), Box::new(index))
                }
                _ => Kind::Call(Box::new(node), self.nested(Self::arguments)?),
            };
            node = Node { kind, range: start..self.end_of_last() };
        }
        Ok(node)
    }

    fn index(&mut self) -> Outcome<Index> {
        let start = if self.is_sign(":") { None } else { Some(self.tuple_or_expression()?) };
        if !self.take_sign(":") {
            return start.map(Index::Item).ok_or_else(|| self.expected("an index"));
        }
        let stop =
            if self.is_sign(":") || self.is_sign("]") { None } else { Some(self.expression()?) };
        let step =
            if self.take_sign(":") && !self.is_sign("]") { Some(self.expression()?) } else { None };
        Ok(Index::Slice { start, stop, step })
    }

    /// Arguments after `(` up to and including `)`.
    fn arguments(&mut self) -> Outcome<Vec<Argument>> {
        let mut arguments = Vec::new();
        while !self.take_sign(")") {
            let place = self.peek().range.clone();
            if self.take_sign("**") {
                arguments.push(Argument::SpreadKeywords(self.expression()?));
            } else if self.take_sign("*") {
                arguments
                    .push(Argument::Positional(Item { node: self.expression()?, spread: true }));
            } else if self.peek().token == Token::Name
                && matches!(self.tokens[self.next + 1].token, Token::Sign("="))
            {
                let name = self.expect_name()?;
                self.next += 1;
                if arguments.iter().any(
                    |argument| matches!(argument, Argument::Keyword(other, _) if *other == name),
                ) {
                    return Err(ExpressionError::new(format!(
                        "the argument `{name}` is given twice"
                    ))
                    .at(&place));
                }
                arguments.push(Argument::Keyword(name, self.expression()?));
            } else {
                let node = self.expression()?;
                if self.is_word("for") {
                    let whole = arguments.is_empty();
                    let node = self.generator(node)?;
                    if !whole || !self.is_sign(")") {
                        return Err(ExpressionError::new(
                            "a generator beside other arguments needs its own parentheses",
                        )
                        .at(&node.range));
                    }
                    arguments.push(Argument::Positional(Item { node, spread: false }));
                } else if arguments
                    .iter()
                    .any(|argument| !matches!(argument, Argument::Positional(_)))
                {
                    return Err(ExpressionError::new(
                        "a positional argument follows one given by name",
                    )
                    .at(&place));
                } else {
                    arguments.push(Argument::Positional(Item { node, spread: false }));
                }
            }
            if !self.take_sign(",") {
                self.expect_sign(")")?;
                break;
            }
        }
        Ok(arguments)
    }

    fn atom(&mut self) -> Outcome<Node> {
        let Placed { token, range } = self.peek().clone();
        let kind = match token {
            Token::Int(int) => Kind::Constant(Value::Int(int)),
            Token::Float(float) => Kind::Constant(Value::Float(float)),
            Token::String(_) => return self.strings(),
            Token::Name => match &self.text[range.clone()] {
                "None" => Kind::Constant(Value::None),
                "True" => Kind::Constant(Value::Bool(true)),
                "False" => Kind::Constant(Value::Bool(false)),
                word @ ("await" | "yield") => {
                    return Err(ExpressionError::new(format!(
                        "`{word}` is not supported in expressions"
                    ))
                    .at(&range));
                }
                _ => Kind::Name(self.expect_name_of_value()?),
            },
            Token::Sign("(") => return self.nested(Self::parenthesized),
            Token::Sign("[") => return self.nested(Self::list),
            Token::Sign("{") => return self.nested(Self::braces),
            Token::Sign("...") => {
                return Err(
                    ExpressionError::new("`...` is not supported in expressions").at(&range)
                );
            }
            _ => return Err(self.expected("a value")),
        };
        if !matches!(kind, Kind::Name(_)) {
            self.next += 1;
        }
        Ok(Node { kind, range })
    }

    fn expect_name_of_value(&mut self) -> Outcome<Rc<str>> {
        if KEYWORDS.contains(&&self.text[self.peek().range.clone()]) {
            Err(self.expected("a value"))
        } else {
            self.expect_name()
        }
    }

    /// Adjacent string literals are concatenated.
    fn strings(&mut self) -> Outcome<Node> {
        let start = self.peek().range.start;
        let mut plain = String::new();
        let mut pieces = Vec::new();
        let mut is_format = false;
        while let Token::String(source) = self.peek().token.clone() {
            self.next += 1;
            if source.is_format {
                is_format = true;
                if !plain.is_empty() {
                    pieces.push(super::ast::Piece::Text(std::mem::take(&mut plain).into()));
                }
                pieces.extend(self.nested(|parser| parser.format_pieces(&source))?);
            } else {
                plain.push_str(&unescape(self.text, source.body, source.is_raw)?);
            }
        }
        let range = start..self.end_of_last();
        if !is_format {
            return Ok(Node { kind: Kind::Constant(Value::text(plain)), range });
        }
        if !plain.is_empty() {
            pieces.push(super::ast::Piece::Text(plain.into()));
        }
        Ok(Node { kind: Kind::Format(pieces), range })
    }
}

/// Precedence of an infix operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Or,
    And,
    Not,
    Comparison,
    BitOr,
    BitXor,
    BitAnd,
    Shift,
    Sum,
    Product,
    Unary,
}

impl Level {
    fn tighter(self) -> Self {
        match self {
            Self::Or => Self::And,
            Self::And => Self::Not,
            Self::Not => Self::Comparison,
            Self::Comparison => Self::BitOr,
            Self::BitOr => Self::BitXor,
            Self::BitXor => Self::BitAnd,
            Self::BitAnd => Self::Shift,
            Self::Shift => Self::Sum,
            Self::Sum => Self::Product,
            Self::Product | Self::Unary => Self::Unary,
        }
    }
}

enum Infix {
    Or,
    And,
    Comparison(Comparison),
    Binary(Binary),
}

/// Returns true if both operators may share one flat chain.
fn same_level(a: Binary, b: Binary) -> bool {
    let level = |operator| match operator {
        Binary::Add | Binary::Subtract => 0,
        Binary::Multiply | Binary::Divide | Binary::FloorDivide | Binary::Modulo => 1,
        Binary::ShiftLeft | Binary::ShiftRight => 2,
        Binary::And => 3,
        Binary::Or => 4,
        Binary::Xor => 5,
        Binary::Power => 6,
    };
    level(a) == level(b)
}

/// Appends to the chain on the left if there is one, so that long chains stay flat. A chain in parentheses
/// is wrapped, see `parenthesized`.
fn join(left: Node, infix: Infix, right: Node) -> Node {
    let range = left.range.start..right.range.end;
    let kind = match (left.kind, infix) {
        (Kind::Or(mut operands), Infix::Or) => {
            operands.push(right);
            Kind::Or(operands)
        }
        (Kind::And(mut operands), Infix::And) => {
            operands.push(right);
            Kind::And(operands)
        }
        (Kind::Comparison(first, mut rest), Infix::Comparison(operator)) => {
            rest.push((operator, right));
            Kind::Comparison(first, rest)
        }
        (Kind::Chain(first, mut rest), Infix::Binary(operator))
            if same_level(rest[0].0, operator) =>
        {
            rest.push((operator, right));
            Kind::Chain(first, rest)
        }
        (kind, infix) => {
            let left = Node { kind, range: left.range };
            match infix {
                Infix::Or => Kind::Or(vec![left, right]),
                Infix::And => Kind::And(vec![left, right]),
                Infix::Comparison(operator) => {
                    Kind::Comparison(Box::new(left), vec![(operator, right)])
                }
                Infix::Binary(operator) => Kind::Chain(Box::new(left), vec![(operator, right)]),
            }
        }
    };
    Node { kind, range }
}

/// Replacement for syntax of other languages or Python statements.
fn hint(written: &str) -> Option<&'static str> {
    Some(match written {
        "=" => "use `==` to compare; an expression cannot assign",
        "&&" => "write `and`",
        "||" => "write `or`",
        "!" => "write `not`",
        "<>" => "write `!=`",
        ":=" | "+=" | "-=" | "*=" | "/=" | "**=" | "//=" | "%=" | "&=" | "|=" | "^=" | "<<="
        | ">>=" | "@=" => "an expression cannot assign; use a property",
        "@" => "matrix products are not supported",
        ";" => "only one expression is allowed",
        "import" | "from" => "modules cannot be imported; `math` is already available",
        "def" | "class" | "return" | "while" | "with" | "try" | "raise" | "del" | "assert"
        | "pass" | "global" | "nonlocal" | "async" => "only expressions are allowed, no statements",
        _ => return None,
    })
}
