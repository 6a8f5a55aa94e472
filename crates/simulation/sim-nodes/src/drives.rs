//! Plugins that move a robot or its joints, and those that tell how it moves.
//!
//! Each becomes a [`Device`] with the parameters, topics, frames, rates and odometry of the
//! original. What differs from Gazebo on purpose is said at each of them.

mod beat;
mod body;
mod car;
mod commands;
mod encoders;
mod gz_ackermann;
mod gz_common;
mod gz_diff;
mod gz_mecanum;
mod joints;
mod order;
mod pid;
mod rolling;
mod sliding;
mod tricycle;
mod wheel_frames;
mod wheels;

pub(crate) use beat::{Beat, earlier};
pub(crate) use body::{Body, canonical};
pub(crate) use order::{Order, unscoped};
pub(crate) use rolling::RollingMean;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_plugin_specs::{Interpreted, Role, Site, Support};

use crate::{Device, Setting, states};

/// The device of a plugin that drives, controls joints or publishes states. None for plugins of
/// other kinds; none, with errors that tell where and why, for those that cannot work; none, with a
/// warning, for those that are known and not run, effects such as slip among them.
#[must_use]
pub fn build(
    setting: &Setting<'_>,
    site: &Site<'_>,
    plugin: &Interpreted,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    fn boxed<D: Device + 'static>(device: Option<D>) -> Option<Box<dyn Device>> {
        device.map(|device| Box::new(device) as Box<dyn Device>)
    }
    let order = &Order { setting, site, plugin };
    let moves = matches!(plugin.known.role, Role::Drive | Role::Control | Role::State);
    if plugin.known.support == Support::Kept && (moves || plugin.known.role == Role::Effect) {
        diagnostics.push(not_run(order));
    }
    if !moves || plugin.known.support != Support::Simulated {
        return None;
    }
    match plugin.known.id {
        "gazebo_ros_diff_drive" | "gazebo_ros_skid_steer_drive" => {
            boxed(wheels::build(order, diagnostics))
        }
        "gazebo_ros_planar_move" => boxed(sliding::planar_move(order, diagnostics)),
        "gazebo_ros_tricycle_drive" => boxed(tricycle::build(order, diagnostics)),
        "gazebo_ros_ackermann_drive" => boxed(car::build(order, diagnostics)),
        "gz-sim-diff-drive-system" => boxed(gz_diff::build(order, diagnostics)),
        "gz-sim-mecanum-drive-system" => boxed(gz_mecanum::build(order, diagnostics)),
        "gz-sim-ackermann-steering-system" => boxed(gz_ackermann::build(order, diagnostics)),
        "gz-sim-velocity-control-system" => boxed(sliding::velocity_control(order, diagnostics)),
        "gz-sim-joint-controller-system" => boxed(joints::speed_controller(order, diagnostics)),
        "gz-sim-joint-position-controller-system" => {
            boxed(joints::position_controller(order, diagnostics))
        }
        _ => states::build(order, diagnostics).unwrap_or_else(|()| {
            diagnostics.push(not_run(order));
            None
        }),
    }
}

/// A plugin that is known and not run.
fn not_run(order: &Order<'_>) -> Diagnostic {
    let name = &order.site.plugin.name;
    let finding = Diagnostic::warning("plugin-not-run", format!("plugin `{name}` is not run"))
        .at(order.origin());
    match order.plugin.known.id {
        "gazebo_ros_wheel_slip" | "WheelSlipPlugin" | "gz-sim-wheel-slip-system" => {
            finding.note("wheels hold the ground by friction alone")
        }
        "gz_ros2_control-system" | "gazebo_ros2_control" | "gazebo_ros_control" => finding
            .note("controllers of ros2_control are not loaded, so its joints move freely")
            .help(
                "add a drive plugin of Gazebo for the same joints, such as \
                 `gz-sim-diff-drive-system` or `libgazebo_ros_diff_drive.so`",
            ),
        "gz-sim-joint-trajectory-controller-system" => {
            finding.help("use one `gz-sim-joint-position-controller-system` for each joint")
        }
        _ => finding,
    }
}
