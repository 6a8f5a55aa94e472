//! Writer of Thrift's compact protocol, as far as Parquet needs it
//! (<https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md>).

/// Types of fields.
const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// Lists of at least this length have it behind their head.
const LONG_LIST: usize = 15;

/// Appends an unsigned number in groups of seven bits, the lowest first.
pub(super) fn put_varint(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)) as u64
}

/// Writer of one struct with structs in it.
#[derive(Default)]
pub(super) struct CompactWriter {
    out: Vec<u8>,
    /// Number of the last field in the current struct.
    last: i16,
    /// Those of the structs around it.
    outer: Vec<i16>,
}

impl CompactWriter {
    fn field(&mut self, number: i16, kind: u8) {
        let delta = number - self.last;
        debug_assert!((1..=15).contains(&delta), "fields are written in their order");
        self.out.push((delta as u8) << 4 | kind);
        self.last = number;
    }

    fn bytes(&mut self, text: &str) {
        put_varint(&mut self.out, text.len() as u64);
        self.out.extend(text.as_bytes());
    }

    fn list(&mut self, number: i16, kind: u8, length: usize) {
        self.field(number, LIST);
        if length < LONG_LIST {
            self.out.push((length as u8) << 4 | kind);
        } else {
            self.out.push(0xf0 | kind);
            put_varint(&mut self.out, length as u64);
        }
    }

    /// Writes a field of 32 bits.
    pub(super) fn int(&mut self, number: i16, value: i32) -> &mut Self {
        self.field(number, I32);
        put_varint(&mut self.out, zigzag(value.into()));
        self
    }

    /// Writes a field of 64 bits.
    pub(super) fn long(&mut self, number: i16, value: i64) -> &mut Self {
        self.field(number, I64);
        put_varint(&mut self.out, zigzag(value));
        self
    }

    /// Writes a text.
    pub(super) fn text(&mut self, number: i16, value: &str) -> &mut Self {
        self.field(number, BINARY);
        self.bytes(value);
        self
    }

    /// Writes a list of numbers of 32 bits.
    pub(super) fn ints(&mut self, number: i16, values: &[i32]) -> &mut Self {
        self.list(number, I32, values.len());
        for value in values {
            put_varint(&mut self.out, zigzag((*value).into()));
        }
        self
    }

    /// Writes a list of texts.
    pub(super) fn texts(&mut self, number: i16, values: &[&str]) -> &mut Self {
        self.list(number, BINARY, values.len());
        for value in values {
            self.bytes(value);
        }
        self
    }

    /// Begins a list of structs: this many [`Self::open_item`] follow.
    pub(super) fn structs(&mut self, number: i16, length: usize) {
        self.list(number, STRUCT, length);
    }

    /// Begins a struct in a field.
    pub(super) fn open(&mut self, number: i16) {
        self.field(number, STRUCT);
        self.open_item();
    }

    /// Begins a struct in a list.
    pub(super) fn open_item(&mut self) -> &mut Self {
        self.outer.push(std::mem::take(&mut self.last));
        self
    }

    /// Ends a struct.
    pub(super) fn close(&mut self) {
        self.out.push(0);
        self.last = self.outer.pop().unwrap_or_default();
    }

    /// Ends the outermost struct and returns the bytes.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.out.push(0);
        self.out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_as_few_bytes_as_they_need() {
        let varint = |value| {
            let mut out = Vec::new();
            put_varint(&mut out, value);
            out
        };
        assert_eq!([varint(1), varint(300)], [vec![1], vec![0xac, 2]]);
        assert_eq!([zigzag(0), zigzag(-1), zigzag(1), zigzag(-2)], [0, 1, 2, 3]);
    }

    #[test]
    fn a_struct_has_its_fields_and_an_end() {
        let mut out = CompactWriter::default();
        out.int(1, -1).text(4, "ab");
        out.open(5);
        out.ints(2, &[3]);
        out.close();
        assert_eq!(out.finish(), [0x15, 1, 0x38, 2, b'a', b'b', 0x1c, 0x29, 0x15, 6, 0, 0]);
    }
}
