//! Robots with steered wheels: `ackermann_steering_controller`, `bicycle_steering_controller` and
//! `tricycle_steering_controller`.

use crate::velocity_reference::{ReferenceOutcome, VelocityReference};
use crate::{
    BaseMotion, ControlCycle, ControllerError, ControllerInterface, InterfaceSelection,
    JointInterfaceKind, LoanedInterfaces, MotionCentre, PlanarTwist, SteeringGeometry,
    SteeringOdometry,
};

/// Settings of a [`SteeringController`].
#[derive(Clone, Debug, PartialEq)]
pub struct SteeringSettings {
    /// Dimensions.
    pub geometry: SteeringGeometry,
    /// Joints of the driven wheels, of two the right one first.
    pub traction_joints: Vec<String>,
    /// Joints of the steered wheels, of two the right one first.
    pub steering_joints: Vec<String>,
    /// Joints whose states are read for the driven wheels; empty for the driven joints.
    pub traction_states: Vec<String>,
    /// Joints whose states are read for the steered wheels; empty for the steered joints.
    pub steering_states: Vec<String>,
    /// True to compute odometry from commands instead of the wheels.
    pub open_loop: bool,
    /// True to compute odometry from wheel angles, false from wheel speeds.
    pub position_feedback: bool,
    /// True to drive slowly until the steering has reached its angle.
    pub slows_until_steered: bool,
    /// Number of updates in the mean velocity.
    pub velocity_window: usize,
    /// Maximum age of a command [s]; zero for none.
    pub timeout_s: f64,
}

impl SteeringSettings {
    /// Checks the wheels.
    ///
    /// # Errors
    /// The reason, when they cannot drive.
    pub fn check(&self) -> Result<(), ControllerError> {
        let [traction, steering] = self.geometry.kind.wheel_counts();
        for (parameter, joints, count) in [
            ("traction_joints_names", &self.traction_joints, traction),
            ("steering_joints_names", &self.steering_joints, steering),
        ] {
            if joints.len() != count {
                let given = joints.len();
                return Err(format!("`{parameter}` has {given} joints; {count} are needed").into());
            }
        }
        let geometry = &self.geometry;
        for (parameter, value) in [
            ("wheelbase", geometry.wheelbase_m),
            ("traction_wheels_radius", geometry.traction_radius_m),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(format!("`{parameter}` is {value}: it must be positive").into());
            }
        }
        Ok(())
    }

    fn states(&self) -> [&[String]; 2] {
        fn or<'a>(states: &'a [String], joints: &'a [String]) -> &'a [String] {
            if states.is_empty() { joints } else { states }
        }
        [
            or(&self.traction_states, &self.traction_joints),
            or(&self.steering_states, &self.steering_joints),
        ]
    }
}

/// Drive with steered wheels and odometry.
///
/// Source: `steering_controllers_library.cpp` of `ros2_controllers`.
#[derive(Clone, Debug)]
pub struct SteeringController {
    settings: SteeringSettings,
    /// Odometry.
    pub odometry: SteeringOdometry,
    reference: VelocityReference,
    command: PlanarTwist,
    /// Factor by which the wheels are slowed down.
    slow_ratio: f64,
}

impl SteeringController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(settings: SteeringSettings) -> Self {
        Self {
            odometry: SteeringOdometry::new(settings.velocity_window),
            reference: VelocityReference::new(settings.timeout_s),
            command: PlanarTwist::default(),
            slow_ratio: 1.0,
            settings,
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &SteeringSettings {
        &self.settings
    }

    /// Receives a command, as [`VelocityReference::receive`].
    pub fn receive(
        &mut self,
        twist: PlanarTwist,
        stamp_ns: Option<i64>,
        now_ns: i64,
    ) -> ReferenceOutcome {
        self.reference.receive(twist, stamp_ns, now_ns)
    }

    /// Returns the motion of the base by the commanded wheel speed and the measured steering angle.
    #[must_use]
    pub fn base_motion(&self) -> BaseMotion {
        let x_m_s = self.command.x_m_s * self.slow_ratio;
        let curvature = libm::tan(self.odometry.angle_rad) / self.settings.geometry.wheelbase_m;
        BaseMotion {
            twist: PlanarTwist { x_m_s, y_m_s: 0.0, yaw_rad_s: x_m_s * curvature },
            centre: MotionCentre::Joints(self.settings.traction_joints.clone()),
        }
    }

    fn measured(&self, interfaces: &LoanedInterfaces<'_>) -> [Vec<f64>; 2] {
        let traction = self.settings.traction_joints.len();
        let steering = self.settings.steering_joints.len();
        let read = |range: std::ops::Range<usize>| range.map(|at| interfaces.state(at)).collect();
        [read(0..traction), read(traction..traction + steering)]
    }
}

impl ControllerInterface for SteeringController {
    fn command_interfaces(&self) -> InterfaceSelection {
        let traction = self
            .settings
            .traction_joints
            .iter()
            .map(|joint| JointInterfaceKind::Velocity.of(joint));
        let steering = self
            .settings
            .steering_joints
            .iter()
            .map(|joint| JointInterfaceKind::Position.of(joint));
        InterfaceSelection::Named(traction.chain(steering).collect())
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let [traction, steering] = self.settings.states();
        let kind = if self.settings.position_feedback {
            JointInterfaceKind::Position
        } else {
            JointInterfaceKind::Velocity
        };
        let traction = traction.iter().map(|joint| kind.of(joint));
        let steering = steering.iter().map(|joint| JointInterfaceKind::Position.of(joint));
        InterfaceSelection::Named(traction.chain(steering).collect())
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        self.settings.check()
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.reference.clear();
        (self.command, self.slow_ratio) = (PlanarTwist::default(), 1.0);
        let [traction, steering] = self.measured(interfaces);
        self.odometry.angle_rad = self.settings.geometry.middle_angle(&steering);
        if self.settings.position_feedback {
            self.odometry.begin_at(traction);
        }
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let [traction, steering] = self.measured(interfaces);
        if !traction.iter().chain(&steering).all(|value| value.is_finite()) {
            return Err(ControllerError::Unmeasured("the state of a wheel is not a number".into()));
        }
        let geometry = self.settings.geometry;
        self.command = self.reference.current(cycle);
        if self.settings.open_loop {
            self.odometry.angle_rad = geometry.middle_angle(&steering);
            self.odometry.update_open_loop(self.command, cycle.period_s);
        } else if self.settings.position_feedback {
            self.odometry.update(&geometry, &traction, &steering, cycle.period_s);
        } else {
            self.odometry.update_from_speeds(&geometry, &traction, &steering, cycle.period_s);
        }
        let measured_rad = (!self.settings.open_loop).then_some(self.odometry.angle_rad);
        let slows = self.settings.slows_until_steered;
        let commands = geometry.commands(self.command, measured_rad, slows);
        let straight = geometry.commands(self.command, measured_rad, false);
        self.slow_ratio = match (commands.traction_rad_s.first(), straight.traction_rad_s.first()) {
            (Some(slow), Some(fast)) if *fast != 0.0 => slow / fast,
            _ => 1.0,
        };
        let all = commands.traction_rad_s.iter().chain(&commands.steering_rad);
        for (index, &value) in all.enumerate() {
            interfaces.set_command(index, value);
        }
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        for index in 0..self.settings.traction_joints.len() {
            interfaces.set_command(index, 0.0);
        }
        self.reference.clear();
        self.command = PlanarTwist::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ControllerManager, Hardware, SteeringKind, SwitchRequest};

    #[test]
    fn the_base_turns_by_the_measured_steering() {
        let mut hardware = Hardware::default();
        hardware.add_command("rear/velocity");
        hardware.add_command("front/position");
        hardware.add_state("rear/velocity", 0.0);
        hardware.add_state("front/position", 0.0);
        let geometry = SteeringGeometry {
            kind: SteeringKind::Bicycle,
            wheelbase_m: 2.0,
            traction_radius_m: 0.5,
            traction_track_m: 0.0,
            steering_track_m: 0.0,
        };
        let settings = SteeringSettings {
            geometry,
            traction_joints: vec!["rear".into()],
            steering_joints: vec!["front".into()],
            traction_states: Vec::new(),
            steering_states: Vec::new(),
            open_loop: false,
            position_feedback: false,
            slows_until_steered: false,
            velocity_window: 1,
            timeout_s: 1.0,
        };
        let mut manager = ControllerManager::new(hardware);
        manager.load("bicycle", "Bicycle", SteeringController::new(settings)).unwrap();
        manager.configure("bicycle").unwrap();
        let activate = vec!["bicycle".to_owned()];
        let cycle = ControlCycle { time_ns: 0, period_s: 0.1 };
        manager.switch(&SwitchRequest { activate, ..Default::default() }, cycle).unwrap();
        let twist = PlanarTwist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.5 };
        let controller = &mut manager.controllers_mut().next().unwrap().controller;
        controller.receive(twist, Some(0), 0);
        manager.update(cycle);
        assert_eq!(manager.hardware.claimed_command("rear/velocity"), Some(2.0));
        let steering = manager.hardware.claimed_command("front/position").unwrap();
        assert!((steering - libm::atan(1.0)).abs() < 1e-12);
        // Not steered yet: it drives straight on.
        assert_eq!(manager.controllers()[0].controller.base_motion().twist.yaw_rad_s, 0.0);
        manager.hardware.set_state("front/position", steering);
        manager.hardware.set_state("rear/velocity", 2.0);
        manager.update(cycle);
        let controller = &manager.controllers()[0].controller;
        assert!((controller.base_motion().twist.yaw_rad_s - 0.5).abs() < 1e-12);
        assert!((controller.odometry.twist.yaw_rad_s - 0.5).abs() < 1e-12);
        assert!((controller.odometry.pose.heading_rad - 0.05).abs() < 1e-12);
    }
}
