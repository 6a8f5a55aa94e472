//! Particles that each have a map of their own.

mod settings;

pub use settings::{GmappingSettings, Noise};
