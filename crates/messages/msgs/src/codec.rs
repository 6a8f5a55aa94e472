//! Conversion of values to a [`Sink`] and from a [`Source`].

use crate::{Count, DecodeError, Sink, Source};

/// Value of a field of a message.
pub trait Codec: Sized {
    /// Minimum size in any binary format [bytes]; limits the length of a list by the remaining size of the
    /// message.
    const MIN_BYTES: usize;

    /// Default value.
    fn blank() -> Self;

    /// Writes the value. `limit` is the maximum length by the type of the field.
    fn write(&self, sink: &mut dyn Sink, limit: Option<u32>);

    /// Reads the value.
    ///
    /// # Errors
    /// If the source has no such value; then it is partially read.
    fn read(&mut self, source: &mut dyn Source, limit: Option<u32>) -> Result<(), DecodeError>;

    /// Writes the elements of a list.
    fn write_all(all: &[Self], sink: &mut dyn Sink) {
        for one in all {
            one.write(sink, None);
        }
    }

    /// Reads the elements of a list.
    ///
    /// # Errors
    /// As [`Codec::read`].
    fn read_all(all: &mut [Self], source: &mut dyn Source) -> Result<(), DecodeError> {
        for (index, one) in all.iter_mut().enumerate() {
            source.enter_element(index)?;
            one.read(source, None).map_err(|error| error.within_element(index))?;
            source.leave();
        }
        Ok(())
    }
}

impl Codec for String {
    const MIN_BYTES: usize = 4;

    fn blank() -> Self {
        Self::new()
    }

    fn write(&self, sink: &mut dyn Sink, limit: Option<u32>) {
        sink.text(self, limit);
    }

    fn read(&mut self, source: &mut dyn Source, limit: Option<u32>) -> Result<(), DecodeError> {
        *self = source.text(limit)?;
        Ok(())
    }
}

/// `wstring`: text that is serialized as UTF-16.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WideString(
    /// Text.
    pub String,
);

impl From<&str> for WideString {
    fn from(text: &str) -> Self {
        Self(text.into())
    }
}

impl Codec for WideString {
    const MIN_BYTES: usize = 4;

    fn blank() -> Self {
        Self::default()
    }

    fn write(&self, sink: &mut dyn Sink, limit: Option<u32>) {
        sink.wide_text(&self.0, limit);
    }

    fn read(&mut self, source: &mut dyn Source, limit: Option<u32>) -> Result<(), DecodeError> {
        self.0 = source.wide_text(limit)?;
        Ok(())
    }
}

impl<T: Codec> Codec for Vec<T> {
    const MIN_BYTES: usize = 4;

    fn blank() -> Self {
        Self::new()
    }

    fn write(&self, sink: &mut dyn Sink, limit: Option<u32>) {
        sink.list(self.len(), at_most(limit));
        T::write_all(self, sink);
        sink.end_list();
    }

    fn read(&mut self, source: &mut dyn Source, limit: Option<u32>) -> Result<(), DecodeError> {
        let length = source.list(at_most(limit), T::MIN_BYTES)?;
        self.clear();
        self.resize_with(length, T::blank);
        T::read_all(self, source)
    }
}

impl<T: Codec, const N: usize> Codec for [T; N] {
    const MIN_BYTES: usize = T::MIN_BYTES * N;

    fn blank() -> Self {
        std::array::from_fn(|_| T::blank())
    }

    fn write(&self, sink: &mut dyn Sink, _: Option<u32>) {
        sink.list(N, Count::Fixed(N));
        T::write_all(self, sink);
        sink.end_list();
    }

    fn read(&mut self, source: &mut dyn Source, _: Option<u32>) -> Result<(), DecodeError> {
        source.list(Count::Fixed(N), T::MIN_BYTES)?;
        T::read_all(self, source)
    }
}

fn at_most(limit: Option<u32>) -> Count {
    limit.map_or(Count::Any, |limit| Count::AtMost(limit as usize))
}

/// Name of a field in messages, from its Rust name.
#[doc(hidden)]
#[must_use]
pub const fn plain(name: &'static str) -> &'static str {
    let bytes = name.as_bytes();
    if let [b'r', b'#', ..] = bytes {
        return name.split_at(2).1;
    }
    // No field name ends like this, except to avoid a keyword.
    if let [.., b'_'] = bytes { name.split_at(bytes.len() - 1).0 } else { name }
}

#[doc(hidden)]
pub fn write_field<T: Codec>(value: &T, name: &str, limit: Option<u32>, sink: &mut dyn Sink) {
    sink.field(name);
    value.write(sink, limit);
}

#[doc(hidden)]
pub fn read_field<T: Codec>(
    value: &mut T,
    name: &str,
    limit: Option<u32>,
    source: &mut dyn Source,
) -> Result<(), DecodeError> {
    if source.enter(name)? {
        value.read(source, limit).map_err(|error| error.within(name))?;
        source.leave();
    }
    Ok(())
}
