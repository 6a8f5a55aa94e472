//! One wheel that is steered and driven: `tricycle_controller`.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use crate::velocity_reference::{ReferenceOutcome, VelocityReference};
use crate::{
    BaseMotion, ControlCycle, ControllerError, ControllerInterface, InterfaceSelection,
    JointInterfaceKind, LoanedInterfaces, MotionCentre, PlanarTwist, SteeringOdometry,
};

/// Factor of the wheel speed while the steering is far off.
const SLOW_RATIO: f64 = 0.01;

/// Command of the wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TricycleCommand {
    /// Speed of the wheel [rad/s].
    pub traction_rad_s: f64,
    /// Steering angle [rad].
    pub steering_rad: f64,
}

/// Returns the command of a velocity for a wheelbase [m] and a wheel radius [m]. Without a forward speed
/// the wheel is steered by a quarter turn, and the robot spins.
///
/// Source: `TricycleController::twist_to_ackermann` of `ros2_controllers`.
#[must_use]
pub fn tricycle_command(twist: PlanarTwist, wheelbase_m: f64, radius_m: f64) -> TricycleCommand {
    let PlanarTwist { x_m_s, yaw_rad_s, .. } = twist;
    if x_m_s == 0.0 && yaw_rad_s != 0.0 {
        return TricycleCommand {
            traction_rad_s: yaw_rad_s.abs() * wheelbase_m / radius_m,
            steering_rad: FRAC_PI_2.copysign(yaw_rad_s),
        };
    }
    let steering_rad = if x_m_s == 0.0 || yaw_rad_s == 0.0 {
        0.0
    } else {
        libm::atan(yaw_rad_s * wheelbase_m / x_m_s)
    };
    TricycleCommand { traction_rad_s: x_m_s / (radius_m * libm::cos(steering_rad)), steering_rad }
}

/// Settings of a [`TricycleController`]. Ranges are of absolute values, `None` is unlimited.
#[derive(Clone, Debug, PartialEq)]
pub struct TricycleSettings {
    /// Joint that drives the wheel.
    pub traction_joint: String,
    /// Joint that steers the wheel.
    pub steering_joint: String,
    /// Distance from the wheel to the axle of the others [m].
    pub wheelbase_m: f64,
    /// Radius of the wheel [m].
    pub radius_m: f64,
    /// True to compute odometry from commands instead of the wheel.
    pub open_loop: bool,
    /// Number of updates in the mean velocity.
    pub velocity_window: usize,
    /// Maximum age of a command [s].
    pub timeout_s: f64,
    /// Range of the wheel speed [rad/s].
    pub traction_velocity: Option<[f64; 2]>,
    /// Range of the rate of a growing wheel speed [rad/s²].
    pub traction_acceleration: Option<[f64; 2]>,
    /// Range of the rate of a falling wheel speed [rad/s²].
    pub traction_deceleration: Option<[f64; 2]>,
    /// Range of the jerk of the wheel speed [rad/s³].
    pub traction_jerk: Option<[f64; 2]>,
    /// Minimum and maximum steering angle [rad].
    pub steering_position: Option<[f64; 2]>,
    /// Range of the steering rate [rad/s].
    pub steering_velocity: Option<[f64; 2]>,
    /// Range of the steering acceleration [rad/s²].
    pub steering_acceleration: Option<[f64; 2]>,
}

/// Tricycle with odometry.
///
/// Source: `tricycle_controller.cpp`, `traction_limiter.cpp` and `steering_limiter.cpp` of
/// `ros2_controllers`.
#[derive(Clone, Debug)]
pub struct TricycleController {
    settings: TricycleSettings,
    /// Odometry.
    pub odometry: SteeringOdometry,
    reference: VelocityReference,
    last: TricycleCommand,
    before_last: TricycleCommand,
}

impl TricycleController {
    /// Creates an inactive controller.
    #[must_use]
    pub fn new(settings: TricycleSettings) -> Self {
        Self {
            odometry: SteeringOdometry::new(settings.velocity_window),
            reference: VelocityReference::new(settings.timeout_s),
            last: TricycleCommand::default(),
            before_last: TricycleCommand::default(),
            settings,
        }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &TricycleSettings {
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
    pub fn limited_command(&self) -> TricycleCommand {
        self.last
    }

    /// Resets the odometry to the origin.
    pub fn reset_odometry(&mut self) {
        let angle_rad = self.odometry.angle_rad;
        self.odometry = SteeringOdometry::new(self.settings.velocity_window);
        self.odometry.angle_rad = angle_rad;
    }

    /// Returns the motion of the base by the commanded wheel speed and the measured steering angle.
    #[must_use]
    pub fn base_motion(&self) -> BaseMotion {
        BaseMotion {
            twist: self.twist(self.last.traction_rad_s, self.odometry.angle_rad),
            centre: MotionCentre::Behind {
                joint: self.settings.steering_joint.clone(),
                distance_m: self.settings.wheelbase_m,
            },
        }
    }

    fn twist(&self, traction_rad_s: f64, steering_rad: f64) -> PlanarTwist {
        let wheel_m_s = traction_rad_s * self.settings.radius_m;
        let (sine, cosine) = libm::sincos(steering_rad);
        PlanarTwist {
            x_m_s: wheel_m_s * cosine,
            y_m_s: 0.0,
            yaw_rad_s: wheel_m_s * sine / self.settings.wheelbase_m,
        }
    }

    fn limited(&self, wanted: TricycleCommand, dt_s: f64) -> TricycleCommand {
        let (last, before) = (self.last, self.before_last);
        let settings = &self.settings;
        let mut speed = wanted.traction_rad_s;
        let change_before = last.traction_rad_s - before.traction_rad_s;
        speed = last.traction_rad_s
            + change_before
            + sized(
                speed - last.traction_rad_s - change_before,
                settings.traction_jerk,
                2.0 * dt_s * dt_s,
            );
        let grows = speed.abs() >= last.traction_rad_s.abs();
        let rates =
            if grows { settings.traction_acceleration } else { settings.traction_deceleration };
        speed = last.traction_rad_s + sized(speed - last.traction_rad_s, rates, dt_s);
        speed = sized(speed, settings.traction_velocity, 1.0);
        let mut angle = wanted.steering_rad;
        let change_before = last.steering_rad - before.steering_rad;
        angle = last.steering_rad
            + change_before
            + sized(
                angle - last.steering_rad - change_before,
                settings.steering_acceleration,
                2.0 * dt_s * dt_s,
            );
        angle =
            last.steering_rad + sized(angle - last.steering_rad, settings.steering_velocity, dt_s);
        if let Some([min, max]) = settings.steering_position {
            angle = angle.max(min).min(max);
        }
        TricycleCommand { traction_rad_s: speed, steering_rad: angle }
    }
}

/// Limits the size of a value to a range times a factor; the sign stays.
fn sized(value: f64, range: Option<[f64; 2]>, factor: f64) -> f64 {
    let Some([min, max]) = range else { return value };
    let size = value.abs().max(min * factor).min(max * factor);
    if value >= 0.0 { size } else { -size }
}

impl ControllerInterface for TricycleController {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Named(vec![
            JointInterfaceKind::Velocity.of(&self.settings.traction_joint),
            JointInterfaceKind::Position.of(&self.settings.steering_joint),
        ])
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        self.command_interfaces()
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        for (parameter, value) in
            [("wheelbase", self.settings.wheelbase_m), ("wheel_radius", self.settings.radius_m)]
        {
            if !(value.is_finite() && value > 0.0) {
                return Err(format!("`{parameter}` is {value}: it must be positive").into());
            }
        }
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.reference.clear();
        (self.last, self.before_last) = Default::default();
        self.odometry.angle_rad = interfaces.state(1);
        Ok(())
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        let (speed_rad_s, angle_rad) = (interfaces.state(0), interfaces.state(1));
        if !(speed_rad_s.is_finite() && angle_rad.is_finite()) {
            return Err(ControllerError::Unmeasured(
                "the state of the wheel is not a number".into(),
            ));
        }
        let wanted = self.reference.current(cycle);
        self.odometry.angle_rad = angle_rad;
        if self.settings.open_loop {
            self.odometry.update_open_loop(wanted, cycle.period_s);
        } else {
            self.odometry.advance(self.twist(speed_rad_s, angle_rad), cycle.period_s);
        }
        let mut command =
            tricycle_command(wanted, self.settings.wheelbase_m, self.settings.radius_m);
        let difference_rad = (command.steering_rad - angle_rad).abs();
        command.traction_rad_s *= if difference_rad < FRAC_PI_6 {
            1.0
        } else if difference_rad > FRAC_PI_2 {
            SLOW_RATIO
        } else {
            libm::cos(difference_rad)
        };
        let limited = self.limited(command, cycle.period_s);
        (self.last, self.before_last) = (limited, self.last);
        interfaces.set_command(0, limited.traction_rad_s);
        interfaces.set_command(1, limited.steering_rad);
        Ok(())
    }

    fn deactivate(&mut self, interfaces: &mut LoanedInterfaces<'_>) {
        interfaces.set_command(0, 0.0);
        self.reference.clear();
        (self.last, self.before_last) = Default::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(twist: [f64; 2], traction_rad_s: f64, steering_rad: f64) {
        let twist = PlanarTwist { x_m_s: twist[0], y_m_s: 0.0, yaw_rad_s: twist[1] };
        let command = tricycle_command(twist, 2.0, 0.5);
        let error = (command.traction_rad_s - traction_rad_s).abs()
            + (command.steering_rad - steering_rad).abs();
        assert!(error < 1e-12, "{command:?}");
    }

    #[test]
    fn velocities_become_a_speed_and_an_angle() {
        check([1.0, 0.0], 2.0, 0.0);
        // 45 degrees: the wheel runs sqrt(2) m/s.
        check([1.0, 0.5], 2.0 * std::f64::consts::SQRT_2, std::f64::consts::FRAC_PI_4);
        check([0.0, -0.5], 2.0, -FRAC_PI_2);
        check([0.0, 0.0], 0.0, 0.0);
    }

    #[test]
    fn sizes_are_limited() {
        assert_eq!(sized(-3.0, Some([0.0, 2.0]), 0.5), -1.0);
        assert_eq!(sized(3.0, None, 0.5), 3.0);
        assert_eq!(sized(0.1, Some([0.5, 2.0]), 1.0), 0.5);
    }
}
