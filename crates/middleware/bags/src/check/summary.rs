//! Validation of the summary section.

use std::collections::BTreeMap;

use super::data::Data;
use super::{Faults, record_at};
use crate::record::{Channel, ChunkIndex, Cursor, Footer, PREFIX, Schema, Statistics, op};

/// Start and end of the records of each opcode.
type Groups = BTreeMap<u8, (u64, u64)>;

pub(super) fn check(
    bytes: &[u8],
    data: &Data,
    footer: Footer,
    footer_at: usize,
    faults: &mut Faults,
) {
    if footer.summary == 0 {
        return faults.unless(
            data.end == footer_at,
            data.end,
            "there is data after the data section",
        );
    }
    faults.unless(
        footer.summary == data.end as u64,
        footer_at,
        "the summary must follow the data section",
    );
    let crc_at = footer_at + PREFIX + 16;
    let sum = crc32fast::hash(&bytes[data.end.min(crc_at)..crc_at]);
    faults.unless(
        footer.crc == 0 || footer.crc == sum,
        crc_at,
        "the checksum of the summary is wrong",
    );

    let mut groups = Groups::new();
    let mut offsets = Groups::new();
    let mut found = Found::default();
    let mut at = data.end;
    while at < footer_at {
        let Some((opcode, content)) = record_at(bytes, at) else {
            return faults.add(at, "a record of the summary is truncated");
        };
        let next = at + PREFIX + content.len();
        if opcode == op::SUMMARY_OFFSET {
            if offsets.is_empty() {
                faults.unless(
                    footer.offsets == at as u64,
                    at,
                    "the footer has a wrong summary offset start",
                );
            }
            let mut cursor = Cursor::new(content);
            match (cursor.u8(), cursor.u64(), cursor.u64()) {
                // Some writers add offsets of empty groups.
                (Some(_), Some(_), Some(0)) => {}
                (Some(kind), Some(start), Some(length)) => {
                    offsets.insert(kind, (start, start.saturating_add(length)));
                }
                _ => faults.add(at, "a summary offset is truncated"),
            }
        } else {
            let group = groups.entry(opcode).or_insert((at as u64, at as u64));
            faults.unless(
                group.1 == at as u64,
                at,
                "records with the same opcode must be contiguous",
            );
            group.1 = next as u64;
            found.take(at, opcode, content, faults);
        }
        at = next;
    }
    faults.unless(at == footer_at, footer_at, "the summary overlaps the footer");
    let right = offsets.is_empty() || offsets == groups;
    faults.unless(right, footer_at, "the summary offsets do not match the summary");
    found.compare(data, footer_at, faults);
}

#[derive(Default)]
struct Found {
    schemas: BTreeMap<u16, Schema>,
    channels: BTreeMap<u16, Channel>,
    chunks: Vec<ChunkIndex>,
    metadata: Vec<(u64, u64)>,
    statistics: Option<Statistics>,
}

impl Found {
    fn take(&mut self, at: usize, opcode: u8, content: &[u8], faults: &mut Faults) {
        let is_read = match opcode {
            op::SCHEMA => {
                Schema::parse(content).map(|one| self.schemas.insert(one.id, one)).is_some()
            }
            op::CHANNEL => {
                Channel::parse(content).map(|one| self.channels.insert(one.id, one)).is_some()
            }
            op::CHUNK_INDEX => {
                ChunkIndex::parse(content).map(|one| self.chunks.push(one)).is_some()
            }
            op::STATISTICS => {
                self.statistics = Statistics::parse(content);
                self.statistics.is_some()
            }
            op::METADATA_INDEX => {
                let mut cursor = Cursor::new(content);
                let place = cursor.u64().zip(cursor.u64());
                self.metadata.extend(place);
                place.is_some()
            }
            op::ATTACHMENT_INDEX => true,
            _ => false,
        };
        faults.unless(is_read, at, "a record of the summary is truncated or has an unknown opcode");
    }

    /// Schemas and channels are optional, but only as a whole.
    fn compare(&self, data: &Data, at: usize, faults: &mut Faults) {
        let right = self.schemas.is_empty() || self.schemas == data.schemas;
        faults.unless(right, at, "the schemas of the summary differ from those of the data");
        let right = self.channels.is_empty() || self.channels == data.channels;
        faults.unless(right, at, "the channels of the summary differ from those of the data");
        faults.unless(self.chunks == data.chunks, at, "the chunk indexes do not match the chunks");
        faults.unless(self.metadata == data.metadata, at, "the metadata indexes are wrong");
        let sums = self.statistics.as_ref();
        let right = sums.is_none_or(|sums| *sums == data.statistics);
        faults.unless(right, at, "the statistics do not match the data");
    }
}
