//! Writes compressed chunks and records their offsets.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::Settings;
use super::chunk::Chunk;
use super::topics::Topics;
use crate::record::{
    ChunkHead, ChunkIndex, Footer, MAGIC, PREFIX, Statistics, begin, end, op, put_message_index,
    put_metadata, put_metadata_index, put_summary_offset, put_text,
};
use crate::{BagInfo, Compression, FileInfo, Stored};

/// Name of rosbag2's metadata record in a file.
const METADATA: &str = "rosbag2";

/// A sink with a byte count and checksums.
struct Counter<W> {
    sink: W,
    written: u64,
    crc: crc32fast::Hasher,
}

impl<W: Write> Counter<W> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sink.write_all(bytes)?;
        self.written += bytes.len() as u64;
        self.crc.update(bytes);
        Ok(())
    }
}

/// State of the file after the open chunk.
pub(super) struct Sealer<W> {
    out: Counter<W>,
    compression: Compression,
    chunks: Vec<ChunkIndex>,
    /// Offsets and lengths of the metadata records.
    metadata: Vec<(u64, u64)>,
    scratch: Vec<u8>,
}

impl<W: Write> Sealer<W> {
    /// Starts the file: magic, header, and the metadata that readers of a truncated file need.
    pub(super) fn new(sink: W, settings: &Settings) -> io::Result<Self> {
        let out = Counter { sink, written: 0, crc: crc32fast::Hasher::new() };
        let mut head = MAGIC.to_vec();
        let start = begin(&mut head, op::HEADER);
        put_text(&mut head, "ros2");
        put_text(&mut head, "periplus");
        end(&mut head, start, 0);
        let mut sealer = Self {
            out,
            compression: settings.compression,
            chunks: Vec::new(),
            metadata: Vec::new(),
            scratch: Vec::new(),
        };
        sealer.out.put(&head)?;
        let info = BagInfo {
            ros_distro: settings.ros_distro.clone(),
            custom_data: settings.custom_data.clone(),
            ..BagInfo::default()
        };
        sealer.put_metadata(&info, settings)?;
        sealer.out.sink.flush()?;
        Ok(sealer)
    }

    fn put_metadata(&mut self, info: &BagInfo, settings: &Settings) -> io::Result<()> {
        let text = info.body(settings.style, 0, &Stored::default());
        let map = BTreeMap::from([("serialized_metadata".to_owned(), text)]);
        self.scratch.clear();
        put_metadata(&mut self.scratch, METADATA, &map);
        self.metadata.push((self.out.written, self.scratch.len() as u64));
        self.out.put(&self.scratch)
    }

    /// Writes a compressed chunk with its schemas, channels and index, and flushes.
    pub(super) fn seal(&mut self, chunk: &Chunk) -> io::Result<()> {
        self.out.put(&chunk.preamble)?;
        if let Some((start, end)) = chunk.span {
            self.put_chunk(chunk, start, end)?;
        }
        self.out.sink.flush()
    }

    fn put_chunk(&mut self, chunk: &Chunk, start: u64, end: u64) -> io::Result<()> {
        let packed = chunk.packed.as_ref().unwrap_or(&chunk.records);
        let head = ChunkHead {
            start,
            end,
            length: chunk.records.len() as u64,
            crc: chunk.crc,
            compression: self.compression.name().into(),
            packed: packed.len() as u64,
        };
        let offset = self.out.written;
        self.scratch.clear();
        head.put(&mut self.scratch);
        self.out.put(&self.scratch)?;
        self.out.put(packed)?;
        let stored = self.out.written - offset;

        self.scratch.clear();
        let mut indexes = BTreeMap::new();
        for (channel, entries) in (0_u16..).zip(&chunk.indexes) {
            if entries.is_empty() {
                continue;
            }
            indexes.insert(channel, self.out.written + self.scratch.len() as u64);
            if entries.is_sorted() {
                put_message_index(&mut self.scratch, channel, entries);
            } else {
                let mut sorted = entries.clone();
                sorted.sort_unstable();
                put_message_index(&mut self.scratch, channel, &sorted);
            }
        }
        self.out.put(&self.scratch)?;
        self.chunks.push(ChunkIndex {
            start,
            end,
            offset,
            stored,
            indexes,
            indexes_length: self.scratch.len() as u64,
            compression: head.compression,
            packed: head.packed,
            length: head.length,
        });
        Ok(())
    }

    /// Ends the file: metadata, then the summary.
    pub(super) fn finish(
        mut self,
        topics: &Topics,
        settings: &Settings,
    ) -> io::Result<(W, BagInfo)> {
        let first = self.chunks.iter().map(|chunk| chunk.start).min();
        let last = self.chunks.iter().map(|chunk| chunk.end).max();
        let signed = |time: u64| i64::try_from(time).unwrap_or(i64::MAX);
        let span_ns = first.zip(last).map(|(first, last)| (signed(first), signed(last)));
        let messages = topics.infos.iter().map(|topic| topic.messages).sum();
        let file = FileInfo { path: settings.file_name.clone(), span_ns, messages };
        let info = BagInfo {
            topics: topics.infos.clone(),
            files: vec![file],
            ros_distro: settings.ros_distro.clone(),
            custom_data: settings.custom_data.clone(),
        };
        self.put_metadata(&info, settings)?;

        let mut tail = Vec::new();
        let at = begin(&mut tail, op::DATA_END);
        tail.extend(self.out.crc.clone().finalize().to_le_bytes());
        end(&mut tail, at, 0);
        self.out.put(&tail)?;

        let statistics = Statistics {
            messages,
            schemas: u16::try_from(topics.schemas.len()).unwrap_or(u16::MAX),
            channels: u32::try_from(topics.channels.len()).unwrap_or(u32::MAX),
            attachments: 0,
            metadata: u32::try_from(self.metadata.len()).unwrap_or(u32::MAX),
            chunks: u32::try_from(self.chunks.len()).unwrap_or(u32::MAX),
            start: first.unwrap_or(0),
            end: last.unwrap_or(0),
            by_channel: (topics.channels.iter().zip(&topics.infos))
                .filter(|(_, info)| info.messages > 0)
                .map(|(channel, info)| (channel.id, info.messages))
                .collect(),
        };
        let summary = self.summary(topics, &statistics);
        self.out.put(&summary)?;
        self.out.sink.flush()?;
        Ok((self.out.sink, info))
    }

    /// Encodes the summary, the footer and the last magic.
    fn summary(&self, topics: &Topics, statistics: &Statistics) -> Vec<u8> {
        let base = self.out.written;
        let mut out = Vec::new();
        let mut groups = Vec::new();
        let mut group = |out: &mut Vec<u8>, opcode, put: &dyn Fn(&mut Vec<u8>)| {
            let start = out.len();
            put(out);
            if out.len() > start {
                groups.push((opcode, base + start as u64, (out.len() - start) as u64));
            }
        };
        group(&mut out, op::SCHEMA, &|out| topics.schemas.iter().for_each(|one| one.put(out)));
        group(&mut out, op::CHANNEL, &|out| topics.channels.iter().for_each(|one| one.put(out)));
        group(&mut out, op::STATISTICS, &|out| statistics.put(out));
        group(&mut out, op::CHUNK_INDEX, &|out| self.chunks.iter().for_each(|one| one.put(out)));
        group(&mut out, op::METADATA_INDEX, &|out| {
            for &(offset, length) in &self.metadata {
                put_metadata_index(out, offset, length, METADATA);
            }
        });
        let offsets = base + out.len() as u64;
        for (opcode, offset, length) in groups {
            put_summary_offset(&mut out, opcode, offset, length);
        }
        // The checksum covers the footer up to its own field.
        let footer = out.len();
        Footer { summary: base, offsets, crc: 0 }.put(&mut out);
        let crc_at = footer + PREFIX + 16;
        let crc = crc32fast::hash(&out[..crc_at]);
        out[crc_at..].copy_from_slice(&crc.to_le_bytes());
        out.extend(MAGIC);
        out
    }
}
