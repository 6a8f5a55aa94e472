//! Bags on disk.
//!
//! [`Bag::open`] opens all kinds: a `ros2 bag` folder with MCAP or sqlite3 files, split,
//! compressed, with or without `metadata.yaml`; a single `.mcap`, `.db3` or ROS 1 `.bag`; complete,
//! truncated or damaged. Its [messages](Bag::messages) are in the order of time across all files,
//! and memory does not grow with their number. [`BagWriter`] writes the same kinds; [`convert`]
//! converts between them; [`Player`] and [`Recorder`] connect them to a [`periplus_graph::Graph`].

#![allow(
    clippy::disallowed_methods,
    reason = "this is an edge: bags are larger than memory and are read from disk"
)]

mod bag;
mod check;
mod convert;
mod error;
mod indexed;
mod info;
mod message_packing;
mod naming;
mod part;
mod play;
mod profile;
mod record;
mod sqlite;
mod stream;
mod temporary;
mod write;

pub use bag::{Bag, BagKind};
pub use check::check;
pub use convert::{Conversion, Report, convert};
pub use error::BagError;
pub use indexed::{
    ChunkCache, ChunkUse, IndexedBag, LocationSpan, MessageLocation, OpenProgress, RecordingFormat,
};
pub use info::{Info, TopicSum, stamp_name};
pub use play::{PlaySettings, Player};
pub use record::{Now, Offered, RecordFilter, RecordSettings, Recorder, Recording};
pub use stream::{BagMessage, BagMessages};
pub use write::{BagWriter, ChunkPacking, Packing, PackingMode, Storage, WriteSettings};
