//! Path following over a sequence of goals.

use periplus_geometry::Pose;
use periplus_msgs::geometry_msgs::Twist;

/// A goal position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Position in the world frame \[m\].
    pub position_m: [f64; 2],
    /// Earliest simulated time \[ns\].
    pub not_before_ns: i64,
    /// Maximum speed [m/s].
    pub speed_m_s: f64,
    /// Maximum yaw rate [rad/s].
    pub turn_rad_s: f64,
    /// Maximum deceleration towards the last goal and acceleration from standstill [m/s²].
    pub acceleration_m_s2: f64,
    /// Tolerance of the position \[m\].
    pub tolerance_m: f64,
    /// Minimum turning radius of a car \[m\]; 0 turns in place.
    pub radius_m: f64,
}

impl Goal {
    /// Returns a goal with defaults: at most 0.5 m/s and 1 rad/s, to within 0.1 m.
    #[must_use]
    pub fn at(position_m: [f64; 2]) -> Self {
        Self {
            position_m,
            not_before_ns: 0,
            speed_m_s: 0.5,
            turn_rad_s: 1.0,
            acceleration_m_s2: 0.5,
            tolerance_m: 0.1,
            radius_m: 0.0,
        }
    }
}

/// A planar velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarVelocity {
    /// Forwards [m/s].
    pub forward_m_s: f64,
    /// Yaw rate, counterclockwise [rad/s].
    pub left_rad_s: f64,
}

impl From<PlanarVelocity> for Twist {
    fn from(velocity: PlanarVelocity) -> Self {
        let mut twist = Self::default();
        twist.linear.x = velocity.forward_m_s;
        twist.angular.z = velocity.left_rad_s;
        twist
    }
}

/// Angle to the goal beyond which a robot turns in place, if it can [rad]: about 45 degrees.
const TURN_IN_PLACE_RAD: f64 = 0.8;

/// Yaw rate per remaining angle when turning in place [1/s].
const TURN_GAIN_PER_S: f64 = 2.0;

/// Minimum speed, so that the last centimetres do not take forever [m/s].
const MIN_SPEED_M_S: f64 = 0.02;

/// Drives to goals in their order.
///
/// The control law is pure pursuit (Coulter 1992, "Implementation of the Pure Pursuit Path Tracking
/// Algorithm") with the goal itself as the pursued point: the arc through it, tangent to the
/// heading, has the curvature `2 y / d²`, where `y` is the lateral offset of the goal and `d` its
/// distance. A robot with the goal far to the side turns in place first.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalController {
    goals: Vec<Goal>,
    next: usize,
    turning: bool,
}

impl GoalController {
    /// Creates a pilot before the first goal.
    #[must_use]
    pub fn new(goals: Vec<Goal>) -> Self {
        Self { goals, next: 0, turning: false }
    }

    /// Returns the current goal; `None` when all are reached.
    #[must_use]
    pub fn goal(&self) -> Option<&Goal> {
        self.goals.get(self.next)
    }

    /// Returns the number of reached goals.
    #[must_use]
    pub fn reached(&self) -> usize {
        self.next
    }

    /// Returns the velocity at a time and pose of the robot's base; `None` when all goals are
    /// reached.
    pub fn steer(&mut self, time_ns: i64, world_from_base: Pose) -> Option<PlanarVelocity> {
        loop {
            let goal = *self.goals.get(self.next)?;
            if time_ns < goal.not_before_ns {
                return Some(PlanarVelocity::default());
            }
            let Some(distance_m) = distance(&goal, world_from_base) else {
                // A robot without a pose stops.
                return Some(PlanarVelocity::default());
            };
            if distance_m > goal.tolerance_m {
                return Some(self.towards(&goal, world_from_base, distance_m));
            }
            self.next += 1;
            self.turning = false;
        }
    }

    fn towards(&mut self, goal: &Goal, world_from_base: Pose, distance_m: f64) -> PlanarVelocity {
        let yaw_rad = world_from_base.rpy().yaw;
        let (sine, cosine) = libm::sincos(yaw_rad);
        let [x_m, y_m] = offset(goal, world_from_base);
        let ahead_m = cosine * x_m + sine * y_m;
        let left_m = cosine * y_m - sine * x_m;
        let angle_rad = libm::atan2(left_m, ahead_m);

        let can_turn_in_place = goal.radius_m <= 0.0;
        // A turn in place is finished once begun, to avoid chattering at the threshold.
        let enough_rad = if self.turning { 0.05 } else { TURN_IN_PLACE_RAD };
        self.turning = can_turn_in_place && angle_rad.abs() > enough_rad;
        if self.turning {
            let rate = (TURN_GAIN_PER_S * angle_rad).clamp(-goal.turn_rad_s, goal.turn_rad_s);
            return PlanarVelocity { forward_m_s: 0.0, left_rad_s: rate };
        }

        let mut curvature = 2.0 * left_m / (distance_m * distance_m);
        if !can_turn_in_place {
            let tightest = 1.0 / goal.radius_m;
            curvature = if ahead_m < 0.0 {
                // The arc through a goal behind would be driven backwards; turn around first.
                if left_m < 0.0 { -tightest } else { tightest }
            } else {
                curvature.clamp(-tightest, tightest)
            };
        }
        let is_last = self.next + 1 == self.goals.len();
        let mut speed_m_s = goal.speed_m_s;
        if is_last {
            // Braking distance: v² = 2 a s.
            let braking = libm::sqrt(2.0 * goal.acceleration_m_s2 * distance_m);
            speed_m_s = speed_m_s.min(braking).max(MIN_SPEED_M_S.min(goal.speed_m_s));
        }
        // A tight curve is driven slowly enough for the maximum yaw rate.
        if (curvature * speed_m_s).abs() > goal.turn_rad_s {
            speed_m_s = goal.turn_rad_s / curvature.abs();
        }
        PlanarVelocity { forward_m_s: speed_m_s, left_rad_s: curvature * speed_m_s }
    }
}

fn offset(goal: &Goal, world_from_base: Pose) -> [f64; 2] {
    let [x_m, y_m] = goal.position_m;
    [x_m - world_from_base.translation.x, y_m - world_from_base.translation.y]
}

fn distance(goal: &Goal, world_from_base: Pose) -> Option<f64> {
    let [x_m, y_m] = offset(goal, world_from_base);
    let is_somewhere = world_from_base.is_finite();
    is_somewhere.then(|| libm::hypot(x_m, y_m))
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;
    use proptest::prelude::*;

    use super::*;

    fn pose(x: f64, y: f64, yaw: f64) -> Pose {
        Pose::from_xyz_rpy([x, y, 0.0], Rpy { roll: 0.0, pitch: 0.0, yaw })
    }

    /// Simulates an ideal robot at 50 Hz; returns the final time and pose.
    fn drive(goals: Vec<Goal>, mut at: [f64; 3], longest_s: f64) -> Option<(f64, [f64; 3])> {
        let mut pilot = GoalController::new(goals);
        let step_s = 0.02;
        let mut time_s = 0.0;
        while time_s < longest_s {
            let time_ns = (time_s * 1e9) as i64;
            let Some(velocity) = pilot.steer(time_ns, pose(at[0], at[1], at[2])) else {
                return Some((time_s, at));
            };
            let goal = pilot.goal().unwrap();
            assert!(velocity.forward_m_s <= goal.speed_m_s + 1e-12, "{velocity:?}");
            assert!(velocity.left_rad_s.abs() <= goal.turn_rad_s + 1e-12, "{velocity:?}");
            let middle = at[2] + velocity.left_rad_s * step_s / 2.0;
            at[0] += velocity.forward_m_s * step_s * libm::cos(middle);
            at[1] += velocity.forward_m_s * step_s * libm::sin(middle);
            at[2] += velocity.left_rad_s * step_s;
            time_s += step_s;
        }
        None
    }

    #[test]
    fn straight_ahead_is_straight() {
        let velocity =
            GoalController::new(vec![Goal::at([9.0, 0.0])]).steer(0, Pose::IDENTITY).unwrap();
        assert_eq!(velocity, PlanarVelocity { forward_m_s: 0.5, left_rad_s: 0.0 });
        // A quarter circle of 1 m would lead there, but the goal is 45 degrees off: an arc.
        let velocity =
            GoalController::new(vec![Goal::at([1.0, 1.0])]).steer(0, Pose::IDENTITY).unwrap();
        assert!((velocity.left_rad_s / velocity.forward_m_s - 1.0).abs() < 1e-12);
        // To the left: turn first.
        let velocity =
            GoalController::new(vec![Goal::at([0.0, 1.0])]).steer(0, Pose::IDENTITY).unwrap();
        assert_eq!(velocity, PlanarVelocity { forward_m_s: 0.0, left_rad_s: 1.0 });
    }

    #[test]
    fn goals_are_reached_one_after_the_other() {
        let square = [[2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        let (time_s, at) =
            drive(square.map(Goal::at).to_vec(), [0.0; 3], 100.0).expect("all are reached");
        assert!(libm::hypot(at[0], at[1]) <= 0.1, "{at:?}");
        // 8 m at 0.5 m/s and three quarter turns at up to 1 rad/s.
        assert!((16.0..28.0).contains(&time_s), "{time_s}");
    }

    #[test]
    fn a_goal_waits_for_its_time() {
        let goal = Goal { not_before_ns: 5_000_000_000, ..Goal::at([1.0, 0.0]) };
        let mut pilot = GoalController::new(vec![goal]);
        assert_eq!(pilot.steer(4_999_999_999, Pose::IDENTITY), Some(PlanarVelocity::default()));
        assert!(pilot.steer(5_000_000_000, Pose::IDENTITY).unwrap().forward_m_s > 0.0);
        assert_eq!(pilot.steer(6_000_000_000, pose(0.95, 0.0, 0.0)), None);
        assert_eq!(pilot.reached(), 1);
    }

    #[test]
    fn a_car_keeps_its_radius() {
        let goal = Goal { radius_m: 1.5, tolerance_m: 0.2, ..Goal::at([-4.0, 0.5]) };
        let mut pilot = GoalController::new(vec![goal]);
        let first = pilot.steer(0, Pose::IDENTITY).unwrap();
        assert!((first.left_rad_s / first.forward_m_s - 1.0 / 1.5).abs() < 1e-12);
        assert!(drive(vec![goal], [0.0; 3], 100.0).is_some());
    }

    #[test]
    fn a_robot_that_is_nowhere_stands() {
        let mut pilot = GoalController::new(vec![Goal::at([1.0, 0.0])]);
        let nowhere = pose(f64::NAN, 0.0, 0.0);
        assert_eq!(pilot.steer(0, nowhere), Some(PlanarVelocity::default()));
    }

    proptest! {
        #[test]
        fn every_goal_is_reached(x in -5.0..5.0, y in -5.0..5.0, yaw in -3.2..3.2) {
            let end = drive(vec![Goal::at([x, y])], [0.0, 0.0, yaw], 120.0);
            let (_, at) = end.expect("reached");
            prop_assert!(libm::hypot(at[0] - x, at[1] - y) <= 0.1 + 1e-9);
        }
    }
}
