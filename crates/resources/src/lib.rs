//! Finding what a URI names, on a machine that is only ever asked through [`Host`].

mod host;
mod memory;

pub use host::{Host, Kind, LARGEST_FILE, ReadError};
pub use memory::MemoryHost;
