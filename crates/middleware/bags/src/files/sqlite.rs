//! rosbag2 databases (sqlite3).
//!
//! Schema versions of `rosbag2_storage_sqlite3`: 1 (Foxy: no QoS profiles), 2 (Galactic), 3 (Humble
//! and Iron: a table `schema`), 4 (Jazzy: type definitions and hashes).

mod read;
mod rescue;
mod times;
mod write;

pub(crate) use read::{Database, Rows};
pub(crate) use times::TimeTable;
pub(crate) use write::SqliteWriter;
