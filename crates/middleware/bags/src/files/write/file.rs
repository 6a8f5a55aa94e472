//! A file of any storage format.

use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::{
    BagTopic, Compression, Ros1Compression, Ros1Settings, Ros1Writer, Settings, Stamp, Stored,
    TopicId, Writer,
};
use periplus_os::fs::File;

use super::{ChunkPacking, Storage, WriteSettings};
use crate::files::BagError;
use crate::files::sqlite::SqliteWriter;

/// A file that is being written.
pub(super) enum FileWriter {
    Mcap { path: PathBuf, writer: Box<Writer<Counted>>, ids: Vec<TopicId>, bytes: Arc<AtomicU64> },
    Sqlite(Box<SqliteWriter>),
    Ros1 { path: PathBuf, writer: Box<Ros1Writer<BufWriter<Counted>>>, bytes: Arc<AtomicU64> },
}

/// A file that counts its bytes.
pub(super) struct Counted {
    file: File,
    bytes: Arc<AtomicU64>,
}

impl Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.bytes.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Counted {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

impl FileWriter {
    pub(super) fn create(path: &Path, settings: &WriteSettings) -> Result<Self, BagError> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = Arc::new(AtomicU64::new(0));
        let file = File::create_new(path).map_err(BagError::file(path))?;
        let path = path.to_owned();
        Ok(match settings.storage {
            Storage::Mcap => {
                let compression = match settings.chunks {
                    ChunkPacking::Zstd => Compression::Zstd,
                    ChunkPacking::Lz4 => Compression::Lz4,
                    ChunkPacking::None | ChunkPacking::Bz2 => Compression::None,
                };
                let settings = Settings {
                    compression,
                    style: settings.style,
                    threads: settings.threads.max(1),
                    ros_distro: settings.ros_distro.clone(),
                    custom_data: settings.custom_data.clone(),
                    ..Settings::new(name)
                };
                let counted = Counted { file, bytes: bytes.clone() };
                let writer = Writer::new(counted, settings).map_err(BagError::write(&path))?;
                Self::Mcap { path, writer: Box::new(writer), ids: Vec::new(), bytes }
            }
            Storage::Sqlite => {
                drop(file);
                let writer = SqliteWriter::create(&path, settings)?;
                Self::Sqlite(Box::new(writer))
            }
            Storage::Ros1 => {
                let compression = match settings.chunks {
                    ChunkPacking::Bz2 => Ros1Compression::Bz2,
                    ChunkPacking::Lz4 => Ros1Compression::Lz4,
                    ChunkPacking::None | ChunkPacking::Zstd => Ros1Compression::None,
                };
                let settings = Ros1Settings { compression, ..Ros1Settings::new(name) };
                let counted = Counted { file, bytes: bytes.clone() };
                let sink = BufWriter::with_capacity(1 << 16, counted);
                let writer = Ros1Writer::new(sink, settings).map_err(BagError::write(&path))?;
                Self::Ros1 { path, writer: Box::new(writer), bytes }
            }
        })
    }

    pub(super) fn topic(&mut self, topic: &BagTopic) -> Result<usize, BagError> {
        match self {
            Self::Mcap { path, writer, ids, .. } => {
                ids.push(writer.copy_topic(topic).map_err(BagError::write(path))?);
                Ok(ids.len() - 1)
            }
            Self::Sqlite(writer) => writer.topic(topic),
            Self::Ros1 { path, writer, .. } => {
                writer.topic(topic).map(|id| id as usize).map_err(BagError::write(path))
            }
        }
    }

    pub(super) fn write(
        &mut self,
        topic: usize,
        stamp: Stamp,
        data: &[u8],
    ) -> Result<(), BagError> {
        match self {
            Self::Mcap { path, writer, ids, .. } => {
                let Some(id) = ids.get(topic) else {
                    return Err(BagError::write(path)(crate::WriteError::UnknownTopic));
                };
                writer.write(*id, stamp, data).map_err(BagError::write(path))
            }
            Self::Sqlite(writer) => writer.write(topic, stamp, data),
            Self::Ros1 { path, writer, .. } => {
                let id = u32::try_from(topic).unwrap_or(u32::MAX);
                writer.write(id, stamp, data).map_err(BagError::write(path))
            }
        }
    }

    /// Size of the file \[bytes\], without buffered data.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Mcap { bytes, .. } | Self::Ros1 { bytes, .. } => bytes.load(Ordering::Relaxed),
            Self::Sqlite(writer) => writer.bytes(),
        }
    }

    pub(super) fn advance_to(&mut self, time_ns: i64) -> Result<(), BagError> {
        match self {
            Self::Mcap { path, writer, .. } => {
                writer.advance_to(time_ns).map_err(BagError::write(path))
            }
            Self::Sqlite(writer) => writer.advance_to(time_ns),
            Self::Ros1 { path, writer, .. } => {
                writer.advance_to(time_ns).map_err(BagError::write(path))
            }
        }
    }

    pub(super) fn flush(&mut self) -> Result<(), BagError> {
        match self {
            Self::Mcap { path, writer, .. } => writer.flush().map_err(BagError::write(path)),
            Self::Sqlite(writer) => writer.flush(),
            Self::Ros1 { path, writer, .. } => writer.flush().map_err(BagError::write(path)),
        }
    }

    pub(super) fn finish(self, stored: &Stored) -> Result<(), BagError> {
        match self {
            Self::Mcap { path, writer, .. } => {
                writer.finish().map(|_| ()).map_err(BagError::write(&path))
            }
            Self::Sqlite(writer) => writer.finish(stored).map(|_| ()),
            Self::Ros1 { path, writer, .. } => {
                writer.finish().map(|_| ()).map_err(BagError::write(&path))
            }
        }
    }
}
