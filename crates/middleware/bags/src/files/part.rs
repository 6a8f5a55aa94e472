//! A file of a bag.

use std::collections::BTreeMap;
use std::io::{Read, Seek};
use std::path::{Path, PathBuf};

use crate::{BagTopic, Message, OwnMessages, Reader, Selection};
use periplus_os::fs::{self, File};

use crate::files::BagError;
use crate::files::naming::{Content, content};
use crate::files::sqlite::Database;
use crate::files::temporary::Temporary;
use crate::files::write::{Packing, Storage};

/// Content of a file, without keeping it open.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) path: PathBuf,
    pub(crate) storage: Storage,
    /// Compression of the whole file.
    pub(crate) packing: Option<Packing>,
    pub(crate) topics: Vec<BagTopic>,
    /// Number of messages of each topic.
    pub(crate) counts: Vec<u64>,
    pub(crate) span_ns: Option<(i64, i64)>,
    pub(crate) faults: Vec<String>,
    pub(crate) is_whole: bool,
    pub(crate) bytes: u64,
    pub(crate) ros_distro: String,
    pub(crate) custom_data: BTreeMap<String, String>,
}

impl Part {
    /// Reads the summary of a file.
    pub(crate) fn look(path: &Path) -> Result<Self, BagError> {
        let bytes = fs::metadata(path).map_err(BagError::file(path))?.len();
        let (file, storage, packing) = plain(path)?;
        let file_path = file.as_ref().map_or(path, Temporary::path);
        let mut part = match storage {
            Storage::Sqlite => Database::open(file_path)?.look()?,
            Storage::Mcap | Storage::Ros1 => look(file_path, storage)?,
        };
        path.clone_into(&mut part.path);
        Ok(Self { packing, bytes, ..part })
    }

    /// Opens the file for reading messages.
    pub(crate) fn read(&self, selection: Selection) -> Result<Open, BagError> {
        let (file, storage, _) = plain(&self.path)?;
        let path = file.as_ref().map_or(&*self.path, Temporary::path);
        let source = match storage {
            Storage::Sqlite => Source::Database(Box::new(Database::open(path)?.read(&selection)?)),
            Storage::Mcap | Storage::Ros1 => {
                let reader = open(path)?;
                Source::Stream(Box::new(reader.into_messages(selection)))
            }
        };
        Ok(Open { path: self.path.clone(), source, _file: file })
    }
}

/// Returns the file itself or a decompressed copy.
pub(crate) fn plain(
    path: &Path,
) -> Result<(Option<Temporary>, Storage, Option<Packing>), BagError> {
    let strange = || {
        let why = "it is neither MCAP, nor a database of rosbag2, nor a bag of ROS 1".to_owned();
        BagError::NoBag(path.to_owned(), why)
    };
    match content(path)?.ok_or_else(strange)? {
        Content::Plain(storage) => Ok((None, storage, None)),
        Content::Packed(packing) => {
            let file = Temporary::unpack(path, packing)?;
            match content(file.path())? {
                Some(Content::Plain(storage)) => Ok((Some(file), storage, Some(packing))),
                _ => Err(strange()),
            }
        }
    }
}

fn open(path: &Path) -> Result<Reader<File>, BagError> {
    let file = File::open(path).map_err(BagError::file(path))?;
    Reader::open(file).map_err(BagError::read(path))
}

fn look(path: &Path, storage: Storage) -> Result<Part, BagError> {
    look_at(&mut open(path)?, path, storage)
}

/// Content of an open file.
pub(crate) fn look_at<R: Read + Seek>(
    reader: &mut Reader<R>,
    path: &Path,
    storage: Storage,
) -> Result<Part, BagError> {
    let mut counts = reader.counts().map(<[u64]>::to_vec);
    if counts.is_none() {
        // The file contains no counts.
        let mut counted = vec![0; reader.topics().len()];
        let mut messages = reader.messages(Selection::default());
        while let Some(message) = messages.next().map_err(BagError::read(path))? {
            if let Some(count) = counted.get_mut(message.topic) {
                *count += 1;
            }
        }
        counts = Some(counted);
    }
    Ok(Part {
        path: path.to_owned(),
        storage,
        packing: None,
        topics: reader.topics().to_vec(),
        counts: counts.unwrap_or_default(),
        span_ns: reader.span_ns(),
        faults: reader.faults().iter().map(ToString::to_string).collect(),
        is_whole: reader.has_summary(),
        bytes: 0,
        ros_distro: String::new(),
        custom_data: reader.custom_data().clone(),
    })
}

/// A file whose messages are being read.
pub(crate) struct Open {
    path: PathBuf,
    source: Source,
    /// Decompressed copy.
    _file: Option<Temporary>,
}

enum Source {
    Stream(Box<OwnMessages<File>>),
    Database(Box<crate::files::sqlite::Rows>),
}

impl Open {
    /// Time of the next message \[ns\].
    pub(crate) fn peek_ns(&mut self) -> Result<Option<i64>, BagError> {
        match &mut self.source {
            Source::Stream(messages) => messages.peek_ns().map_err(BagError::read(&self.path)),
            Source::Database(rows) => rows.peek_ns().map_err(BagError::database(&self.path)),
        }
    }

    /// Returns the next message; its topic is an index of this file.
    pub(crate) fn next(&mut self) -> Result<Option<Message<'_>>, BagError> {
        match &mut self.source {
            Source::Stream(messages) => messages.next().map_err(BagError::read(&self.path)),
            Source::Database(rows) => rows.next().map_err(BagError::database(&self.path)),
        }
    }

    /// Damage found so far.
    pub(crate) fn faults(&self) -> Vec<String> {
        match &self.source {
            Source::Stream(messages) => {
                messages.reader().faults().iter().map(ToString::to_string).collect()
            }
            Source::Database(rows) => rows.faults().to_vec(),
        }
    }
}
