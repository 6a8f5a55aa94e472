//! Plans that run, as other nodes see them.
#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]
#![allow(clippy::disallowed_methods, reason = "one of them reads the documentation")]

mod document;
mod move_base;
mod robots;
mod running;
