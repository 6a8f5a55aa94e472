//! Accuracy of AMCL, SLAM and costmaps among people: a robot drives through the warehouse with 0 to 200 of them.
//!
//! `cargo xtask crowds --accuracy` prints the tables; the argument `amcl` or `slam` chooses one.
#![allow(
    clippy::print_stdout,
    clippy::disallowed_methods,
    clippy::unwrap_used,
    reason = "an example that writes a temporary map and prints tables"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use periplus_geometry::{Pose2, Stream};
use periplus_graph::{Mailbox, Publisher, Qos};
use periplus_grid::{OccupancyGrid, occupancy, squared_distances};
use periplus_maps::{Distro, Saving, render};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::OccupancyGrid as GridMessage;
use periplus_msgs::vision_msgs::Detection3DArray;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_os::Stopwatch;
use periplus_session::nodes::{
    EstimatorRequest, GoalDriver, GoalOutcome, MappingRequest, MappingSource, Navigation,
    NavigationDefaults, NavigationRequest, PlanningMap, RobotPose, initial_pose_message,
    slam_parameters,
};
use periplus_session::{
    ProgressLine, RunSettings, SessionBuilder, SessionTask, SimulationSession, terminal,
};
use periplus_sim::{
    AssetFiles, FreeFloor, MapDrawing, Options, PeopleFile, PlacementPose, RobotPlacement,
    Simulation, Tick, compose,
};

/// Numbers of people in the world.
const COUNTS: [usize; 4] = [0, 10, 50, 200];

/// Duration of a run \[s\].
const DURATION_S: f64 = 240.0;

/// Time between two comparisons with the truth \[ns\].
const COMPARISON_PERIOD_NS: i64 = 500_000_000;

/// Start of the robot in the world.
const START: Pose2 = Pose2 { x_m: -10.0, y_m: -2.5, yaw_rad: 0.0 };

/// Radius of the robot, for its goals \[m\].
const RADIUS_M: f64 = 0.3;

/// Number of goals, more than are reached.
const GOAL_COUNT: u64 = 40;

/// Range in which the local costmap marks obstacles by default \[m\].
const MARKING_RANGE_M: f64 = 2.5;

/// Distance of marked cells from the centre of a person who causes them \[m\]: half of the depth of a body, and what it
/// has walked since the scan.
const BODY_M: f64 = 0.5;

/// Distance of marked cells from a wall that causes them \[m\].
const WALL_M: f64 = 0.15;

/// Source of the map and the pose.
#[derive(Clone, Copy, PartialEq)]
enum Estimator {
    Amcl,
    Slam,
}

/// Results of a run.
#[derive(Default)]
struct Scores {
    errors_m: Vec<f64>,
    /// People in sight and range, and those of them with a marked cell.
    people: [usize; 2],
    /// Marked cells, and those of them that neither people nor walls cause.
    cells: [usize; 2],
    reached: usize,
    length_m: f64,
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let world = root.join("worlds/warehouse.sdf");
    let robot = root.join("benches/fleet_robot.urdf");
    let map = drawn_map(&world);
    let folder = std::env::temp_dir().join(format!("periplus-people-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let saved = write_map(&folder, &map);
    let wanted = std::env::args().nth(1);
    let all = [(Estimator::Amcl, "AMCL"), (Estimator::Slam, "SLAM")];
    for (estimator, name) in all
        .into_iter()
        .filter(|(_, name)| wanted.as_ref().is_none_or(|wanted| wanted.eq_ignore_ascii_case(name)))
    {
        println!(
            "\n| people | {name}: mean error [m] | largest [m] | people in range that are marked | marked cells without cause | goals | driven [m] |\n\
             |---|---|---|---|---|---|---|"
        );
        for count in COUNTS {
            let scores = run(&world, &robot, estimator, count, &map, &saved);
            println!("| {count} | {} |", scores.columns());
        }
    }
    let _ = std::fs::remove_dir_all(&folder);
}

impl Scores {
    fn columns(&self) -> String {
        let mean_m = self.errors_m.iter().sum::<f64>() / self.errors_m.len().max(1) as f64;
        let max_m = self.errors_m.iter().copied().fold(0.0, f64::max);
        let share = |[all, some]: [usize; 2]| match all {
            0 => "-".to_owned(),
            _ => format!("{:.1} %", 100.0 * some as f64 / all as f64),
        };
        let Self { people, cells, reached, length_m, .. } = self;
        format!(
            "{mean_m:.3} | {max_m:.3} | {} | {} | {reached} | {length_m:.0}",
            share(*people),
            share(*cells)
        )
    }
}

/// Map of the walls of a world, in its frame.
fn drawn_map(world: &Path) -> OccupancyGrid {
    let mut composition =
        terminal::search(&[]).with_context(true, |context| compose(world, &[], context));
    let files = Arc::new(AssetFiles::default());
    let mut simulation = Simulation::new(&mut composition, files, Options::default());
    let start_m = [START.x_m, START.y_m];
    let drawing = MapDrawing { start_m, height_m: 0.2, resolution_m: 0.05, max_side_m: 100.0 };
    simulation.draw_map(drawing).unwrap()
}

/// Writes a map, and returns its YAML file.
fn write_map(folder: &Path, map: &OccupancyGrid) -> PathBuf {
    let name = folder.join("map").display().to_string();
    let saved = render(map, &Saving::new(name.as_str(), Distro::Jazzy));
    std::fs::write(&saved.image_path, &saved.image).unwrap();
    std::fs::write(&saved.yaml_path, saved.yaml.as_bytes()).unwrap();
    PathBuf::from(saved.yaml_path)
}

/// Drives among people, and compares with the truth.
fn run(
    world: &Path,
    robot: &Path,
    estimator: Estimator,
    people: usize,
    map: &OccupancyGrid,
    saved: &Path,
) -> Scores {
    let placement = RobotPlacement {
        file: robot.to_owned(),
        arguments: Vec::new(),
        name: None,
        namespace: None,
        pose: PlacementPose::OnGround([START.x_m, START.y_m, START.yaw_rad]),
    };
    let composition = terminal::search(&[])
        .with_context(true, |context| compose(world, std::slice::from_ref(&placement), context));
    let is_mapped = estimator == Estimator::Amcl;
    let (program, values) = slam_parameters(None, Some(Program::Async)).unwrap();
    let mapping = MappingRequest { source: MappingSource::Values(program, values), out: None };
    let planning = if is_mapped { PlanningMap::Known } else { PlanningMap::Growing };
    let defaults = NavigationDefaults { map: planning, ..NavigationDefaults::for_robots(2) };
    let request = EstimatorRequest {
        detects_robot: true,
        localization: is_mapped.then(|| saved.to_owned()).into_iter().collect(),
        mapping: (!is_mapped).then_some(mapping),
        navigation: Some(NavigationRequest { parameters: None, defaults }),
        ..EstimatorRequest::default()
    };
    let threads = terminal::processors();
    let mut session = SessionBuilder::new(
        composition,
        Options { threads, ..Options::default() },
        Stopwatch::start(),
    )
    .quiet(true)
    .people((people > 0).then(|| PeopleFile::wandering(people)))
    .estimators(request)
    .build()
    .unwrap();
    let mut task = PeopleTask::new(&mut session, estimator, map.clone());
    let stop = Arc::new(AtomicBool::new(false));
    let settings = RunSettings { duration_s: Some(DURATION_S), stop: &stop, is_paused: false };
    session.run(settings, &mut task);
    task.finish()
}

/// A robot that drives to random goals, and its scores.
struct PeopleTask {
    navigation: Navigation,
    goals: GoalDriver,
    pose: RobotPose,
    people: Mailbox<Detection3DArray>,
    costmap: Mailbox<GridMessage>,
    /// Pose from which AMCL starts, until it is published.
    initial: Option<Publisher<PoseWithCovarianceStamped>>,
    walls: OccupancyGrid,
    /// Squared distances to walls of the map \[cells²\].
    squared_cells: Vec<f32>,
    /// Pose of the map in the world: for SLAM such that the first estimate has no error.
    world_from_map: Option<Pose2>,
    /// Goals in the world, until they are sent.
    given: Vec<Pose2>,
    next_ns: i64,
    last: Pose2,
    scores: Scores,
}

impl PeopleTask {
    fn new(session: &mut SimulationSession, estimator: Estimator, walls: OccupancyGrid) -> Self {
        let navigation = session.take_navigation().pop().unwrap();
        let floor = FreeFloor::new(&walls, RADIUS_M);
        let cells = floor.reachable_from(floor.start_cell(START).unwrap());
        let goal = |number: u64| {
            let mut stream = Stream::keyed(0, "goals among people", number);
            let (x_m, y_m) =
                walls.info.centre_of(cells[(stream.unit() * cells.len() as f64) as usize]);
            Pose2::new(x_m, y_m, 0.0)
        };
        let given: Vec<Pose2> = (0..GOAL_COUNT).map(goal).collect();
        let goals =
            GoalDriver::new(session.graph(), &navigation.global_frame(), Vec::new()).unwrap();
        let node = goals.node().clone();
        let distances = squared_distances(&walls, |value| *value == occupancy::OCCUPIED);
        Self {
            pose: RobotPose::new(&node, "base_link").unwrap(),
            people: node.mailbox("/people", Qos::reliable(1)).unwrap(),
            costmap: node.mailbox("/local_costmap/costmap", Qos::latched(1)).unwrap(),
            initial: (estimator == Estimator::Amcl)
                .then(|| node.publisher("/initialpose", Qos::reliable(1)).unwrap()),
            squared_cells: distances.cells.iter().map(|it| *it as f32).collect(),
            navigation,
            goals,
            walls,
            world_from_map: (estimator == Estimator::Amcl).then_some(Pose2::IDENTITY),
            given,
            next_ns: COMPARISON_PERIOD_NS,
            last: START,
            scores: Scores::default(),
        }
    }

    fn finish(mut self) -> Scores {
        let reached = self.goals.reports().iter().filter(|it| it.outcome == GoalOutcome::Reached);
        self.scores.reached = reached.count();
        self.scores
    }

    /// Compares pose and costmap with the truth.
    fn compare(&mut self, world_from_base: Pose2) {
        if let Some(map_from_base) = self.pose.newest_in("map") {
            let world_from_map = *self
                .world_from_map
                .get_or_insert_with(|| world_from_base * map_from_base.inverse());
            for goal in self.given.drain(..) {
                self.goals.push(world_from_map.inverse() * goal);
            }
            let estimate = world_from_map * map_from_base;
            self.scores.errors_m.push(distance_m(estimate, world_from_base));
        }
        let people: Vec<[f64; 2]> = self
            .people
            .latest()
            .iter()
            .flat_map(|boxes| &boxes.detections)
            .map(|it| [it.bbox.center.position.x, it.bbox.center.position.y])
            .collect();
        let odom_from_base = self.pose.newest_in("odom");
        if let (Some(costmap), Some(odom_from_base)) = (self.costmap.latest(), odom_from_base) {
            let world_from_odom = world_from_base * odom_from_base.inverse();
            self.compare_costmap(&costmap, world_from_odom, world_from_base, &people);
        }
    }

    fn compare_costmap(
        &mut self,
        costmap: &GridMessage,
        world_from_odom: Pose2,
        world_from_base: Pose2,
        people: &[[f64; 2]],
    ) {
        let origin = &costmap.info.origin.position;
        let resolution_m = f64::from(costmap.info.resolution);
        let width = costmap.info.width as usize;
        let mut is_marked = vec![false; people.len()];
        for (index, _) in costmap.data.iter().enumerate().filter(|(_, cost)| **cost == 100) {
            let centre = |count: usize| (count as f64 + 0.5) * resolution_m;
            let (x_m, y_m) = (origin.x + centre(index % width), origin.y + centre(index / width));
            let cell = world_from_odom * Pose2::new(x_m, y_m, 0.0);
            let mut has_cause = self.is_wall(cell.x_m, cell.y_m);
            for (person, is_marked) in people.iter().zip(&mut is_marked) {
                if libm::hypot(person[0] - cell.x_m, person[1] - cell.y_m) < BODY_M {
                    (has_cause, *is_marked) = (true, true);
                }
            }
            self.scores.cells[0] += 1;
            self.scores.cells[1] += usize::from(!has_cause);
        }
        for (person, is_marked) in people.iter().zip(is_marked) {
            if self.is_seen([world_from_base.x_m, world_from_base.y_m], *person, people) {
                self.scores.people[0] += 1;
                self.scores.people[1] += usize::from(is_marked);
            }
        }
    }

    /// True within a cell's width of a wall of the map.
    fn is_wall(&self, x_m: f64, y_m: f64) -> bool {
        let info = &self.walls.info;
        let Some(cell) = info.cell_of(x_m, y_m) else { return true };
        let limit = WALL_M / info.resolution_m;
        f64::from(self.squared_cells[info.index(cell)]) <= limit * limit
    }

    /// True if a person is in the range of the costmap, and neither walls nor other people are in between.
    fn is_seen(&self, from: [f64; 2], person: [f64; 2], people: &[[f64; 2]]) -> bool {
        let (dx_m, dy_m) = (person[0] - from[0], person[1] - from[1]);
        let range_m = libm::hypot(dx_m, dy_m);
        if range_m > MARKING_RANGE_M - BODY_M {
            return false;
        }
        let steps = (range_m / 0.05) as usize;
        (0..steps).all(|step| {
            let part = step as f64 / steps as f64;
            let (x_m, y_m) = (from[0] + part * dx_m, from[1] + part * dy_m);
            let is_free = self
                .walls
                .info
                .cell_of(x_m, y_m)
                .is_some_and(|cell| self.squared_cells[self.walls.info.index(cell)] > 0.0);
            let in_other = |other: &[f64; 2]| {
                *other != person && libm::hypot(other[0] - x_m, other[1] - y_m) < 0.3
            };
            is_free && !people.iter().any(in_other)
        })
    }
}

fn distance_m(one: Pose2, other: Pose2) -> f64 {
    libm::hypot(one.x_m - other.x_m, one.y_m - other.y_m)
}

impl SessionTask for PeopleTask {
    fn before_step(&mut self, simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        let Some(world_from_base) = simulation.robot_pose().map(Pose2::from) else {
            return Tick::End;
        };
        if let Some(initial) = self.initial.take() {
            initial.publish(initial_pose_message(START));
        }
        self.scores.length_m += distance_m(self.last, world_from_base);
        self.last = world_from_base;
        if simulation.time_ns() >= self.next_ns {
            self.next_ns += COMPARISON_PERIOD_NS;
            self.compare(world_from_base);
        }
        if self.given.is_empty() {
            self.goals.spin_once(simulation.time_ns(), || self.navigation.obstacle());
        }
        if self.given.is_empty() && self.goals.is_done() { Tick::End } else { Tick::Go }
    }
}
