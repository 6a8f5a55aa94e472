//! Lazy iteration, as in Python: `any(...)` stops at the first hit.

use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;

use super::ast::Comprehension;
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::{Frames, Interpreter};
use super::value::{PythonList, PythonRange, Sequence, Value, ViewKind};

/// Iterator; its clones share the position.
#[derive(Clone)]
pub struct IteratorHandle(Rc<Cell>);

struct Cell {
    state: RefCell<State>,
    depth: u32,
}

pub(super) enum State {
    /// Being advanced, failed, or at the end.
    Done,
    List {
        list: PythonList,
        next: usize,
    },
    Tuple {
        items: Rc<Sequence>,
        next: usize,
    },
    Letters {
        text: Rc<str>,
        next: usize,
    },
    Range {
        range: PythonRange,
        next: i128,
    },
    Values(std::vec::IntoIter<Value>),
    Map {
        function: Value,
        sources: Vec<IteratorHandle>,
    },
    /// `filter`; without a function it uses the truth value of the elements.
    Filter {
        function: Option<Value>,
        source: IteratorHandle,
    },
    Zip(Vec<IteratorHandle>),
    Enumerate {
        source: IteratorHandle,
        next: i128,
    },
    Generator(Generator),
}

/// Running comprehension.
pub(super) struct Generator {
    comprehension: Rc<Comprehension>,
    /// Per active `for` clause: its iterator and frames.
    levels: Vec<(IteratorHandle, Frames)>,
    source: Rc<str>,
}

impl Generator {
    pub(super) fn new(
        comprehension: Rc<Comprehension>,
        first: IteratorHandle,
        frames: Frames,
        source: Rc<str>,
    ) -> Self {
        Self { comprehension, levels: vec![(first, frames)], source }
    }
}

impl IteratorHandle {
    pub(super) fn new(state: State) -> Outcome<Self> {
        let of_handles = |handles: &[Self]| handles.iter().map(Self::depth).max().unwrap_or(0);
        let inner = match &state {
            State::Done | State::Letters { .. } | State::Range { .. } => 0,
            State::List { list, .. } => {
                list.items.items().iter().map(Value::depth).max().unwrap_or(0)
            }
            State::Tuple { items, .. } => items.items().iter().map(Value::depth).max().unwrap_or(0),
            State::Values(values) => values.as_slice().iter().map(Value::depth).max().unwrap_or(0),
            State::Map { function, sources } => function.depth().max(of_handles(sources)),
            State::Filter { function, source } => {
                function.as_ref().map_or(0, Value::depth).max(source.depth())
            }
            State::Zip(sources) => of_handles(sources),
            State::Enumerate { source, .. } => source.depth(),
            State::Generator(generator) => {
                let levels = generator.levels.iter();
                levels
                    .map(|(iterator, frames)| {
                        iterator.depth().max(frames.as_ref().map_or(0, |frame| frame.depth()))
                    })
                    .max()
                    .unwrap_or(0)
            }
        };
        if inner >= 100 {
            return fail("iterators are nested too deeply");
        }
        Ok(Self(Rc::new(Cell { state: RefCell::new(state), depth: inner + 1 })))
    }

    pub(super) fn depth(&self) -> u32 {
        self.0.depth
    }

    pub(super) fn is_same(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for IteratorHandle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("<iterator>")
    }
}

impl Interpreter<'_> {
    /// Iterator over a value; an iterator returns itself.
    pub(super) fn iterate(&mut self, value: &Value) -> Outcome<IteratorHandle> {
        let state = match value {
            Value::Iterator(iterator) => return Ok(iterator.clone()),
            Value::List(list) => State::List { list: list.clone(), next: 0 },
            Value::Tuple(items) => State::Tuple { items: items.clone(), next: 0 },
            Value::Str(text) => State::Letters { text: text.clone(), next: 0 },
            Value::Range(range) => State::Range { range: *range, next: 0 },
            Value::Dict(dict) => self.values(dict.entries().iter().map(|(key, _)| key.clone()))?,
            Value::Set(set) => self.values(set.entries().iter().map(|(key, _)| key.clone()))?,
            Value::View(view) => {
                let entries = view.dict.entries().iter();
                match view.kind {
                    ViewKind::Keys => self.values(entries.map(|(key, _)| key.clone()))?,
                    ViewKind::Values => self.values(entries.map(|(_, value)| value.clone()))?,
                    ViewKind::Items => {
                        self.budget.allocate_values(2 * view.dict.entries().len())?;
                        let pairs: Outcome<Vec<Value>> = entries
                            .map(|(key, value)| Value::tuple(vec![key.clone(), value.clone()]))
                            .collect();
                        State::Values(pairs?.into_iter())
                    }
                }
            }
            other => {
                let error = ExpressionError::new(format!(
                    "a `{}` cannot be walked through",
                    other.type_name()
                ));
                return Err(if other.number().is_some() {
                    error.with_help("for a count, use range(...)")
                } else {
                    error
                });
            }
        };
        IteratorHandle::new(state)
    }

    fn values(&mut self, values: impl ExactSizeIterator<Item = Value>) -> Outcome<State> {
        self.budget.allocate_values(values.len())?;
        self.budget.steps(values.len() as u64 / 16)?;
        Ok(State::Values(values.collect::<Vec<_>>().into_iter()))
    }

    /// All elements of a value.
    pub(super) fn collect(&mut self, value: &Value) -> Outcome<Vec<Value>> {
        let iterator = self.iterate(value)?;
        self.drain(&iterator)
    }

    /// All remaining elements.
    pub(super) fn drain(&mut self, iterator: &IteratorHandle) -> Outcome<Vec<Value>> {
        let mut values = Vec::new();
        while let Some(value) = self.next(iterator)? {
            // Twice, for the growth of the vector.
            self.budget.allocate(2 * size_of::<Value>() as u128)?;
            values.push(value);
        }
        Ok(values)
    }

    /// Next element.
    pub(super) fn next(&mut self, iterator: &IteratorHandle) -> Outcome<Option<Value>> {
        self.budget.step()?;
        // Removed while it advances, so that a recursive request finds the end instead of a panic.
        let mut state = iterator.0.state.replace(State::Done);
        let next = self.deeper(|interpreter| interpreter.advance(&mut state))?;
        if next.is_some() {
            iterator.0.state.replace(state);
        }
        Ok(next)
    }

    fn advance(&mut self, state: &mut State) -> Outcome<Option<Value>> {
        Ok(match state {
            State::Done => None,
            State::List { list, next } => {
                let value = list.get(*next).cloned().map(|value| value.dotted_if(list.is_dotted));
                *next += 1;
                value
            }
            State::Tuple { items, next } => {
                let value = items.items().get(*next).cloned();
                *next += 1;
                value
            }
            State::Letters { text, next } => {
                let letter = text[*next..].chars().next();
                *next += letter.map_or(0, char::len_utf8);
                self.budget.allocate(24)?;
                letter.map(|letter| Value::text(letter.to_string()))
            }
            State::Range { range, next } if *next < range.length => {
                let value = range.nth(*next);
                *next += 1;
                Some(Value::Int(value))
            }
            State::Range { .. } => None,
            State::Values(values) => values.next(),
            State::Map { function, sources } => match self.next_of_each(sources)? {
                Some(values) => Some(self.apply(function, values)?),
                None => None,
            },
            State::Filter { function, source } => loop {
                let Some(value) = self.next(source)? else { break None };
                let keep = match function {
                    Some(function) => self.apply(function, vec![value.clone()])?.is_true(),
                    None => value.is_true(),
                };
                if keep {
                    break Some(value);
                }
            },
            State::Zip(sources) => match self.next_of_each(sources)? {
                Some(values) => Some(Value::tuple(values)?),
                None => None,
            },
            State::Enumerate { source, next } => match self.next(source)? {
                Some(value) => {
                    let index = *next;
                    *next = next.checked_add(1).ok_or_else(super::number::too_large)?;
                    self.budget.allocate_values(2)?;
                    Some(Value::tuple(vec![Value::Int(index), value])?)
                }
                None => None,
            },
            State::Generator(generator) => {
                let source = generator.source.clone();
                self.in_source(&source, |interpreter| interpreter.advance_generator(generator))?
            }
        })
    }

    /// One element of each, unless one of them has ended.
    fn next_of_each(&mut self, sources: &[IteratorHandle]) -> Outcome<Option<Vec<Value>>> {
        if sources.is_empty() {
            return Ok(None);
        }
        self.budget.allocate_values(sources.len())?;
        let mut values = Vec::with_capacity(sources.len());
        for source in sources {
            match self.next(source)? {
                Some(value) => values.push(value),
                None => return Ok(None),
            }
        }
        Ok(Some(values))
    }

    fn advance_generator(&mut self, generator: &mut Generator) -> Outcome<Option<Value>> {
        let Generator { comprehension, levels, .. } = generator;
        while let Some((iterator, outer)) = levels.last() {
            let (iterator, outer) = (iterator.clone(), outer.clone());
            let Some(value) = self.next(&iterator)? else {
                levels.pop();
                continue;
            };
            let clause = &comprehension.clauses[levels.len() - 1];
            let frames = self
                .bind(&clause.target, value, &outer)
                .map_err(|error| error.at(&clause.iterable.range))?;
            let mut is_wanted = true;
            for condition in &clause.conditions {
                if !self.evaluate(condition, &frames)?.is_true() {
                    is_wanted = false;
                    break;
                }
            }
            if !is_wanted {
                continue;
            }
            if let Some(inner) = comprehension.clauses.get(levels.len()) {
                let iterable = self.evaluate(&inner.iterable, &frames)?;
                let iterator =
                    self.iterate(&iterable).map_err(|error| error.at(&inner.iterable.range))?;
                levels.push((iterator, frames));
                continue;
            }
            let element = self.evaluate(&comprehension.element, &frames)?;
            return match &comprehension.value {
                None => Ok(Some(element)),
                Some(value) => {
                    let value = self.evaluate(value, &frames)?;
                    self.budget.allocate_values(2)?;
                    Value::tuple(vec![element, value]).map(Some)
                }
            };
        }
        Ok(None)
    }
}
