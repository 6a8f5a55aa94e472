//! `ros2_control` and `ros_control` in the simulation: the controller manager of a robot's plugin
//! with its services, its controllers as nodes, and its hardware, the joints of the model.

mod device;
mod factory;
mod hardware;
mod inertial;
mod joints;
mod nodes;
mod parameter_files;
mod plugin;
mod ros_controller;
mod services;
mod startup;

pub(crate) use device::ControlDevice;
pub use parameter_files::{NoParameterFiles, ParameterFiles};

use periplus_diagnostics::Diagnostics;

use crate::drives::BuildContext;

/// Builds the controller manager of a plugin of `gz_ros2_control`, `gazebo_ros2_control` or
/// `gazebo_ros_control`.
pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<ControlDevice> {
    device::build(context, diagnostics)
}
