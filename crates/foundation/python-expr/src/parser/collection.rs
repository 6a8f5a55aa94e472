//! Parentheses, lists, sets, dicts and comprehensions.

use std::rc::Rc;

use super::super::ast::{Clause, Comprehension, Entry, Item, Kind, Node, Shape, Target};
use super::super::error::{ExpressionError, Outcome};
use super::super::token::Token;
use super::{Level, Parser};

impl Parser<'_> {
    /// Expression, or tuple without parentheses.
    pub(super) fn tuple_or_expression(&mut self) -> Outcome<Node> {
        let first = self.item()?;
        if !first.spread && !self.is_sign(",") {
            return Ok(first.node);
        }
        let start = first.node.range.start;
        let mut items = vec![first];
        while self.take_sign(",") {
            if !self.starts_item() {
                break;
            }
            items.push(self.item()?);
        }
        if items.len() == 1
            && items[0].spread
            && !matches!(self.tokens[self.next - 1].token, Token::Sign(","))
        {
            return Err(ExpressionError::new("`*` needs a list around it, as in `[*values]`")
                .at(&items[0].node.range));
        }
        Ok(Node { kind: Kind::Tuple(items), range: start..self.end_of_last() })
    }

    fn starts_item(&self) -> bool {
        match self.peek().token {
            Token::End => false,
            Token::Sign(sign) => !matches!(sign, ")" | "]" | "}" | ":" | "="),
            _ => true,
        }
    }

    fn item(&mut self) -> Outcome<Item> {
        if self.take_sign("*") {
            return Ok(Item { node: self.operators(Level::BitOr)?, spread: true });
        }
        Ok(Item { node: self.expression()?, spread: false })
    }

    /// Items up to and including the closing bracket; the first is already parsed.
    fn items(&mut self, first: Item, closing: &str) -> Outcome<Vec<Item>> {
        let mut items = vec![first];
        while self.take_sign(",") {
            if self.is_sign(closing) {
                break;
            }
            items.push(self.item()?);
        }
        self.expect_sign(closing)?;
        Ok(items)
    }

    pub(super) fn parenthesized(&mut self) -> Outcome<Node> {
        let start = self.advance().start;
        if self.take_sign(")") {
            return Ok(Node { kind: Kind::Tuple(Vec::new()), range: start..self.end_of_last() });
        }
        let inner = self.tuple_or_expression()?;
        let inner = if self.is_word("for") { self.generator(inner)? } else { inner };
        self.expect_sign(")")?;
        let range = start..self.end_of_last();
        let kind = match inner.kind {
            // These would take the operators that follow, see `join`.
            Kind::Or(_) | Kind::And(_) | Kind::Comparison(..) | Kind::Chain(..) => {
                Kind::Parenthesized(Box::new(inner))
            }
            kind => kind,
        };
        Ok(Node { kind, range })
    }

    pub(super) fn list(&mut self) -> Outcome<Node> {
        let start = self.advance().start;
        if self.take_sign("]") {
            return Ok(Node { kind: Kind::List(Vec::new()), range: start..self.end_of_last() });
        }
        let first = self.item()?;
        let kind = if self.is_word("for") {
            let comprehension = self.comprehension(Shape::List, first, None)?;
            self.expect_sign("]")?;
            comprehension
        } else {
            Kind::List(self.items(first, "]")?)
        };
        Ok(Node { kind, range: start..self.end_of_last() })
    }

    /// Set or dict.
    pub(super) fn braces(&mut self) -> Outcome<Node> {
        let start = self.advance().start;
        if self.take_sign("}") {
            return Ok(Node { kind: Kind::Dict(Vec::new()), range: start..self.end_of_last() });
        }
        let kind = if self.is_sign("**") {
            Kind::Dict(self.entries(Vec::new())?)
        } else {
            let first = self.item()?;
            if !first.spread && self.take_sign(":") {
                let value = self.expression()?;
                if self.is_word("for") {
                    let comprehension = self.comprehension(Shape::Dict, first, Some(value))?;
                    self.expect_sign("}")?;
                    comprehension
                } else {
                    let pairs = vec![Entry::Pair(first.node, value)];
                    if self.take_sign(",") {
                        Kind::Dict(self.entries(pairs)?)
                    } else {
                        self.expect_sign("}")?;
                        Kind::Dict(pairs)
                    }
                }
            } else if self.is_word("for") {
                let comprehension = self.comprehension(Shape::Set, first, None)?;
                self.expect_sign("}")?;
                comprehension
            } else {
                Kind::Set(self.items(first, "}")?)
            }
        };
        Ok(Node { kind, range: start..self.end_of_last() })
    }

    /// Further entries of a dict, up to and including the closing brace.
    fn entries(&mut self, mut entries: Vec<Entry>) -> Outcome<Vec<Entry>> {
        while !self.take_sign("}") {
            if self.take_sign("**") {
                entries.push(Entry::Spread(self.operators(Level::BitOr)?));
            } else {
                let key = self.expression()?;
                self.expect_sign(":")?;
                entries.push(Entry::Pair(key, self.expression()?));
            }
            if !self.take_sign(",") {
                self.expect_sign("}")?;
                break;
            }
        }
        Ok(entries)
    }

    /// Clauses after an element, as a generator.
    pub(super) fn generator(&mut self, element: Node) -> Outcome<Node> {
        let start = element.range.start;
        let kind =
            self.comprehension(Shape::Generator, Item { node: element, spread: false }, None)?;
        Ok(Node { kind, range: start..self.end_of_last() })
    }

    fn comprehension(&mut self, shape: Shape, element: Item, value: Option<Node>) -> Outcome<Kind> {
        if element.spread {
            return Err(ExpressionError::new("`*` is not allowed in a comprehension")
                .at(&element.node.range));
        }
        let mut clauses = Vec::new();
        while self.take_word("for") {
            let target = self.target()?;
            if !self.take_word("in") {
                return Err(self.expected("`in`"));
            }
            let iterable = self.operators(Level::Or)?;
            let mut conditions = Vec::new();
            while self.take_word("if") {
                conditions.push(self.operators(Level::Or)?);
            }
            clauses.push(Clause { target, iterable, conditions });
        }
        Ok(Kind::Comprehension(Rc::new(Comprehension {
            shape,
            element: element.node,
            value,
            clauses,
        })))
    }

    /// Names after `for`.
    fn target(&mut self) -> Outcome<Target> {
        let first = self.one_target()?;
        if !self.is_sign(",") {
            return Ok(first);
        }
        let mut targets = vec![first];
        while self.take_sign(",") {
            if self.is_word("in") || self.is_sign(")") || self.is_sign("]") {
                break;
            }
            targets.push(self.one_target()?);
        }
        Ok(Target::Tuple(targets))
    }

    fn one_target(&mut self) -> Outcome<Target> {
        let closing = if self.take_sign("(") {
            ")"
        } else if self.take_sign("[") {
            "]"
        } else {
            return self.expect_name().map(Target::Name);
        };
        let target = self.nested(Self::target)?;
        self.expect_sign(closing)?;
        Ok(match target {
            // Square brackets alone make a target of one element, parentheses do not.
            Target::Name(_) if closing == "]" => Target::Tuple(vec![target]),
            target => target,
        })
    }
}
