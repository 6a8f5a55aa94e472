//! Settings of bag writers.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};

use crate::zstandard;
use std::path::Path;

use crate::Style;

use crate::files::BagError;

/// Storage format of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// MCAP.
    Mcap,
    /// A sqlite3 database.
    Sqlite,
    /// A ROS 1 bag.
    Ros1,
}

impl Storage {
    /// Storage identifier of `ros2 bag`; `rosbag` for ROS 1.
    #[must_use]
    pub fn identifier(self) -> &'static str {
        match self {
            Self::Mcap => "mcap",
            Self::Sqlite => "sqlite3",
            Self::Ros1 => "rosbag",
        }
    }

    /// File extension.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Mcap => "mcap",
            Self::Sqlite => "db3",
            Self::Ros1 => "bag",
        }
    }

    /// Storage by the extension of a path.
    #[must_use]
    pub fn of_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        [Self::Mcap, Self::Sqlite, Self::Ros1].into_iter().find(|one| ending == one.ending())
    }
}

/// Compression on top of the storage format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Packing {
    /// Zstandard, included in `ros2 bag`.
    #[default]
    Zstd,
    /// LZ4, for which `ros2 bag` needs a plugin.
    Lz4,
}

/// Zstandard level, as for chunks.
const LEVEL: i32 = 1;

impl Packing {
    /// Name in `metadata.yaml`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Zstd => "zstd",
            Self::Lz4 => "lz4",
        }
    }

    /// Magic number of compressed data.
    pub(crate) fn magic(self) -> [u8; 4] {
        match self {
            Self::Zstd => [0x28, 0xb5, 0x2f, 0xfd],
            Self::Lz4 => [0x04, 0x22, 0x4d, 0x18],
        }
    }

    /// Compresses a message.
    pub(crate) fn pack(self, data: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
        packed.clear();
        match self {
            Self::Zstd => {
                zstandard::Compressor::new(LEVEL)?.compress(data, packed)?;
            }
            Self::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(packed);
                encoder.write_all(data)?;
                encoder.finish()?;
            }
        }
        Ok(())
    }

    /// Compresses a file.
    pub(crate) fn pack_all<W: Write>(self, mut plain: impl Read, target: W) -> io::Result<W> {
        match self {
            Self::Zstd => zstandard::compress_all(LEVEL, plain, target),
            Self::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(target);
                io::copy(&mut plain, &mut encoder)?;
                Ok(encoder.finish()?)
            }
        }
    }
}

/// Unit of compression on top of the storage format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PackingMode {
    /// No compression.
    #[default]
    None,
    /// Each file when it is complete.
    File,
    /// Each message.
    Message,
}

impl PackingMode {
    /// Name in `metadata.yaml`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "",
            Self::File => "FILE",
            Self::Message => "MESSAGE",
        }
    }
}

/// Compression of chunks by the storage format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChunkPacking {
    /// No compression.
    None,
    /// LZ4, in MCAP and ROS 1 bags.
    Lz4,
    /// Zstandard, in MCAP.
    Zstd,
    /// bzip2, in ROS 1 bags.
    Bz2,
}

/// Settings of a bag writer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteSettings {
    /// Storage format.
    pub storage: Storage,
    /// Compression of chunks.
    pub chunks: ChunkPacking,
    /// Unit of additional compression.
    pub mode: PackingMode,
    /// Format of additional compression.
    pub packing: Packing,
    /// Maximum size of a file before a new one is started \[bytes\].
    pub max_bytes: Option<u64>,
    /// Maximum time span of a file before a new one is started \[ns\].
    pub max_span_ns: Option<i64>,
    /// Version of the metadata.
    pub style: Style,
    /// Number of compression threads for MCAP; the bytes are the same.
    pub threads: usize,
    /// Name of the ROS distribution; may be empty.
    pub ros_distro: String,
    /// Facts of the recorder by name; bags of ROS 1 and metadata of Humble have no room for them.
    pub custom_data: BTreeMap<String, String>,
    /// True if the bag must survive a crash at any time: for recordings, in contrast to
    /// conversions, which can be repeated.
    pub is_live: bool,
}

impl WriteSettings {
    /// Default settings of a storage format: MCAP with Zstandard, in WebAssembly with LZ4, others uncompressed.
    #[must_use]
    pub fn new(storage: Storage) -> Self {
        let chunks = match storage {
            Storage::Mcap if cfg!(target_family = "wasm") => ChunkPacking::Lz4,
            Storage::Mcap => ChunkPacking::Zstd,
            _ => ChunkPacking::None,
        };
        Self {
            storage,
            chunks,
            mode: PackingMode::None,
            packing: Packing::default(),
            max_bytes: None,
            max_span_ns: None,
            style: Style::default(),
            threads: 1,
            ros_distro: String::new(),
            custom_data: BTreeMap::new(),
            is_live: false,
        }
    }

    pub(crate) fn is_split(&self) -> bool {
        self.max_bytes.is_some() || self.max_span_ns.is_some()
    }

    pub(crate) fn check(&self, path: &Path) -> Result<(), BagError> {
        let wrong = |why: String| Err(BagError::Settings(why));
        let name = self.storage.identifier();
        let of_path = Storage::of_path(path);
        if of_path.is_some_and(|storage| storage != self.storage) {
            return wrong(format!(
                "`{}` does not have the extension of the storage {name}",
                path.display()
            ));
        }
        let can = match self.chunks {
            ChunkPacking::None => true,
            ChunkPacking::Lz4 => self.storage != Storage::Sqlite,
            ChunkPacking::Zstd => self.storage == Storage::Mcap,
            ChunkPacking::Bz2 => self.storage == Storage::Ros1,
        };
        if !can {
            return wrong(format!(
                "the storage {name} does not support chunk compression with {:?}",
                self.chunks
            ));
        }
        let is_packed = self.mode != PackingMode::None;
        if is_packed && (of_path.is_some() || self.storage == Storage::Ros1) {
            return wrong("compression of files and messages requires a `ros2 bag` folder".into());
        }
        if self.is_split() && of_path.is_some() && self.storage != Storage::Ros1 {
            return wrong("a single file cannot be split; use a folder".into());
        }
        Ok(())
    }
}
