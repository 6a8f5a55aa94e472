//! Drive and joint controller plugins, with their odometry.
//!
//! Each becomes a [`Device`] with the parameters, topics, frames, rates and odometry of the
//! original. Intended deviations from Gazebo are documented at each device.

mod ackermann;
mod body;
mod build_context;
mod classic_odometry;
mod commands;
mod differential;
mod encoders;
mod gz_ackermann;
mod gz_common;
mod gz_diff;
mod gz_mecanum;
mod joints;
mod pid;
mod planar;
mod rate_timer;
mod rolling_mean;
mod slotcar;
mod tricycle;
mod wheel_frames;

pub(crate) use body::{Body, canonical};
pub(crate) use build_context::{BuildContext, unscoped};
pub(crate) use rate_timer::{RateTimer, earlier};
pub(crate) use rolling_mean::RollingMean;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_plugin_specs::{InterpretedPlugin, PluginSite, Role, Support};

use crate::{Device, DeviceContext, control, states};

/// Builds the device of a plugin that drives, controls joints or publishes states. Returns `None`
/// for other kinds of plugins, for a plugin that cannot work (with located errors), and for a known
/// plugin that is not supported, such as wheel slip (with a warning).
#[must_use]
pub fn build(
    setting: &DeviceContext<'_>,
    site: &PluginSite<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) -> Option<Box<dyn Device>> {
    fn boxed<D: Device + 'static>(device: Option<D>) -> Option<Box<dyn Device>> {
        device.map(|device| Box::new(device) as Box<dyn Device>)
    }
    let context = &BuildContext { setting, site, plugin };
    // Sensors are built with the sensor of their plugin; a plugin of a model brings its own.
    let senses = plugin.known.role == Role::Sensor && site.context.sensor.is_none();
    let moves = senses || matches!(plugin.known.role, Role::Drive | Role::Control | Role::State);
    if plugin.known.support == Support::Kept && (moves || plugin.known.role == Role::Effect) {
        diagnostics.push(unsupported_plugin(context));
    }
    if !moves || plugin.known.support != Support::Simulated {
        return None;
    }
    match plugin.known.id {
        "gazebo_ros_diff_drive" | "gazebo_ros_skid_steer_drive" => {
            boxed(differential::build(context, diagnostics))
        }
        "gazebo_ros_planar_move" => boxed(planar::planar_move(context, diagnostics)),
        "gazebo_ros_tricycle_drive" => boxed(tricycle::build(context, diagnostics)),
        "gazebo_ros_ackermann_drive" => boxed(ackermann::build(context, diagnostics)),
        "gz-sim-diff-drive-system" => boxed(gz_diff::build(context, diagnostics)),
        "gz-sim-mecanum-drive-system" => boxed(gz_mecanum::build(context, diagnostics)),
        "gz-sim-ackermann-steering-system" => boxed(gz_ackermann::build(context, diagnostics)),
        "gz-sim-velocity-control-system" => boxed(planar::velocity_control(context, diagnostics)),
        "gz-sim-joint-controller-system" => boxed(joints::speed_controller(context, diagnostics)),
        "gz-sim-joint-position-controller-system" => {
            boxed(joints::position_controller(context, diagnostics))
        }
        "slotcar" => boxed(slotcar::build(context, diagnostics)),
        "gz_ros2_control-system" | "gazebo_ros2_control" | "gazebo_ros_control" => {
            boxed(control::build(context, diagnostics))
        }
        _ => states::build(context, diagnostics).unwrap_or_else(|()| {
            diagnostics.push(unsupported_plugin(context));
            None
        }),
    }
}

/// Warning for a known plugin that is not supported.
fn unsupported_plugin(context: &BuildContext<'_>) -> Diagnostic {
    let name = &context.site.plugin.name;
    let finding =
        Diagnostic::warning("plugin-not-run", format!("plugin `{name}` is not supported"))
            .at(context.origin());
    match context.plugin.known.id {
        "gazebo_ros_wheel_slip" | "WheelSlipPlugin" | "gz-sim-wheel-slip-system" => {
            finding.note("wheels have friction with the floor but no configurable slip")
        }
        "gz-sim-joint-trajectory-controller-system" => {
            finding.help("use one `gz-sim-joint-position-controller-system` for each joint")
        }
        _ => finding,
    }
}
