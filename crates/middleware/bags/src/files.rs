//! Recordings on the disk.
//!
//! [`Bag::open`] is the one door: a folder of `ros2 bag` with MCAP or sqlite3 files, split, packed,
//! with or without its `metadata.yaml`; a single `.mcap`, `.db3` or `.bag` of ROS 1; whole, cut or
//! damaged. Its [messages](Bag::messages) come in the order of time across all files, in memory that
//! does not grow with them. [`BagWriter`] makes the same kinds; [`convert`] goes from one to the
//! other; [`Player`] and [`Recorder`] connect them to a [`periplus_graph::Graph`].

#![allow(
    clippy::disallowed_methods,
    reason = "this is an edge: recordings are larger than memory and are read where they lie"
)]

mod bag;
mod check;
mod convert;
mod error;
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

pub use bag::{Bag, Kind};
pub use check::check;
pub use convert::{Conversion, Report, convert};
pub use error::BagError;
pub use info::{Info, TopicSum, stamp_name};
pub use play::{PlaySettings, Player};
pub use record::{Now, Offered, RecordSettings, Recorder, Recording, Wanted};
pub use stream::{BagMessage, BagMessages};
pub use write::{BagWriter, ChunkPacking, Packing, PackingMode, Storage, WriteSettings};
