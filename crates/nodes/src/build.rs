//! From a model to its devices.

use periplus_diagnostics::Diagnostics;

use crate::{Device, Setting};

/// The devices of a model: first what drives it, then what measures, then who tells of its joints.
/// What cannot be is told, and the rest is there. `description` is the URDF that it came from.
#[must_use]
pub fn devices(
    _setting: &Setting<'_>,
    _description: Option<&str>,
    _diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    Vec::new()
}
