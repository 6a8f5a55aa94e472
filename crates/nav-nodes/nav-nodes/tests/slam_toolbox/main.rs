//! Mapping on a graph, as other nodes see it.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

mod health;
mod nodes;
mod stage;
