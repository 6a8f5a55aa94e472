//! Tables as Apache Parquet files.
//!
//! A file has one row group and one page for each column: nullable values, encoding PLAIN, without compression. The format
//! is that of <https://parquet.apache.org/docs/file-format/>: the pages, then the metadata in Thrift's compact
//! protocol ([`thrift`]), its length, and the magic number at both ends. The same table gives the same bytes.

mod thrift;

use crate::table::{Column, ColumnValues, SweepTable};
use thrift::CompactWriter;

/// Magic number at the start and at the end of a file.
const MAGIC: &[u8; 4] = b"PAR1";

/// Values of enums in `parquet.thrift`.
mod code {
    pub(super) const BOOLEAN: i32 = 0;
    pub(super) const INT64: i32 = 2;
    pub(super) const DOUBLE: i32 = 5;
    pub(super) const BYTE_ARRAY: i32 = 6;
    pub(super) const OPTIONAL: i32 = 1;
    pub(super) const CONVERTED_UTF8: i32 = 0;
    pub(super) const PLAIN: i32 = 0;
    pub(super) const RLE: i32 = 3;
    pub(super) const UNCOMPRESSED: i32 = 0;
    pub(super) const DATA_PAGE: i32 = 0;
}

/// A column that is written.
struct Written<'a> {
    column: &'a Column,
    /// Position of the page in the file \[bytes\].
    offset: usize,
    /// Size of the page with its header \[bytes\].
    size: usize,
}

/// Bytes of a Parquet file. `created_by` names the writer, and `metadata` are pairs of texts in the file.
#[must_use]
pub fn write_parquet(table: &SweepTable, created_by: &str, metadata: &[(&str, &str)]) -> Vec<u8> {
    let mut out = MAGIC.to_vec();
    let mut written = Vec::new();
    for column in &table.columns {
        let offset = out.len();
        let page = page(&column.values);
        out.extend(page_header(page.len(), table.row_count));
        out.extend(page);
        written.push(Written { column, offset, size: out.len() - offset });
    }
    let footer = footer(table.row_count, &written, created_by, metadata);
    out.extend(&footer);
    out.extend(length(footer.len()).to_le_bytes());
    out.extend(MAGIC);
    out
}

/// Length as the format has it. A table of [`crate::MAX_RUNS`] rows is far below its limit.
fn length(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

fn number(value: usize) -> i64 {
    i64::try_from(value).unwrap_or(i64::MAX)
}

fn small(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX)
}

fn physical_type(values: &ColumnValues) -> i32 {
    match values {
        ColumnValues::Bool(_) => code::BOOLEAN,
        ColumnValues::Int(_) => code::INT64,
        ColumnValues::Double(_) => code::DOUBLE,
        ColumnValues::Text(_) => code::BYTE_ARRAY,
    }
}

/// Content of a page: definition levels, then the values that are not null.
fn page(values: &ColumnValues) -> Vec<u8> {
    match values {
        ColumnValues::Bool(values) => {
            let mut out = levels(values);
            let given: Vec<bool> = values.iter().flatten().copied().collect();
            let byte = |bits: &[bool]| {
                bits.iter().enumerate().fold(0, |byte, (place, bit)| byte | u8::from(*bit) << place)
            };
            out.extend(given.chunks(8).map(byte));
            out
        }
        ColumnValues::Int(values) => plain(values, |it, out| out.extend(it.to_le_bytes())),
        ColumnValues::Double(values) => plain(values, |it, out| out.extend(it.to_le_bytes())),
        ColumnValues::Text(values) => plain(values, |it, out| {
            out.extend(length(it.len()).to_le_bytes());
            out.extend(it.as_bytes());
        }),
    }
}

fn plain<T>(values: &[Option<T>], put: impl Fn(&T, &mut Vec<u8>)) -> Vec<u8> {
    let mut out = levels(values);
    for value in values.iter().flatten() {
        put(value, &mut out);
    }
    out
}

/// Definition levels (0 for null, 1 for a value) as runs of equal ones, with their length in bytes before them.
fn levels<T>(values: &[Option<T>]) -> Vec<u8> {
    let mut runs = Vec::new();
    for run in values.chunk_by(|a, b| a.is_some() == b.is_some()) {
        thrift::put_varint(&mut runs, (run.len() as u64) << 1);
        runs.push(u8::from(run[0].is_some()));
    }
    let mut out = length(runs.len()).to_le_bytes().to_vec();
    out.extend(runs);
    out
}

fn page_header(size: usize, rows: usize) -> Vec<u8> {
    let mut out = CompactWriter::default();
    out.int(1, code::DATA_PAGE).int(2, small(size)).int(3, small(size));
    out.open(5);
    out.int(1, small(rows)).int(2, code::PLAIN).int(3, code::RLE).int(4, code::RLE);
    out.close();
    out.finish()
}

fn footer(
    rows: usize,
    written: &[Written<'_>],
    created_by: &str,
    metadata: &[(&str, &str)],
) -> Vec<u8> {
    let mut out = CompactWriter::default();
    out.int(1, 1);
    out.structs(2, written.len() + 1);
    out.open_item().text(4, "schema").int(5, small(written.len()));
    out.close();
    for Written { column, .. } in written {
        out.open_item().int(1, physical_type(&column.values)).int(3, code::OPTIONAL);
        out.text(4, &column.name);
        if matches!(column.values, ColumnValues::Text(_)) {
            out.int(6, code::CONVERTED_UTF8);
            // The logical type STRING: the first member of the union, an empty struct.
            out.open(10);
            out.open(1);
            out.close();
            out.close();
        }
        out.close();
    }
    out.long(3, number(rows));
    out.structs(4, 1);
    out.open_item();
    out.structs(1, written.len());
    for Written { column, offset, size } in written {
        out.open_item().long(2, number(*offset));
        out.open(3);
        out.int(1, physical_type(&column.values)).ints(2, &[code::PLAIN, code::RLE]);
        out.texts(3, &[&column.name]).int(4, code::UNCOMPRESSED);
        out.long(5, number(rows)).long(6, number(*size)).long(7, number(*size));
        out.long(9, number(*offset));
        out.close();
        out.close();
    }
    let size = written.iter().map(|it| it.size).sum();
    out.long(2, number(size)).long(3, number(rows));
    out.close();
    if !metadata.is_empty() {
        out.structs(5, metadata.len());
        for (name, value) in metadata {
            out.open_item().text(1, name).text(2, value);
            out.close();
        }
    }
    out.text(6, created_by);
    out.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_runs() {
        // Two values, one null: the runs (2 << 1, 1) and (1 << 1, 0).
        assert_eq!(levels(&[Some(1), Some(2), None]), [4, 0, 0, 0, 4, 1, 2, 0]);
        assert_eq!(levels::<u8>(&[]), [0, 0, 0, 0]);
    }

    #[test]
    fn values_are_plain() {
        let bits: Vec<Option<bool>> = [true, false, true, true].map(Some).into();
        assert_eq!(page(&ColumnValues::Bool(bits))[6..], [0b1101]);
        let text = ColumnValues::Text(vec![None, Some("ab".into())]);
        assert_eq!(page(&text)[8..], [2, 0, 0, 0, b'a', b'b']);
        let number = ColumnValues::Int(vec![Some(-2)]);
        assert_eq!(page(&number)[6..], [0xfe, 255, 255, 255, 255, 255, 255, 255]);
    }

    #[test]
    fn a_file_begins_and_ends_with_the_magic_number() {
        let values = ColumnValues::Int(vec![Some(1)]);
        let column = Column { name: "a".into(), values, is_metric: false };
        let table = SweepTable { columns: vec![column], row_count: 1 };
        let file = write_parquet(&table, "periplus", &[("scenario", "x")]);
        assert!(file.starts_with(MAGIC) && file.ends_with(MAGIC));
        let end = file.len() - 8;
        let footer = u32::from_le_bytes(file[end..end + 4].try_into().unwrap()) as usize;
        // Version 1 as the first field.
        assert_eq!(file[end - footer..][..2], [0x15, 2]);
        assert_eq!(file, write_parquet(&table, "periplus", &[("scenario", "x")]));
    }
}
