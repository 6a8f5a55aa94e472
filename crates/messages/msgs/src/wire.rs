//! What every form of a message has in common: where values go to, and where they come from.

use crate::{DecodeError, Number, NumberKind, Numbers, NumbersMut};

/// How many elements a list has by its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Always so many.
    Fixed(usize),
    /// At most so many.
    AtMost(usize),
    /// Any number.
    Any,
}

/// Takes the values of a message in their order.
pub trait Sink {
    /// A structure begins; with the full name of its type.
    fn begin(&mut self, type_name: &str);
    /// The structure ends; whether it has no fields at all.
    fn end(&mut self, is_empty: bool);
    /// The next value belongs to this field.
    fn field(&mut self, name: &str);
    /// A number.
    fn number(&mut self, number: Number);
    /// A text of at most `limit` bytes.
    fn text(&mut self, text: &str, limit: Option<u32>);
    /// A text in UTF-16 of at most `limit` units.
    fn wide_text(&mut self, text: &str, limit: Option<u32>);
    /// A list begins.
    fn list(&mut self, length: usize, count: Count);
    /// The list ends.
    fn end_list(&mut self);
    /// All elements of a list.
    fn numbers(&mut self, numbers: Numbers<'_>);
}

/// Gives the values of a message in their order.
///
/// # Errors
/// All functions fail when what is there is not what is asked for.
pub trait Source {
    /// A structure begins; with the full name of its type and the names of its fields.
    fn begin(
        &mut self,
        type_name: &str,
        fields: &mut dyn Iterator<Item = &str>,
    ) -> Result<(), DecodeError>;
    /// The structure ends; whether it has no fields at all.
    fn end(&mut self, is_empty: bool) -> Result<(), DecodeError>;
    /// Goes into a field; false when it is not given, and keeps the value that it has.
    fn enter(&mut self, name: &str) -> Result<bool, DecodeError>;
    /// Goes into an element of a list.
    fn enter_element(&mut self, index: usize) -> Result<(), DecodeError>;
    /// Leaves a field or an element.
    fn leave(&mut self);
    /// A number of this kind and of no other.
    fn number(&mut self, kind: NumberKind) -> Result<Number, DecodeError>;
    /// A text of at most `limit` bytes.
    fn text(&mut self, limit: Option<u32>) -> Result<String, DecodeError>;
    /// A text in UTF-16 of at most `limit` units.
    fn wide_text(&mut self, limit: Option<u32>) -> Result<String, DecodeError>;
    /// How many elements the list has that begins here; each takes at least `least_bytes`.
    fn list(&mut self, count: Count, least_bytes: usize) -> Result<usize, DecodeError>;
    /// All elements of a list, which has as many as there is room.
    fn numbers(&mut self, numbers: NumbersMut<'_>) -> Result<(), DecodeError>;
}
