//! The path of a slotcar.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_msgs::rmf_fleet_msgs::Location;

use crate::{FleetPathError, fleet_path_from, fleet_point_distance_m};

/// Distance from a point at which it is reached \[m\].
const REACHED_M: f64 = 0.02;

/// The same while the robot turns at the point, where it drifts a little \[m\].
const TURNING_REACHED_M: f64 = 0.04;

/// Error of the heading up to which the robot drives while it turns: 5 degrees \[rad\].
const AHEAD_RAD: f64 = 0.087_266;

/// Error of the heading that counts as none \[rad\].
const TURNED_RAD: f64 = 0.002;

/// Points that are not reached yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PathFollower {
    rest: Vec<Location>,
    /// Heading at the end \[rad\], until it is reached.
    end_yaw_rad: Option<f64>,
    was_turning: bool,
}

/// Remaining motion to the next point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Step {
    /// Distance to drive \[m\]; negative: backwards.
    pub(super) distance_m: f64,
    /// Angle to turn \[rad\].
    pub(super) turn_rad: f64,
    /// Limit of the speed on this part of the path \[m/s\].
    pub(super) speed_limit_m_s: Option<f64>,
}

impl PathFollower {
    /// Takes a path, whose first point is where the robot is.
    ///
    /// # Errors
    /// When the robot is not there, or a number is not finite: the robot stops.
    pub(super) fn take(&mut self, path: &[Location], pose: Pose2) -> Result<(), FleetPathError> {
        self.end_yaw_rad = None;
        let rest = fleet_path_from(path, pose).inspect_err(|_| self.rest.clear())?;
        self.rest = rest.to_vec();
        self.end_yaw_rad = path.last().map(|last| f64::from(last.yaw));
        Ok(())
    }

    /// Points that are not reached yet.
    pub(super) fn rest(&self) -> &[Location] {
        &self.rest
    }

    /// True at the end of the path.
    pub(super) fn is_done(&self) -> bool {
        self.rest.is_empty() && self.end_yaw_rad.is_none()
    }

    /// Remaining motion from a pose; `holds` keeps the robot at the next point.
    pub(super) fn step(&mut self, pose: Pose2, is_reversible: bool, holds: bool) -> Step {
        while let Some(next) = self.rest.first() {
            let away_m = fleet_point_distance_m(pose, next);
            let reach_m = if self.was_turning { TURNING_REACHED_M } else { REACHED_M };
            if away_m >= reach_m {
                break;
            }
            if holds {
                self.was_turning = true;
                let turn_rad = turn_to(pose, f64::from(next.yaw));
                return Step { turn_rad, ..Step::default() };
            }
            self.was_turning = false;
            self.rest.remove(0);
        }
        let Some(next) = self.rest.first() else { return self.turn_at_end(pose) };
        let (x_m, y_m) = (f64::from(next.x) - pose.x_m, f64::from(next.y) - pose.y_m);
        let ahead_rad = turn_to(pose, libm::atan2(y_m, x_m));
        let is_behind = is_reversible && ahead_rad.abs() > std::f64::consts::FRAC_PI_2;
        let turn_rad = if is_behind { turn_to(pose, libm::atan2(-y_m, -x_m)) } else { ahead_rad };
        let away_m = if is_behind { -libm::hypot(x_m, y_m) } else { libm::hypot(x_m, y_m) };
        let limit_m_s = f64::from(next.approach_speed_limit);
        let is_limited = next.obey_approach_speed_limit && limit_m_s > 0.0;
        Step {
            distance_m: if turn_rad.abs() < AHEAD_RAD { away_m } else { 0.0 },
            turn_rad,
            speed_limit_m_s: is_limited.then_some(limit_m_s),
        }
    }

    fn turn_at_end(&mut self, pose: Pose2) -> Step {
        let Some(yaw_rad) = self.end_yaw_rad else { return Step::default() };
        let turn_rad = turn_to(pose, yaw_rad);
        if turn_rad.abs() < TURNED_RAD {
            self.end_yaw_rad = None;
            return Step::default();
        }
        Step { turn_rad, ..Step::default() }
    }
}

fn turn_to(pose: Pose2, yaw_rad: f64) -> f64 {
    normalize_angle(yaw_rad - pose.yaw_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, y: f32, yaw: f32) -> Location {
        Location { x, y, yaw, ..Location::default() }
    }

    fn follower(path: &[Location]) -> PathFollower {
        let mut follower = PathFollower::default();
        follower.take(path, Pose2::IDENTITY).unwrap();
        follower
    }

    #[test]
    fn it_turns_before_it_drives() {
        let check = |to: [f32; 2], is_reversible, distance_m: f64, turn_rad: f64| {
            let mut follower = follower(&[at(0.0, 0.0, 0.0), at(to[0], to[1], 0.0)]);
            let step = follower.step(Pose2::IDENTITY, is_reversible, false);
            assert!((step.distance_m - distance_m).abs() < 1e-9, "{to:?}: {step:?}");
            assert!((step.turn_rad - turn_rad).abs() < 1e-6, "{to:?}: {step:?}");
        };
        check([2.0, 0.0], true, 2.0, 0.0);
        check([-2.0, 0.0], true, -2.0, 0.0);
        check([-2.0, 0.0], false, 0.0, std::f64::consts::PI);
        check([0.0, 1.0], true, 0.0, std::f64::consts::FRAC_PI_2);
    }

    #[test]
    fn points_are_passed_and_the_end_has_a_heading() {
        let mut follower = follower(&[at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(2.0, 0.0, 1.0)]);
        follower.step(Pose2::new(0.99, 0.0, 0.0), true, false);
        assert_eq!(follower.rest().len(), 1);
        let step = follower.step(Pose2::new(2.0, 0.0, 0.0), true, false);
        assert!(follower.rest().is_empty() && (step.turn_rad - 1.0).abs() < 1e-6, "{step:?}");
        assert!(!follower.is_done());
        follower.step(Pose2::new(2.0, 0.0, 1.0), true, false);
        assert!(follower.is_done());
    }

    #[test]
    fn it_waits_at_a_point() {
        let mut follower = follower(&[at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.5), at(2.0, 0.0, 0.0)]);
        let step = follower.step(Pose2::new(1.0, 0.0, 0.0), true, true);
        assert_eq!((step.distance_m, follower.rest().len()), (0.0, 2));
        assert!((step.turn_rad - 0.5).abs() < 1e-6);
        let step = follower.step(Pose2::new(1.0, 0.0, 0.0), true, false);
        assert!((step.distance_m - 1.0).abs() < 1e-9, "{step:?}");
    }

    #[test]
    fn a_path_from_elsewhere_is_refused() {
        let mut follower = PathFollower::default();
        let refused = follower.take(&[at(3.0, 0.0, 0.0), at(4.0, 0.0, 0.0)], Pose2::IDENTITY);
        assert_eq!(
            refused.map_err(|why| why.to_string()),
            Err("it begins 3.0 m from the robot".to_owned())
        );
        assert!(follower.is_done());
        assert!(follower.take(&[at(f32::NAN, 0.0, 0.0)], Pose2::IDENTITY).is_err());
    }
}
