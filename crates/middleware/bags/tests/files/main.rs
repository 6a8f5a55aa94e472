//! Bags on disk.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(
    clippy::print_stdout,
    reason = "a parent reads the output of its child; skipped tests report it"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "these tests look at files, clocks and the environment"
)]

mod common;
mod doors;
mod live;
mod many;
mod peers;
mod random_access;
