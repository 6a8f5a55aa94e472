//! Access to the machine: files, environment, clock, memory.
//!
//! Readers use it through [`periplus_resources::Host`]. No other library crate accesses files or the
//! environment.
//!
//! ```
//! use std::path::Path;
//!
//! use periplus_os::{Machine, Overlay};
//! use periplus_resources::Host;
//!
//! let bytes = Machine.read(Path::new("Cargo.toml")).expect("the manifest of this crate");
//! assert!(bytes.starts_with(b"[package]"));
//! let variables = [("ROS_DOMAIN_ID".to_owned(), Some("7".to_owned()))].into();
//! let host = Overlay { variables, ..Overlay::default() };
//! assert_eq!(host.variable("ROS_DOMAIN_ID").as_deref(), Some("7"));
//! ```

mod file_log;
pub mod fs;
mod machine;
mod memory;
#[cfg(any(test, target_family = "wasm"))]
#[cfg_attr(
    not(target_family = "wasm"),
    expect(
        dead_code,
        unreachable_pub,
        reason = "tests use a part of it; other targets have files"
    )
)]
mod memory_fs;
mod overlay;
mod process;
mod shell;
mod stopwatch;
#[cfg(any(windows, test))]
mod verbatim;

pub use file_log::{FileLog, plain};
pub use machine::Machine;
pub use memory::peak_memory_bytes;
pub use overlay::Overlay;
pub use process::{process_id, processors, start_thread};
pub use shell::shell_word;
#[cfg(target_family = "wasm")]
pub use stopwatch::set_clock;
pub use stopwatch::{Stopwatch, sleep, unix_ns};
