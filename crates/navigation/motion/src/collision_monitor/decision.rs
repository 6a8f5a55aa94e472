//! Choice of the safest velocity.

use periplus_geometry::Twist2;

use super::zone::{MonitorZone, ZoneAction};
use super::{CollisionPoint, SourcePoints};

/// Action of the monitor, numbered as in `nav2_msgs/msg/CollisionMonitorState`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MonitorAction {
    /// The command passes.
    #[default]
    DoNothing,
    /// The robot stops.
    Stop,
    /// The robot is slowed down by a ratio.
    Slowdown,
    /// The robot keeps a time before a collision.
    Approach,
    /// The speed of the robot is limited.
    Limit,
}

impl MonitorAction {
    /// Number in messages.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::DoNothing => 0,
            Self::Stop => 1,
            Self::Slowdown => 2,
            Self::Approach => 3,
            Self::Limit => 4,
        }
    }
}

/// Velocity that the monitor allows, and its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct MonitorDecision {
    /// Action.
    pub action: MonitorAction,
    /// Index of the zone that caused it; none if the command passes.
    pub zone: Option<usize>,
    /// Allowed velocity.
    pub velocity: Twist2,
    /// Points that caused it, with the index of their source.
    pub points: Vec<(usize, CollisionPoint)>,
}

impl MonitorDecision {
    /// Lets a command pass.
    #[must_use]
    pub fn pass(command: Twist2) -> Self {
        Self { action: MonitorAction::DoNothing, zone: None, velocity: command, points: Vec::new() }
    }

    /// Stops the robot without a zone, as when a source is silent.
    #[must_use]
    pub fn stop() -> Self {
        Self { action: MonitorAction::Stop, ..Self::pass(Twist2::ZERO) }
    }
}

/// Applies zones, in order, to a command. A zone that stops ends the search; otherwise the slowest
/// velocity counts, the first of equal ones. `start` is the decision so far: a stop is final.
///
/// ```
/// use periplus_geometry::Twist2;
/// use periplus_motion::collision_monitor::*;
///
/// let mut zone = MonitorZone::new("slow", ZoneAction::Slowdown { ratio: 0.5 }, 1);
/// zone.shape = Some(MonitorShape::Circle { radius_m: 1.0 });
/// zone.sources = vec!["scan".to_owned()];
/// let points = vec![CollisionPoint::planar(0.8, 0.0)];
/// let seen = [SourcePoints { source: "scan".to_owned(), points }];
/// let command = Twist2::new(0.4, 0.0, 0.2);
/// let decision = decide(&mut [zone], &seen, command, MonitorDecision::pass(command));
/// assert_eq!(decision.velocity, Twist2::new(0.2, 0.0, 0.1));
/// ```
#[must_use]
pub fn decide(
    zones: &mut [MonitorZone],
    points: &[SourcePoints],
    command: Twist2,
    start: MonitorDecision,
) -> MonitorDecision {
    let mut decision = start;
    for (index, zone) in zones.iter_mut().enumerate() {
        if decision.action == MonitorAction::Stop {
            break;
        }
        if !zone.is_enabled {
            continue;
        }
        zone.select_shape(command);
        if zone.shape.is_none() {
            continue;
        }
        let Some((action, velocity, points)) = apply(zone, points, command) else { continue };
        if action == MonitorAction::Stop || energy(velocity) < energy(decision.velocity) {
            decision = MonitorDecision { action, zone: Some(index), velocity, points };
        }
    }
    decision
}

type Candidate = (MonitorAction, Twist2, Vec<(usize, CollisionPoint)>);

/// Velocity that a zone allows; none if it is not triggered.
fn apply(zone: &mut MonitorZone, points: &[SourcePoints], command: Twist2) -> Option<Candidate> {
    if let ZoneAction::Approach(limits) = zone.action {
        let (time_s, inside) = zone.time_to_collision(points, command, limits)?;
        let velocity = command.scaled(time_s / limits.time_before_collision_s);
        return Some((MonitorAction::Approach, velocity, inside));
    }
    if zone.action == ZoneAction::None {
        return None;
    }
    let (is_triggered, inside) = zone.trigger(points);
    if !is_triggered {
        return None;
    }
    let (action, velocity) = match zone.action {
        ZoneAction::Stop => (MonitorAction::Stop, Twist2::ZERO),
        ZoneAction::Slowdown { ratio } => (MonitorAction::Slowdown, command.scaled(ratio)),
        ZoneAction::Limit { linear_m_s, angular_rad_s } => {
            let ratio = limit_ratio(command, linear_m_s, angular_rad_s);
            (MonitorAction::Limit, command.scaled(ratio))
        }
        ZoneAction::None | ZoneAction::Approach(_) => return None,
    };
    Some((action, velocity, inside))
}

/// Factor that brings linear and angular speed within their limits.
fn limit_ratio(command: Twist2, linear_m_s: f64, angular_rad_s: f64) -> f64 {
    let speed_m_s = libm::hypot(command.vx_m_s, command.vy_m_s);
    let mut ratio: f64 = 1.0;
    if speed_m_s != 0.0 {
        ratio = ratio.min(linear_m_s / speed_m_s);
    }
    if command.wz_rad_s != 0.0 {
        ratio = ratio.min(angular_rad_s / command.wz_rad_s.abs());
    }
    ratio.clamp(0.0, 1.0)
}

/// Measure by which velocities are compared, rotations in place included.
fn energy(velocity: Twist2) -> f64 {
    let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
    vx_m_s * vx_m_s + vy_m_s * vy_m_s + wz_rad_s * wz_rad_s
}

/// State of a zone, as a collision detector reports it.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneDetection {
    /// Index of the zone.
    pub zone: usize,
    /// True if it is triggered.
    pub is_triggered: bool,
    /// Points inside, with the index of their source.
    pub points: Vec<(usize, CollisionPoint)>,
}

/// Reports for each enabled zone whether points trigger it.
#[must_use]
pub fn detect(zones: &mut [MonitorZone], points: &[SourcePoints]) -> Vec<ZoneDetection> {
    let enabled = zones.iter_mut().enumerate().filter(|(_, zone)| zone.is_enabled);
    enabled
        .map(|(index, zone)| {
            let (is_triggered, inside) = zone.trigger(points);
            ZoneDetection { zone: index, is_triggered, points: inside }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{ApproachLimits, MonitorShape};
    use super::*;

    fn circle(name: &str, radius_m: f64, action: ZoneAction) -> MonitorZone {
        MonitorZone {
            shape: Some(MonitorShape::Circle { radius_m }),
            sources: vec!["scan".to_owned()],
            ..MonitorZone::new(name, action, 1)
        }
    }

    fn seen(points: &[(f64, f64)]) -> Vec<SourcePoints> {
        let points = points.iter().map(|(x, y)| CollisionPoint::planar(*x, *y)).collect();
        vec![SourcePoints { source: "scan".to_owned(), points }]
    }

    fn approach(time_s: f64, step_s: f64) -> ZoneAction {
        ZoneAction::Approach(ApproachLimits {
            time_before_collision_s: time_s,
            simulation_time_step_s: step_s,
        })
    }

    #[test]
    fn the_safest_zone_counts() {
        let slow = || circle("slow", 2.0, ZoneAction::Slowdown { ratio: 0.5 });
        let limit =
            |linear_m_s| circle("limit", 2.0, ZoneAction::Limit { linear_m_s, angular_rad_s: 9.0 });
        let stop = || circle("stop", 1.0, ZoneAction::Stop);
        let check = |zones: Vec<MonitorZone>, at_m: f64, action: MonitorAction, vx: f64| {
            let command = Twist2::new(1.0, 0.0, 0.0);
            let mut zones = zones;
            let start = MonitorDecision::pass(command);
            let decision = decide(&mut zones, &seen(&[(at_m, 0.0)]), command, start);
            assert_eq!(decision.action, action);
            assert!((decision.velocity.vx_m_s - vx).abs() < 1e-12, "{}", decision.velocity.vx_m_s);
        };
        check(vec![slow(), limit(0.2), stop()], 1.5, MonitorAction::Limit, 0.2);
        check(vec![slow(), limit(0.5), stop()], 1.5, MonitorAction::Slowdown, 0.5);
        check(vec![limit(0.2), stop(), slow()], 0.5, MonitorAction::Stop, 0.0);
        check(vec![slow(), limit(0.2), stop()], 2.5, MonitorAction::DoNothing, 1.0);
        let disabled = MonitorZone { is_enabled: false, ..stop() };
        check(vec![disabled], 0.5, MonitorAction::DoNothing, 1.0);
        let shapeless = MonitorZone { shape: None, ..stop() };
        check(vec![shapeless], 0.5, MonitorAction::DoNothing, 1.0);
        let deaf = MonitorZone { sources: vec!["other".to_owned()], ..stop() };
        check(vec![deaf], 0.5, MonitorAction::DoNothing, 1.0);
    }

    #[test]
    fn the_time_to_a_collision_is_that_before_the_step() {
        // At 1 m/s the point 1.05 m ahead enters the circle of 0.5 m in the sixth step of 0.1 s.
        let mut zones = [circle("a", 0.5, approach(2.0, 0.1))];
        let command = Twist2::new(1.0, 0.0, 0.0);
        let mut speed = |at: &[(f64, f64)]| {
            decide(&mut zones, &seen(at), command, MonitorDecision::pass(command)).velocity.vx_m_s
        };
        assert!((speed(&[(1.05, 0.0)]) - 0.5 / 2.0).abs() < 1e-12);
        assert_eq!(speed(&[(0.4, 0.0)]), 0.0);
        assert_eq!(speed(&[(3.0, 0.0)]), 1.0);
        assert_eq!(speed(&[(1.05, 0.6)]), 1.0);
    }

    #[test]
    fn a_robot_leaves_the_points_that_are_in_its_outline() {
        // A wall 0.45 m ahead, 0.05 m inside the circle of 0.5 m.
        let wall: Vec<(f64, f64)> = (-10..=10).map(|y| (0.45, 0.02 * f64::from(y))).collect();
        let speed = |command: Twist2, points: &[(f64, f64)]| {
            let mut zones = [circle("a", 0.5, approach(1.0, 0.1))];
            decide(&mut zones, &seen(points), command, MonitorDecision::pass(command)).velocity
        };
        let back = Twist2::new(-0.2, 0.0, 0.0);
        let away = Twist2::new(-0.1, 0.1, 0.3);
        let turn = Twist2::new(0.0, 0.0, 1.0);
        for command in [back, away, turn] {
            assert_eq!(speed(command, &wall), command, "{command:?}");
        }
        for command in [Twist2::new(0.2, 0.0, 0.0), Twist2::new(0.05, 0.0, 1.0)] {
            assert_eq!(speed(command, &wall), Twist2::ZERO, "{command:?}");
        }
        // In front of another wall behind it, backing up is an approach: 0.25 m, less than 1.5 steps.
        let between: Vec<_> = wall.into_iter().chain([(-0.525, 0.0)]).collect();
        assert_eq!(speed(back, &between), back.scaled(0.1));
    }

    #[test]
    fn a_polygon_does_not_turn_its_corners_into_points() {
        let corners = vec![[0.4, 0.2], [0.4, -0.2], [-0.4, -0.2], [-0.4, 0.2]];
        let mut zones = [MonitorZone {
            shape: Some(MonitorShape::Polygon(corners)),
            ..circle("a", 0.0, approach(1.0, 0.1))
        }];
        let mut passes = |command: Twist2| {
            // To the left, ahead of the middle: the left turn brings the front corner nearer.
            let decision =
                decide(&mut zones, &seen(&[(0.3, 0.19)]), command, MonitorDecision::pass(command));
            decision.velocity == command
        };
        assert!(passes(Twist2::new(0.0, -0.1, 0.0)) && passes(Twist2::new(0.0, 0.0, -0.5)));
        assert!(!passes(Twist2::new(0.0, 0.1, 0.0)) && !passes(Twist2::new(0.0, 0.0, 0.5)));
    }

    #[test]
    fn a_stop_for_another_reason_is_final() {
        let mut zones = [circle("slow", 2.0, ZoneAction::Slowdown { ratio: 0.5 })];
        let command = Twist2::new(1.0, 0.0, 0.0);
        let decision = decide(&mut zones, &seen(&[(1.0, 0.0)]), command, MonitorDecision::stop());
        assert_eq!(decision, MonitorDecision::stop());
    }

    #[test]
    fn detection_reports_each_enabled_zone() {
        let mut zones = [
            circle("near", 1.0, ZoneAction::None),
            circle("far", 2.0, ZoneAction::None),
            MonitorZone { is_enabled: false, ..circle("off", 9.0, ZoneAction::None) },
        ];
        let points = vec![(0, CollisionPoint::planar(1.5, 0.0))];
        let expected = [
            ZoneDetection { zone: 0, is_triggered: false, points: Vec::new() },
            ZoneDetection { zone: 1, is_triggered: true, points },
        ];
        assert_eq!(detect(&mut zones, &seen(&[(1.5, 0.0)])), expected);
    }

    proptest! {
        #[test]
        fn the_monitor_never_speeds_up(
            vx in -1.0..1.0f64, vy in -1.0..1.0f64, wz in -2.0..2.0f64,
            points in prop::collection::vec((-2.0..2.0f64, -2.0..2.0f64), 0..10),
        ) {
            let mut zones = [
                circle("a", 0.5, approach(1.0, 0.1)),
                circle("b", 1.0, ZoneAction::Slowdown { ratio: 0.7 }),
                circle("c", 1.5, ZoneAction::Limit { linear_m_s: 0.3, angular_rad_s: 0.5 }),
            ];
            let command = Twist2::new(vx, vy, wz);
            let start = MonitorDecision::pass(command);
            let decision = decide(&mut zones, &seen(&points), command, start);
            prop_assert!(energy(decision.velocity) <= energy(command));
            // The direction is kept.
            let Twist2 { vx_m_s, vy_m_s, .. } = decision.velocity;
            prop_assert!((vx_m_s * vy - vy_m_s * vx).abs() < 1e-9);
        }
    }
}
