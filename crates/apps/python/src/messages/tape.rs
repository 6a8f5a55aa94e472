//! Decoded values of messages, in the order of their types.

use std::cell::RefCell;
use std::sync::Arc;

use periplus::msgs::{Codec, Count, DecodeError, Format, Number, NumberVec, Sink, Source, decode};
use periplus_rosidl::ArrayShape;

use super::plan::{Element, Plan, PlanField};

/// Values of messages, one after the other. It needs no interpreter.
#[derive(Default)]
pub(crate) struct Tape {
    numbers: Vec<Number>,
    texts: Vec<String>,
    arrays: Vec<NumberVec>,
    lengths: Vec<usize>,
}

/// Values of a tape, in order.
pub(crate) struct TapeReader {
    pub(crate) numbers: std::vec::IntoIter<Number>,
    pub(crate) texts: std::vec::IntoIter<String>,
    pub(crate) arrays: std::vec::IntoIter<NumberVec>,
    pub(crate) lengths: std::vec::IntoIter<usize>,
}

thread_local! {
    /// Type and values of the message that this thread decodes: a [`Codec`] has no other access to them.
    static CURRENT: RefCell<Option<(Arc<Plan>, Tape)>> = const { RefCell::new(None) };
}

impl Tape {
    /// Appends the values of a message. Appends nothing if it cannot be decoded.
    pub(crate) fn append(
        &mut self,
        plan: &Arc<Plan>,
        format: Format,
        bytes: &[u8],
    ) -> Result<(), DecodeError> {
        let marks = (self.numbers.len(), self.texts.len(), self.arrays.len(), self.lengths.len());
        let own = std::mem::take(self);
        CURRENT.with(|current| *current.borrow_mut() = Some((plan.clone(), own)));
        let decoded = decode::<Recorded>(format, bytes);
        if let Some((_, tape)) = CURRENT.with(|current| current.borrow_mut().take()) {
            *self = tape;
        }
        if decoded.is_err() {
            self.numbers.truncate(marks.0);
            self.texts.truncate(marks.1);
            self.arrays.truncate(marks.2);
            self.lengths.truncate(marks.3);
        }
        decoded.map(|_| ())
    }

    /// Reads the values.
    pub(crate) fn read(self) -> TapeReader {
        TapeReader {
            numbers: self.numbers.into_iter(),
            texts: self.texts.into_iter(),
            arrays: self.arrays.into_iter(),
            lengths: self.lengths.into_iter(),
        }
    }

    fn message(&mut self, plan: &Plan, source: &mut dyn Source) -> Result<(), DecodeError> {
        let mut names = plan.fields.iter().map(|field| field.name.as_str());
        source.begin(&plan.type_name, &mut names)?;
        for field in &plan.fields {
            if source.enter(&field.name)? {
                self.field(field, source).map_err(|error| within(error, &field.name))?;
                source.leave();
            }
        }
        source.end(plan.fields.is_empty())
    }

    fn field(&mut self, field: &PlanField, source: &mut dyn Source) -> Result<(), DecodeError> {
        let Some(count) = count(field.shape) else { return self.one(&field.element, source) };
        let length = source.list(count, field.element.min_bytes())?;
        if let Some(kind) = field.element.number() {
            let mut numbers = kind.zeros(length);
            source.numbers(numbers.borrow_mut())?;
            self.arrays.push(numbers);
            return Ok(());
        }
        self.lengths.push(length);
        for index in 0..length {
            source.enter_element(index)?;
            self.one(&field.element, source)
                .map_err(|error| within(error, &format!("[{index}]")))?;
            source.leave();
        }
        Ok(())
    }

    fn one(&mut self, element: &Element, source: &mut dyn Source) -> Result<(), DecodeError> {
        match element {
            Element::Number(kind) => self.numbers.push(source.number(*kind)?),
            Element::Byte => self.numbers.push(source.number(periplus::msgs::NumberKind::U8)?),
            Element::Text(limit) => self.texts.push(source.text(*limit)?),
            Element::WideText(limit) => self.texts.push(source.wide_text(*limit)?),
            Element::Message(plan) => self.message(plan, source)?,
        }
        Ok(())
    }
}

/// Number of elements of a field that is a list.
pub(crate) fn count(shape: ArrayShape) -> Option<Count> {
    let narrow = |length: u64| usize::try_from(length).unwrap_or(usize::MAX);
    match shape {
        ArrayShape::One => None,
        ArrayShape::Fixed(length) => Some(Count::Fixed(narrow(length))),
        ArrayShape::Bounded(limit) => Some(Count::AtMost(narrow(limit))),
        ArrayShape::Unbounded => Some(Count::Any),
    }
}

/// Adds a field to the path of an error.
fn within(mut error: DecodeError, field: &str) -> DecodeError {
    let dot = if error.path.is_empty() || error.path.starts_with('[') { "" } else { "." };
    error.path = format!("{field}{dot}{}", error.path);
    error
}

/// Appends what it reads to the tape of this thread.
struct Recorded;

impl Codec for Recorded {
    const MIN_BYTES: usize = 0;

    fn blank() -> Self {
        Self
    }

    fn write(&self, _: &mut dyn Sink, _: Option<u32>) {}

    fn read(&mut self, source: &mut dyn Source, _: Option<u32>) -> Result<(), DecodeError> {
        let current = CURRENT.with(|current| current.borrow_mut().take());
        let Some((plan, mut tape)) = current else { return Ok(()) };
        let read = tape.message(&plan, source);
        CURRENT.with(|current| *current.borrow_mut() = Some((plan, tape)));
        read
    }
}
