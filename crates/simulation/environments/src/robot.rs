//! Kinematic robots with a planar lidar.

use std::f64::consts::TAU;
use std::fmt;

use periplus_geometry::{Pose2, Stream, Twist2};
use periplus_raycast::{Filter, Ray};

use crate::footprint::{RobotFootprint, RobotFootprintError};
use crate::parameters::{DriveKind, EnvironmentRobotParams};
use crate::world::NavigationWorld;

/// Distance that a step may overlook in a collision \[m\].
const COLLISION_RESOLUTION_M: f64 = 0.01;

/// Robot that follows its commands exactly within its limits.
#[derive(Clone, Debug)]
pub struct EnvironmentRobot {
    params: EnvironmentRobotParams,
    footprint: RobotFootprint,
    /// Directions of the beams in the base frame.
    beams: Vec<[f64; 2]>,
}

/// Reasons that parameters describe no robot.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotError {
    /// The footprint is invalid.
    Footprint(RobotFootprintError),
    /// A parameter contradicts another: the name of both, and what is needed.
    Conflict(&'static str),
}

impl fmt::Display for RobotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Footprint(error) => error.fmt(f),
            Self::Conflict(needed) => write!(f, "{needed}"),
        }
    }
}

impl std::error::Error for RobotError {}

impl EnvironmentRobot {
    /// Creates a robot from its parameters.
    ///
    /// # Errors
    /// When the footprint is invalid or parameters contradict each other.
    pub fn new(params: EnvironmentRobotParams) -> Result<Self, RobotError> {
        let corners = &params.footprint_m;
        let footprint = if corners.is_empty() {
            RobotFootprint::circle(params.radius_m)
        } else if corners.len() % 2 == 1 {
            let needed = "`footprint` needs pairs of numbers: x1 y1 x2 y2 x3 y3";
            return Err(RobotError::Conflict(needed));
        } else {
            RobotFootprint::polygon(corners.chunks_exact(2).map(|it| [it[0], it[1]]).collect())
        };
        let footprint = footprint.map_err(RobotError::Footprint)?;
        let span_rad = params.lidar_max_angle_rad - params.lidar_min_angle_rad;
        for (is_wrong, needed) in [
            (params.min_speed_m_s >= params.max_speed_m_s, "`min_speed` must be below `max_speed`"),
            (params.body_bottom_m >= params.body_top_m, "`body_bottom` must be below `body_top`"),
            (
                params.lidar_min_range_m >= params.lidar_max_range_m,
                "`lidar_min_range` must be below `lidar_max_range`",
            ),
            (
                !(0.0..TAU + 1e-6).contains(&span_rad),
                "`lidar_max_angle` must be from `lidar_min_angle` to a full turn beyond it",
            ),
        ] {
            if is_wrong {
                return Err(RobotError::Conflict(needed));
            }
        }
        let beams = (0..params.lidar_beams).map(|beam| {
            let angle_rad = params.lidar_yaw_rad + beam_angle_rad(&params, span_rad, beam);
            let (sine, cosine) = libm::sincos(angle_rad);
            [cosine, sine]
        });
        let beams = beams.collect();
        Ok(Self { params, footprint, beams })
    }

    /// Returns the parameters.
    #[must_use]
    pub fn params(&self) -> &EnvironmentRobotParams {
        &self.params
    }

    /// Returns the footprint.
    #[must_use]
    pub fn footprint(&self) -> &RobotFootprint {
        &self.footprint
    }

    /// Returns the number of parts of an action: 2 of a differential drive, 3 of an omnidirectional one.
    #[must_use]
    pub fn action_size(&self) -> usize {
        match self.params.drive {
            DriveKind::Differential => 2,
            DriveKind::Omni => 3,
        }
    }

    /// Returns the velocity that an action of -1 to 1 along each axis commands; numbers beyond are limited.
    #[must_use]
    pub fn commanded(&self, action: &[f32]) -> Twist2 {
        let part = |at: usize| f64::from(action.get(at).copied().unwrap_or(0.0)).clamp(-1.0, 1.0);
        let EnvironmentRobotParams { min_speed_m_s: min, max_speed_m_s: max, .. } = self.params;
        // An omnidirectional robot drives backwards as fast as forwards unless a minimum is set.
        let is_symmetric = self.params.drive == DriveKind::Omni && min == 0.0;
        let min = if is_symmetric { -max } else { min };
        let vx_m_s = min + (max - min) * (part(0) + 1.0) / 2.0;
        let turn_rad_s = self.params.max_turn_rate_rad_s;
        match self.params.drive {
            DriveKind::Differential => Twist2::new(vx_m_s, 0.0, part(1) * turn_rad_s),
            DriveKind::Omni => Twist2::new(
                vx_m_s,
                part(1) * self.params.max_lateral_speed_m_s,
                part(2) * turn_rad_s,
            ),
        }
    }

    /// Returns the velocity after a time \[s\] of accelerating towards a command.
    #[must_use]
    pub fn accelerated(&self, from: Twist2, to: Twist2, dt_s: f64) -> Twist2 {
        let limited = |from: f64, to: f64, limit: f64| {
            if limit == 0.0 { to } else { to.clamp(from - limit * dt_s, from + limit * dt_s) }
        };
        let EnvironmentRobotParams {
            max_acceleration_m_s2: linear,
            max_turn_acceleration_rad_s2: angular,
            ..
        } = self.params;
        Twist2::new(
            limited(from.vx_m_s, to.vx_m_s, linear),
            limited(from.vy_m_s, to.vy_m_s, linear),
            limited(from.wz_rad_s, to.wz_rad_s, angular),
        )
    }

    /// Moves along the arc of a velocity for a time \[s\]. In a collision it stops in front of the obstacle. The
    /// distance to the obstacles limits each part of the motion (conservative advancement; Mirtich 1996, "Impulse-based
    /// dynamic simulation of rigid body systems"), so that no obstacle is passed.
    pub(crate) fn moved(
        &self,
        world: &NavigationWorld,
        pose: Pose2,
        twist: Twist2,
        dt_s: f64,
        corners: &mut Vec<[f64; 2]>,
    ) -> Motion {
        let radius_m = self.footprint.circumscribed_radius_m();
        let travel_m = (twist.speed_m_s() + twist.wz_rad_s.abs() * radius_m) * dt_s;
        let end = pose.advanced(twist, dt_s);
        let nearest_m = world.free_space().min_distance_m([pose.x_m, pose.y_m]);
        if nearest_m > radius_m + travel_m {
            return Motion { end, is_collision: false };
        }
        let (mut last, mut done_m) = (pose, 0.0);
        loop {
            let is_end = done_m >= travel_m;
            let here = if is_end { end } else { pose.advanced(twist, dt_s * done_m / travel_m) };
            let left_m = (travel_m - done_m).max(0.0);
            let placed = self.footprint.placed(here, corners);
            let distance_m =
                world.obstacles().distance_to_footprint_m(&placed, left_m + COLLISION_RESOLUTION_M);
            if distance_m == 0.0 {
                return Motion { end: last, is_collision: true };
            }
            if is_end || distance_m > left_m {
                return Motion { end, is_collision: false };
            }
            last = here;
            // Not onto the obstacle, which would be a collision.
            done_m += (distance_m - COLLISION_RESOLUTION_M / 2.0).max(COLLISION_RESOLUTION_M);
        }
    }

    /// Measures the exact ranges from a pose; infinite without a hit. Also returns the lidar's position.
    pub(crate) fn cast(
        &self,
        world: &NavigationWorld,
        world_from_base: Pose2,
        rays: &mut Vec<Ray>,
        ranges_m: &mut [f32],
    ) {
        let lidar = self.lidar_pose(world_from_base);
        let (sine, cosine) = libm::sincos(world_from_base.yaw_rad);
        let mut ray = Ray {
            origin_m: [lidar.x_m, lidar.y_m, self.params.lidar_height_m].into(),
            direction: periplus_geometry::DVec3::X,
            min_m: 0.0,
            max_m: self.params.lidar_max_range_m,
        };
        rays.clear();
        rays.extend(self.beams.iter().map(|[x, y]| {
            ray.direction.x = cosine * x - sine * y;
            ray.direction.y = sine * x + cosine * y;
            ray
        }));
        world.rays().cast_batch(rays, Filter::default(), 1, ranges_m);
    }

    /// Returns the pose of the lidar.
    #[must_use]
    pub fn lidar_pose(&self, world_from_base: Pose2) -> Pose2 {
        let EnvironmentRobotParams { lidar_x_m, lidar_y_m, lidar_yaw_rad, .. } = self.params;
        world_from_base * Pose2::new(lidar_x_m, lidar_y_m, lidar_yaw_rad)
    }

    /// Adds the noise of the device and limits the ranges to those that it reports.
    pub(crate) fn finish_ranges(&self, ranges_m: &mut [f32], noise: Option<&mut Stream>) {
        let EnvironmentRobotParams { lidar_min_range_m, lidar_max_range_m, lidar_noise_m, .. } =
            self.params;
        #[expect(clippy::cast_possible_truncation, reason = "single precision is asked for")]
        let [min, max] = [lidar_min_range_m as f32, lidar_max_range_m as f32];
        if let Some(stream) = noise {
            for range in ranges_m.iter_mut().filter(|range| range.is_finite()) {
                #[expect(clippy::cast_possible_truncation, reason = "single precision will do")]
                let error = (stream.normal() * lidar_noise_m) as f32;
                *range += error;
            }
        }
        for range in ranges_m {
            *range = range.clamp(min, max);
        }
    }
}

/// Angle of a beam from the x axis of the lidar \[rad\]. Of a full turn the last beam is before the first.
fn beam_angle_rad(params: &EnvironmentRobotParams, span_rad: f64, beam: usize) -> f64 {
    let is_full = span_rad > TAU - 1e-6;
    let steps =
        if is_full { params.lidar_beams } else { params.lidar_beams.saturating_sub(1).max(1) };
    #[expect(clippy::cast_precision_loss, reason = "beams are below 2^17")]
    let fraction = beam as f64 / steps as f64;
    params.lidar_min_angle_rad + span_rad * fraction
}

/// Result of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion {
    pub(crate) end: Pose2,
    pub(crate) is_collision: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(change: impl Fn(&mut EnvironmentRobotParams)) -> Result<EnvironmentRobot, RobotError> {
        let mut params = EnvironmentRobotParams::default();
        change(&mut params);
        EnvironmentRobot::new(params)
    }

    #[test]
    fn actions_are_fractions_of_the_limits() {
        let differential = robot(|it| it.min_speed_m_s = -0.2).expect("a robot");
        let check = |robot: &EnvironmentRobot, action: &[f32], expected: [f64; 3]| {
            let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = robot.commanded(action);
            let found = [vx_m_s, vy_m_s, wz_rad_s];
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        };
        check(&differential, &[1.0, 0.0], [0.8, 0.0, 0.0]);
        check(&differential, &[-1.0, -1.0], [-0.2, 0.0, -1.5]);
        check(&differential, &[0.0, 9.0], [0.3, 0.0, 1.5]);
        let omni = robot(|it| it.drive = DriveKind::Omni).expect("a robot");
        check(&omni, &[0.0, 0.5, 0.0], [0.0, 0.25, 0.0]);
    }

    #[test]
    fn acceleration_is_limited() {
        let robot = robot(|_| {}).expect("a robot");
        let found = robot.accelerated(Twist2::ZERO, Twist2::new(0.8, 0.0, -1.5), 0.1);
        assert_eq!(found, Twist2::new(0.25, 0.0, -0.6000000000000001));
    }

    #[test]
    fn beams_of_a_full_turn_do_not_repeat() {
        let full = robot(|it| it.lidar_beams = 4).expect("a robot");
        let near = |[x, y]: [f64; 2], [a, b]: [f64; 2]| libm::hypot(x - a, y - b) < 1e-12;
        let expected = [[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(full.beams.iter().zip(expected).all(|(a, b)| near(*a, b)), "{:?}", full.beams);
        let half = robot(|it| {
            it.lidar_beams = 3;
            it.lidar_min_angle_rad = -TAU / 4.0;
            it.lidar_max_angle_rad = TAU / 4.0;
        });
        let half = half.expect("a robot");
        let expected = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(half.beams.iter().zip(expected).all(|(a, b)| near(*a, b)), "{:?}", half.beams);
    }

    #[test]
    fn contradictions_are_errors() {
        let check = |change: fn(&mut EnvironmentRobotParams), needed: &str| {
            let error = robot(change).expect_err("a contradiction").to_string();
            assert!(error.contains(needed), "{error}");
        };
        check(|it| it.min_speed_m_s = 2.0, "`min_speed`");
        check(|it| it.footprint_m = vec![1.0; 5], "pairs");
        check(|it| it.lidar_max_angle_rad = 9.0, "`lidar_max_angle`");
        check(|it| it.lidar_min_range_m = 20.0, "`lidar_min_range`");
    }
}
