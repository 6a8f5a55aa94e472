//! rosbag2 databases (sqlite3).
//!
//! Schema versions of `rosbag2_storage_sqlite3`: 1 (Foxy: no QoS profiles), 2 (Galactic), 3 (Humble
//! and Iron: a table `schema`), 4 (Jazzy: type definitions and hashes).

#[cfg(target_family = "wasm")]
mod absent;
#[cfg(not(target_family = "wasm"))]
mod read;
#[cfg(not(target_family = "wasm"))]
mod rescue;
#[cfg(not(target_family = "wasm"))]
mod times;
#[cfg(not(target_family = "wasm"))]
mod write;

use std::collections::BTreeMap;

use crate::BagTopic;

#[cfg(target_family = "wasm")]
pub(crate) use absent::{Database, DatabaseError, Rows, SqliteWriter, TimeTable};
#[cfg(not(target_family = "wasm"))]
pub(crate) use read::{Database, Rows};
#[cfg(not(target_family = "wasm"))]
pub(crate) use rusqlite::Error as DatabaseError;
#[cfg(not(target_family = "wasm"))]
pub(crate) use times::TimeTable;
#[cfg(not(target_family = "wasm"))]
pub(crate) use write::SqliteWriter;

/// Content of a database.
pub(crate) struct TimeSummary {
    pub(crate) topics: Vec<BagTopic>,
    /// Number of messages of each topic.
    pub(crate) counts: Vec<u64>,
    pub(crate) span_ns: Option<(i64, i64)>,
    pub(crate) faults: Vec<String>,
    pub(crate) ros_distro: String,
    pub(crate) custom_data: BTreeMap<String, String>,
}
