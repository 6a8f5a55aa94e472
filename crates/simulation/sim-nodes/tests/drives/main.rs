//! Drives, controllers and publishers of states in small worlds with known results.
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]
#![allow(clippy::cast_possible_truncation, reason = "times of a few seconds")]

mod bench;
mod classic;
mod control;
mod controllers;
mod frames;
mod gz;
mod states;
mod wrong;
