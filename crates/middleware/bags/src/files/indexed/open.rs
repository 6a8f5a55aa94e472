//! Opening of a recording for random access.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_os::fs::{self, File};

use super::chunk_cache::CachedChunks;
use super::database_file::DatabaseFile;
use super::progress::{OpenProgress, WatchedFile};
use super::stream_file::StreamFile;
use super::{IndexedBag, IndexedFile, RecordingFormat, carmen, format_of};
use crate::files::bag::{Bag, METADATA};
use crate::files::naming::content;
use crate::files::part::{Part, look_at, plain};
use crate::files::sqlite::{Database, TimeTable};
use crate::files::temporary::Temporary;
use crate::files::{BagError, Storage};
use crate::read::Block;
use crate::{Reader, Target, Translation, is_carmen};

/// Size of the start of a file that shows whether it is a CARMEN log \[bytes\].
const HEAD_BYTES: u64 = 64 << 10;

/// A file that was read while its recording is opened.
enum Pending {
    Stream { copy: Option<Temporary>, blocks: Vec<Block>, by_channel: BTreeMap<u32, usize> },
    Database { copy: Option<Temporary>, table: TimeTable },
}

pub(super) fn open(
    path: &Path,
    progress: &OpenProgress,
    cache: CachedChunks,
) -> Result<IndexedBag, BagError> {
    progress.set_total(size_of(path));
    if is_carmen_file(path)? {
        return open_carmen(path, progress, cache);
    }
    if fs::is_file(path) && !is_metadata(path) && content(path)?.is_none() {
        let why =
            "it is neither MCAP, nor a database of rosbag2, a bag of ROS 1 or a log of CARMEN";
        return Err(BagError::NoBag(path.to_owned(), why.to_owned()));
    }
    let mut pending = Vec::new();
    let mut look = |file: &Path| {
        if progress.is_cancelled() {
            return Err(BagError::Settings("opening was cancelled".to_owned()));
        }
        let (part, read) = look(file, progress)?;
        progress.finish_file(part.bytes);
        pending.push(read);
        Ok(part)
    };
    let bag = Bag::open_with(path, &mut look)?;
    let format = format_of(fs::is_dir(path), bag.storage());
    assemble(&bag, pending, format, cache)
}

/// Reads a CARMEN log into a temporary recording.
fn open_carmen(
    path: &Path,
    progress: &OpenProgress,
    cache: CachedChunks,
) -> Result<IndexedBag, BagError> {
    let (copy, faults) = carmen::convert(path, progress)?;
    let unwatched = OpenProgress::default();
    let mut pending = Vec::new();
    let mut look = |file: &Path| {
        let (part, read) = look(file, &unwatched)?;
        pending.push(read);
        Ok(part)
    };
    let bag = Bag::open_with(copy.path(), &mut look)?;
    if let Some(Pending::Stream { copy: kept, .. }) = pending.first_mut() {
        *kept = Some(copy);
    }
    let mut indexed = assemble(&bag, pending, RecordingFormat::Carmen, cache)?;
    for (line, fault) in faults {
        let wrong = format!("`{}`: line {line}: {fault}", path.display());
        indexed.findings.push(Diagnostic::warning("damaged-log", wrong));
    }
    path.clone_into(&mut indexed.path);
    indexed.bytes = size_of(path);
    Ok(indexed)
}

/// Reads the index of a file.
fn look(path: &Path, progress: &OpenProgress) -> Result<(Part, Pending), BagError> {
    let bytes = size_of(path);
    let (copy, storage, packing) = plain(path)?;
    let file_path = copy.as_ref().map_or(path, Temporary::path).to_owned();
    let (part, pending) = match storage {
        Storage::Sqlite => {
            let mut report = |fraction: f64| {
                progress.set_position((fraction.clamp(0.0, 1.0) * bytes as f64) as u64);
                if progress.is_cancelled() {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let (table, summary) = TimeTable::new(Database::open(&file_path)?, &mut report)?;
            let part = Part {
                path: path.to_owned(),
                storage,
                packing,
                topics: summary.topics,
                counts: summary.counts,
                span_ns: summary.span_ns,
                is_whole: summary.faults.is_empty(),
                faults: summary.faults,
                bytes,
                ros_distro: summary.ros_distro,
                custom_data: summary.custom_data,
            };
            (part, Pending::Database { copy, table })
        }
        Storage::Mcap | Storage::Ros1 => {
            let file = File::open(&file_path).map_err(BagError::file(&file_path))?;
            let watched = WatchedFile { file, progress, position: 0 };
            let mut reader = Reader::open(watched).map_err(BagError::read(path))?;
            let part = look_at(&mut reader, path, storage)?;
            let (blocks, by_channel) = reader.into_index();
            let part = Part { packing, bytes, ..part };
            (part, Pending::Stream { copy, blocks, by_channel })
        }
    };
    Ok((part, pending))
}

fn assemble(
    bag: &Bag,
    pending: Vec<Pending>,
    format: RecordingFormat,
    cache: CachedChunks,
) -> Result<IndexedBag, BagError> {
    let (topics, findings) = (bag.topics(), bag.findings().clone());
    let paths: Vec<PathBuf> = bag.files().map(Path::to_owned).collect();
    let mut files = Vec::new();
    for ((read, by_topic), path) in pending.into_iter().zip(bag.topics_of_parts()).zip(paths) {
        files.push(match read {
            Pending::Stream { copy, blocks, by_channel } => {
                let of_bag =
                    |(channel, topic): (u32, usize)| Some((channel, *by_topic.get(topic)?));
                let by_channel = by_channel.into_iter().filter_map(of_bag).collect();
                let file = StreamFile::new(&path, copy, blocks, by_channel, topics.len())?;
                IndexedFile::Stream(file)
            }
            Pending::Database { copy, table } => {
                IndexedFile::Database(DatabaseFile::new(table, copy, &by_topic, topics.len()))
            }
        });
    }
    let mut indexed = IndexedBag {
        path: bag.path().to_owned(),
        format,
        topics: Vec::new(),
        counts: bag.counts().to_vec(),
        span_ns: bag.span_ns(),
        bytes: bag.bytes(),
        custom_data: bag.custom_data().clone(),
        findings,
        files,
        translations: Vec::new(),
        is_cdr: topics.iter().map(|topic| topic.encoding == "cdr").collect(),
        cache,
        faults: Mutex::default(),
    };
    for topic in topics {
        let mut unused = Diagnostics::new();
        let translation = Translation::new(topic, Target::Ros2, &mut unused);
        // A topic that cannot be translated stays as it is.
        indexed.findings.append(unused);
        let described = translation.as_ref().map_or(topic, Translation::topic);
        indexed.topics.push(described.clone());
        let translation = translation.filter(|translation| !translation.is_same());
        indexed.translations.push(translation.map(Mutex::new));
    }
    Ok(indexed)
}

fn is_metadata(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name == METADATA)
}

pub(crate) fn is_carmen_file(path: &Path) -> Result<bool, BagError> {
    if !fs::is_file(path) {
        return Ok(false);
    }
    let file = File::open(path).map_err(BagError::file(path))?;
    let mut head = Vec::new();
    file.take(HEAD_BYTES).read_to_end(&mut head).map_err(BagError::file(path))?;
    Ok(!head.contains(&0) && is_carmen(&head))
}

/// Size of a file, or of the files of a folder \[bytes\].
fn size_of(path: &Path) -> u64 {
    let length = |path: &Path| fs::metadata(path).map_or(0, |about| about.len());
    if !fs::is_dir(path) {
        return length(path);
    }
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.path())
        .filter(|path| fs::is_file(path))
        .map(|path| length(&path))
        .sum()
}
