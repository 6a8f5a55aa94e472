//! Expressions of the script language.

use std::ops::Range;

use super::token::{Token, TokenKind, tokenize};
use super::{MAX_SCRIPT_DEPTH, ScriptError};
use crate::TreeValue;

/// Expression with its location in the script.
#[derive(Clone, Debug)]
pub(super) struct Expr {
    pub(super) kind: ExprKind,
    pub(super) range: Range<usize>,
}

#[derive(Clone, Debug)]
pub(super) enum ExprKind {
    Literal(TreeValue),
    Name(String),
    Unary(&'static str, Box<Expr>),
    Binary(&'static str, Box<(Expr, Expr)>),
    /// `a < b <= c`: operands and the operators between them.
    Comparison(Vec<Expr>, Vec<&'static str>),
    /// Condition, value if true, value otherwise.
    Choice(Box<[Expr; 3]>),
    Assignment(&'static str, String, Box<Expr>),
}

/// Precedence levels, from loose to tight.
const ASSIGNMENT: u8 = 1;
const CHOICE: u8 = 2;
const COMPARISON: u8 = 5;
const PREFIX: u8 = 10;

fn precedence(mark: &str) -> Option<u8> {
    Some(match mark {
        ":=" | "=" | "+=" | "-=" | "*=" | "/=" => ASSIGNMENT,
        "?" => CHOICE,
        "||" => 3,
        "&&" => 4,
        "==" | "!=" | "<" | "<=" | ">" | ">=" => COMPARISON,
        "|" | "^" => 6,
        "&" => 7,
        "+" | "-" | ".." => 8,
        "*" | "/" => 9,
        _ => return None,
    })
}

pub(super) fn statements(source: &str) -> Result<Vec<Expr>, ScriptError> {
    let mut parser = Parser { tokens: tokenize(source)?, at: 0, depth: 0 };
    let mut statements = Vec::new();
    loop {
        while parser.peek().kind == TokenKind::Mark(";") {
            parser.at += 1;
        }
        if parser.peek().kind == TokenKind::End {
            return Ok(statements);
        }
        statements.push(parser.expression(0)?);
        let next = parser.peek();
        if !matches!(next.kind, TokenKind::Mark(";") | TokenKind::End) {
            let message = "an operator or `;` is missing before this";
            return Err(ScriptError::new(message, next.range.clone()));
        }
    }
}

struct Parser {
    /// The last token is the end.
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

impl Parser {
    fn peek(&self) -> &Token {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    fn next(&mut self) -> Token {
        let token = self.peek().clone();
        self.at += 1;
        token
    }

    fn mark(&self) -> Option<(&'static str, u8)> {
        match self.peek().kind {
            TokenKind::Mark(mark) => precedence(mark).map(|level| (mark, level)),
            _ => None,
        }
    }

    fn expect(&mut self, mark: &'static str, opened: &Range<usize>) -> Result<(), ScriptError> {
        let token = self.next();
        if token.kind == TokenKind::Mark(mark) {
            return Ok(());
        }
        let message = format!("`{mark}` is missing");
        Err(ScriptError::new(message, opened.start..token.range.end))
    }

    fn expression(&mut self, min_level: u8) -> Result<Expr, ScriptError> {
        self.depth += 1;
        if self.depth > MAX_SCRIPT_DEPTH {
            let message = format!("expressions are nested more than {MAX_SCRIPT_DEPTH} deep");
            return Err(ScriptError::new(message, self.peek().range.clone()));
        }
        let mut left = self.operand()?;
        while let Some((mark, level)) = self.mark().filter(|(_, level)| *level >= min_level) {
            left = match level {
                ASSIGNMENT => self.assignment(left)?,
                CHOICE => self.choice(left)?,
                COMPARISON => self.comparison(left)?,
                _ => {
                    self.at += 1;
                    let right = self.expression(level + 1)?;
                    let range = left.range.start..right.range.end;
                    Expr { kind: ExprKind::Binary(mark, Box::new((left, right))), range }
                }
            };
            if level <= CHOICE {
                break;
            }
        }
        self.depth -= 1;
        Ok(left)
    }

    fn operand(&mut self) -> Result<Expr, ScriptError> {
        let Token { kind, range } = self.next();
        let literal = |value: TreeValue| ExprKind::Literal(value);
        let kind = match kind {
            TokenKind::Int(value) => literal(TreeValue::Int(value)),
            TokenKind::Real(value) => literal(TreeValue::Real(value)),
            TokenKind::Bool(value) => literal(TreeValue::Bool(value)),
            TokenKind::Text(text) => literal(text.as_str().into()),
            TokenKind::Name(name) => ExprKind::Name(name),
            TokenKind::Mark(mark @ ("-" | "!" | "~")) => {
                let operand = self.expression(PREFIX)?;
                let range = range.start..operand.range.end;
                return Ok(Expr { kind: ExprKind::Unary(mark, Box::new(operand)), range });
            }
            TokenKind::Mark("(") => {
                let inner = self.expression(0)?;
                self.expect(")", &range)?;
                return Ok(inner);
            }
            TokenKind::Mark(_) | TokenKind::End => {
                return Err(ScriptError::new("an operand is missing here", range));
            }
        };
        Ok(Expr { kind, range })
    }

    fn assignment(&mut self, left: Expr) -> Result<Expr, ScriptError> {
        let Some((mark, _)) = self.mark() else { return Ok(left) };
        self.at += 1;
        let ExprKind::Name(name) = left.kind else {
            let message = format!("left of `{mark}` must be the name of an entry");
            return Err(ScriptError::new(message, left.range));
        };
        let right = self.expression(0)?;
        let range = left.range.start..right.range.end;
        Ok(Expr { kind: ExprKind::Assignment(mark, name, Box::new(right)), range })
    }

    fn choice(&mut self, condition: Expr) -> Result<Expr, ScriptError> {
        let question = self.next().range;
        let then = self.expression(0)?;
        self.expect(":", &question)?;
        let otherwise = self.expression(CHOICE)?;
        let range = condition.range.start..otherwise.range.end;
        Ok(Expr { kind: ExprKind::Choice(Box::new([condition, then, otherwise])), range })
    }

    fn comparison(&mut self, first: Expr) -> Result<Expr, ScriptError> {
        let start = first.range.start;
        let mut operands = vec![first];
        let mut marks = Vec::new();
        while let Some((mark, COMPARISON)) = self.mark() {
            self.at += 1;
            marks.push(mark);
            operands.push(self.expression(COMPARISON + 1)?);
        }
        let end = operands.last().map_or(start, |last| last.range.end);
        Ok(Expr { kind: ExprKind::Comparison(operands, marks), range: start..end })
    }
}
