//! Kinematics and odometry of robots with steered wheels.

use crate::odometry::MIN_INTERVAL_S;
use crate::{PlanarPose, PlanarTwist, SpeedMeans};

/// Steering angle below which the robot drives straight [rad].
const MIN_STEERING_RAD: f64 = 1e-6;

/// Speed below which the steering angle is zero [m/s]: the precision of a 32-bit number.
const MIN_STEERING_SPEED_M_S: f64 = 1.192_092_9e-7;

/// Difference of steering angles from which wheels are slowed down [rad].
const SLOW_FROM_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// Difference of steering angles from which wheels nearly stop [rad]; its cosine is 0.01.
const SLOW_TO_RAD: f64 = 1.5608;

/// Factor of the wheel speed while the steering is far off.
const SLOW_RATIO: f64 = 0.01;

/// Number of steered and driven wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SteeringKind {
    /// One steered, one driven wheel.
    Bicycle,
    /// One steered, two driven wheels.
    Tricycle,
    /// Two steered, two driven wheels.
    Ackermann,
}

impl SteeringKind {
    /// Returns the numbers of driven and of steered wheels.
    #[must_use]
    pub fn wheel_counts(self) -> [usize; 2] {
        match self {
            Self::Bicycle => [1, 1],
            Self::Tricycle => [2, 1],
            Self::Ackermann => [2, 2],
        }
    }
}

/// Dimensions of a robot with steered wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringGeometry {
    /// Wheels.
    pub kind: SteeringKind,
    /// Distance between the axles [m].
    pub wheelbase_m: f64,
    /// Radius of the driven wheels [m].
    pub traction_radius_m: f64,
    /// Distance between the driven wheels [m].
    pub traction_track_m: f64,
    /// Distance between the steered wheels [m].
    pub steering_track_m: f64,
}

/// Commands of the wheels, of two wheels the right one first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WheelCommands {
    /// Speeds of the driven wheels [rad/s].
    pub traction_rad_s: Vec<f64>,
    /// Angles of the steered wheels [rad].
    pub steering_rad: Vec<f64>,
}

impl SteeringGeometry {
    /// Returns the steering angle in the middle of the steered axle [rad]: `atan(w L / v)`, and zero
    /// without a speed.
    #[must_use]
    pub fn steering_angle(&self, twist: PlanarTwist) -> f64 {
        if twist.x_m_s.abs() < MIN_STEERING_SPEED_M_S {
            return 0.0;
        }
        libm::atan(twist.yaw_rad_s * self.wheelbase_m / twist.x_m_s)
    }

    /// Returns the commands of a velocity while the robot steers by `measured_rad`; `None` computes
    /// the wheel speeds for the commanded angle (open loop). With `slows_down` the wheels turn slowly
    /// until the steering has reached its angle.
    ///
    /// Source: `SteeringOdometry::get_commands` of `steering_controllers_library`.
    #[must_use]
    pub fn commands(
        &self,
        twist: PlanarTwist,
        measured_rad: Option<f64>,
        slows_down: bool,
    ) -> WheelCommands {
        let wanted_rad = self.steering_angle(twist);
        let angle_rad = measured_rad.unwrap_or(wanted_rad);
        let slow_ratio = match measured_rad {
            Some(measured_rad) if slows_down => slow_ratio(wanted_rad - measured_rad),
            _ => 1.0,
        };
        let speed_rad_s = twist.x_m_s / self.traction_radius_m * slow_ratio;
        let is_straight = angle_rad.abs() < MIN_STEERING_RAD;
        let traction_rad_s = if self.kind == SteeringKind::Bicycle {
            vec![speed_rad_s]
        } else if is_straight {
            vec![speed_rad_s; 2]
        } else {
            let radius_m = self.wheelbase_m / libm::tan(angle_rad);
            let half_m = self.traction_track_m * 0.5;
            vec![
                speed_rad_s * (radius_m + half_m) / radius_m,
                speed_rad_s * (radius_m - half_m) / radius_m,
            ]
        };
        let steering_rad = match self.kind {
            SteeringKind::Ackermann if !is_straight => {
                let (sine, cosine) = libm::sincos(wanted_rad);
                let ahead = 2.0 * self.wheelbase_m * cosine;
                let aside = self.steering_track_m * sine;
                let across = 2.0 * self.wheelbase_m * sine;
                vec![libm::atan2(across, ahead + aside), libm::atan2(across, ahead - aside)]
            }
            SteeringKind::Ackermann => vec![wanted_rad; 2],
            SteeringKind::Bicycle | SteeringKind::Tricycle => vec![wanted_rad],
        };
        WheelCommands { traction_rad_s, steering_rad }
    }

    /// Returns the steering angle in the middle of the steered axle of measured angles, of two the
    /// right one first [rad].
    #[must_use]
    pub fn middle_angle(&self, steering_rad: &[f64]) -> f64 {
        let &[right_rad, left_rad] = steering_rad else {
            return steering_rad.first().copied().unwrap_or_default();
        };
        let middle = |angle_rad: f64, aside_m: f64| {
            let tangent = libm::tan(angle_rad);
            libm::atan(self.wheelbase_m * tangent / (self.wheelbase_m + aside_m * tangent))
        };
        let half_m = self.steering_track_m / 2.0;
        (middle(right_rad, -half_m) + middle(left_rad, half_m)) * 0.5
    }

    /// Returns the velocity of measured wheel speeds [rad/s] and a steering angle [rad].
    #[must_use]
    pub fn twist(&self, traction_rad_s: &[f64], angle_rad: f64) -> PlanarTwist {
        let tangent = libm::tan(angle_rad);
        let x_m_s = match *traction_rad_s {
            [right_rad_s, left_rad_s] => {
                let share = self.traction_track_m * 0.5 * tangent / self.wheelbase_m;
                let right_m_s = right_rad_s * self.traction_radius_m / (1.0 + share);
                let left_m_s = left_rad_s * self.traction_radius_m / (1.0 - share);
                (right_m_s + left_m_s) * 0.5
            }
            _ => traction_rad_s.first().copied().unwrap_or_default() * self.traction_radius_m,
        };
        PlanarTwist { x_m_s, y_m_s: 0.0, yaw_rad_s: tangent * x_m_s / self.wheelbase_m }
    }
}

/// Returns the factor of the wheel speed for a difference of the steering angle [rad].
fn slow_ratio(difference_rad: f64) -> f64 {
    let difference_rad = difference_rad.abs();
    if difference_rad < SLOW_FROM_RAD {
        1.0
    } else if difference_rad >= SLOW_TO_RAD {
        SLOW_RATIO
    } else {
        libm::cos(difference_rad)
    }
}

/// Odometry of a robot with steered wheels.
#[derive(Clone, Debug, PartialEq)]
pub struct SteeringOdometry {
    /// Pose from the start.
    pub pose: PlanarPose,
    /// Rolling mean of the velocity.
    pub twist: PlanarTwist,
    /// Measured steering angle in the middle of the steered axle [rad].
    pub angle_rad: f64,
    means: SpeedMeans,
    before_rad: Vec<f64>,
}

impl SteeringOdometry {
    /// Creates odometry at the origin with a number of updates in the mean velocity.
    #[must_use]
    pub fn new(window: usize) -> Self {
        Self {
            pose: PlanarPose::default(),
            twist: PlanarTwist::default(),
            angle_rad: 0.0,
            means: SpeedMeans::new(window),
            before_rad: Vec::new(),
        }
    }

    /// Sets the angles of the driven wheels from which the next update counts [rad].
    pub fn begin_at(&mut self, traction_rad: Vec<f64>) {
        self.before_rad = traction_rad;
    }

    /// Updates from the angles of the driven wheels [rad] and of the steered wheels [rad] after a
    /// time [s].
    pub fn update(
        &mut self,
        geometry: &SteeringGeometry,
        traction_rad: &[f64],
        steering_rad: &[f64],
        dt_s: f64,
    ) {
        let before = std::mem::replace(&mut self.before_rad, traction_rad.to_vec());
        if dt_s < MIN_INTERVAL_S {
            return;
        }
        let speeds: Vec<f64> = traction_rad
            .iter()
            .enumerate()
            .map(|(index, now)| (now - before.get(index).copied().unwrap_or_default()) / dt_s)
            .collect();
        self.update_from_speeds(geometry, &speeds, steering_rad, dt_s);
    }

    /// Updates from the speeds of the driven wheels [rad/s] and the angles of the steered wheels
    /// [rad] after a time [s].
    pub fn update_from_speeds(
        &mut self,
        geometry: &SteeringGeometry,
        traction_rad_s: &[f64],
        steering_rad: &[f64],
        dt_s: f64,
    ) {
        self.angle_rad = geometry.middle_angle(steering_rad);
        self.advance(geometry.twist(traction_rad_s, self.angle_rad), dt_s);
    }

    /// Updates from a commanded velocity over a time [s]: the velocity is published as it is.
    pub fn update_open_loop(&mut self, twist: PlanarTwist, dt_s: f64) {
        self.twist = PlanarTwist { y_m_s: 0.0, ..twist };
        self.pose = self.pose.moved(twist.x_m_s * dt_s, twist.yaw_rad_s * dt_s);
    }

    /// Updates from a measured velocity over a time [s].
    pub(crate) fn advance(&mut self, twist: PlanarTwist, dt_s: f64) {
        self.pose = self.pose.moved(twist.x_m_s * dt_s, twist.yaw_rad_s * dt_s);
        if dt_s >= MIN_INTERVAL_S {
            self.twist = self.means.push(twist.x_m_s, twist.yaw_rad_s);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn geometry(kind: SteeringKind) -> SteeringGeometry {
        SteeringGeometry {
            kind,
            wheelbase_m: 1.0,
            traction_radius_m: 0.2,
            traction_track_m: 1.0,
            steering_track_m: 0.8,
        }
    }

    fn check(kind: SteeringKind, twist: [f64; 2], traction: &[f64], steering: &[f64]) {
        let twist = PlanarTwist { x_m_s: twist[0], y_m_s: 0.0, yaw_rad_s: twist[1] };
        let commands = geometry(kind).commands(twist, None, false);
        let near = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len()
                && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(near(&commands.traction_rad_s, traction), "{commands:?}");
        assert!(near(&commands.steering_rad, steering), "{commands:?}");
        // The odometry of these commands is the twist again.
        let geometry = geometry(kind);
        let angle_rad = geometry.middle_angle(&commands.steering_rad);
        let back = geometry.twist(&commands.traction_rad_s, angle_rad);
        let error = (back.x_m_s - twist.x_m_s).abs() + (back.yaw_rad_s - twist.yaw_rad_s).abs();
        assert!(error < 1e-12, "{back:?}");
    }

    #[test]
    fn a_circle_of_four_metres_to_the_left() {
        // The middle of the driven axle is 4 m from the centre, the right wheel 4.5 m.
        let middle = libm::atan(0.25);
        check(SteeringKind::Bicycle, [1.0, 0.25], &[5.0], &[middle]);
        check(SteeringKind::Tricycle, [1.0, 0.25], &[5.625, 4.375], &[middle]);
        let sides = [libm::atan(1.0 / 4.4), libm::atan(1.0 / 3.6)];
        check(SteeringKind::Ackermann, [1.0, 0.25], &[5.625, 4.375], &sides);
    }

    #[test]
    fn straight_ahead() {
        check(SteeringKind::Bicycle, [1.0, 0.0], &[5.0], &[0.0]);
        check(SteeringKind::Tricycle, [1.0, 0.0], &[5.0, 5.0], &[0.0]);
        check(SteeringKind::Ackermann, [-1.0, 0.0], &[-5.0, -5.0], &[0.0, 0.0]);
    }

    #[test]
    fn no_turn_in_place() {
        let turn = PlanarTwist { yaw_rad_s: 1.0, ..PlanarTwist::default() };
        let commands = geometry(SteeringKind::Ackermann).commands(turn, None, false);
        assert_eq!(commands.traction_rad_s, [0.0, 0.0]);
        assert_eq!(commands.steering_rad, [0.0, 0.0]);
    }

    #[test]
    fn wheels_wait_for_the_steering() {
        let bicycle = geometry(SteeringKind::Bicycle);
        let twist = PlanarTwist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 1.0 };
        // 45 degrees are missing: cos(45 degrees).
        let commands = bicycle.commands(twist, Some(0.0), true);
        let expected = 5.0 * std::f64::consts::FRAC_1_SQRT_2;
        assert!((commands.traction_rad_s[0] - expected).abs() < 1e-12);
        assert_eq!(bicycle.commands(twist, Some(0.0), false).traction_rad_s, [5.0]);
    }
}
