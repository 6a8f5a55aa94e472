//! Scripted motion of an actor: trajectories of waypoints, as SDF's `<actor>` has them.
//!
//! The interpolation is that of Gazebo (`PoseAnimation` of gz-common, `Spline` and `RotationSpline` of gz-math, the same
//! in Gazebo Classic). Between two waypoints the time is a ratio `t` from 0 to 1. Positions are cubic Hermite curves with
//! the tangents of Catmull and Rom, `(1 - tension) (p[i+1] - p[i-1]) / 2`; at an end the missing neighbour is the
//! waypoint itself, and on a closed path, whose first and last positions are equal, the one across the seam. Rotations
//! are spherical quadrangle curves (K. Shoemake, "Quaternion calculus and fast animation", SIGGRAPH 1987): `squad(t, p, a,
//! b, q) = slerp(2 t (1 - t), slerp(t, p, q), slerp(t, a, b))` with the control rotation of each waypoint
//! `a = p exp(-(log(p^-1 next) + log(p^-1 previous)) / 4)`.
//!
//! The trajectories of a script follow each other, each for the time from its first to its last waypoint.

mod rotation;

use periplus_geometry::{DQuat, DVec3, Pose};

use self::rotation::{control, squad};

/// Samples between two waypoints from which lengths are computed.
const LENGTH_SAMPLES: u32 = 64;

/// Time over which a speed is measured \[s\].
const SPEED_INTERVAL_S: f64 = 0.02;

/// Pose at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Time since the start of the script \[s\].
    pub time_s: f64,
    /// `world_from_waypoint`.
    pub pose: Pose,
}

/// Trajectory through waypoints.
#[derive(Clone, Debug, PartialEq)]
pub struct ActorTrajectory {
    waypoints: Vec<Waypoint>,
    tangents_m: Vec<DVec3>,
    controls: Vec<DQuat>,
    /// Length of the path up to each sample \[m\].
    lengths_m: Vec<f64>,
}

impl ActorTrajectory {
    /// Trajectory through waypoints, which are sorted by time; of equal times the last counts, as in Gazebo. The
    /// tension is clamped to 0 (smooth) to 1 (straight); without waypoints the result is none.
    #[must_use]
    pub fn new(mut waypoints: Vec<Waypoint>, tension: f64) -> Option<Self> {
        waypoints.retain(|it| it.time_s.is_finite() && it.pose.is_finite());
        waypoints.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        // Of equal times the last one stays.
        waypoints.reverse();
        waypoints.dedup_by(|next, kept| next.time_s == kept.time_s);
        waypoints.reverse();
        if waypoints.is_empty() {
            return None;
        }
        let looseness = 1.0 - tension.clamp(0.0, 1.0);
        let last = waypoints.len() - 1;
        let at = |index: usize| waypoints[index].pose.translation;
        let is_closed = last > 0 && at(0) == at(last);
        let turn = |index: usize| waypoints[index].pose.rotation;
        let is_closed_turn = last > 0 && turn(0) == turn(last);
        let neighbours = |index: usize, is_closed: bool| {
            let before = if index > 0 {
                index - 1
            } else if is_closed {
                last - 1
            } else {
                0
            };
            let after = if index < last {
                index + 1
            } else if is_closed {
                1
            } else {
                last
            };
            [before, after]
        };
        let tangent = |index: usize| {
            let [before, after] = neighbours(index, is_closed);
            (at(after) - at(before)) * (0.5 * looseness)
        };
        let control = |index: usize| {
            let [before, after] = neighbours(index, is_closed_turn);
            control(turn(index), turn(before), turn(after))
        };
        let tangents_m = (0..=last).map(tangent).collect();
        let controls = (0..=last).map(control).collect();
        let mut trajectory = Self { waypoints, tangents_m, controls, lengths_m: vec![0.0] };
        let mut before = trajectory.waypoints[0].pose.translation;
        for segment in 0..last {
            for sample in 1..=LENGTH_SAMPLES {
                let ratio = f64::from(sample) / f64::from(LENGTH_SAMPLES);
                let point = trajectory.position(segment, ratio);
                let length_m = trajectory.length_m() + before.distance(point);
                trajectory.lengths_m.push(length_m);
                before = point;
            }
        }
        Some(trajectory)
    }

    /// Time from the first to the last waypoint \[s\].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.waypoints[self.waypoints.len() - 1].time_s - self.waypoints[0].time_s
    }

    /// Length of the path \[m\].
    #[must_use]
    pub fn length_m(&self) -> f64 {
        self.lengths_m[self.lengths_m.len() - 1]
    }

    /// Returns the pose at a time since the first waypoint, and the length of the path to it; before the start and
    /// after the end those of the ends.
    #[must_use]
    pub fn sample(&self, time_s: f64) -> (Pose, f64) {
        let time_s = self.waypoints[0].time_s + time_s.max(0.0);
        let after = self.waypoints.partition_point(|waypoint| waypoint.time_s <= time_s);
        if after == self.waypoints.len() {
            return (self.waypoints[after - 1].pose, self.length_m());
        }
        let segment = after.saturating_sub(1);
        let (start, end) = (&self.waypoints[segment], &self.waypoints[segment + 1]);
        let ratio = (time_s - start.time_s) / (end.time_s - start.time_s);
        let rotation = squad(
            ratio,
            [start.pose.rotation, end.pose.rotation],
            [self.controls[segment], self.controls[segment + 1]],
        );
        let pose = Pose { translation: self.position(segment, ratio), rotation };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a ratio from 0 to 1"
        )]
        let sample = (ratio * f64::from(LENGTH_SAMPLES)) as usize;
        let index = segment * LENGTH_SAMPLES as usize + sample;
        let part = ratio * f64::from(LENGTH_SAMPLES) - (ratio * f64::from(LENGTH_SAMPLES)).floor();
        let next = self.lengths_m[(index + 1).min(self.lengths_m.len() - 1)];
        (pose, self.lengths_m[index] + (next - self.lengths_m[index]) * part)
    }

    fn position(&self, segment: usize, t: f64) -> DVec3 {
        let [start, end] =
            [segment, segment + 1].map(|index| self.waypoints[index].pose.translation);
        let (t2, t3) = (t * t, t * t * t);
        start * (2.0 * t3 - 3.0 * t2 + 1.0)
            + end * (3.0 * t2 - 2.0 * t3)
            + self.tangents_m[segment] * (t3 - 2.0 * t2 + t)
            + self.tangents_m[segment + 1] * (t3 - t2)
    }
}

/// Script of an actor.
#[derive(Clone, Debug, PartialEq)]
pub struct ActorScript {
    /// Trajectories, one after the other.
    pub trajectories: Vec<ActorTrajectory>,
    /// True if the script starts again at its end.
    pub is_loop: bool,
    /// Time before the start of the script \[s\].
    pub delay_start_s: f64,
}

/// Motion of an actor at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActorMotion {
    /// `world_from_waypoint`.
    pub pose: Pose,
    /// Length of the path since the start of the script \[m\].
    pub walked_m: f64,
    /// Speed \[m/s\].
    pub speed_m_per_s: f64,
}

impl ActorScript {
    /// Duration of all trajectories \[s\].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.trajectories.iter().map(ActorTrajectory::duration_s).sum()
    }

    /// Returns the motion at a time since the start of the simulation; none without trajectories.
    #[must_use]
    pub fn motion_at(&self, time_s: f64) -> Option<ActorMotion> {
        let (pose, walked_m) = self.sample(time_s)?;
        // Backwards, so that the seam of a loop and the end of the script have a speed.
        let (_, before_m) = self.sample(time_s - SPEED_INTERVAL_S)?;
        let speed_m_per_s = (walked_m - before_m).max(0.0) / SPEED_INTERVAL_S;
        Some(ActorMotion { pose, walked_m, speed_m_per_s })
    }

    fn sample(&self, time_s: f64) -> Option<(Pose, f64)> {
        let duration_s = self.duration_s();
        let mut time_s = (time_s - self.delay_start_s).max(0.0);
        let mut walked_m = 0.0;
        if self.is_loop && duration_s > 0.0 {
            let rounds = (time_s / duration_s).floor();
            time_s -= rounds * duration_s;
            let length_m: f64 = self.trajectories.iter().map(ActorTrajectory::length_m).sum();
            walked_m = rounds * length_m;
        }
        let (last, others) = self.trajectories.split_last()?;
        for trajectory in others {
            if time_s < trajectory.duration_s() {
                let (pose, length_m) = trajectory.sample(time_s);
                return Some((pose, walked_m + length_m));
            }
            time_s -= trajectory.duration_s();
            walked_m += trajectory.length_m();
        }
        let (pose, length_m) = last.sample(time_s);
        Some((pose, walked_m + length_m))
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Rpy;

    use super::*;

    fn waypoint(time_s: f64, x: f64, y: f64, yaw: f64) -> Waypoint {
        let rpy = Rpy { roll: 0.0, pitch: 0.0, yaw };
        Waypoint { time_s, pose: Pose::from_xyz_rpy([x, y, 0.0], rpy) }
    }

    fn script(trajectories: Vec<ActorTrajectory>, is_loop: bool) -> ActorScript {
        ActorScript { trajectories, is_loop, delay_start_s: 0.0 }
    }

    fn at(trajectory: &ActorTrajectory, time_s: f64) -> [f64; 2] {
        let point = trajectory.sample(time_s).0.translation;
        [point.x, point.y]
    }

    #[test]
    fn two_waypoints_are_a_straight_line_with_soft_ends() {
        let points = vec![waypoint(1.0, 0.0, 0.0, 0.0), waypoint(3.0, 4.0, 0.0, 0.0)];
        let smooth = ActorTrajectory::new(points.clone(), 0.0).unwrap();
        assert_eq!(smooth.duration_s(), 2.0);
        // Tangents of 2 m at both ends: 4 (3 / 16 - 2 / 64) + 2 (1/64 - 2/16 + 1/4) + 2 (1/64 - 1/16) at a quarter.
        assert!((at(&smooth, 0.5)[0] - 0.8125).abs() < 1e-12, "{:?}", at(&smooth, 0.5));
        assert_eq!(at(&smooth, 1.0), [2.0, 0.0]);
        assert_eq!(at(&smooth, 9.0), [4.0, 0.0]);
        // Full tension: it starts and ends at rest, 4 (3 / 16 - 2 / 64).
        let stiff = ActorTrajectory::new(points, 1.0).unwrap();
        assert_eq!(at(&stiff, 0.5), [0.625, 0.0]);
        assert!((stiff.sample(0.5).1 - 0.625).abs() < 1e-9);
    }

    #[test]
    fn three_waypoints_are_a_curve_of_catmull_and_rom() {
        let points = vec![
            waypoint(0.0, 0.0, 0.0, 0.0),
            waypoint(1.0, 2.0, 0.0, 0.0),
            waypoint(2.0, 2.0, 2.0, 0.0),
        ];
        let trajectory = ActorTrajectory::new(points, 0.0).unwrap();
        // The tangent in the middle is (1, 1), at the start (1, 0): at half of the first part the position is
        // (0 + 2) / 2 + (1 - 1) / 8 along x and -1 / 8 along y.
        assert_eq!(at(&trajectory, 0.5), [1.0, -0.125]);
    }

    #[test]
    fn rotations_turn_the_short_way() {
        let points = vec![waypoint(0.0, 0.0, 0.0, 3.0), waypoint(1.0, 0.0, 0.0, -3.0)];
        let trajectory = ActorTrajectory::new(points, 0.0).unwrap();
        let yaw = trajectory.sample(0.5).0.rpy().yaw;
        assert!((yaw.abs() - std::f64::consts::PI).abs() < 1e-9, "{yaw}");
    }

    #[test]
    fn a_loop_starts_again_and_the_path_grows() {
        let there = ActorTrajectory::new(
            vec![waypoint(0.0, 0.0, 0.0, 0.0), waypoint(2.0, 4.0, 0.0, 0.0)],
            1.0,
        );
        let back = ActorTrajectory::new(
            vec![waypoint(5.0, 4.0, 0.0, 0.0), waypoint(7.0, 0.0, 0.0, 0.0)],
            1.0,
        );
        let trajectories = vec![there.unwrap(), back.unwrap()];
        let endless = script(trajectories.clone(), true);
        let motion = endless.motion_at(5.0).unwrap();
        assert!((motion.pose.translation.x - 2.0).abs() < 1e-9);
        assert!((motion.walked_m - 10.0).abs() < 1e-6, "{motion:?}");
        // In the middle a path with full tension has 1.5 times the mean speed of 2 m/s.
        assert!((motion.speed_m_per_s - 3.0).abs() < 0.01, "{motion:?}");
        let once = script(trajectories, false).motion_at(50.0).unwrap();
        assert_eq!((once.pose.translation.x, once.speed_m_per_s), (0.0, 0.0));
    }

    #[test]
    fn a_delay_holds_the_first_waypoint() {
        let points = vec![waypoint(0.0, 0.0, 0.0, 0.0), waypoint(2.0, 4.0, 0.0, 0.0)];
        let trajectories = vec![ActorTrajectory::new(points, 1.0).unwrap()];
        let script = ActorScript { delay_start_s: 3.0, ..script(trajectories, true) };
        assert_eq!(script.motion_at(2.9).unwrap().walked_m, 0.0);
        assert!((script.motion_at(4.0).unwrap().pose.translation.x - 2.0).abs() < 1e-9);
        assert_eq!(ActorScript { trajectories: Vec::new(), ..script }.motion_at(0.0), None);
    }
}
