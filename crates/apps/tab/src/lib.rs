//! The simulator in a browser tab.
//!
//! [`Tab`] is a session that the caller steps, with one client in Foxglove's protocol, which is the page. Files are in
//! memory. In WebAssembly the module `exports` offers it as functions that take and return addresses; they
//! need no generated code on the side of JavaScript.

#[cfg(target_family = "wasm")]
pub mod exports;
pub mod files;
mod options;
mod tab;

pub use options::{DemoOptions, TabOptions};
pub use tab::{Tab, TabError, TabFrame};
