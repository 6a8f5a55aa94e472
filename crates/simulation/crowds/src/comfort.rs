//! Comfort of people near robots: distances, times to collision, and what robots force people to do.
//!
//! Distances are from the surface of a robot to that of a person's body, as the distances of E. T. Hall, "The Hidden
//! Dimension", 1966, are: intimate below 0.45 m, personal below 1.2 m.
//!
//! The time to collision is the time after which the two bodies touch if both keep their velocities (J. C. Hayward,
//! "Near-miss determination through use of a scale of danger", Highway Research Record 384, 1972).
//!
//! An encounter is a time in which a walking person would touch the robot within 3 s with the velocity that it has
//! without others, and the robot with its own. It is the conflict of the traffic conflict technique (C. Hyden, "The
//! development of a method for traffic safety evaluation", Lund, 1987): two that are on a collision course until one
//! evades. The reaction of the person is in its velocity, and not in the one of the conflict, so that a person who
//! evades stays in it until it has passed. In an encounter a person stops if its speed along its preferred direction is
//! below a quarter of the preferred speed for 0.5 s, and makes a detour if it walks in a direction more than 30 degrees
//! off the preferred one for 0.5 s; each counts once per encounter. An encounter ends after 2 s without a conflict.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::agent::{Person, PersonState};
use crate::obstacle::MovingObstacle;

/// Limit of the intimate distance (Hall 1966) \[m\].
const INTIMATE_M: f64 = 0.45;

/// Limit of the personal distance (Hall 1966) \[m\].
const PERSONAL_M: f64 = 1.2;

/// Time to collision below which a person is in conflict with a robot \[s\].
const CONFLICT_S: f64 = 3.0;

/// Time for which a stop or a detour must last to count \[s\].
const MIN_REACTION_S: f64 = 0.5;

/// Speed along the preferred direction below which a person has stopped, as a part of the preferred speed.
const STOPPED_RATIO: f64 = 0.25;

/// Cosine of the angle to the preferred direction below which a person makes a detour: 30 degrees.
const DETOUR_COSINE_RATIO: f64 = 0.866_025_403_784_438_6;

/// Time without a conflict after which an encounter ends \[s\].
const ENCOUNTER_END_S: f64 = 2.0;

/// Time after which a walking person that has not moved counts as frozen \[s\].
const FREEZE_S: f64 = 10.0;

/// Comfort of people near one robot, over a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotComfort {
    /// Smallest distance of a person's body to the robot, negative where they overlap; none before the first sample with
    /// people \[m\].
    pub min_distance_m: Option<f64>,
    /// Time with a person within 0.45 m \[s\].
    pub intimate_s: f64,
    /// Time with a person within 1.2 m \[s\].
    pub personal_s: f64,
    /// Smallest time to collision with a person; none if no two were ever on a collision course \[s\].
    pub min_time_to_collision_s: Option<f64>,
    /// Number of stops that the robot forced people to.
    pub forced_stops: usize,
    /// Number of detours that the robot forced people to.
    pub forced_detours: usize,
}

/// Comfort of all people, over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PeopleComfort {
    /// Longest time for which a walking person did not leave a circle of 0.5 m \[s\].
    pub longest_freeze_s: f64,
    /// Number of times that a walking person did not leave such a circle for 10 s.
    pub freezes: usize,
}

/// Encounter of a person with a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Encounter {
    /// Time since the last conflict \[s\].
    clear_s: f64,
    /// Duration of the present stop \[s\].
    stopped_s: f64,
    /// Duration of the present detour \[s\].
    detour_s: f64,
    has_stopped: bool,
    has_made_detour: bool,
}

/// Measures the comfort of people near robots, from samples of one duration after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComfortMeter {
    robots: BTreeMap<String, RobotComfort>,
    people: PeopleComfort,
    /// Encounters by the name of the robot and the number of the person.
    encounters: BTreeMap<(String, usize), Encounter>,
    /// People that are frozen at the last sample.
    frozen: Vec<bool>,
}

impl ComfortMeter {
    /// Comfort near each robot, by its name.
    #[must_use]
    pub fn robots(&self) -> &BTreeMap<String, RobotComfort> {
        &self.robots
    }

    /// Comfort of all people.
    #[must_use]
    pub fn people(&self) -> PeopleComfort {
        self.people
    }

    /// Adds a sample that stands for a duration \[s\]: robots with their names, and people in their order.
    pub fn sample<'a>(
        &mut self,
        duration_s: f64,
        robots: impl IntoIterator<Item = (&'a str, MovingObstacle)>,
        people: &[Person],
    ) {
        for (name, robot) in robots {
            if !self.robots.contains_key(name) {
                self.robots.insert(name.to_owned(), RobotComfort::default());
            }
            if let Some(comfort) = self.robots.get_mut(name) {
                sample_robot(comfort, &mut self.encounters, duration_s, (name, &robot), people);
            }
        }
        self.frozen.resize(people.len(), false);
        for (person, was_frozen) in people.iter().zip(&mut self.frozen) {
            self.people.longest_freeze_s = self.people.longest_freeze_s.max(person.still_s());
            let is_frozen = person.still_s() > FREEZE_S;
            self.people.freezes += usize::from(is_frozen && !*was_frozen);
            *was_frozen = is_frozen;
        }
    }
}

fn sample_robot(
    comfort: &mut RobotComfort,
    encounters: &mut BTreeMap<(String, usize), Encounter>,
    duration_s: f64,
    (name, robot): (&str, &MovingObstacle),
    people: &[Person],
) {
    let mut nearest_m = f64::INFINITY;
    for (number, person) in people.iter().enumerate() {
        let radius_m = person.body_radius_m();
        let distance_m = robot.distance_m(person.position()) - radius_m;
        nearest_m = nearest_m.min(distance_m);
        let relative = person.velocity() - robot.velocity;
        if let Some(time_s) = time_to_collision_s(robot, radius_m, person.position(), relative) {
            let least_s = comfort.min_time_to_collision_s.unwrap_or(f64::INFINITY);
            comfort.min_time_to_collision_s = Some(least_s.min(time_s));
        }
        let is_conflict = is_conflict(robot, radius_m, person);
        let key = (name.to_owned(), number);
        let is_known = encounters.contains_key(&key);
        if !is_conflict && !is_known {
            continue;
        }
        let encounter = encounters.entry(key.clone()).or_default();
        encounter.clear_s = if is_conflict { 0.0 } else { encounter.clear_s + duration_s };
        if encounter.clear_s > ENCOUNTER_END_S {
            encounters.remove(&key);
        } else if is_conflict {
            react(encounter, comfort, duration_s, person);
        } else {
            (encounter.stopped_s, encounter.detour_s) = (0.0, 0.0);
        }
    }
    if nearest_m.is_finite() {
        let before_m = comfort.min_distance_m.unwrap_or(f64::INFINITY);
        comfort.min_distance_m = Some(before_m.min(nearest_m));
        comfort.intimate_s += if nearest_m < INTIMATE_M { duration_s } else { 0.0 };
        comfort.personal_s += if nearest_m < PERSONAL_M { duration_s } else { 0.0 };
    }
}

/// True if a walking person would soon touch the robot with the velocity that it has without others.
fn is_conflict(robot: &MovingObstacle, radius_m: f64, person: &Person) -> bool {
    let preferred = person.preferred_velocity();
    if person.state() != PersonState::Walking || preferred == DVec2::ZERO {
        return false;
    }
    let relative = preferred - robot.velocity;
    time_to_collision_s(robot, radius_m, person.position(), relative)
        .is_some_and(|time_s| time_s < CONFLICT_S)
}

/// Counts a stop and a detour of a person in an encounter, once each.
fn react(encounter: &mut Encounter, comfort: &mut RobotComfort, duration_s: f64, person: &Person) {
    let preferred_m_per_s = person.preferred_velocity().length();
    let along_m_per_s = person.velocity().dot(person.preferred_velocity()) / preferred_m_per_s;
    let speed_m_per_s = person.velocity().length();
    let is_stopped = along_m_per_s < STOPPED_RATIO * preferred_m_per_s
        && speed_m_per_s < STOPPED_RATIO * preferred_m_per_s;
    let is_detour = !is_stopped && along_m_per_s < DETOUR_COSINE_RATIO * speed_m_per_s;
    encounter.stopped_s = if is_stopped { encounter.stopped_s + duration_s } else { 0.0 };
    encounter.detour_s = if is_detour { encounter.detour_s + duration_s } else { 0.0 };
    // A billionth less, since the durations of steps do not add up exactly.
    if encounter.stopped_s >= MIN_REACTION_S - 1e-9 && !encounter.has_stopped {
        encounter.has_stopped = true;
        comfort.forced_stops += 1;
    }
    if encounter.detour_s >= MIN_REACTION_S - 1e-9 && !encounter.has_made_detour {
        encounter.has_made_detour = true;
        comfort.forced_detours += 1;
    }
}

/// Time after which a disc of a radius at a position touches the robot, by a velocity relative to the robot; none if it
/// never does, zero if they touch already and approach \[s\].
fn time_to_collision_s(
    robot: &MovingObstacle,
    radius_m: f64,
    position: DVec2,
    relative: DVec2,
) -> Option<f64> {
    let reach_m = robot.radius_m + radius_m;
    let nearest = robot.nearest_axis_point(position);
    if nearest.distance(position) <= reach_m {
        return (relative.dot(nearest - position) > 0.0).then_some(0.0);
    }
    let [start, end] = robot.axis;
    let ends = [start, end].into_iter().filter_map(|end| disc_s(end, reach_m, position, relative));
    // The straight sides of the capsule.
    let along = (end - start).normalize_or_zero();
    let sides = [along.perp(), -along.perp()].into_iter().filter_map(|normal| {
        let closing_m_per_s = -relative.dot(normal);
        let gap_m = (position - start).dot(normal) - reach_m;
        if normal == DVec2::ZERO || closing_m_per_s <= 0.0 || gap_m < 0.0 {
            return None;
        }
        let time_s = gap_m / closing_m_per_s;
        let met_m = (position + relative * time_s - start).dot(along);
        (0.0..=start.distance(end)).contains(&met_m).then_some(time_s)
    });
    ends.chain(sides).reduce(f64::min)
}

/// Time after which a point reaches a disc \[s\].
fn disc_s(centre: DVec2, radius_m: f64, point: DVec2, velocity: DVec2) -> Option<f64> {
    let offset = centre - point;
    let (squared, along) = (velocity.length_squared(), velocity.dot(offset));
    if along <= 0.0 {
        return None;
    }
    let root = along * along - squared * (offset.length_squared() - radius_m * radius_m);
    (root >= 0.0).then(|| (along - root.sqrt()) / squared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::agent::PersonSettings;

    fn person(position: [f64; 2], velocity: [f64; 2], preferred: [f64; 2]) -> Person {
        let mut person = Person::new(PersonSettings::at(position.into()), 0);
        (person.velocity, person.preferred) = (velocity.into(), preferred.into());
        person.state = PersonState::Walking;
        person
    }

    fn robot(velocity: [f64; 2]) -> MovingObstacle {
        MovingObstacle::disc(DVec2::ZERO, 0.3, velocity.into())
    }

    /// Comfort after samples of 0.1 s.
    fn sampled(samples: &[(MovingObstacle, Person)]) -> RobotComfort {
        let mut meter = ComfortMeter::default();
        for (robot, person) in samples {
            meter.sample(0.1, [("r", *robot)], std::slice::from_ref(person));
        }
        meter.robots()["r"].clone()
    }

    #[test]
    fn distances_are_from_surface_to_surface() {
        let at = |x: f64| (robot([0.0; 2]), person([x, 0.0], [0.0; 2], [0.0; 2]));
        // Radii of 0.3 m and 0.2 m: gaps of 0.4 m, 1.0 m and 2.0 m.
        let comfort = sampled(&[at(0.9), at(1.5), at(2.5)]);
        assert!((comfort.min_distance_m.unwrap() - 0.4).abs() < 1e-12);
        assert!((comfort.intimate_s - 0.1).abs() < 1e-12);
        assert!((comfort.personal_s - 0.2).abs() < 1e-12);
        assert_eq!(comfort.min_time_to_collision_s, None);
    }

    #[test]
    fn the_time_to_collision_is_the_gap_by_the_closing_speed() {
        let check = |robot: MovingObstacle, position: [f64; 2], velocity: [f64; 2], expected| {
            let relative = DVec2::from(velocity) - robot.velocity;
            let found = time_to_collision_s(&robot, 0.2, position.into(), relative);
            match (found, expected) {
                (Some(found), Some(expected)) => {
                    let expected: f64 = expected;
                    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
                }
                (found, expected) => assert_eq!(found, expected),
            }
        };
        // A gap of 2.5 m at 1 m/s and 0.5 m/s towards each other.
        check(robot([0.5, 0.0]), [3.0, 0.0], [-0.75, 0.0], Some(2.0));
        // Away from each other, side by side, and past each other at 0.6 m.
        check(robot([0.0, 0.0]), [3.0, 0.0], [1.0, 0.0], None);
        check(robot([1.0, 0.0]), [0.0, 2.0], [1.0, 0.0], None);
        check(robot([0.0, 0.0]), [3.0, 0.6], [-1.0, 0.0], None);
        // At 0.3 m beside the centre the discs touch 0.4 m before it.
        check(robot([0.0, 0.0]), [2.4, 0.3], [-1.0, 0.0], Some(2.0));
        // The side of a capsule.
        let axis = [DVec2::new(-1.0, 0.0), DVec2::new(1.0, 0.0)];
        let capsule = MovingObstacle { axis, ..robot([0.0, 0.0]) };
        check(capsule, [0.5, 2.5], [0.0, -1.0], Some(2.0));
        check(capsule, [3.5, 0.0], [-1.0, 0.0], Some(2.0));
        check(capsule, [0.5, -1.5], [0.0, 1.0], Some(1.0));
        check(capsule, [0.5, 0.4], [0.0, -1.0], Some(0.0));
    }

    #[test]
    fn a_stop_counts_once_per_encounter() {
        let walks = (robot([0.0; 2]), person([2.0, 0.0], [-1.34, 0.0], [-1.34, 0.0]));
        let stops = (robot([0.0; 2]), person([0.8, 0.0], [-0.1, 0.0], [-1.34, 0.0]));
        let leaves = (robot([0.0; 2]), person([0.8, 0.0], [1.34, 0.0], [1.34, 0.0]));
        let run = |parts: &[(usize, &(MovingObstacle, Person))]| {
            let repeat = |(count, sample): &(usize, &(MovingObstacle, Person))| {
                std::iter::repeat_n((*sample).clone(), *count)
            };
            let samples: Vec<_> = parts.iter().flat_map(repeat).collect();
            let comfort = sampled(&samples);
            (comfort.forced_stops, comfort.forced_detours)
        };
        assert_eq!(run(&[(20, &walks)]), (0, 0));
        assert_eq!(run(&[(5, &walks), (4, &stops), (5, &walks)]), (0, 0));
        assert_eq!(run(&[(5, &walks), (5, &stops), (5, &walks)]), (1, 0));
        // Two stops with 1 s between them, and with 2.1 s between them.
        assert_eq!(run(&[(9, &stops), (10, &leaves), (9, &stops)]), (1, 0));
        assert_eq!(run(&[(9, &stops), (21, &leaves), (9, &stops)]), (2, 0));
    }

    #[test]
    fn a_detour_is_a_direction_of_more_than_30_degrees() {
        let turned = |degrees: f64| {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            (robot([0.0; 2]), person([2.0, 0.0], [-cosine, sine], [-1.34, 0.0]))
        };
        let detours = |degrees: f64| sampled(&vec![turned(degrees); 6]).forced_detours;
        assert_eq!([detours(0.0), detours(29.0), detours(31.0), detours(90.0)], [0, 0, 1, 1]);
        // A person that is not on a collision course is not forced.
        let aside = (robot([0.0; 2]), person([2.0, 1.0], [0.0, 1.0], [-1.34, 0.0]));
        assert_eq!(sampled(&vec![aside; 20]).forced_detours, 0);
    }

    #[test]
    fn a_freeze_counts_once() {
        let mut meter = ComfortMeter::default();
        for still_s in [9.0, 10.5, 12.0, 0.0, 11.0] {
            let mut person = person([5.0, 0.0], [0.0; 2], [1.0, 0.0]);
            person.still_s = still_s;
            meter.sample(0.1, [], &[person]);
        }
        assert_eq!(meter.people(), PeopleComfort { longest_freeze_s: 12.0, freezes: 2 });
        assert!(meter.robots().is_empty());
    }
}
