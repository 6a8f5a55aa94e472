//! People of a running world: a crowd on the floor of its walls, seen by all sensors and solid for robots.
//!
//! The crowd is stepped at a fixed rate in simulated time. It is one period ahead: between the two last states people are
//! seen on straight lines, so that the rates of sensors have no influence.

mod contour;
mod file;
mod floor;
mod population;
mod request;
mod robot_shape;

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use periplus_crowds::{ComfortMeter, Crowd, DVec2, MovingObstacle, PersonState};
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_physics::{ModelId, PhysicsWorld};
use periplus_scene::{Collision, Link, Model, Shape};
use periplus_sim_nodes::{FigureId, Views};

use crate::actors::{figure_links, figure_poses};

pub use self::file::{MAX_PEOPLE_COUNT, read_people};
pub(crate) use self::floor::{FloorError, FloorSeeds};
pub(crate) use self::population::{Population, populate};
pub use self::request::{
    PeopleFile, PeopleRequest, RequestedDoor, RequestedGoal, RequestedParty, RequestedPerson,
    RequestedPlan,
};
pub(crate) use self::robot_shape::{RobotShape, has_devices};

/// Period of the crowd \[ns\].
pub(crate) const PERIOD_NS: i64 = 50_000_000;

/// Period of the crowd \[s\].
const PERIOD_S: f64 = 0.05;

/// Fastest turn of a body \[rad/s\].
const MAX_TURN_RAD_PER_S: f64 = 6.0;

/// Height of a person \[m\].
pub(crate) const HEIGHT_M: f64 = 1.75;

/// Radius of the solid core of a body, as a part of its radius: that of a body that has turned sideways.
const CORE_RATIO: f64 = 0.65;

/// State of a person in the frame of the world at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PersonMotion {
    /// Position on the floor \[m\].
    pub position_m: [f64; 2],
    /// Direction in which it looks \[rad\].
    pub yaw_rad: f64,
    /// Velocity \[m/s\].
    pub velocity_m_per_s: [f64; 2],
    /// Radius of the body \[m\].
    pub radius_m: f64,
    /// State.
    pub state: PersonState,
}

/// Shown pose of a person.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ShownPose {
    position: DVec2,
    yaw_rad: f64,
    walked_m: f64,
    speed_m_per_s: f64,
}

/// State of the people that a snapshot has.
#[derive(Clone, Debug)]
pub(crate) struct PeopleState {
    crowd: Crowd,
    /// Time of `from` \[ns\].
    start_ns: i64,
    from: Vec<ShownPose>,
    to: Vec<ShownPose>,
    comfort: ComfortMeter,
}

/// People of a running world.
pub(crate) struct People {
    names: Vec<String>,
    door_names: Vec<String>,
    floor_m: f64,
    figures: Vec<FigureId>,
    bodies: Vec<ModelId>,
    /// Crowd before its first step.
    initial: Crowd,
    state: PeopleState,
    /// Shapes of robots by the numbers of their builds.
    pub(crate) shapes: BTreeMap<u64, RobotShape>,
}

/// Robot with its name, at the time of a step of the crowd.
pub(crate) type NamedRobot = (String, MovingObstacle);

impl People {
    /// Adds the figures and bodies of a crowd to the sensors and to the physics.
    pub(crate) fn new(
        population: Population,
        request: &PeopleRequest,
        start_ns: i64,
        views: &mut Views,
        motion: &mut PhysicsWorld,
        files: &dyn periplus_physics::Meshes,
    ) -> Self {
        let Population { crowd, names } = population;
        let (mut figures, mut bodies) = (Vec::new(), Vec::new());
        for (name, person) in names.iter().zip(crowd.agents()) {
            let mut figure = Model::new(name.clone());
            figure.links = figure_links(name);
            figures.push(views.add_figure(Arc::new(figure)));
            let position = person.position();
            let world_from_person = Pose::from_xyz(position.x, position.y, request.floor_m);
            let body = solid(name, CORE_RATIO * person.settings().radius_m);
            // A cylinder that moves by its velocity has nothing that can be refused.
            bodies.extend(motion.add(&body, world_from_person, files).model);
        }
        let state = PeopleState::start(crowd.clone(), start_ns);
        Self {
            door_names: request.doors.iter().map(|door| door.name.clone()).collect(),
            floor_m: request.floor_m,
            initial: crowd,
            shapes: BTreeMap::new(),
            names,
            figures,
            bodies,
            state,
        }
    }

    /// Names of the people.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Names of the doors.
    pub(crate) fn door_names(&self) -> &[String] {
        &self.door_names
    }

    /// The crowd, up to a period ahead of the simulation.
    pub(crate) fn crowd(&self) -> &Crowd {
        &self.state.crowd
    }

    /// Mutable crowd, to operate its doors.
    pub(crate) fn crowd_mut(&mut self) -> &mut Crowd {
        &mut self.state.crowd
    }

    /// Comfort near robots since the start.
    pub(crate) fn comfort(&self) -> &ComfortMeter {
        &self.state.comfort
    }

    /// Height of the floor \[m\].
    pub(crate) fn floor_m(&self) -> f64 {
        self.floor_m
    }

    /// State to continue from.
    pub(crate) fn state(&self) -> &PeopleState {
        &self.state
    }

    /// Time of the next step of the crowd \[ns\].
    pub(crate) fn next_ns(&self) -> i64 {
        self.state.start_ns.saturating_add(PERIOD_NS)
    }

    /// Returns to the start at a time \[ns\].
    pub(crate) fn restart(&mut self, start_ns: i64) {
        self.state = PeopleState::start(self.initial.clone(), start_ns);
    }

    /// Continues from a state.
    pub(crate) fn restore(&mut self, state: &PeopleState) {
        self.state = state.clone();
    }

    /// Moves all times by an offset \[ns\].
    pub(crate) fn shift_time(&mut self, offset_ns: i64) {
        self.state.start_ns = self.state.start_ns.saturating_add(offset_ns);
    }

    /// Takes the first step after the start, among these robots.
    pub(crate) fn begin(&mut self, robots: &[NamedRobot]) {
        self.state.step(robots);
    }

    /// Takes a step of the crowd, and measures its comfort at the beginning of it.
    pub(crate) fn advance(&mut self, robots: &[NamedRobot]) {
        let state = &mut self.state;
        state.start_ns += PERIOD_NS;
        let named = robots.iter().map(|(name, robot)| (name.as_str(), *robot));
        state.comfort.sample(PERIOD_S, named, state.crowd.agents());
        state.from.clone_from(&state.to);
        state.step(robots);
    }

    /// Gives the bodies the velocities with which they reach the end of the period.
    pub(crate) fn push_bodies(&self, time_ns: i64, motion: &mut PhysicsWorld) {
        let left_s = (self.next_ns() - time_ns).max(1) as f64 * 1e-9;
        for (body, to) in self.bodies.iter().zip(&self.state.to) {
            let Some(pose) = motion.model_pose(*body) else { continue };
            let way = to.position - pose.translation.truncate();
            let turn_rad = wrapped(to.yaw_rad - pose.rpy().yaw);
            let linear_m_s = (way / left_s).extend(0.0);
            motion.set_model_velocity(*body, linear_m_s, DVec3::Z * (turn_rad / left_s));
        }
    }

    /// Puts the bodies at once where people are at a time \[ns\].
    pub(crate) fn place_bodies(&self, time_ns: i64, motion: &mut PhysicsWorld) {
        for (number, body) in self.bodies.iter().enumerate() {
            let shown = self.shown(number, time_ns);
            motion.set_pose(*body, self.world_from_person(&shown));
        }
    }

    /// Moves the figures to their poses at a time \[ns\].
    pub(crate) fn place_figures(&self, time_ns: i64, views: &mut Views) {
        for (number, figure) in self.figures.iter().enumerate() {
            let shown = self.shown(number, time_ns);
            let world_from_soles = self.world_from_person(&shown);
            views.set_figure(
                *figure,
                time_ns,
                &figure_poses(world_from_soles, shown.walked_m, shown.speed_m_per_s),
            );
        }
    }

    /// States of all people at a time \[ns\].
    pub(crate) fn motions(&self, time_ns: i64) -> impl Iterator<Item = PersonMotion> {
        self.state.crowd.agents().iter().enumerate().map(move |(number, person)| {
            let shown = self.shown(number, time_ns);
            let moved = self.state.to[number].position - self.state.from[number].position;
            PersonMotion {
                position_m: shown.position.to_array(),
                yaw_rad: shown.yaw_rad,
                velocity_m_per_s: (moved / PERIOD_S).to_array(),
                radius_m: person.settings().radius_m,
                state: person.state(),
            }
        })
    }

    /// True if a robot has moved into the core of a body since an earlier position.
    pub(crate) fn blocks(
        &self,
        before: &MovingObstacle,
        now: &MovingObstacle,
        time_ns: i64,
    ) -> bool {
        self.state.crowd.agents().iter().enumerate().any(|(number, person)| {
            let core_m = CORE_RATIO * person.settings().radius_m;
            let position = self.shown(number, time_ns).position;
            let gap_m = now.distance_m(position) - core_m;
            gap_m < 0.0 && now.distance_m(position) < before.distance_m(position)
        })
    }

    fn world_from_person(&self, shown: &ShownPose) -> Pose {
        let rpy = Rpy { roll: 0.0, pitch: 0.0, yaw: shown.yaw_rad };
        Pose::from_xyz_rpy([shown.position.x, shown.position.y, self.floor_m], rpy)
    }

    /// Pose at a time within the period \[ns\].
    fn shown(&self, number: usize, time_ns: i64) -> ShownPose {
        let (from, to) = (self.state.from[number], self.state.to[number]);
        let ratio = ((time_ns - self.state.start_ns) as f64 / PERIOD_NS as f64).clamp(0.0, 1.0);
        ShownPose {
            position: from.position.lerp(to.position, ratio),
            yaw_rad: from.yaw_rad + wrapped(to.yaw_rad - from.yaw_rad) * ratio,
            walked_m: from.walked_m + (to.walked_m - from.walked_m) * ratio,
            speed_m_per_s: from.speed_m_per_s + (to.speed_m_per_s - from.speed_m_per_s) * ratio,
        }
    }
}

impl PeopleState {
    fn start(crowd: Crowd, start_ns: i64) -> Self {
        let shown = |person: &periplus_crowds::Person| ShownPose {
            position: person.position(),
            yaw_rad: libm::atan2(person.heading().y, person.heading().x),
            walked_m: 0.0,
            speed_m_per_s: 0.0,
        };
        let from: Vec<ShownPose> = crowd.agents().iter().map(shown).collect();
        Self { to: from.clone(), from, crowd, start_ns, comfort: ComfortMeter::default() }
    }

    /// Steps the crowd among robots, and turns the bodies to where people walk.
    fn step(&mut self, robots: &[NamedRobot]) {
        self.crowd.set_obstacles(robots.iter().map(|(_, robot)| *robot).collect());
        self.crowd.step(PERIOD_S);
        for (shown, person) in self.to.iter_mut().zip(self.crowd.agents()) {
            let heading_rad = libm::atan2(person.heading().y, person.heading().x);
            let limit_rad = MAX_TURN_RAD_PER_S * PERIOD_S;
            let turn_rad = wrapped(heading_rad - shown.yaw_rad).clamp(-limit_rad, limit_rad);
            *shown = ShownPose {
                position: person.position(),
                yaw_rad: wrapped(shown.yaw_rad + turn_rad),
                walked_m: person.walked_m(),
                speed_m_per_s: person.velocity().length(),
            };
        }
    }
}

/// Core of a body, which robots cannot enter.
fn solid(name: &str, radius_m: f64) -> Model {
    let shape = Shape::Cylinder { radius_m, length_m: HEIGHT_M };
    let link_from_collision = Pose::from_xyz(0.0, 0.0, 0.5 * HEIGHT_M);
    let mut link = Link::new("body");
    link.kinematic = true;
    link.collisions.push(Collision { link_from_collision, ..Collision::new("body", shape) });
    let mut model = Model::new(name);
    model.links.push(link);
    model
}

/// Angle from -pi to pi \[rad\].
fn wrapped(angle_rad: f64) -> f64 {
    angle_rad - TAU * libm::floor((angle_rad + PI) / TAU)
}
