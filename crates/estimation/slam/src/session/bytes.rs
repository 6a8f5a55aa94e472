//! Values as bytes, the lowest first, and back.

use std::collections::VecDeque;
use std::ops::Range;

/// Bytes that are being written.
#[derive(Default)]
pub(crate) struct Bytes(pub(crate) Vec<u8>);

impl Bytes {
    /// A value by itself.
    pub(crate) fn of(value: &impl Pack) -> Self {
        let mut out = Self::default();
        value.pack(&mut out);
        out
    }
}

/// Fault of a value.
pub(crate) struct Fault(pub(crate) String);

/// Bytes that are being read.
#[derive(Clone)]
pub(crate) struct Reader<'a> {
    rest: &'a [u8],
    /// Offset of the start of `rest` in the file.
    at: usize,
}

impl<'a> Reader<'a> {
    /// All bytes of a file but the first few.
    pub(crate) fn new(file: &'a [u8], at: usize) -> Self {
        Self::within(&file[at.min(file.len())..], at)
    }

    /// Bytes at an offset in the file.
    pub(crate) fn within(rest: &'a [u8], at: usize) -> Self {
        Self { rest, at }
    }

    pub(crate) fn at(&self) -> usize {
        self.at
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        if count > self.rest.len() {
            return Err(Fault(format!(
                "{count} bytes are wanted here, and {} are left",
                self.rest.len()
            )));
        }
        let (taken, rest) = self.rest.split_at(count);
        self.rest = rest;
        self.at += count;
        Ok(taken)
    }
}

/// Values that can be written and read.
pub(crate) trait Pack: Sized {
    fn pack(&self, out: &mut Bytes);
    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault>;
}

/// Implements [`Pack`] for a struct as its fields in this order. A new field changes the format: increase
/// its version.
macro_rules! packed {
    ($name:ident { $($field:ident),* $(,)? }) => {
        impl $crate::session::Pack for $name {
            fn pack(&self, out: &mut $crate::session::Bytes) {
                let Self { $($field),* } = self;
                $($crate::session::Pack::pack($field, out);)*
            }

            fn unpack(
                from: &mut $crate::session::Reader<'_>,
            ) -> Result<Self, $crate::session::Fault> {
                Ok(Self { $($field: $crate::session::Pack::unpack(from)?),* })
            }
        }
    };
}
pub(crate) use packed;

macro_rules! numbers {
    ($($kind:ty),*) => {$(
        impl Pack for $kind {
            fn pack(&self, out: &mut Bytes) {
                out.0.extend_from_slice(&self.to_le_bytes());
            }

            fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
                let mut bytes = [0; size_of::<$kind>()];
                bytes.copy_from_slice(from.take(size_of::<$kind>())?);
                Ok(Self::from_le_bytes(bytes))
            }
        }
    )*};
}

/// No count is larger.
const MAX_COUNT: u64 = 1 << 48;

numbers!(u8, u32, u64, i64, f32, f64);

impl Pack for usize {
    fn pack(&self, out: &mut Bytes) {
        (*self as u64).pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let value = u64::unpack(from)?;
        // Counts go on from here, and must not overflow for it.
        let value = Some(value).filter(|&value| value < MAX_COUNT).ok_or(value);
        value
            .and_then(|value| Self::try_from(value).map_err(|_| value))
            .map_err(|value| Fault(format!("{value} is too large a number")))
    }
}

impl Pack for bool {
    fn pack(&self, out: &mut Bytes) {
        u8::from(*self).pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        match u8::unpack(from)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Fault(format!("{other} is neither yes nor no"))),
        }
    }
}

impl<T: Pack> Pack for Option<T> {
    fn pack(&self, out: &mut Bytes) {
        self.is_some().pack(out);
        if let Some(value) = self {
            value.pack(out);
        }
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        bool::unpack(from)?.then(|| T::unpack(from)).transpose()
    }
}

impl<T: Pack> Pack for Vec<T> {
    fn pack(&self, out: &mut Bytes) {
        self.len().pack(out);
        self.iter().for_each(|it| it.pack(out));
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let count = usize::unpack(from)?;
        // Every value takes a byte at least, so that no promise of many can be kept for free.
        if count > from.rest.len() {
            return Err(Fault(format!("there is no room for {count} values")));
        }
        // Not reserved: a list grows as its values turn out to be there.
        let mut values = Self::new();
        for _ in 0..count {
            values.push(T::unpack(from)?);
        }
        Ok(values)
    }
}

impl<T: Pack> Pack for VecDeque<T> {
    fn pack(&self, out: &mut Bytes) {
        self.len().pack(out);
        self.iter().for_each(|it| it.pack(out));
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        Vec::unpack(from).map(Self::from)
    }
}

impl<T: Pack + Copy + Default, const N: usize> Pack for [T; N] {
    fn pack(&self, out: &mut Bytes) {
        self.iter().for_each(|it| it.pack(out));
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let mut all = [T::default(); N];
        for one in &mut all {
            *one = T::unpack(from)?;
        }
        Ok(all)
    }
}

impl<A: Pack, B: Pack> Pack for (A, B) {
    fn pack(&self, out: &mut Bytes) {
        self.0.pack(out);
        self.1.pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        Ok((A::unpack(from)?, B::unpack(from)?))
    }
}

impl Pack for Range<usize> {
    fn pack(&self, out: &mut Bytes) {
        (self.start, self.end).pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let (start, end) = Pack::unpack(from)?;
        if start > end {
            return Err(Fault(format!("a range from {start} ends at {end}")));
        }
        Ok(start..end)
    }
}

impl Pack for String {
    fn pack(&self, out: &mut Bytes) {
        self.len().pack(out);
        out.0.extend_from_slice(self.as_bytes());
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let count = usize::unpack(from)?;
        let text = from.take(count)?;
        Self::from_utf8(text.to_vec()).map_err(|_| Fault("a text is not UTF-8".into()))
    }
}
