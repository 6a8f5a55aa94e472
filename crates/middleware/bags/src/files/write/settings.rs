//! How a recording is written.

use std::io::{self, Read, Write};
use std::path::Path;

use crate::Style;

use crate::files::BagError;

/// How files are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// MCAP.
    Mcap,
    /// A database of sqlite3.
    Sqlite,
    /// A bag of ROS 1.
    Ros1,
}

impl Storage {
    /// The name that `ros2 bag` has for it; `rosbag` for ROS 1.
    #[must_use]
    pub fn identifier(self) -> &'static str {
        match self {
            Self::Mcap => "mcap",
            Self::Sqlite => "sqlite3",
            Self::Ros1 => "rosbag",
        }
    }

    /// The ending of its files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Mcap => "mcap",
            Self::Sqlite => "db3",
            Self::Ros1 => "bag",
        }
    }

    /// By the ending of a path.
    #[must_use]
    pub fn of_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        [Self::Mcap, Self::Sqlite, Self::Ros1].into_iter().find(|one| ending == one.ending())
    }
}

/// How bytes are packed, besides the storage's own way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Packing {
    /// Zstandard, the one that comes with `ros2 bag`.
    #[default]
    Zstd,
    /// LZ4, for which `ros2 bag` needs a plugin.
    Lz4,
}

/// The level of Zstandard, as in chunks.
const LEVEL: i32 = 1;

impl Packing {
    /// Its name in `metadata.yaml`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Zstd => "zstd",
            Self::Lz4 => "lz4",
        }
    }

    /// The first bytes of what is packed.
    pub(crate) fn magic(self) -> [u8; 4] {
        match self {
            Self::Zstd => [0x28, 0xb5, 0x2f, 0xfd],
            Self::Lz4 => [0x04, 0x22, 0x4d, 0x18],
        }
    }

    /// Packs one message.
    pub(crate) fn pack(self, data: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
        packed.clear();
        match self {
            Self::Zstd => {
                packed.reserve(zstd::zstd_safe::compress_bound(data.len()));
                let mut compressor = zstd::bulk::Compressor::new(LEVEL)?;
                compressor.compress_to_buffer(data, packed)?;
            }
            Self::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(packed);
                encoder.write_all(data)?;
                encoder.finish()?;
            }
        }
        Ok(())
    }

    /// Packs a whole file.
    pub(crate) fn pack_all<W: Write>(self, mut plain: impl Read, target: W) -> io::Result<W> {
        match self {
            Self::Zstd => {
                let mut encoder = zstd::stream::write::Encoder::new(target, LEVEL)?;
                io::copy(&mut plain, &mut encoder)?;
                encoder.finish()
            }
            Self::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(target);
                io::copy(&mut plain, &mut encoder)?;
                Ok(encoder.finish()?)
            }
        }
    }
}

/// What is packed, besides the storage's own way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PackingMode {
    /// Nothing.
    #[default]
    None,
    /// Every file when it is complete.
    File,
    /// Every message.
    Message,
}

impl PackingMode {
    /// Its name in `metadata.yaml`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "",
            Self::File => "FILE",
            Self::Message => "MESSAGE",
        }
    }
}

/// How the storage itself packs its chunks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChunkPacking {
    /// Not.
    None,
    /// LZ4, in MCAP and bags of ROS 1.
    Lz4,
    /// Zstandard, in MCAP.
    Zstd,
    /// bzip2, in bags of ROS 1.
    Bz2,
}

/// How a recording is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteSettings {
    /// How files are stored.
    pub storage: Storage,
    /// How their chunks are packed.
    pub chunks: ChunkPacking,
    /// What is packed besides.
    pub mode: PackingMode,
    /// How.
    pub packing: Packing,
    /// A new file begins when one has so many bytes.
    pub max_bytes: Option<u64>,
    /// A new file begins when one would span this time \[ns\].
    pub max_span_ns: Option<i64>,
    /// For which readers the metadata is written.
    pub style: Style,
    /// How many threads pack the chunks of MCAP; the bytes are the same.
    pub threads: usize,
    /// The name of the ROS distribution; may be empty.
    pub ros_distro: String,
    /// Whether it must survive the end of the program at any time: what is recorded, in contrast to
    /// what can be converted again.
    pub is_live: bool,
}

impl WriteSettings {
    /// Files of a storage, their chunks packed as usual: MCAP with Zstandard, others not.
    #[must_use]
    pub fn new(storage: Storage) -> Self {
        let chunks = if storage == Storage::Mcap { ChunkPacking::Zstd } else { ChunkPacking::None };
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
            return wrong(format!("`{}` is no name for the storage {name}", path.display()));
        }
        let can = match self.chunks {
            ChunkPacking::None => true,
            ChunkPacking::Lz4 => self.storage != Storage::Sqlite,
            ChunkPacking::Zstd => self.storage == Storage::Mcap,
            ChunkPacking::Bz2 => self.storage == Storage::Ros1,
        };
        if !can {
            return wrong(format!("the storage {name} cannot pack chunks with {:?}", self.chunks));
        }
        let is_packed = self.mode != PackingMode::None;
        if is_packed && (of_path.is_some() || self.storage == Storage::Ros1) {
            return wrong("files and messages are packed in folders of `ros2 bag` only".into());
        }
        if self.is_split() && of_path.is_some() && self.storage != Storage::Ros1 {
            return wrong("a single file is not split; name a folder".into());
        }
        Ok(())
    }
}
