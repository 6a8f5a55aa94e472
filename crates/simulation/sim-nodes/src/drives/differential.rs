//! Differential drives of Gazebo Classic.

mod parameters;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_physics::drives::{ClassicDiffDrive, ClassicDrive};
use periplus_physics::{JointCommand, JointId, ModelId, PhysicsWorld};
use periplus_plugin_specs::Family;

use super::body::Body;
use super::build_context::BuildContext;
use super::classic_odometry::{ClassicOdometry, ClassicOdometryState, OdometrySource};
use super::commands::{Commands, CommandsState};
use super::encoders::{Encoders, speed};
use super::rate_timer::{RateTimer, earlier};
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// `libgazebo_ros_diff_drive.so` of ROS 1 and ROS 2, and `libgazebo_ros_skid_steer_drive.so`.
///
/// Source: `gazebo_plugins/src/gazebo_ros_diff_drive.cpp` and `gazebo_ros_skid_steer_drive.cpp` of
/// `gazebo_ros_pkgs`. Commands have no timeout. Odometry of source `WORLD` is the true pose of the
/// model in the world, not from zero; wheel odometry uses the first pair only.
pub(crate) struct WheelDrive {
    name: String,
    model: ModelId,
    /// Midpoint of the wheels, in the model [m].
    centre_m: DVec3,
    drive: ClassicDiffDrive,
    pairs: Vec<[JointId; 2]>,
    commands: Commands,
    state: WheelDriveState,
    odometry: ClassicOdometry,
}

#[derive(Clone)]
struct WheelDriveState {
    controller: ClassicDrive,
    control_timer: RateTimer,
    acted_ns: i64,
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<WheelDrive> {
    let node = context.node(diagnostics)?;
    let parts = match (context.plugin.known.id, context.plugin.known.family) {
        ("gazebo_ros_skid_steer_drive", _) => parameters::skid_steer(context, node, diagnostics)?,
        (_, Family::ClassicRos1) => parameters::diff_drive_of_ros1(context, node, diagnostics)?,
        _ => parameters::diff_drive_of_ros2(context, node, diagnostics)?,
    };
    let body = Body::of_model(context)?;
    let commands = Commands::new(context, &parts.node, &parts.command_topic, diagnostics)?;
    let (rate_hz, start_ns) = (parts.drive.update_rate_hz, context.setting.start_ns);
    let encoders = parts
        .pairs
        .first()
        .zip(parts.drive.pairs.first())
        .map(|(wheels, pair)| Encoders::new(*wheels, pair.diameter_m / 2.0, pair.separation_m));
    Some(WheelDrive {
        name: context.name(),
        model: context.setting.model,
        centre_m: context.middle(&parts.pairs.concat()),
        state: WheelDriveState {
            controller: ClassicDrive::default(),
            control_timer: RateTimer::for_controller(rate_hz, start_ns),
            acted_ns: start_ns,
        },
        commands,
        odometry: ClassicOdometry {
            source: OdometrySource::new(parts.counts_wheels),
            body,
            encoders,
            publisher: parts.odometry_publisher,
            wheel_frames: parts.wheel_frames,
            joint_states: parts.joint_states,
            timer: RateTimer::for_publisher(rate_hz, start_ns),
        },
        drive: parts.drive,
        pairs: parts.pairs,
    })
}

impl Device for WheelDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        self.odometry.begin(world);
        if !self.state.control_timer.due(span.start_ns) {
            return;
        }
        let since = StepInterval {
            start_ns: self.state.acted_ns,
            length_ns: span.start_ns - self.state.acted_ns,
        };
        self.state.acted_ns = span.start_ns;
        let wheels: Vec<[f64; 2]> =
            self.pairs.iter().map(|pair| pair.map(|joint| speed(world, joint))).collect();
        let wanted = self.commands.planar();
        let answer = self.state.controller.update(&self.drive, wanted, &wheels, since.seconds());
        let max_effort = self.drive.max_wheel_torque_n_m;
        for (pair, targets) in self.pairs.iter().zip(&answer) {
            for (&joint, &target) in pair.iter().zip(targets) {
                world.command(joint, JointCommand::Velocity { target, max_effort });
            }
        }
        world.follow_about(self.model, self.centre_m, self.drive.twist(&answer));
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.odometry.sense(moment);
    }

    fn next_ns(&self) -> Option<i64> {
        earlier(self.state.control_timer.next_ns(), self.odometry.next_ns())
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.controller = ClassicDrive::default();
        self.commands.reset();
        self.state.control_timer.restart(time_ns);
        self.state.acted_ns = time_ns;
        self.odometry.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save(), self.odometry.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        type Saved = (WheelDriveState, CommandsState, ClassicOdometryState);
        let Some((state, commands, odometry)) = saved.get::<Saved>() else { return false };
        self.state = state.clone();
        self.commands.restore(commands);
        self.odometry.restore(odometry);
        true
    }
}
