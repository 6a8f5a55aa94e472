//! `periplus navigate`.

mod fleet;
mod random_goals;
mod report;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use periplus_geometry::Pose2;
use periplus_graph::{Arguments, Publisher, Qos};
use periplus_grid::OccupancyGrid;
use periplus_loader::LoadContext;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_os::Stopwatch;
use periplus_session::nodes::{
    EstimatorRequest, GoalDriver, GoalOutcome, MappingRequest, MappingSource, Navigation,
    NavigationDefaults, NavigationRequest, PathController, PlanningMap, RobotBase,
    initial_pose_message, slam_parameters,
};
use periplus_session::{
    PageContext, ProgressLine, RunSettings, SessionBuilder, SessionTask, SimulationSession, stop,
};
use periplus_sim::{
    ArrivalClock, Composition, DriveScore, Options, PlacementPose, RunProgress, Simulation, Tick,
    compose, wall_grid_around,
};

use self::fleet::FleetTask;
use self::random_goals::GoalAreas;
use crate::error::CliError;
use crate::options::SearchOptions;
use crate::page::PageOptions;
use crate::run_options::{
    Factor, Reach, Ros1Options, TopicSelection, exit_code, factor, finite_numbers, positive,
};
use crate::sim::fleet::drawn_places;
use crate::sim::{Dynamics, Robots, people, robot_count};
use crate::terminal;

/// Drive a robot to goals in a simulated world, as Nav2 does
///
/// Runs the servers of Nav2 (planner, controller, behaviors, navigator) beside the robot, with SLAM, or on a map with
/// `--map`, and sends the goals one after the other. The robot knows its sensors only; the report compares with the
/// truth. Exit code 1: a goal was not reached.
///
/// With `--robots`, or several `--robot`, each robot has its own servers, AMCL and costmaps in its namespace, on one
/// map in the frame of the world, and drives to its own random goals.
#[derive(Debug, Args)]
pub(crate) struct NavigateOptions {
    /// World, and `name:=value` for its xacro
    #[arg(value_name = "WORLD|NAME:=VALUE")]
    words: Vec<String>,
    #[command(flatten)]
    robots: Robots,
    /// Goal [m, rad]: X,Y or X,Y,YAW; repeatable, in their order. In the frame of the map with `--map`; with SLAM in the
    /// frame of the world, if the robot stands at `--pose`; without a map relative to the start
    #[arg(long = "goal", value_name = "X,Y,YAW", value_parser = pose, allow_hyphen_values = true,
        required_unless_present_any = ["random_goals", "open_rmf"])]
    goals: Vec<Pose2>,
    /// Number of random goals that the robot can reach on the map, after those of `--goal`; they depend on `--seed`
    #[arg(long, value_name = "NUMBER", requires = "map")]
    random_goals: Option<usize>,
    /// Number of copies of the robot, each at a random start on the map
    #[arg(long = "robots", value_name = "COUNT", value_parser = robot_count, requires = "map")]
    robot_count: Option<usize>,
    /// Motion model: rigid bodies, or motion exactly as commanded on a flat floor
    #[arg(long, value_enum, default_value_t = Dynamics::Rigid)]
    dynamics: Dynamics,
    /// People who walk among the robots: their number, or a YAML file
    #[arg(long, value_name = "COUNT|FILE.yaml")]
    people: Option<String>,
    /// Attach the robots to Open-RMF as this fleet: publish their states, and drive the paths that a fleet adapter
    /// requests, until `--timeout`
    #[arg(long, value_name = "FLEET")]
    open_rmf: Option<String>,
    /// Controller, for the default parameters: `mppi`, which leads around obstacles, or `rpp`, regulated pure pursuit,
    /// which follows the path in a hundredth of the computing time [default: mppi, for several robots rpp]
    #[arg(long, value_enum, value_name = "NAME")]
    controller: Option<Controller>,
    /// Map to localize on with AMCL [default: SLAM builds one while the robot drives]
    #[arg(long, value_name = "MAP.yaml", conflicts_with = "no_map")]
    map: Option<PathBuf>,
    /// Pose of the robot in the map at the start, from which AMCL starts [m, rad] [default: that of `--pose`]. Maps of SLAM
    /// begin at the robot: 0,0,0 is where the map was begun
    #[arg(long, value_name = "X,Y,YAW", value_parser = pose, allow_hyphen_values = true, requires = "map")]
    initial_pose: Option<Pose2>,
    /// At the end write the map that SLAM built to a folder: map.yaml, map.pgm, map.session, map.png
    #[arg(long, value_name = "DIR", conflicts_with_all = ["map", "no_map"])]
    slam_out: Option<PathBuf>,
    /// Drive without a map, in the odometry frame: goals are relative to the start
    #[arg(long)]
    no_map: bool,
    /// Parameter file of Nav2 [default: parameters for the detected robot]
    #[arg(long, value_name = "FILE.yaml")]
    params_file: Option<PathBuf>,
    /// Motion that the wheels allow, for the default parameters
    #[arg(long, value_enum, default_value_t = Base::Differential, value_name = "BASE")]
    base: Base,
    /// Smallest radius of a turn, for `--base ackermann` [m]
    #[arg(long, default_value_t = 0.5, value_name = "METRES", value_parser = positive)]
    min_turning_radius: f64,
    /// Maximum speed, for the default parameters [m/s]
    #[arg(long, default_value_t = 0.5, value_name = "SPEED", value_parser = positive)]
    max_speed: f64,
    /// Maximum turn rate, for the default parameters [rad/s]
    #[arg(long, default_value_t = 1.9, value_name = "RATE", value_parser = positive)]
    max_turn_rate: f64,
    /// Maximum duration of the run in simulated seconds
    #[arg(long, default_value_t = 600.0, value_name = "SECONDS", value_parser = positive)]
    timeout: f64,
    /// End the run when the robot is within this distance of the last goal [m]; the report has the time since it
    /// moved, as in the BARN challenge
    #[arg(long, value_name = "METRES", value_parser = positive)]
    arrival_radius: Option<f64>,
    /// End the run at the first collision
    #[arg(long)]
    end_at_collision: bool,
    /// Record published topics to a bag: FILE.mcap, or a folder in the format of `ros2 bag`
    #[arg(long, value_name = "FILE.mcap|FOLDER")]
    record: Option<PathBuf>,
    #[command(flatten)]
    recorded: TopicSelection,
    /// Seed of all noise
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    /// Real-time factor, or `max` for full speed [default: max, with `--page` that of the world]
    #[arg(long, value_name = "FACTOR|max", value_parser = factor)]
    rtf: Option<Factor>,
    /// Number of threads, for rays and for the nodes of several robots; results do not depend on it
    #[arg(long, value_name = "NUMBER")]
    threads: Option<usize>,
    /// Visibility of the run on ROS 2 [default: off at full speed]
    #[arg(long, value_enum, value_name = "off|loopback|network|zenoh")]
    ros2: Option<Reach>,
    #[command(flatten)]
    ros1: Ros1Options,
    #[command(flatten)]
    page: PageOptions,
    /// Do not open a browser
    #[arg(long, requires = "page")]
    no_browser: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// Print only errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    search: SearchOptions,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Controller {
    /// Model predictive path integral control
    Mppi,
    /// Regulated pure pursuit
    Rpp,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Base {
    /// Two driven wheels, tracks, or four wheels that slip
    Differential,
    /// In all directions: mecanum or omni wheels
    Omni,
    /// As a car
    Ackermann,
}

/// Radius of a robot without collisions, for random goals \[m\].
const UNKNOWN_RADIUS_M: f64 = 0.3;

pub(crate) fn run(options: &NavigateOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let start = Stopwatch::start();
    let to_nodes = crate::arguments::read(ros)?;
    let (world, arguments) = options.robots.world(&options.words, "navigate")?;
    options.check()?;
    let search = terminal::search(&options.search.resource_path);
    let load = || {
        search.with_context(true, |context| {
            let context = LoadContext { arguments: arguments.clone(), ..context.clone() };
            compose(&world, &options.robots.placements, &context)
        })
    };
    let mut composition = load();
    let map = options.fleet_map()?;
    if let (Some(count), Some(map), false) = (options.robot_count, &map, composition.has_errors()) {
        composition.spread_last(&drawn_places(load(), map, count, options.seed)?);
    }
    let pose = options.start_pose();
    let people = options.people.as_deref().map(people::read).transpose()?;
    let factor = options.factor(&composition);
    let page = options.page.of_run(
        PageContext::of(&composition, &options.search.resource_path),
        options.quiet,
        !options.no_browser,
    );
    let mut session = SessionBuilder::new(composition, options.simulation(to_nodes), start)
        .quiet(options.quiet)
        .progress(!options.quiet && !options.json)
        .factor(factor)
        .search(search)
        .recording(options.recorded.recording(options.record.as_deref()))
        .recording_truth(options.recorded.records_truth())
        .people(people)
        .open_rmf(options.open_rmf.clone())
        .estimators(options.estimators()?)
        .ros2(options.ros2.map(Into::into))
        .ros1(options.ros1.reach())
        .page(page)
        .build()?;
    let stop = stop::on_signal();
    let settings = RunSettings { duration_s: Some(options.timeout), stop: &stop, is_paused: false };
    if let Some(map) = map {
        return run_fleet(options, &mut session, settings, map);
    }
    let mut task = NavigateTask::new(&mut session, options, pose)?;
    session.run(settings, &mut task);
    session.finish()?;
    task.goals.finish(session.simulation().time_ns());
    options.print(&session, &task)?;
    session.write_maps(options.quiet)?;
    exit_code(session.end())?;
    let is_reached =
        |report: &periplus_session::nodes::GoalReport| report.outcome == GoalOutcome::Reached;
    let has_failed = options.end_at_collision && task.collisions() > 0;
    let is_done = task.has_arrived() || task.goals.reports().iter().all(is_reached);
    if is_done && !has_failed { Ok(ExitCode::SUCCESS) } else { Ok(ExitCode::FAILURE) }
}

/// Runs several robots.
fn run_fleet(
    options: &NavigateOptions,
    session: &mut SimulationSession,
    settings: RunSettings<'_>,
    map: OccupancyGrid,
) -> Result<ExitCode, CliError> {
    let mut task = FleetTask::new(session, options, map)?;
    session.run(settings, &mut task);
    session.finish()?;
    task.finish(session.simulation().time_ns());
    if options.json {
        writeln!(io::stdout().lock(), "{:#}", task.to_json(session))?;
    } else if !options.quiet {
        task.print(session, &mut anstream::stderr().lock())?;
    }
    exit_code(session.end())?;
    Ok(if task.is_done() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

impl NavigateOptions {
    fn number_of_robots(&self) -> usize {
        self.robot_count.unwrap_or(self.robots.placements.len())
    }

    /// True if each robot has its own namespace.
    fn is_fleet(&self) -> bool {
        self.robot_count.is_some() || self.robots.placements.len() > 1
    }

    /// Checks combinations of options.
    fn check(&self) -> Result<(), CliError> {
        if self.robot_count.is_some() && self.robots.placements.len() != 1 {
            return Err(CliError::usage("`--robots` needs exactly one `--robot`"));
        }
        if !self.is_fleet() {
            return Ok(());
        }
        if self.map.is_none() || self.random_goals.is_none() && self.open_rmf.is_none() {
            return Err(CliError::usage(
                "several robots need a map, and random goals on it (`--map MAP.yaml --random-goals NUMBER`) or a fleet \
                 adapter that sends them paths (`--open-rmf FLEET`); `periplus map draw WORLD` draws the map of a world",
            ));
        }
        let single = [
            (!self.goals.is_empty(), "--goal"),
            (self.initial_pose.is_some(), "--initial-pose"),
            (self.arrival_radius.is_some(), "--arrival-radius"),
            (self.end_at_collision, "--end-at-collision"),
        ];
        match single.into_iter().find(|(is_given, _)| *is_given) {
            Some((_, option)) => Err(CliError::Usage(format!("`{option}` is for one robot"))),
            None => Ok(()),
        }
    }

    /// Map of several robots.
    fn fleet_map(&self) -> Result<Option<OccupancyGrid>, CliError> {
        let path = self.map.as_ref().filter(|_| self.is_fleet());
        path.map(|path| crate::localize::map_grid(path)).transpose()
    }

    fn controller(&self) -> PathController {
        match self.controller {
            Some(Controller::Mppi) => PathController::Mppi,
            Some(Controller::Rpp) => PathController::RegulatedPurePursuit,
            None => NavigationDefaults::for_robots(self.number_of_robots()).controller,
        }
    }

    /// Pose at which the user has put the robot.
    fn start_pose(&self) -> Pose2 {
        match self.robots.placements.first().map(|placement| &placement.pose) {
            Some(PlacementPose::OnGround([x_m, y_m, yaw_rad])) => Pose2::new(*x_m, *y_m, *yaw_rad),
            Some(PlacementPose::At(pose)) => Pose2::from(*pose),
            Some(PlacementPose::AsWritten) | None => Pose2::IDENTITY,
        }
    }

    /// Goals of the user, and random ones.
    fn all_goals(&self, simulation: &Simulation, start: Pose2) -> Result<Vec<Pose2>, CliError> {
        let mut goals = self.goals.clone();
        if let (Some(count), Some(path)) = (self.random_goals, &self.map) {
            let map = crate::localize::map_grid(path)?;
            let radius_m = simulation.robot_radius_m().unwrap_or(UNKNOWN_RADIUS_M);
            let found = GoalAreas::new(&map, radius_m).draw(start, count, self.seed);
            if found.len() < count {
                return Err(CliError::failed(format!(
                    "{}: no position near the start has {radius_m:.2} m of room for the robot",
                    path.display()
                )));
            }
            goals.extend(found);
        }
        Ok(goals)
    }

    fn simulation(&self, arguments: Arguments) -> Options {
        Options {
            seed: self.seed,
            mode: self.dynamics.into(),
            threads: self.threads.unwrap_or_else(terminal::processors),
            arguments,
            ..Options::default()
        }
    }

    fn factor(&self, composition: &Composition) -> Option<f64> {
        let duration_s = self.page.page.is_none().then_some(self.timeout);
        Factor::of_run(self.rtf, duration_s, composition)
    }

    fn estimators(&self) -> Result<EstimatorRequest, CliError> {
        let base = match self.base {
            Base::Differential => RobotBase::Differential,
            Base::Omni => RobotBase::Omnidirectional,
            Base::Ackermann => {
                RobotBase::Ackermann { min_turning_radius_m: self.min_turning_radius }
            }
        };
        let is_mapped = self.map.is_none() && !self.no_map;
        let mapping = is_mapped.then(|| mapping(self.slam_out.clone())).transpose()?;
        Ok(EstimatorRequest {
            detects_robot: true,
            is_fleet: self.is_fleet(),
            localization: self.map.iter().cloned().collect(),
            mapping,
            navigation: Some(NavigationRequest {
                parameters: self.params_file.clone(),
                defaults: NavigationDefaults {
                    controller: self.controller(),
                    base,
                    max_speed_m_s: self.max_speed,
                    max_turn_rate_rad_s: self.max_turn_rate,
                    map: self.planning_map(),
                },
            }),
            ..EstimatorRequest::default()
        })
    }

    fn planning_map(&self) -> PlanningMap {
        match (&self.map, self.no_map) {
            (Some(_), _) => PlanningMap::Known,
            (None, true) => PlanningMap::Absent,
            (None, false) => PlanningMap::Growing,
        }
    }

    /// Prints the report of the run.
    fn print(&self, session: &SimulationSession, task: &NavigateTask) -> Result<(), CliError> {
        if self.json {
            let report = report::to_json(session, task);
            writeln!(io::stdout().lock(), "{report:#}")?;
        } else if !self.quiet {
            report::print(session, task, &mut anstream::stderr().lock())?;
        }
        Ok(())
    }
}

/// SLAM with default parameters.
fn mapping(out: Option<PathBuf>) -> Result<MappingRequest, CliError> {
    let (program, values) = slam_parameters(None, Some(Program::Async))?;
    Ok(MappingRequest { source: MappingSource::Values(program, values), out })
}

/// Navigation of a run: sends the goals, and keeps the score.
struct NavigateTask {
    navigation: Navigation,
    /// Goals as the user has given them.
    given: Vec<Pose2>,
    goals: GoalDriver,
    /// Pose that AMCL starts from, until it is published.
    initial_pose: Option<(Publisher<PoseWithCovarianceStamped>, Pose2)>,
    score: Option<DriveScore>,
    arrival: Option<ArrivalClock>,
    ends_at_collision: bool,
    /// True if a fleet adapter may send more paths.
    is_attached: bool,
}

impl NavigateTask {
    fn new(
        session: &mut SimulationSession,
        options: &NavigateOptions,
        start: Pose2,
    ) -> Result<Self, CliError> {
        let initial = options.initial_pose.unwrap_or(start);
        let given = options.all_goals(session.simulation(), initial)?;
        let navigation = session.take_navigation().pop().unwrap_or_default();
        let frame = navigation.global_frame();
        // The frame of a map of SLAM is the odometry frame of the start.
        let frame_from_start =
            session.profile().map_or(Pose2::IDENTITY, |profile| profile.odom_from_start);
        let in_frame = |goal: &Pose2| match options.planning_map() {
            PlanningMap::Growing => frame_from_start * start.inverse() * *goal,
            PlanningMap::Known => *goal,
            PlanningMap::Absent => frame_from_start * *goal,
        };
        let poses = given.iter().map(in_frame).collect();
        let goals = GoalDriver::new(session.graph(), &frame, poses).map_err(CliError::failed)?;
        let initial_pose = options.map.as_ref().map(|_| {
            let publisher = goals.node().publisher("/initialpose", Qos::reliable(1));
            publisher.map(|publisher| (publisher, initial))
        });
        let initial_pose = initial_pose.transpose().map_err(CliError::failed)?;
        let world_from_goals = match options.planning_map() {
            PlanningMap::Growing => Pose2::IDENTITY,
            PlanningMap::Known => start * initial.inverse(),
            PlanningMap::Absent => start,
        };
        let in_world: Vec<Pose2> = given.iter().map(|goal| world_from_goals * *goal).collect();
        let cells = wall_grid_around(&[&[start], &in_world[..]].concat());
        let score = DriveScore::new(session.simulation_mut(), cells);
        let arrival = options
            .arrival_radius
            .zip(in_world.last())
            .map(|(radius_m, goal)| ArrivalClock::new([goal.x_m, goal.y_m], radius_m));
        Ok(Self {
            navigation,
            given,
            goals,
            initial_pose,
            score,
            arrival,
            ends_at_collision: options.end_at_collision,
            is_attached: options.open_rmf.is_some(),
        })
    }

    fn collisions(&self) -> usize {
        self.score.as_ref().map_or(0, |score| score.collisions.len())
    }

    fn has_arrived(&self) -> bool {
        self.arrival.as_ref().is_some_and(|clock| clock.time_s().is_some())
    }

    /// Returns true if the truth ends the run.
    fn is_over(&self) -> bool {
        self.has_arrived() || self.ends_at_collision && self.collisions() > 0
    }
}

impl SessionTask for NavigateTask {
    fn before_step(&mut self, simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        if let Some((publisher, pose)) = self.initial_pose.take() {
            publisher.publish(initial_pose_message(pose));
        }
        if let Some(score) = &mut self.score {
            score.sample(simulation);
        }
        if self.goals.reports().len() + 1 == self.goals.goal_count()
            && let Some(clock) = &mut self.arrival
        {
            clock.sample(simulation);
        }
        self.goals.spin_once(simulation.time_ns(), || self.navigation.obstacle());
        let is_done = self.goals.is_done() && !self.is_attached;
        if is_done || self.is_over() { Tick::End } else { Tick::Go }
    }

    fn after_step(&mut self, _progress: RunProgress) {}
}

fn pose(word: &str) -> Result<Pose2, String> {
    match finite_numbers(word).as_deref() {
        Some(&[x_m, y_m]) => Ok(Pose2::new(x_m, y_m, 0.0)),
        Some(&[x_m, y_m, yaw_rad]) => Ok(Pose2::new(x_m, y_m, yaw_rad)),
        _ => Err(format!("`{word}` is not a pose; write X,Y or X,Y,YAW")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_poses() {
        assert_eq!(pose("1,2"), Ok(Pose2::new(1.0, 2.0, 0.0)));
        assert_eq!(pose("-1, 2.5,1.57"), Ok(Pose2::new(-1.0, 2.5, 1.57)));
        assert!(pose("1").is_err() && pose("1,x").is_err() && pose("inf,0").is_err());
    }
}
