//! The MPPI controller as a whole: parameters, critics, driving.

mod critics;
mod driving;
mod parameters;
mod world;
