//! Four mecanum wheels: `mecanum_drive_controller`.

use crate::odometry::MIN_INTERVAL_S;
use crate::velocity_reference::{ReferenceOutcome, VelocityReference};
use crate::{
    BaseMotion, ControlCycle, ControllerError, ControllerInterface, InterfaceSelection,
    JointInterfaceKind, LoanedInterfaces, MotionCentre, PlanarPose, PlanarTwist, SpeedLimiter,
};

/// Dimensions of a robot with mecanum wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MecanumGeometry {
    /// Radius of the wheels [m].
    pub radius_m: f64,
    /// Sum of the distances from the centre to a wheel along x and along y [m].
    pub sum_of_projections_m: f64,
    /// Pose of the base frame in the centre frame: x [m], y [m], yaw [rad].
    pub centre_from_base: [f64; 3],
}

impl MecanumGeometry {
    /// Returns the wheel speeds of a velocity of the base: front left, front right, rear right, rear
    /// left [rad/s].
    #[must_use]
    pub fn wheel_speeds(&self, twist: PlanarTwist) -> [f64; 4] {
        let [offset_x_m, offset_y_m, yaw_rad] = self.centre_from_base;
        let (sine, cosine) = libm::sincos(yaw_rad);
        let turn = twist.yaw_rad_s;
        let x_m_s = cosine * twist.x_m_s - sine * twist.y_m_s + offset_y_m * turn;
        let y_m_s = sine * twist.x_m_s + cosine * twist.y_m_s - offset_x_m * turn;
        let arm_m_s = self.sum_of_projections_m * turn;
        [
            (x_m_s - y_m_s - arm_m_s) / self.radius_m,
            (x_m_s + y_m_s + arm_m_s) / self.radius_m,
            (x_m_s - y_m_s + arm_m_s) / self.radius_m,
            (x_m_s + y_m_s - arm_m_s) / self.radius_m,
        ]
    }

    /// Returns the velocity of the base of wheel speeds in the same order [rad/s].
    #[must_use]
    pub fn twist(&self, [front_left, front_right, rear_right, rear_left]: [f64; 4]) -> PlanarTwist {
        let share = 0.25 * self.radius_m;
        let x_m_s = share * (front_left + rear_left + rear_right + front_right);
        let y_m_s = share * (-front_left + rear_left - rear_right + front_right);
        let yaw_rad_s = share / self.sum_of_projections_m
            * (-front_left - rear_left + rear_right + front_right);
        let [offset_x_m, offset_y_m, yaw_rad] = self.centre_from_base;
        let (sine, cosine) = libm::sincos(yaw_rad);
        // The velocity at the base, then in its axes.
        let (x_m_s, y_m_s) = (x_m_s - offset_y_m * yaw_rad_s, y_m_s + offset_x_m * yaw_rad_s);
        PlanarTwist {
            x_m_s: cosine * x_m_s + sine * y_m_s,
            y_m_s: cosine * y_m_s - sine * x_m_s,
            yaw_rad_s,
        }
    }
}

/// Settings of a [`MecanumController`].
#[derive(Clone, Debug, PartialEq)]
pub struct MecanumSettings {
    /// Commanded joints: front left, front right, rear right, rear left.
    pub joints: [String; 4],
    /// Joints whose states are read, in the same order.
    pub state_joints: [String; 4],
    /// Dimensions.
    pub geometry: MecanumGeometry,
    /// Maximum age of a command [s]; zero for none.
    pub timeout_s: f64,
    /// Limits along x and y, and of the yaw rate.
    pub limiters: [SpeedLimiter; 3],
}

/// Mecanum drive with odometry, whose velocity is not averaged.
///
/// Source: `mecanum_drive_controller.cpp` and `odometry.cpp` of `ros2_controllers`.
#[derive(Clone, Debug)]
pub struct MecanumController {
    settings: MecanumSettings,
    /// Pose from the start.
    pub pose: PlanarPose,
    /// Measured velocity.
    pub twist: PlanarTwist,
    /// Measured wheel speeds in the order of the joints [rad/s].
    pub wheels_rad_s: [f64; 4],
    reference: VelocityReference,
    last: PlanarTwist,
    before_last: PlanarTwist,
}

impl MecanumController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(settings: MecanumSettings) -> Self {
        Self {
            pose: PlanarPose::default(),
            twist: PlanarTwist::default(),
            wheels_rad_s: [0.0; 4],
            reference: VelocityReference::new(settings.timeout_s),
            last: PlanarTwist::default(),
            before_last: PlanarTwist::default(),
            settings,
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &MecanumSettings {
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
        BaseMotion { twist: self.last, centre: MotionCentre::Joints(self.settings.joints.to_vec()) }
    }
}

impl ControllerInterface for MecanumController {
    fn command_interfaces(&self) -> InterfaceSelection {
        let names = self.settings.joints.iter().map(|joint| JointInterfaceKind::Velocity.of(joint));
        InterfaceSelection::Named(names.collect())
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let names =
            self.settings.state_joints.iter().map(|joint| JointInterfaceKind::Velocity.of(joint));
        InterfaceSelection::Named(names.collect())
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        if let Some(place) = self.settings.joints.iter().position(String::is_empty) {
            let wheel = ["front_left", "front_right", "rear_right", "rear_left"][place];
            return Err(format!("`{wheel}_wheel_command_joint_name` is empty").into());
        }
        let MecanumGeometry { radius_m, sum_of_projections_m, .. } = self.settings.geometry;
        for (parameter, value) in [
            ("kinematics.wheels_radius", radius_m),
            ("kinematics.sum_of_robot_center_projection_on_X_Y_axis", sum_of_projections_m),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(format!("`{parameter}` is {value}: it must be positive").into());
            }
        }
        Ok(())
    }

    fn activate(
        &mut self,
        _: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.reference.clear();
        (self.last, self.before_last) = Default::default();
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.wheels_rad_s = std::array::from_fn(|index| interfaces.state(index));
        let is_measured = self.wheels_rad_s.iter().all(|speed| speed.is_finite());
        if is_measured && cycle.period_s >= MIN_INTERVAL_S {
            self.twist = self.settings.geometry.twist(self.wheels_rad_s);
            self.pose = self.pose.moved_sideways(self.twist, cycle.period_s);
        }
        let wanted = self.reference.current(cycle);
        let (last, before, dt_s) = (self.last, self.before_last, cycle.period_s);
        let [x, y, yaw] = &self.settings.limiters;
        let limited = PlanarTwist {
            x_m_s: x.limited(wanted.x_m_s, last.x_m_s, before.x_m_s, dt_s),
            y_m_s: y.limited(wanted.y_m_s, last.y_m_s, before.y_m_s, dt_s),
            yaw_rad_s: yaw.limited(wanted.yaw_rad_s, last.yaw_rad_s, before.yaw_rad_s, dt_s),
        };
        (self.last, self.before_last) = (limited, last);
        for (index, speed) in self.settings.geometry.wheel_speeds(limited).into_iter().enumerate() {
            interfaces.set_command(index, speed);
        }
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        (0..4).for_each(|index| interfaces.set_command(index, 0.0));
        self.reference.clear();
        (self.last, self.before_last) = Default::default();
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn geometry(centre_from_base: [f64; 3]) -> MecanumGeometry {
        MecanumGeometry { radius_m: 0.1, sum_of_projections_m: 0.5, centre_from_base }
    }

    #[test]
    fn forwards_sideways_and_turning() {
        let straight = geometry([0.0; 3]);
        let speeds =
            |x, y, w| straight.wheel_speeds(PlanarTwist { x_m_s: x, y_m_s: y, yaw_rad_s: w });
        assert_eq!(speeds(0.5, 0.0, 0.0), [5.0, 5.0, 5.0, 5.0]);
        assert_eq!(speeds(0.0, 0.5, 0.0), [-5.0, 5.0, -5.0, 5.0]);
        assert_eq!(speeds(0.0, 0.0, 1.0), [-5.0, 5.0, 5.0, -5.0]);
    }

    proptest! {
        #[test]
        fn a_twist_comes_back(
            x in -2.0..2.0f64,
            y in -2.0..2.0f64,
            w in -2.0..2.0f64,
            offset in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let twist = PlanarTwist { x_m_s: x, y_m_s: y, yaw_rad_s: w };
            let geometry = geometry(offset);
            let back = geometry.twist(geometry.wheel_speeds(twist));
            let error = (back.x_m_s - x).abs() + (back.y_m_s - y).abs() + (back.yaw_rad_s - w).abs();
            prop_assert!(error < 1e-9, "{back:?}");
        }
    }
}
