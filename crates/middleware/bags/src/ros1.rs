//! ROS 1 bags, version 2.0.
//!
//! A record is the length of its header, the header, the length of its data, and the data; a header
//! is a list of fields `name=value`, each prefixed with its length. Chunks contain connections
//! (topics with their types) and messages; an index follows each chunk, and an index of all chunks
//! is at the end of the file. Source: wiki.ros.org/Bags/Format/2.0.

mod packing;
mod read;
mod record;
mod walk;
mod write;

pub use packing::Ros1Compression;
pub(crate) use packing::unpack_record;
pub(crate) use read::read;
#[cfg(feature = "files")]
pub(crate) use record::next_index;
pub(crate) use record::next_message;
pub use write::{Ros1Settings, Ros1Writer};

/// First bytes of a file.
pub(crate) const MAGIC: &[u8; 13] = b"#ROSBAG V2.0\n";

/// Record opcodes.
pub(crate) mod op {
    pub(crate) const MESSAGE: u8 = 2;
    pub(crate) const BAG: u8 = 3;
    pub(crate) const INDEX: u8 = 4;
    pub(crate) const CHUNK: u8 = 5;
    pub(crate) const CHUNK_INFO: u8 = 6;
    pub(crate) const CONNECTION: u8 = 7;
}
