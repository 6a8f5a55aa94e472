//! Output of verbs against nodes of this same program.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

mod action;
mod bench;
mod interface;
mod lifecycle;
mod map;
mod node;
mod param;
mod service;
mod tf;
mod topic;
