//! Time of a drive from its first motion to its arrival, from the truth.

use periplus_geometry::Pose2;

use crate::Simulation;

/// Distance from the start at which the clock begins \[m\], as in the BARN challenge.
const MOTION_M: f64 = 0.1;

/// Clock of a drive to a point: it begins when the robot has moved, and ends near the point.
///
/// Source of the rule: `run.py` of the BARN challenge.
#[derive(Clone, Debug)]
pub struct ArrivalClock {
    target_m: [f64; 2],
    radius_m: f64,
    start: Option<Pose2>,
    began_ns: Option<i64>,
    arrived_ns: Option<i64>,
}

impl ArrivalClock {
    /// Clock of a drive to a point in the frame of the world \[m\]; the robot arrives within `radius_m` of it.
    #[must_use]
    pub fn new(target_m: [f64; 2], radius_m: f64) -> Self {
        Self { target_m, radius_m, start: None, began_ns: None, arrived_ns: None }
    }

    /// Looks at the robot. Call it after each step.
    pub fn sample(&mut self, simulation: &Simulation) {
        if let Some(pose) = simulation.robot_pose() {
            self.look(Pose2::from(pose), simulation.time_ns());
        }
    }

    fn look(&mut self, pose: Pose2, now_ns: i64) {
        let start = *self.start.get_or_insert(pose);
        if libm::hypot(pose.x_m - start.x_m, pose.y_m - start.y_m) > MOTION_M {
            self.began_ns.get_or_insert(now_ns);
        }
        let [x_m, y_m] = self.target_m;
        if self.began_ns.is_some() && libm::hypot(pose.x_m - x_m, pose.y_m - y_m) <= self.radius_m {
            self.arrived_ns.get_or_insert(now_ns);
        }
    }

    /// Time from the first motion to the arrival \[s\].
    #[must_use]
    pub fn time_s(&self) -> Option<f64> {
        Some((self.arrived_ns? - self.began_ns?) as f64 * 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clock_runs_from_the_first_motion_to_the_circle_around_the_target() {
        let mut clock = ArrivalClock::new([10.0, 0.0], 1.0);
        for (second, x_m) in [0.0, 0.05, 0.2, 5.0, 8.9, 9.0, 10.0].into_iter().enumerate() {
            clock.look(Pose2::new(x_m, 0.0, 0.0), second as i64 * 1_000_000_000);
            assert_eq!(clock.time_s().is_some(), x_m >= 9.0);
        }
        assert_eq!(clock.time_s(), Some(3.0));
    }
}
