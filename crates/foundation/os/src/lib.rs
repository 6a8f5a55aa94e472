//! The real machine, for readers that ask only through [`periplus_resources::Host`].
//!
//! This is the one place below the programs where files and the environment are touched.

mod machine;
mod memory;
mod overlay;
mod stopwatch;

pub use machine::Machine;
pub use memory::peak_memory_bytes;
pub use overlay::Overlay;
pub use stopwatch::{Stopwatch, sleep, unix_ns};
