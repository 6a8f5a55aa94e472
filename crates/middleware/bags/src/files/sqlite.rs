//! Databases of rosbag2.
//!
//! Tables and their versions after `rosbag2_storage_sqlite3`: 1 (Foxy: no profiles), 2 (Galactic), 3
//! (Humble and Iron: a table `schema`), 4 (Jazzy: texts and hashes of types).

mod read;
mod rescue;
mod write;

pub(crate) use read::{Database, Rows};
pub(crate) use write::SqliteWriter;
