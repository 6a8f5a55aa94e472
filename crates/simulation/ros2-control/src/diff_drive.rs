//! Differential drive: `diff_drive_controller`.

use crate::velocity_reference::{ReferenceOutcome, VelocityReference};
use crate::{
    BaseMotion, ControlCycle, ControllerError, ControllerInterface, DiffDriveOdometry,
    InterfaceSelection, JointInterfaceKind, LoanedInterfaces, MotionCentre, PlanarTwist,
    SpeedLimiter,
};

/// Wheels of a differential drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffDriveGeometry {
    /// Distance between left and right wheels [m].
    pub separation_m: f64,
    /// Radius of the left wheels [m].
    pub left_radius_m: f64,
    /// Radius of the right wheels [m].
    pub right_radius_m: f64,
}

impl DiffDriveGeometry {
    /// Returns the speeds of the left and right wheels [rad/s] of a velocity:
    /// `(v -+ w separation / 2) / radius`.
    #[must_use]
    pub fn wheel_speeds(&self, twist: PlanarTwist) -> [f64; 2] {
        let aside_m_s = twist.yaw_rad_s * self.separation_m / 2.0;
        [
            (twist.x_m_s - aside_m_s) / self.left_radius_m,
            (twist.x_m_s + aside_m_s) / self.right_radius_m,
        ]
    }

    /// Returns the velocity of wheel speeds [rad/s].
    #[must_use]
    pub fn twist(&self, [left_rad_s, right_rad_s]: [f64; 2]) -> PlanarTwist {
        let (left_m_s, right_m_s) =
            (left_rad_s * self.left_radius_m, right_rad_s * self.right_radius_m);
        PlanarTwist {
            x_m_s: (left_m_s + right_m_s) * 0.5,
            y_m_s: 0.0,
            yaw_rad_s: (right_m_s - left_m_s) / self.separation_m,
        }
    }
}

/// Settings of a [`DiffDriveController`].
#[derive(Clone, Debug, PartialEq)]
pub struct DiffDriveSettings {
    /// Joints of the left wheels.
    pub left_joints: Vec<String>,
    /// Joints of the right wheels; as many as left ones.
    pub right_joints: Vec<String>,
    /// Wheels with the multipliers applied.
    pub geometry: DiffDriveGeometry,
    /// True to compute odometry from commands instead of the wheels.
    pub open_loop: bool,
    /// True to compute odometry from wheel angles, false from wheel speeds.
    pub position_feedback: bool,
    /// Number of updates in the mean velocity.
    pub velocity_window: usize,
    /// Maximum age of a command [s]; zero for none.
    pub timeout_s: f64,
    /// Limits of the forward speed.
    pub linear: SpeedLimiter,
    /// Limits of the yaw rate.
    pub angular: SpeedLimiter,
}

impl DiffDriveSettings {
    /// Checks the wheels.
    ///
    /// # Errors
    /// The reason, when they cannot drive.
    pub fn check(&self) -> Result<(), ControllerError> {
        let (left, right) = (self.left_joints.len(), self.right_joints.len());
        if left == 0 || right == 0 {
            return Err("the names of the left or right wheels are empty: set `left_wheel_names` \
                        and `right_wheel_names`"
                .into());
        }
        if left != right {
            return Err(format!("{left} left wheels and {right} right wheels are given").into());
        }
        let DiffDriveGeometry { separation_m, left_radius_m, right_radius_m } = self.geometry;
        for (name, value) in [
            ("wheel_separation", separation_m),
            ("wheel_radius", left_radius_m),
            ("wheel_radius", right_radius_m),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(format!("`{name}` is {value}: it must be positive").into());
            }
        }
        Ok(())
    }
}

/// Differential drive with odometry.
///
/// Source: `diff_drive_controller.cpp` of `ros2_controllers` and of `ros_controllers`.
#[derive(Clone, Debug)]
pub struct DiffDriveController {
    settings: DiffDriveSettings,
    /// Odometry.
    pub odometry: DiffDriveOdometry,
    reference: VelocityReference,
    last: PlanarTwist,
    before_last: PlanarTwist,
}

impl DiffDriveController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(settings: DiffDriveSettings) -> Self {
        Self {
            odometry: DiffDriveOdometry::new(settings.geometry, settings.velocity_window),
            reference: VelocityReference::new(settings.timeout_s),
            last: PlanarTwist::default(),
            before_last: PlanarTwist::default(),
            settings,
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &DiffDriveSettings {
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

    /// Returns the last limited command.
    #[must_use]
    pub fn limited_command(&self) -> PlanarTwist {
        self.last
    }

    /// Returns the motion of the base by the last command.
    #[must_use]
    pub fn base_motion(&self) -> BaseMotion {
        let joints = [self.settings.left_joints.as_slice(), &self.settings.right_joints].concat();
        BaseMotion { twist: self.last, centre: MotionCentre::Joints(joints) }
    }

    /// Resets the odometry to the origin.
    pub fn reset_odometry(&mut self) {
        let angles = self.odometry.clone();
        self.odometry =
            DiffDriveOdometry::new(self.settings.geometry, self.settings.velocity_window);
        self.odometry.keep_angles_of(&angles);
    }

    /// Returns the means of the states of both sides.
    fn feedback(&self, interfaces: &LoanedInterfaces<'_>) -> [f64; 2] {
        let count = self.settings.left_joints.len();
        let mean = |first: usize| {
            (first..first + count).map(|index| interfaces.state(index)).sum::<f64>() / count as f64
        };
        [mean(0), mean(count)]
    }

    fn all(&self, kind: JointInterfaceKind) -> InterfaceSelection {
        let joints = self.settings.left_joints.iter().chain(&self.settings.right_joints);
        InterfaceSelection::Named(joints.map(|joint| kind.of(joint)).collect())
    }
}

impl ControllerInterface for DiffDriveController {
    fn command_interfaces(&self) -> InterfaceSelection {
        self.all(JointInterfaceKind::Velocity)
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        if self.settings.open_loop {
            return InterfaceSelection::Nothing;
        }
        self.all(if self.settings.position_feedback {
            JointInterfaceKind::Position
        } else {
            JointInterfaceKind::Velocity
        })
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
        (self.last, self.before_last) = Default::default();
        let feedback = self.feedback(interfaces);
        if self.settings.position_feedback && feedback.iter().all(|angle| angle.is_finite()) {
            self.odometry.begin_at(feedback);
        }
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let wanted = self.reference.current(cycle);
        if self.settings.open_loop {
            self.odometry.update_open_loop(wanted, cycle.period_s);
        } else {
            let feedback = self.feedback(interfaces);
            if !feedback.iter().all(|value| value.is_finite()) {
                return Err(ControllerError::Unmeasured(
                    "the state of a wheel is not a number".into(),
                ));
            }
            if self.settings.position_feedback {
                self.odometry.update(feedback, cycle.period_s);
            } else {
                self.odometry.update_from_speeds(feedback, cycle.period_s);
            }
        }
        let (last, before) = (self.last, self.before_last);
        let DiffDriveSettings { linear, angular, geometry, .. } = &self.settings;
        let dt_s = cycle.period_s;
        let limited = PlanarTwist {
            x_m_s: linear.limited(wanted.x_m_s, last.x_m_s, before.x_m_s, dt_s),
            y_m_s: 0.0,
            yaw_rad_s: angular.limited(wanted.yaw_rad_s, last.yaw_rad_s, before.yaw_rad_s, dt_s),
        };
        (self.last, self.before_last) = (limited, last);
        let [left, right] = geometry.wheel_speeds(limited);
        let count = self.settings.left_joints.len();
        for index in 0..count {
            interfaces.set_command(index, left);
            interfaces.set_command(count + index, right);
        }
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        (0..interfaces.command_count()).for_each(|index| interfaces.set_command(index, 0.0));
        self.reference.clear();
        (self.last, self.before_last) = Default::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AccelerationLimits, ControllerManager, Hardware, SwitchRequest};

    fn settings() -> DiffDriveSettings {
        DiffDriveSettings {
            left_joints: vec!["left".into()],
            right_joints: vec!["right".into()],
            geometry: DiffDriveGeometry {
                separation_m: 0.4,
                left_radius_m: 0.1,
                right_radius_m: 0.1,
            },
            open_loop: false,
            position_feedback: true,
            velocity_window: 10,
            timeout_s: 0.5,
            linear: SpeedLimiter::default(),
            angular: SpeedLimiter::default(),
        }
    }

    fn running(settings: DiffDriveSettings) -> ControllerManager<DiffDriveController> {
        let mut hardware = Hardware::default();
        for joint in ["left", "right"] {
            hardware.add_command(JointInterfaceKind::Velocity.of(joint));
            hardware.add_state(JointInterfaceKind::Position.of(joint), 2.0);
        }
        let mut manager = ControllerManager::new(hardware);
        manager.load("drive", "DiffDrive", DiffDriveController::new(settings)).unwrap();
        manager.configure("drive").unwrap();
        let activate = vec!["drive".to_owned()];
        let request = SwitchRequest { activate, ..SwitchRequest::default() };
        manager.switch(&request, cycle(0)).unwrap();
        manager
    }

    fn cycle(time_ms: i64) -> ControlCycle {
        ControlCycle { time_ns: time_ms * 1_000_000, period_s: 0.1 }
    }

    fn drive(manager: &mut ControllerManager<DiffDriveController>, x: f64, w: f64, time_ms: i64) {
        let twist = PlanarTwist { x_m_s: x, y_m_s: 0.0, yaw_rad_s: w };
        let controller = &mut manager.controllers_mut().next().unwrap().controller;
        controller.receive(twist, None, time_ms * 1_000_000);
        assert!(manager.update(cycle(time_ms)).is_empty());
    }

    fn commands(manager: &ControllerManager<DiffDriveController>) -> [f64; 2] {
        ["left", "right"].map(|joint| {
            manager.hardware.claimed_command(&JointInterfaceKind::Velocity.of(joint)).unwrap()
        })
    }

    #[test]
    fn commands_reach_the_wheels_and_expire() {
        let mut manager = running(settings());
        drive(&mut manager, 0.5, 1.0, 100);
        // (0.5 -+ 0.2) / 0.1.
        let near = |found: [f64; 2]| (found[0] - 3.0).abs() + (found[1] - 7.0).abs() < 1e-12;
        assert!(near(commands(&manager)));
        manager.update(cycle(600));
        assert!(near(commands(&manager)));
        manager.update(cycle(601));
        assert_eq!(commands(&manager), [0.0, 0.0]);
    }

    #[test]
    fn odometry_begins_at_the_angles_of_the_activation() {
        let mut manager = running(settings());
        manager.hardware.set_state("left/position", 3.0);
        manager.hardware.set_state("right/position", 3.0);
        drive(&mut manager, 0.0, 0.0, 100);
        // One radian on 0.1 m.
        let pose = manager.controllers()[0].controller.odometry.pose;
        assert!((pose.x_m - 0.1).abs() < 1e-12, "{pose:?}");
    }

    #[test]
    fn accelerations_are_limited() {
        let linear = SpeedLimiter {
            acceleration: Some(AccelerationLimits::between(-1.0, 1.0)),
            ..SpeedLimiter::default()
        };
        let mut manager = running(DiffDriveSettings { linear, ..settings() });
        drive(&mut manager, 1.0, 0.0, 100);
        // 1 m/s² for 0.1 s: 0.1 m/s on 0.1 m.
        assert!((commands(&manager)[0] - 1.0).abs() < 1e-12);
        drive(&mut manager, 1.0, 0.0, 200);
        assert!((commands(&manager)[0] - 2.0).abs() < 1e-12);
        let motion = manager.controllers()[0].controller.base_motion();
        assert!((motion.twist.x_m_s - 0.2).abs() < 1e-12);
    }

    #[test]
    fn wheels_are_checked() {
        let wrong = DiffDriveSettings { right_joints: Vec::new(), ..settings() };
        assert!(wrong.check().unwrap_err().to_string().contains("right_wheel_names"));
        let geometry = DiffDriveGeometry { separation_m: 0.0, ..settings().geometry };
        let wrong = DiffDriveSettings { geometry, ..settings() };
        assert_eq!(
            wrong.check().unwrap_err().to_string(),
            "`wheel_separation` is 0: it must be positive"
        );
    }
}
