//! Calls.

use std::rc::Rc;

use super::super::ast::{Argument, Lambda, Node, ParameterKind};
use super::super::callable::{Arguments, Callable, LambdaFunction};
use super::super::error::{ExpressionError, Outcome, fail};
use super::super::methods;
use super::super::value::{Value, depth_around};
use super::{Frame, Frames, Interpreter};

impl Interpreter<'_> {
    pub(super) fn call_node(
        &mut self,
        function: &Node,
        arguments: &[Argument],
        frames: &Frames,
    ) -> Outcome<Value> {
        let callee = self.evaluate(function, frames)?;
        let arguments = self.arguments(arguments, frames)?;
        match callee {
            Value::Function(callable) => self.call(&callable, arguments),
            other => {
                Err(ExpressionError::new(format!("a `{}` cannot be called", other.type_name()))
                    .with_help(
                        "parentheses behind a value call it; is an operator missing before them?",
                    )
                    .at(&function.range))
            }
        }
    }

    fn arguments(&mut self, nodes: &[Argument], frames: &Frames) -> Outcome<Arguments> {
        self.budget.allocate_values(nodes.len())?;
        let mut arguments = Arguments::default();
        for argument in nodes {
            match argument {
                Argument::Positional(item) if item.spread => {
                    let values = self.evaluate(&item.node, frames)?;
                    arguments
                        .positional
                        .extend(self.collect(&values).map_err(|error| error.at(&item.node.range))?);
                }
                Argument::Positional(item) => {
                    arguments.positional.push(self.evaluate(&item.node, frames)?);
                }
                Argument::Keyword(name, node) => {
                    let value = self.evaluate(node, frames)?;
                    arguments.keywords.push((name.clone(), value));
                }
                Argument::SpreadKeywords(node) => {
                    let Value::Dict(dict) = self.evaluate(node, frames)? else {
                        return Err(ExpressionError::new("`**` needs a dict").at(&node.range));
                    };
                    for (key, value) in dict.entries() {
                        self.budget.allocate_values(2)?;
                        match key {
                            Value::Str(name) => {
                                arguments.keywords.push((name.clone(), value.clone()));
                            }
                            _ => {
                                return Err(ExpressionError::new(
                                    "`**` needs a dict whose keys are text",
                                )
                                .at(&node.range));
                            }
                        }
                    }
                }
            }
        }
        let mut names: Vec<&str> = arguments.keywords.iter().map(|(name, _)| &**name).collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return fail(format!("the argument `{}` is given twice", twice[0]));
        }
        Ok(arguments)
    }

    /// Calls a value with positional arguments only.
    pub(in super::super) fn apply(
        &mut self,
        function: &Value,
        arguments: Vec<Value>,
    ) -> Outcome<Value> {
        match function {
            Value::Function(callable) => self.call(callable, Arguments::positional(arguments)),
            other => fail(format!("a `{}` cannot be called", other.type_name())),
        }
    }

    pub(in super::super) fn call(
        &mut self,
        callable: &Callable,
        arguments: Arguments,
    ) -> Outcome<Value> {
        self.budget.step()?;
        match callable {
            Callable::Builtin(builtin) => {
                self.deeper(|interpreter| (builtin.call)(interpreter, arguments))
            }
            Callable::Method(method) => self.deeper(|interpreter| {
                methods::call(interpreter, &method.object, &method.name, arguments)
            }),
            Callable::Lambda(closure) => self.call_lambda(closure, arguments),
            Callable::Host(name) => match self.scope.call_host(
                name,
                &arguments.positional,
                &arguments.keywords,
                self.budget,
            ) {
                Some(result) => result.map_err(ExpressionError::unplaced),
                None => fail(format!("`{name}` is not available here")),
            },
        }
    }

    pub(super) fn lambda(&mut self, lambda: &Rc<Lambda>, frames: &Frames) -> Outcome<Value> {
        let mut defaults = Vec::with_capacity(lambda.parameters.len());
        for parameter in &lambda.parameters {
            defaults.push(
                parameter.default.as_ref().map(|node| self.evaluate(node, frames)).transpose()?,
            );
        }
        let depth = depth_around(defaults.iter().flatten())?
            .max(frames.as_ref().map_or(0, |frame| frame.depth() + 1));
        let closure = LambdaFunction {
            lambda: lambda.clone(),
            defaults,
            frame: frames.clone(),
            source: self.source.clone(),
            depth,
        };
        Ok(Value::Function(Callable::Lambda(Rc::new(closure))))
    }

    fn call_lambda(&mut self, closure: &LambdaFunction, arguments: Arguments) -> Outcome<Value> {
        let bindings = self.bind_parameters(closure, arguments)?;
        let frames = Some(Frame::new(bindings, &closure.frame)?);
        let body = &closure.lambda.body;
        self.in_source(&closure.source, |interpreter| interpreter.evaluate(body, &frames))
    }

    /// Runs an action with another text for the locations in errors.
    pub(in super::super) fn in_source<T>(
        &mut self,
        source: &Rc<str>,
        action: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Outcome<T> {
        if Rc::ptr_eq(source, &self.source) {
            return action(self);
        }
        let own = std::mem::replace(&mut self.source, source.clone());
        let result = action(self).map_err(ExpressionError::unplaced);
        self.source = own;
        result
    }

    fn bind_parameters(
        &mut self,
        closure: &LambdaFunction,
        arguments: Arguments,
    ) -> Outcome<Vec<(Rc<str>, Value)>> {
        let Arguments { positional, mut keywords } = arguments;
        let mut positional = positional.into_iter();
        let mut bindings = Vec::with_capacity(closure.lambda.parameters.len());
        let mut takes_rest = false;
        for (parameter, default) in closure.lambda.parameters.iter().zip(&closure.defaults) {
            let name = &parameter.name;
            let value = match parameter.kind {
                ParameterKind::Rest => {
                    takes_rest = true;
                    Value::tuple(positional.by_ref().collect())?
                }
                ParameterKind::RestKeywords => Value::dict(
                    keywords.drain(..).map(|(name, value)| (Value::Str(name), value)).collect(),
                )?,
                kind => {
                    let by_place =
                        if kind == ParameterKind::Positional { positional.next() } else { None };
                    let by_name = keywords.iter().position(|(keyword, _)| keyword == name);
                    match (by_place, by_name, default) {
                        (Some(_), Some(_), _) => {
                            return fail(format!("the lambda gets the argument `{name}` twice"));
                        }
                        (Some(value), None, _) => value,
                        (None, Some(index), _) => keywords.remove(index).1,
                        (None, None, Some(default)) => default.clone(),
                        (None, None, None) => {
                            return fail(format!("the lambda needs the argument `{name}`"));
                        }
                    }
                }
            };
            bindings.push((name.clone(), value));
        }
        if positional.len() > 0 && !takes_rest {
            let takes = closure
                .lambda
                .parameters
                .iter()
                .filter(|parameter| parameter.kind == ParameterKind::Positional)
                .count();
            return fail(format!(
                "the lambda takes {takes} arguments, not {}",
                takes + positional.len()
            ));
        }
        match keywords.first() {
            Some((name, _)) => fail(format!("the lambda has no argument `{name}`")),
            None => Ok(bindings),
        }
    }
}
