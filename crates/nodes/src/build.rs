//! From a model to its devices.

use periplus_diagnostics::Diagnostics;
use periplus_plugins::model_sites;

use crate::{Device, Setting, sensors};

/// The devices of a model: first what drives it, then what measures, then who tells of its joints.
/// What cannot be is told, and the rest is there. `description` is the URDF that it came from.
#[must_use]
pub fn devices(
    setting: &Setting<'_>,
    _description: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Vec<Box<dyn Device>> {
    let sites = model_sites(setting.scene, setting.root);
    sensors::build(setting, &sites, diagnostics)
}
