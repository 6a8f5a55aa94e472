//! Systems that act on bodies.

use crate::entry::MigrationOutcome;
use crate::old_plugin::OldPlugin;
use crate::replacement::{Replacement, system};

/// `gazebo_ros_wheel_slip`, `WheelSlipPlugin`.
pub(super) fn wheel_slip(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let mut slip = system("wheel-slip", "WheelSlip");
    for wheel in plugin.plugin.content.iter().filter(|element| element.name == "wheel") {
        if wheel.child("wheel_radius").is_none() {
            replacement.differs("WheelSlip needs <wheel_radius> in each <wheel>");
        }
        slip.push(wheel.clone());
    }
    replacement.elements.push(slip);
    replacement
}

/// `LiftDragPlugin`: the parameters have kept their names.
pub(super) fn lift_drag(plugin: &OldPlugin<'_>) -> Replacement {
    let mut replacement = Replacement::new(MigrationOutcome::Converted);
    let mut lift = system("lift-drag", "LiftDrag");
    for parameter in &plugin.plugin.content {
        if parameter.name != "robotNamespace" {
            lift.push(parameter.clone());
        }
    }
    replacement.elements.push(lift);
    replacement
}
