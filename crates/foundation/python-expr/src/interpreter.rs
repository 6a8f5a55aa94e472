//! Evaluation of the syntax tree.

mod calls;

use std::cmp::Ordering;
use std::rc::Rc;

use super::Scope;
use super::ast::{
    Binary, Comparison, Comprehension, Entry, Index, Item, Kind, Node, Piece, Shape, Target,
};
use super::budget::Budget;
use super::callable::{Bound, Callable};
use super::compare;
use super::error::{ExpressionError, ExpressionErrorKind, Outcome, fail};
use super::format_spec::format_value;
use super::globals;
use super::iterator::{Generator, IteratorHandle, State};
use super::methods;
use super::operators;
use super::subscript;
use super::suggest::closest;
use super::text::to_ascii;
use super::value::{Dict, DictHandle, Value, depth_around};

/// Names bound by a lambda or a comprehension; immutable, so they cannot form cycles.
#[derive(Debug)]
pub(super) struct Frame {
    bindings: Vec<(Rc<str>, Value)>,
    parent: Frames,
    depth: u32,
}

/// Frames around an expression, innermost first.
pub(super) type Frames = Option<Rc<Frame>>;

impl Frame {
    pub(super) fn new(bindings: Vec<(Rc<str>, Value)>, parent: &Frames) -> Outcome<Rc<Self>> {
        let own = depth_around(bindings.iter().map(|(_, value)| value))?;
        let depth = own.max(parent.as_ref().map_or(0, |parent| parent.depth + 1));
        if depth > 200 {
            return fail("lambdas or comprehensions are nested too deeply");
        }
        Ok(Rc::new(Self { bindings, parent: parent.clone(), depth }))
    }

    pub(super) fn depth(&self) -> u32 {
        self.depth
    }
}

pub(super) struct Interpreter<'a> {
    scope: &'a dyn Scope,
    pub(super) budget: &'a mut Budget,
    /// Text of the byte ranges in errors.
    pub(super) source: Rc<str>,
}

impl<'a> Interpreter<'a> {
    pub(super) fn new(scope: &'a dyn Scope, budget: &'a mut Budget, source: Rc<str>) -> Self {
        Self { scope, budget, source }
    }

    /// Value of a node.
    pub(super) fn evaluate(&mut self, node: &Node, frames: &Frames) -> Outcome<Value> {
        if let Kind::Constant(value) = &node.kind {
            return Ok(value.clone());
        }
        self.budget.step().map_err(|error| error.at(&node.range))?;
        self.deeper(|interpreter| interpreter.evaluate_kind(node, frames))
            .map_err(|error| error.at(&node.range))
    }

    /// Runs an action one nesting level deeper.
    pub(super) fn deeper<T>(&mut self, action: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        self.budget.enter()?;
        let result = action(self);
        self.budget.leave();
        result
    }

    // One short arm each: every nesting level takes the largest stack frame of this function.
    fn evaluate_kind(&mut self, node: &Node, frames: &Frames) -> Outcome<Value> {
        match &node.kind {
            Kind::Constant(value) => Ok(value.clone()),
            Kind::Name(name) => self.name(name, node, frames),
            Kind::Format(pieces) => self.format(pieces, frames).map(Value::text),
            Kind::List(items) => self.items(items, frames).and_then(Value::list),
            Kind::Tuple(items) => self.items(items, frames).and_then(Value::tuple),
            Kind::Set(items) => self.items(items, frames).and_then(|items| self.set_of(items)),
            Kind::Dict(entries) => self.dict(entries, frames),
            Kind::Comprehension(comprehension) => self.comprehension(comprehension, frames),
            Kind::Lambda(lambda) => self.lambda(lambda, frames),
            Kind::Conditional(parts) => {
                let branch = if self.evaluate(&parts.condition, frames)?.is_true() {
                    &parts.then
                } else {
                    &parts.otherwise
                };
                self.evaluate(branch, frames)
            }
            Kind::And(operands) => self.until(operands, false, frames),
            Kind::Or(operands) => self.until(operands, true, frames),
            Kind::Not(operand) => Ok(Value::Bool(!self.evaluate(operand, frames)?.is_true())),
            Kind::Parenthesized(inner) => self.evaluate(inner, frames),
            Kind::Comparison(first, rest) => self.comparison(first, rest, frames).map(Value::Bool),
            Kind::Chain(first, rest) => self.chain(first, rest, frames),
            Kind::Power(operands) => self.power(operands, frames),
            Kind::Unary(operator, operand) => {
                operators::unary(*operator, &self.evaluate(operand, frames)?)
            }
            Kind::Attribute(object, name) => self.attribute_node(object, name, node, frames),
            Kind::Subscript(object, index) => self.subscript(object, index, frames),
            Kind::Call(function, arguments) => self.call_node(function, arguments, frames),
        }
    }

    fn name(&mut self, name: &Rc<str>, node: &Node, frames: &Frames) -> Outcome<Value> {
        let mut frame = frames;
        while let Some(inner) = frame {
            if let Some((_, value)) = inner.bindings.iter().find(|(bound, _)| bound == name) {
                return Ok(value.clone());
            }
            frame = &inner.parent;
        }
        if let Some(value) =
            self.scope.lookup(name, self.budget).map_err(ExpressionError::unplaced)?
        {
            return Ok(value);
        }
        let dialect = self.scope.dialect();
        match globals::lookup(dialect, name) {
            Some(global) => {
                if let Some(replacement) = global.deprecated_for {
                    self.scope.deprecated(name, replacement, node.range.clone());
                }
                global.value
            }
            None => Err(self.undefined(name, dialect, frames)),
        }
    }

    fn undefined(
        &self,
        name: &str,
        dialect: globals::ExpressionDialect,
        frames: &Frames,
    ) -> ExpressionError {
        let undefined = |advice: &str| {
            let message = format!("`{name}` is not defined{advice}");
            ExpressionError::new(message).with_kind(ExpressionErrorKind::UndefinedName)
        };
        if let Some(help) = globals::hint(dialect, name) {
            return undefined("").with_help(help);
        }
        let mut known = self.scope.names();
        let mut frame = frames;
        while let Some(inner) = frame {
            known.extend(inner.bindings.iter().map(|(name, _)| name.to_string()));
            frame = &inner.parent;
        }
        // The caller's own names first: similarity to a built-in name is usually accidental.
        let found = closest(name, known.iter().map(String::as_str))
            .or_else(|| closest(name, globals::names(dialect).into_iter()));
        match found {
            Some(found) => undefined(&format!("; did you mean `{found}`?")),
            None => {
                let help = match dialect {
                    globals::ExpressionDialect::Xacro => {
                        format!(
                            "define it with a property, or write '{name}' if it is meant as text"
                        )
                    }
                    globals::ExpressionDialect::SubstitutionArgs => format!(
                        "`$(eval ...)` sees arguments only: declare it with <xacro:arg>, or put a property in as ${{{name}}}"
                    ),
                };
                undefined("").with_help(help)
            }
        }
    }

    fn format(&mut self, pieces: &[Piece], frames: &Frames) -> Outcome<String> {
        let mut result = String::new();
        for piece in pieces {
            match piece {
                Piece::Text(text) => {
                    self.budget.allocate(text.len() as u128)?;
                    result.push_str(text);
                }
                Piece::Field { value, conversion, format } => {
                    let value = self.evaluate(value, frames)?;
                    let specification = self.format(format, frames)?;
                    let value = self.convert(value, *conversion)?;
                    result.push_str(&format_value(&value, &specification, self.budget)?);
                }
            }
        }
        Ok(result)
    }

    /// `!s`, `!r` and `!a` of format fields.
    pub(super) fn convert(&mut self, value: Value, conversion: Option<char>) -> Outcome<Value> {
        Ok(match conversion {
            None => value,
            Some('s') => Value::text(value.to_text(self.budget)?),
            Some('r') => Value::text(value.to_repr(self.budget)?),
            Some('a') => Value::text(to_ascii(&value.to_repr(self.budget)?)),
            Some(other) => {
                return fail(format!(
                    "`!{other}` is not a conversion, one of `!r`, `!s` and `!a` is"
                ));
            }
        })
    }

    fn items(&mut self, items: &[Item], frames: &Frames) -> Outcome<Vec<Value>> {
        self.budget.allocate_values(items.len())?;
        let mut values = Vec::with_capacity(items.len());
        for item in items {
            let value = self.evaluate(&item.node, frames)?;
            if item.spread {
                values.extend(self.collect(&value).map_err(|error| error.at(&item.node.range))?);
            } else {
                values.push(value);
            }
        }
        Ok(values)
    }

    pub(super) fn set_of(&mut self, items: Vec<Value>) -> Outcome<Value> {
        self.budget.allocate_values(4 * items.len())?;
        let mut set = Dict::default();
        for item in items {
            set.insert(item, Value::None)?;
        }
        Ok(Value::Set(Rc::new(set)))
    }

    fn dict(&mut self, entries: &[Entry], frames: &Frames) -> Outcome<Value> {
        let mut dict = Dict::default();
        for entry in entries {
            match entry {
                Entry::Pair(key_node, value) => {
                    let key = self.evaluate(key_node, frames)?;
                    let value = self.evaluate(value, frames)?;
                    self.insert(&mut dict, key, value)
                        .map_err(|error| error.at(&key_node.range))?;
                }
                Entry::Spread(node) => {
                    let Value::Dict(spread) = self.evaluate(node, frames)? else {
                        return Err(ExpressionError::new("`**` needs a dict").at(&node.range));
                    };
                    for (key, value) in spread.entries() {
                        self.insert(&mut dict, key.clone(), value.clone())?;
                    }
                }
            }
        }
        Ok(Value::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
    }

    pub(super) fn insert(&mut self, dict: &mut Dict, key: Value, value: Value) -> Outcome<()> {
        self.budget.step()?;
        self.budget.allocate_values(4)?;
        dict.insert(key, value)
    }

    fn comprehension(
        &mut self,
        comprehension: &Rc<Comprehension>,
        frames: &Frames,
    ) -> Outcome<Value> {
        // The first iterable is evaluated in the outer frames, as in Python.
        let first = &comprehension.clauses[0].iterable;
        let iterable = self.evaluate(first, frames)?;
        let iterator = self.iterate(&iterable).map_err(|error| error.at(&first.range))?;
        let generator =
            Generator::new(comprehension.clone(), iterator, frames.clone(), self.source.clone());
        let generator = IteratorHandle::new(State::Generator(generator))?;
        match comprehension.shape {
            Shape::Generator => Ok(Value::Iterator(generator)),
            Shape::List => self.drain(&generator).and_then(Value::list),
            Shape::Set => {
                let items = self.drain(&generator)?;
                self.set_of(items)
            }
            Shape::Dict => {
                let mut dict = Dict::default();
                while let Some(pair) = self.next(&generator)? {
                    if let Value::Tuple(pair) = pair {
                        self.insert(&mut dict, pair.items()[0].clone(), pair.items()[1].clone())?;
                    }
                }
                Ok(Value::Dict(DictHandle { dict: Rc::new(dict), is_dotted: false }))
            }
        }
    }

    /// Frames with the target's names bound to a value.
    pub(super) fn bind(
        &mut self,
        target: &Target,
        value: Value,
        frames: &Frames,
    ) -> Outcome<Frames> {
        let mut bindings = Vec::new();
        self.unpack(target, value, &mut bindings)?;
        self.budget.allocate_values(2 * bindings.len())?;
        Frame::new(bindings, frames).map(Some)
    }

    fn unpack(
        &mut self,
        target: &Target,
        value: Value,
        bindings: &mut Vec<(Rc<str>, Value)>,
    ) -> Outcome<()> {
        match target {
            Target::Name(name) => {
                // The last of equal names wins.
                bindings.insert(0, (name.clone(), value));
                Ok(())
            }
            Target::Tuple(targets) => {
                let values = self.collect(&value)?;
                if values.len() != targets.len() {
                    return fail(format!(
                        "{} values cannot be unpacked into {} names",
                        values.len(),
                        targets.len()
                    ));
                }
                for (target, value) in targets.iter().zip(values) {
                    self.unpack(target, value, bindings)?;
                }
                Ok(())
            }
        }
    }

    /// First operand whose truth value is `wanted`, or the last.
    fn until(&mut self, operands: &[Node], wanted: bool, frames: &Frames) -> Outcome<Value> {
        let mut value = Value::None;
        for operand in operands {
            value = self.evaluate(operand, frames)?;
            if value.is_true() == wanted {
                break;
            }
        }
        Ok(value)
    }

    fn comparison(
        &mut self,
        first: &Node,
        rest: &[(Comparison, Node)],
        frames: &Frames,
    ) -> Outcome<bool> {
        let mut left = self.evaluate(first, frames)?;
        let mut start = first.range.start;
        for (operator, right_node) in rest {
            let right = self.evaluate(right_node, frames)?;
            let place = start..right_node.range.end;
            if !self.compare(*operator, &left, &right).map_err(|error| error.at(&place))? {
                return Ok(false);
            }
            left = right;
            start = right_node.range.start;
        }
        Ok(true)
    }

    fn compare(&mut self, operator: Comparison, a: &Value, b: &Value) -> Outcome<bool> {
        let budget = &mut *self.budget;
        Ok(match operator {
            Comparison::Equal => compare::equal(a, b, budget)?,
            Comparison::NotEqual => !compare::equal(a, b, budget)?,
            Comparison::Less => compare::order(a, b, "<", budget)? == Some(Ordering::Less),
            Comparison::LessEqual => matches!(
                compare::order(a, b, "<=", budget)?,
                Some(Ordering::Less | Ordering::Equal)
            ),
            Comparison::Greater => compare::order(a, b, ">", budget)? == Some(Ordering::Greater),
            Comparison::GreaterEqual => matches!(
                compare::order(a, b, ">=", budget)?,
                Some(Ordering::Greater | Ordering::Equal)
            ),
            Comparison::In => self.contains(b, a)?,
            Comparison::NotIn => !self.contains(b, a)?,
            Comparison::Is => compare::is(a, b),
            Comparison::IsNot => !compare::is(a, b),
        })
    }

    fn contains(&mut self, container: &Value, element: &Value) -> Outcome<bool> {
        let Value::Iterator(iterator) = container else {
            return compare::contains(container, element, self.budget);
        };
        while let Some(item) = self.next(iterator)? {
            if compare::equal(&item, element, self.budget)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn chain(&mut self, first: &Node, rest: &[(Binary, Node)], frames: &Frames) -> Outcome<Value> {
        let mut left = self.evaluate(first, frames)?;
        for (operator, right) in rest {
            let value = self.evaluate(right, frames)?;
            self.budget.step()?;
            left = operators::binary(*operator, &left, &value, self.budget)
                .map_err(|error| error.at(&(first.range.start..right.range.end)))?;
        }
        Ok(left)
    }

    fn power(&mut self, operands: &(Node, Node), frames: &Frames) -> Outcome<Value> {
        let base = self.evaluate(&operands.0, frames)?;
        let exponent = self.evaluate(&operands.1, frames)?;
        operators::binary(Binary::Power, &base, &exponent, self.budget)
    }

    fn subscript(&mut self, object: &Node, index: &Index, frames: &Frames) -> Outcome<Value> {
        let object = self.evaluate(object, frames)?;
        match index {
            Index::Item(node) => {
                let index = self.evaluate(node, frames)?;
                subscript::item(&object, &index, self.budget)
            }
            Index::Slice { start, stop, step } => {
                let mut bound = |node: &Option<Node>| {
                    node.as_ref().map(|node| self.evaluate(node, frames)).transpose()
                };
                let bounds = [bound(start)?, bound(stop)?, bound(step)?];
                subscript::slice(&object, &bounds, self.budget)
            }
        }
    }

    fn attribute_node(
        &mut self,
        object: &Node,
        name: &Rc<str>,
        node: &Node,
        frames: &Frames,
    ) -> Outcome<Value> {
        let object = self.evaluate(object, frames)?;
        let place = node.range.end - name.len()..node.range.end;
        self.attribute(object, name).map_err(|error| error.at(&place))
    }

    /// `object.name`.
    pub(super) fn attribute(&mut self, object: Value, name: &Rc<str>) -> Outcome<Value> {
        match &object {
            Value::Module(module) => return globals::member(*module, name),
            Value::Namespace(namespace) => {
                return match self
                    .scope
                    .member(namespace, name, self.budget)
                    .map_err(ExpressionError::unplaced)?
                {
                    Some(value) => Ok(value),
                    None => {
                        let known = self.scope.member_names(namespace);
                        let guess = closest(name, known.iter().map(String::as_str))
                            .map(|found| format!("; did you mean `{found}`?"))
                            .unwrap_or_default();
                        fail(format!("the namespace `{namespace}` has no `{name}`{guess}"))
                    }
                };
            }
            Value::Range(range) => match &**name {
                "start" => return Ok(Value::Int(range.start)),
                "stop" => return Ok(Value::Int(range.stop)),
                "step" => return Ok(Value::Int(range.step)),
                _ => {}
            },
            _ => {}
        }
        if methods::names(&object).contains(&&**name) {
            return Ok(Value::Function(Callable::Method(Rc::new(Bound {
                object,
                name: name.clone(),
            }))));
        }
        match &object {
            Value::Dict(dict) if dict.is_dotted => dict
                .get_text(name)
                .map(|value| value.clone().dotted())
                .ok_or_else(|| subscript::missing_key(dict, name)),
            _ => Err(methods::unknown(&object, name)),
        }
    }
}
