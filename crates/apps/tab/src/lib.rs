//! The simulator in a browser tab.
//!
//! [`Tab`] is a session that the caller steps, with one client in Foxglove's protocol, which is the page. Files are in
//! memory. In WebAssembly the module `exports` offers it as functions that take and return addresses; they
//! need no generated code on the side of JavaScript.

mod call_error;
pub mod calls;
#[cfg(target_family = "wasm")]
pub mod exports;
pub mod files;
pub mod log_mapping;
mod opened;
pub mod options;
mod results;
mod run;
mod tab;
pub mod unpack;

pub use call_error::TabCallError;
pub use options::{DemoOptions, RunOptions, TabOptions};
pub use tab::{Tab, TabError, TabFrame};
