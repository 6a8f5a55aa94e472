//! Zones around the robot.

use periplus_geometry::{Pose2, Twist2};

use super::shape::MonitorShape;
use super::velocity_polygon::VelocityParts;
use super::{CollisionPoint, SourcePoints};
use crate::outline::SAME_OVERLAP_M;

/// Limits of [`ZoneAction::Approach`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApproachLimits {
    /// Time before a collision from which the robot slows down \[s\].
    pub time_before_collision_s: f64,
    /// Step of the simulated motion \[s\].
    pub simulation_time_step_s: f64,
}

/// Action that points in a zone trigger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZoneAction {
    /// None; the zone is only observed.
    None,
    /// Stops the robot.
    Stop,
    /// Scales the velocity.
    Slowdown {
        /// Factor.
        ratio: f64,
    },
    /// Limits linear and angular speed by one factor, so that the curvature is kept.
    Limit {
        /// Maximum linear speed \[m/s\].
        linear_m_s: f64,
        /// Maximum angular speed \[rad/s\].
        angular_rad_s: f64,
    },
    /// Keeps a time before the collision of the shape with a point.
    Approach(ApproachLimits),
}

/// Number of consecutive evaluations after which a zone is triggered and released.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriggerFilter {
    trigger_count: usize,
    release_count: usize,
    hits: usize,
    misses: usize,
    is_triggered: bool,
}

impl Default for TriggerFilter {
    /// Each evaluation counts.
    fn default() -> Self {
        Self::new(1, 1)
    }
}

impl TriggerFilter {
    /// Creates a filter; counts below 1 are 1.
    #[must_use]
    pub fn new(trigger_count: usize, release_count: usize) -> Self {
        Self {
            trigger_count: trigger_count.max(1),
            release_count: release_count.max(1),
            hits: 0,
            misses: 0,
            is_triggered: false,
        }
    }

    /// Adds an evaluation; returns true if the zone is triggered.
    pub fn update(&mut self, is_hit: bool) -> bool {
        if is_hit {
            (self.hits, self.misses) = (self.hits + 1, 0);
            self.is_triggered |= self.hits >= self.trigger_count;
        } else {
            (self.hits, self.misses) = (0, self.misses + 1);
            self.is_triggered &= self.misses < self.release_count;
        }
        self.is_triggered
    }

    /// Releases the zone, as when its shape changes.
    pub fn reset(&mut self) {
        *self = Self::new(self.trigger_count, self.release_count);
    }
}

/// Zone around the robot with the action that points inside it trigger.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorZone {
    /// Name.
    pub name: String,
    /// Shape in the base frame; none until it is known.
    pub shape: Option<MonitorShape>,
    /// Shapes by velocity; none for a zone with one shape.
    pub parts: Option<VelocityParts>,
    /// Action.
    pub action: ZoneAction,
    /// Number of points inside that trigger it; at least 1.
    pub min_points: usize,
    /// Number of points inside with which an approach counts as a collision now. It differs in
    /// Humble, which compares with `max_points` there.
    pub min_points_at_once: usize,
    /// Names of the sources whose points count.
    pub sources: Vec<String>,
    /// Filter of the trigger.
    pub filter: TriggerFilter,
    /// True if the zone is used.
    pub is_enabled: bool,
}

impl MonitorZone {
    /// Creates an enabled zone.
    #[must_use]
    pub fn new(name: impl Into<String>, action: ZoneAction, min_points: usize) -> Self {
        Self {
            name: name.into(),
            shape: None,
            parts: None,
            action,
            min_points,
            min_points_at_once: min_points,
            sources: Vec::new(),
            filter: TriggerFilter::default(),
            is_enabled: true,
        }
    }

    /// Selects the shape for a command. Returns false, and keeps the shape, if no range of
    /// velocities contains it.
    pub fn select_shape(&mut self, command: Twist2) -> bool {
        let Some(parts) = &self.parts else { return true };
        let Some(part) = parts.select(command) else { return false };
        self.shape = Some(MonitorShape::Polygon(part.corners.clone()));
        true
    }

    /// Points of the sources of this zone, with the index of the source.
    pub(super) fn points<'a>(
        &'a self,
        all: &'a [SourcePoints],
    ) -> impl Iterator<Item = (usize, CollisionPoint)> + 'a {
        let own = all.iter().enumerate().filter(|(_, one)| self.sources.contains(&one.source));
        own.flat_map(|(index, one)| one.points.iter().map(move |point| (index, *point)))
    }

    /// Points inside the shape.
    pub(super) fn points_inside(&self, all: &[SourcePoints]) -> Vec<(usize, CollisionPoint)> {
        let Some(shape) = &self.shape else { return Vec::new() };
        self.points(all).filter(|(_, point)| shape.contains(point.x_m, point.y_m)).collect()
    }

    /// True if the zone is triggered, with the points inside.
    pub(super) fn trigger(&mut self, all: &[SourcePoints]) -> (bool, Vec<(usize, CollisionPoint)>) {
        let inside = self.points_inside(all);
        (self.filter.update(inside.len() >= self.min_points), inside)
    }

    /// Time until the robot, driving at a velocity, has points inside the shape \[s\], with those
    /// points as they are now; none within `limits`. The time is that before the step of the
    /// simulation in which the collision happens.
    ///
    /// A robot that has points inside already cannot move in Nav2: each command is reduced to zero,
    /// those of recoveries too. Here a motion that leaves these points does not count as a collision
    /// with them: their overlap must not grow in any step until they are outside.
    pub(super) fn time_to_collision(
        &self,
        all: &[SourcePoints],
        velocity: Twist2,
        limits: ApproachLimits,
    ) -> Option<(f64, Vec<(usize, CollisionPoint)>)> {
        let shape = self.shape.as_ref()?;
        let points: Vec<(usize, CollisionPoint)> = self.points(all).collect();
        let is_inside = |pose: &Pose2, point: &CollisionPoint| {
            let [x_m, y_m] = seen_from(pose, point);
            shape.contains(x_m, y_m)
        };
        let (now, mut outside): (Vec<_>, Vec<_>) =
            points.iter().copied().partition(|(_, point)| is_inside(&Pose2::IDENTITY, point));
        let overlap_m = |pose: &Pose2| -> f64 {
            let depth_m = |(_, point): &(usize, CollisionPoint)| {
                let [x_m, y_m] = seen_from(pose, point);
                shape.depth_m(x_m, y_m)
            };
            now.iter().map(depth_m).sum()
        };
        let mut collides_now = now.len() >= self.min_points_at_once;
        let step_s = limits.simulation_time_step_s;
        if step_s <= 0.0 || points.len() < self.min_points {
            return collides_now.then_some((0.0, now));
        }
        if !collides_now {
            outside.clone_from(&points);
        }
        let (mut pose, mut velocity, mut time_s) = (Pose2::IDENTITY, velocity, 0.0);
        let mut last_m = overlap_m(&pose);
        while time_s <= limits.time_before_collision_s {
            project(step_s, &mut pose, &mut velocity);
            if collides_now {
                let next_m = overlap_m(&pose);
                if next_m > last_m + SAME_OVERLAP_M {
                    return Some((time_s, now));
                }
                last_m = next_m;
                if now.iter().filter(|(_, point)| is_inside(&pose, point)).count()
                    < self.min_points_at_once
                {
                    collides_now = false;
                    outside.clone_from(&points);
                }
            }
            let inside = || outside.iter().filter(|(_, point)| is_inside(&pose, point));
            if inside().count() >= self.min_points {
                return Some((time_s, inside().copied().collect()));
            }
            time_s += step_s;
        }
        None
    }
}

/// Position of a point from a pose of the robot, which was at the origin when the point was seen \[m\].
fn seen_from(pose: &Pose2, point: &CollisionPoint) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(pose.yaw_rad);
    let (x, y) = (point.x_m - pose.x_m, point.y_m - pose.y_m);
    [x * cosine + y * sine, -x * sine + y * cosine]
}

/// Moves a robot for a step along its velocity in the start frame, which then turns.
fn project(step_s: f64, pose: &mut Pose2, velocity: &mut Twist2) {
    let turn_rad = velocity.wz_rad_s * step_s;
    let (sine, cosine) = libm::sincos(turn_rad);
    let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = *velocity;
    *pose =
        Pose2::new(pose.x_m + vx_m_s * step_s, pose.y_m + vy_m_s * step_s, pose.yaw_rad + turn_rad);
    *velocity = Twist2 {
        vx_m_s: vx_m_s * cosine - vy_m_s * sine,
        vy_m_s: vx_m_s * sine + vy_m_s * cosine,
        wz_rad_s,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_waits_for_consecutive_evaluations() {
        let check = |mut filter: TriggerFilter, hits: &str, expected: &str| {
            let states: String =
                hits.chars().map(|hit| if filter.update(hit == 'x') { 'x' } else { '.' }).collect();
            assert_eq!(states, expected, "{hits}");
        };
        check(TriggerFilter::default(), "x.xx..", "x.xx..");
        check(TriggerFilter::new(2, 1), "x.xx.x", "...x..");
        check(TriggerFilter::new(1, 2), "x.x..x", "xxxx.x");
        check(TriggerFilter::new(0, 0), "x.", "x.");
        let mut filter = TriggerFilter::new(1, 9);
        filter.update(true);
        filter.reset();
        assert!(!filter.update(false));
    }
}
