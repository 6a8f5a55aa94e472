//! Trajectories of joints, sampled as splines.

/// State of all joints at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrajectoryPoint {
    /// Positions [m or rad]; empty if not given.
    pub positions: Vec<f64>,
    /// Velocities [m/s or rad/s]; empty if not given.
    pub velocities: Vec<f64>,
    /// Accelerations [m/s² or rad/s²]; empty if not given.
    pub accelerations: Vec<f64>,
    /// Efforts [N or N m]; empty if not given.
    pub efforts: Vec<f64>,
    /// Time from the start of the trajectory [ns].
    pub time_from_start_ns: i64,
}

/// Points of joints over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointTrajectory {
    /// Names of the joints, in the order of the points' values.
    pub joints: Vec<String>,
    /// Points by rising time.
    pub points: Vec<TrajectoryPoint>,
    /// Time of the start [ns]; zero starts when the trajectory is received.
    pub start_ns: i64,
}

/// Part of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplePhase {
    /// Before the last point.
    Moving,
    /// At or after the last point.
    AtEnd,
}

/// A state between the points of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectorySample {
    /// Interpolated state with positions, velocities and accelerations.
    pub point: TrajectoryPoint,
    /// Part of the trajectory.
    pub phase: SamplePhase,
}

impl JointTrajectory {
    /// Returns the time of the last point [ns].
    #[must_use]
    pub fn end_ns(&self) -> i64 {
        self.start_ns.saturating_add(self.points.last().map_or(0, |point| point.time_from_start_ns))
    }

    /// Returns the interpolated state at a time [ns]. `before` is the state at `before_ns`, from
    /// which the first point is approached. `None` without points.
    ///
    /// Source: `Trajectory::sample` of `joint_trajectory_controller`: linear without velocities,
    /// cubic with velocities, quintic with accelerations too, of both ends of a segment.
    #[must_use]
    pub fn sample(
        &self,
        time_ns: i64,
        before: &TrajectoryPoint,
        before_ns: i64,
        interpolates: bool,
    ) -> Option<TrajectorySample> {
        let at = |point: &TrajectoryPoint| self.start_ns.saturating_add(point.time_from_start_ns);
        let first = self.points.first()?;
        let moving = |point| Some(TrajectorySample { point, phase: SamplePhase::Moving });
        if time_ns < at(first) {
            return moving(if interpolates {
                between((before_ns, before), (at(first), first), time_ns)
            } else {
                before.clone()
            });
        }
        for pair in self.points.windows(2) {
            let [start, end] = pair else { continue };
            if time_ns >= at(start) && time_ns < at(end) {
                return moving(if interpolates {
                    between((at(start), start), (at(end), end), time_ns)
                } else {
                    end.clone()
                });
            }
        }
        let mut point = self.points.last()?.clone();
        let count = point.positions.len();
        for values in [&mut point.velocities, &mut point.accelerations] {
            if values.is_empty() {
                values.resize(count, 0.0);
            }
        }
        Some(TrajectorySample { point, phase: SamplePhase::AtEnd })
    }
}

#[expect(clippy::cast_precision_loss, reason = "segments are far below 2^53 ns")]
fn seconds(ns: i64) -> f64 {
    ns as f64 * 1e-9
}

/// Interpolates between two states with their times [ns].
fn between(
    (start_ns, start): (i64, &TrajectoryPoint),
    (end_ns, end): (i64, &TrajectoryPoint),
    time_ns: i64,
) -> TrajectoryPoint {
    let whole_s = seconds(end_ns.saturating_sub(start_ns)).max(0.0);
    let raw_s = seconds(time_ns.saturating_sub(start_ns));
    let passed_s = raw_s.clamp(0.0, whole_s);
    let is_inside = passed_s == raw_s;
    let has_velocities = is_inside && !start.velocities.is_empty() && !end.velocities.is_empty();
    let has_accelerations =
        has_velocities && !start.accelerations.is_empty() && !end.accelerations.is_empty();
    let at = |values: &[f64], index: usize| values.get(index).copied().unwrap_or_default();
    let mut point = TrajectoryPoint::default();
    for index in 0..start.positions.len() {
        let ends = [
            SplineEnd {
                position: at(&start.positions, index),
                velocity: at(&start.velocities, index),
                acceleration: at(&start.accelerations, index),
            },
            SplineEnd {
                position: at(&end.positions, index),
                velocity: at(&end.velocities, index),
                acceleration: at(&end.accelerations, index),
            },
        ];
        let coefficients = if has_accelerations {
            quintic(ends, whole_s)
        } else if has_velocities {
            cubic(ends, whole_s)
        } else {
            linear(ends, whole_s)
        };
        let [position, velocity, acceleration] = evaluate(coefficients, passed_s);
        point.positions.push(position);
        point.velocities.push(velocity);
        point.accelerations.push(acceleration);
    }
    point
}

#[derive(Clone, Copy)]
struct SplineEnd {
    position: f64,
    velocity: f64,
    acceleration: f64,
}

/// Coefficients of a polynomial of the time, the constant one first.
type Polynomial = [f64; 6];

fn linear([start, end]: [SplineEnd; 2], whole_s: f64) -> Polynomial {
    let slope = if whole_s > 0.0 { (end.position - start.position) / whole_s } else { 0.0 };
    [start.position, slope, 0.0, 0.0, 0.0, 0.0]
}

/// Cubic Hermite spline.
fn cubic([start, end]: [SplineEnd; 2], whole_s: f64) -> Polynomial {
    let mut spline = [start.position, start.velocity, 0.0, 0.0, 0.0, 0.0];
    if whole_s > 0.0 {
        let slope = (end.position - start.position) / whole_s;
        spline[2] = (3.0 * slope - 2.0 * start.velocity - end.velocity) / whole_s;
        spline[3] = (start.velocity + end.velocity - 2.0 * slope) / (whole_s * whole_s);
    }
    spline
}

/// Quintic Hermite spline, from the conditions of position, velocity and acceleration at the end.
fn quintic([start, end]: [SplineEnd; 2], whole_s: f64) -> Polynomial {
    let mut spline = [start.position, start.velocity, 0.5 * start.acceleration, 0.0, 0.0, 0.0];
    if whole_s > 0.0 {
        let s2 = whole_s * whole_s;
        // Missing position, velocity and acceleration at the end, each scaled by the time.
        let position = end.position
            - start.position
            - start.velocity * whole_s
            - 0.5 * start.acceleration * s2;
        let velocity = (end.velocity - start.velocity - start.acceleration * whole_s) * whole_s;
        let acceleration = (end.acceleration - start.acceleration) * s2;
        let s3 = s2 * whole_s;
        spline[3] = (10.0 * position - 4.0 * velocity + 0.5 * acceleration) / s3;
        spline[4] = (-15.0 * position + 7.0 * velocity - acceleration) / (s3 * whole_s);
        spline[5] = (6.0 * position - 3.0 * velocity + 0.5 * acceleration) / (s3 * s2);
    }
    spline
}

/// Returns the value of a polynomial and its first two derivatives.
fn evaluate(coefficients: Polynomial, at_s: f64) -> [f64; 3] {
    let [mut value, mut first, mut half_second] = [0.0; 3];
    for coefficient in coefficients.into_iter().rev() {
        half_second = half_second * at_s + first;
        first = first * at_s + value;
        value = value * at_s + coefficient;
    }
    [value, first, 2.0 * half_second]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point(ms: i64, values: &[f64]) -> TrajectoryPoint {
        let one = |index: usize| values.get(index).map(|&value| vec![value]).unwrap_or_default();
        TrajectoryPoint {
            positions: one(0),
            velocities: one(1),
            accelerations: one(2),
            efforts: Vec::new(),
            time_from_start_ns: ms * 1_000_000,
        }
    }

    fn check(points: &[TrajectoryPoint], ms: i64, expected: [f64; 2]) {
        let trajectory = JointTrajectory {
            joints: vec!["arm".into()],
            points: points.to_vec(),
            start_ns: 1_000_000_000,
        };
        let before = point(0, &[0.0, 0.0, 0.0]);
        let now_ns = 1_000_000_000 + ms * 1_000_000;
        let sample = trajectory.sample(now_ns, &before, 1_000_000_000, true).unwrap();
        let found = [sample.point.positions[0], sample.point.velocities[0]];
        let error = (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs();
        assert!(error < 1e-12, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn the_order_follows_from_the_points() {
        // Linear: one in two seconds.
        check(&[point(2000, &[1.0])], 500, [0.25, 0.5]);
        // Cubic from rest to rest: half of the distance in half of the time, at 1.5 times the mean speed.
        check(&[point(2000, &[1.0, 0.0])], 1000, [0.5, 0.75]);
        // Quintic: at 1.875 times the mean speed.
        check(&[point(2000, &[1.0, 0.0, 0.0])], 1000, [0.5, 0.9375]);
        // The second segment, and after the end.
        let two = [point(1000, &[1.0]), point(2000, &[3.0])];
        check(&two, 1500, [2.0, 2.0]);
        check(&two, 2500, [3.0, 0.0]);
    }

    #[test]
    fn without_interpolation_the_next_point_counts() {
        let two = vec![point(1000, &[1.0]), point(2000, &[3.0])];
        let trajectory = JointTrajectory { joints: Vec::new(), points: two, start_ns: 0 };
        let before = point(0, &[0.5]);
        let at = |ms: i64| {
            let sample = trajectory.sample(ms * 1_000_000, &before, 0, false).unwrap();
            (sample.point.positions[0], sample.phase)
        };
        assert_eq!(at(500), (0.5, SamplePhase::Moving));
        assert_eq!(at(1500), (3.0, SamplePhase::Moving));
        assert_eq!(at(2000), (3.0, SamplePhase::AtEnd));
    }

    proptest! {
        #[test]
        fn splines_meet_their_ends(
            start in prop::array::uniform3(-2.0..2.0f64),
            end in prop::array::uniform3(-2.0..2.0f64),
            whole_s in 0.1..5.0f64,
        ) {
            let ends = [start, end]
                .map(|[position, velocity, acceleration]| SplineEnd { position, velocity, acceleration });
            let near = |found: f64, expected: f64| (found - expected).abs() < 1e-7;
            for (spline, count) in [(linear(ends, whole_s), 1), (cubic(ends, whole_s), 2), (quintic(ends, whole_s), 3)] {
                let (first, last) = (evaluate(spline, 0.0), evaluate(spline, whole_s));
                for index in 0..count {
                    prop_assert!(near(first[index], start[index]), "{first:?}");
                    prop_assert!(near(last[index], end[index]), "{last:?}");
                }
            }
        }
    }
}
