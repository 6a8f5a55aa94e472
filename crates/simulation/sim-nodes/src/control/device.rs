//! The controller manager as a device.

mod core;
mod saved;

use std::collections::BTreeMap;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_physics::{ModelId, PhysicsMode, PhysicsWorld, Twist};
use periplus_ros2_control::{
    BaseMotion, ControlCycle, JointInterfaceKind, MotionCentre, RollingWheel, rolling_twist,
};

use self::saved::SavedControl;
use super::services::ManagerServices;
use super::startup;
use crate::drives::{BuildContext, RateTimer};
use crate::{Device, DeviceState, SenseContext, StepInterval};

pub(super) use self::core::ControlCore;

/// Controller manager of a robot.
///
/// In each period of `update_rate` in simulated time the joints are read, the active controllers are
/// updated, and the commands are written; commands of positions are written in each step of the
/// simulation. Without physics the base follows the motion that its wheels' controllers give.
///
/// Source: `gz_ros2_control_plugin.cpp`, `gz_system.cpp`, `gazebo_ros2_control_plugin.cpp` and
/// `gazebo_ros_control_plugin.cpp`.
pub(crate) struct ControlDevice {
    name: String,
    model: ModelId,
    core: ControlCore,
    services: ManagerServices,
    state: ControlState,
    /// Centres of motion in the model by joints [m].
    centres: BTreeMap<Vec<String>, DVec3>,
}

#[derive(Clone)]
struct ControlState {
    timer: RateTimer,
    updated_ns: Option<i64>,
    /// True while a controller moves the base.
    moves_base: bool,
    /// True after a reset, until the controllers restart with the joints of the reset world.
    restarts: bool,
}

/// Builds the controller manager of a plugin.
pub(super) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<ControlDevice> {
    let setting = context.setting;
    let mut core = context.accept(ControlCore::new(context, diagnostics), diagnostics)?;
    let services = ManagerServices::new(&core.node, core.plugin.release);
    let services = context.accept(services, diagnostics)?;
    let start_ns = setting.start_ns;
    core.hardware.read(setting.world, &mut core.manager.hardware, 0.0);
    let cycle = ControlCycle { time_ns: start_ns, period_s: 0.0 };
    if setting.starts_controllers {
        startup::start(&mut core, context, cycle, diagnostics);
    }
    services.publish_activity(&core, start_ns);
    Some(ControlDevice {
        name: context.name(),
        model: setting.model,
        state: ControlState {
            timer: RateTimer::for_controller(core.update_rate_hz(), start_ns),
            updated_ns: None,
            moves_base: false,
            restarts: false,
        },
        core,
        services,
        centres: BTreeMap::new(),
    })
}

impl ControlDevice {
    fn update(&mut self, world: &PhysicsWorld, now_ns: i64) {
        let period_s = 1.0 / self.core.update_rate_hz();
        let since = self.state.updated_ns.replace(now_ns);
        #[expect(clippy::cast_precision_loss, reason = "a short time")]
        let period_s = since.map_or(period_s, |before_ns| (now_ns - before_ns) as f64 * 1e-9);
        self.core.update(world, ControlCycle { time_ns: now_ns, period_s });
    }

    /// Moves the base without physics.
    fn move_base(&mut self, world: &mut PhysicsWorld) {
        if world.mode() != PhysicsMode::Kinematic {
            return;
        }
        let motion = self.core.base_motion().or_else(|| self.rolling_motion(world));
        if motion.is_none() && !self.state.moves_base {
            return;
        }
        self.state.moves_base = motion.is_some();
        let twist = motion.as_ref().map(|motion| motion.twist).unwrap_or_default();
        let centre_m = motion.map_or(DVec3::ZERO, |motion| self.centre_m(world, motion));
        let twist = Twist { x_m_s: twist.x_m_s, y_m_s: twist.y_m_s, yaw_rad_s: twist.yaw_rad_s };
        world.follow_about(self.model, centre_m, twist);
    }

    /// Returns the motion of the base by wheels that a controller of joints turns.
    fn rolling_motion(&self, world: &PhysicsWorld) -> Option<BaseMotion> {
        let hardware = &self.core.manager.hardware;
        let commanded = |name: &String| {
            let command = hardware.claimed_command(&JointInterfaceKind::Velocity.of(name));
            command.map(|speed_rad_s| (name.clone(), speed_rad_s))
        };
        let turned: Vec<(String, f64)> = self
            .core
            .joints
            .iter()
            .filter(|(_, joint)| joint.is_wheel)
            .filter_map(|(name, _)| commanded(name))
            .collect();
        let names: Vec<String> = turned.iter().map(|(name, _)| name.clone()).collect();
        let ids: Vec<_> =
            names.iter().filter_map(|name| Some(self.core.joints.get(name)?.id)).collect();
        let centre_m = world.middle_of(self.model, &ids)?;
        let wheel = |(name, speed_rad_s): &(String, f64)| {
            let joint = self.core.joints.get(name)?;
            joint.rolling_wheel(world, self.model, centre_m, *speed_rad_s)
        };
        let wheels: Vec<RollingWheel> = turned.iter().filter_map(wheel).collect();
        (!wheels.is_empty() && wheels.len() == turned.len()).then(|| BaseMotion {
            twist: rolling_twist(&wheels),
            centre: MotionCentre::Joints(names),
        })
    }

    /// Returns the centre of a motion in the model [m]; computed once, so that it stays the same.
    fn centre_m(&mut self, world: &PhysicsWorld, motion: BaseMotion) -> DVec3 {
        let (joints, behind_m) = match motion.centre {
            MotionCentre::Joints(joints) => (joints, 0.0),
            MotionCentre::Behind { joint, distance_m } => (vec![joint], distance_m),
        };
        if let Some(&centre_m) = self.centres.get(&joints) {
            return centre_m;
        }
        let ids: Vec<_> =
            joints.iter().filter_map(|name| Some(self.core.joints.get(name)?.id)).collect();
        let middle_m = world.middle_of(self.model, &ids).unwrap_or_default();
        let centre_m = middle_m - DVec3::X * behind_m;
        self.centres.insert(joints, centre_m);
        centre_m
    }
}

impl Device for ControlDevice {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        let cycle = ControlCycle { time_ns: span.start_ns, period_s: span.seconds() };
        if std::mem::take(&mut self.state.restarts) {
            self.core.restart(world, cycle);
        }
        self.services.serve(&mut self.core, cycle);
        if self.state.timer.due(span.start_ns) {
            self.update(world, span.start_ns);
        }
        self.core.write(world);
        self.move_base(world);
    }

    fn sense(&mut self, _: &mut SenseContext<'_>) {}

    fn next_ns(&self) -> Option<i64> {
        self.state.timer.next_ns()
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.restart(time_ns);
        (self.state.updated_ns, self.state.moves_base) = (None, false);
        self.state.restarts = true;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(SavedControl::of(&self.core, self.state.clone()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(saved) = saved.get::<SavedControl>() else { return false };
        saved.restore(&mut self.core);
        self.state = saved.state.clone();
        true
    }
}
