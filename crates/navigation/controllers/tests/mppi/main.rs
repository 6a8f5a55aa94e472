//! The MPPI controller as a whole: parameters, critics, driving.

#![allow(
    clippy::approx_constant,
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "tests read files and have numbers as users write them"
)]

mod critics;
mod driving;
mod parameters;
mod threads;
mod world;
