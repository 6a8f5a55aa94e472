//! Reading of messages at their locations.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::chunk_cache::ChunkKey;
use super::location::MessageLocation;
use super::stream_file::StreamFile;
use super::{ChunkUse, IndexedBag, IndexedFile, lock};
use crate::files::BagError;
use crate::files::message_packing::{packing_of, unpack};

/// Maximum number of threads that decompress chunks for one request.
const MAX_THREADS: usize = 4;

/// Maximum size of the chunks that are decompressed ahead \[bytes\]; at least one is. Three chunks of
/// the usual size may overlap without being decompressed twice.
const MAX_AHEAD_BYTES: u64 = 12 << 20;

/// Records of chunks, decompressed for the next messages; none if damaged.
type Ahead = HashMap<ChunkKey, Option<Arc<Vec<u8>>>>;

pub(super) fn read(
    bag: &IndexedBag,
    locations: &[MessageLocation],
    chunks: ChunkUse,
    visit: &mut dyn FnMut(&MessageLocation, &[u8]) -> ControlFlow<()>,
) -> Result<bool, BagError> {
    let threads = match chunks {
        ChunkUse::Keep => std::thread::available_parallelism().map_or(1, usize::from),
        // No client waits for a pass over the whole recording.
        ChunkUse::Once => 1,
    };
    let threads = threads.min(MAX_THREADS);
    let mut ahead = Ahead::new();
    let mut is_complete = true;
    let mut unpacked = Vec::new();
    let mut row = Vec::new();
    for (number, location) in locations.iter().enumerate() {
        let Some(file) = bag.files.get(location.file as usize) else { continue };
        let mut records = None;
        let data = match file {
            IndexedFile::Stream(file) => {
                let Some(block) = file.block_of(location) else { continue };
                let key = (location.file as usize, block);
                if !ahead.contains_key(&key) {
                    let before = std::mem::take(&mut ahead);
                    ahead = load_ahead(bag, &locations[number..], threads, chunks, before)?;
                }
                records = ahead.get(&key).cloned().flatten().or(records);
                let data =
                    records.as_ref().and_then(|records| file.message(block, records, location));
                if records.is_some() && data.is_none() {
                    bag.fault(file.ignore_index(block));
                }
                data
            }
            IndexedFile::Database(file) => match file.load(location.at, &mut row)? {
                Ok(()) => Some(row.as_slice()),
                Err(why) => {
                    bag.fault(why);
                    None
                }
            },
        };
        let Some(data) = data else {
            is_complete = false;
            continue;
        };
        if visit_translated(bag, location, data, &mut unpacked, visit).is_break() {
            break;
        }
    }
    Ok(is_complete)
}

/// Decompresses the next chunks that the messages need, by several threads.
fn load_ahead(
    bag: &IndexedBag,
    locations: &[MessageLocation],
    threads: usize,
    chunks: ChunkUse,
    mut before: Ahead,
) -> Result<Ahead, BagError> {
    let mut ahead = Ahead::new();
    let mut missing: Vec<(ChunkKey, &StreamFile)> = Vec::new();
    let mut bytes = 0_u64;
    for location in locations {
        let Some(IndexedFile::Stream(file)) = bag.files.get(location.file as usize) else {
            continue;
        };
        let Some(block) = file.block_of(location) else { continue };
        let key = (location.file as usize, block);
        if ahead.contains_key(&key) || missing.iter().any(|(other, _)| *other == key) {
            continue;
        }
        bytes = bytes.saturating_add(file.block_bytes(block));
        let is_first = ahead.is_empty() && missing.is_empty();
        if !is_first && bytes > MAX_AHEAD_BYTES {
            break;
        }
        match before.remove(&key).or_else(|| bag.cache.get(key).map(Some)) {
            Some(kept) => {
                ahead.insert(key, kept);
            }
            None => missing.push((key, file)),
        }
    }
    let load = |(key, file): (ChunkKey, &StreamFile)| -> Result<_, BagError> {
        Ok((key, file.load(key.1)?))
    };
    // Their memory is free before more is used.
    drop(before);
    let mut loaded = Vec::new();
    for group in missing.chunks(threads.max(1)) {
        if let [one] = group {
            loaded.push(load(*one));
            continue;
        }
        std::thread::scope(|scope| {
            let running: Vec<_> =
                group.iter().copied().map(|one| scope.spawn(move || load(one))).collect();
            for one in running {
                // A panic there is a panic here.
                loaded.push(one.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            }
        });
    }
    for one in loaded {
        let (key, records) = one?;
        let records = match records {
            Ok(records) => Some(Arc::new(records)),
            Err(why) => {
                bag.fault(why);
                None
            }
        };
        if let (ChunkUse::Keep, Some(records)) = (chunks, &records) {
            bag.cache.put(key, records);
        }
        ahead.insert(key, records);
    }
    Ok(ahead)
}

/// Decompresses and translates a message, and visits it.
fn visit_translated<'a>(
    bag: &IndexedBag,
    location: &MessageLocation,
    mut data: &'a [u8],
    unpacked: &'a mut Vec<u8>,
    visit: &mut dyn FnMut(&MessageLocation, &[u8]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    if bag.is_cdr.get(location.topic) == Some(&true)
        && let Some(packing) = packing_of(data)
    {
        match unpack(packing, data, unpacked) {
            Ok(()) => data = unpacked,
            Err(why) => bag.fault(format!("a message cannot be decompressed: {why}")),
        }
    }
    let Some(Some(translation)) = bag.translations.get(location.topic) else {
        return visit(location, data);
    };
    match lock(translation).translate(data) {
        Ok(translated) => visit(location, translated),
        Err(why) => {
            let name = bag.topics.get(location.topic).map_or("", |topic| &topic.name);
            bag.fault(format!("a message of `{name}` cannot be translated: {why}"));
            ControlFlow::Continue(())
        }
    }
}
