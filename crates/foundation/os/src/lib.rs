//! Access to the machine: files, environment, clock, memory.
//!
//! Readers use it through [`periplus_resources::Host`]. No other library crate accesses files or the
//! environment.

mod machine;
mod memory;
mod overlay;
mod stopwatch;

pub use machine::Machine;
pub use memory::peak_memory_bytes;
pub use overlay::Overlay;
pub use stopwatch::{Stopwatch, sleep, unix_ns};
