//! Drives of several robots at once.

use std::io::{self, Write};

use periplus_geometry::Pose2;
use periplus_graph::GraphError;
use periplus_grid::OccupancyGrid;
use periplus_session::nodes::{
    Estimators, GoalDriver, GoalOutcome, GoalReport, RobotPose, RobotProfile, pose_text,
};
use periplus_session::{ProgressLine, SessionTask, SimulationSession};
use periplus_sim::{FleetMember, FleetScore, Simulation, Tick};
use serde_json::{Value, json};

use super::random_goals::GoalAreas;
use super::{NavigateOptions, UNKNOWN_RADIUS_M, report};
use crate::error::CliError;

/// Time between two comparisons of a robot's pose with its estimate \[ns\].
const COMPARISON_PERIOD_NS: i64 = 1_000_000_000;

/// Navigation of several robots, each to its own goals.
pub(super) struct FleetTask {
    robots: Vec<RobotTask>,
    score: FleetScore,
    next_comparison_ns: i64,
    /// True if a fleet adapter may send more paths.
    is_attached: bool,
}

/// Navigation of a robot.
struct RobotTask {
    name: String,
    start: Pose2,
    estimators: Estimators,
    goals: GoalDriver,
    given: Vec<Pose2>,
    pose: RobotPose,
    map_frame: String,
    error: EstimateError,
}

/// Distances of estimates from the truth.
#[derive(Default)]
struct EstimateError {
    count: usize,
    sum_m: f64,
    max_m: f64,
}

impl EstimateError {
    fn add(&mut self, distance_m: f64) {
        self.count += 1;
        self.sum_m += distance_m;
        self.max_m = self.max_m.max(distance_m);
    }

    fn mean_m(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum_m / self.count as f64)
    }
}

impl FleetTask {
    /// Draws the goals of each robot on the map, and connects to its navigator.
    pub(super) fn new(
        session: &mut SimulationSession,
        options: &NavigateOptions,
        map: OccupancyGrid,
    ) -> Result<Self, CliError> {
        let estimators = session.take_estimators();
        let radius_m = session.simulation().robot_radius_m().unwrap_or(UNKNOWN_RADIUS_M);
        let count = options.random_goals.unwrap_or_default();
        let mut areas = GoalAreas::new(&map, radius_m);
        let profiles = session.profiles().iter().zip(estimators).zip(session.simulation().robots());
        let robots = profiles.enumerate().map(|(index, ((profile, estimators), robot))| {
            let start = Pose2::from(robot.world_from_robot);
            // Each robot has its own goals.
            let seed = options.seed.wrapping_add((index as u64) << 32);
            let given = areas.draw(start, count, seed);
            if given.len() < count {
                return Err(CliError::failed(format!(
                    "`{}` has no room of {radius_m:.2} m around its start {}: the map must have the frame of the world",
                    robot.name,
                    pose_text(start)
                )));
            }
            RobotTask::new(session, profile, estimators, robot.name, start, given)
                .map_err(CliError::failed)
        });
        let robots = robots.collect::<Result<Vec<_>, _>>()?;
        let score = FleetScore::new(session.simulation(), Some(map));
        let is_attached = options.open_rmf.is_some();
        Ok(Self { robots, score, next_comparison_ns: 0, is_attached })
    }

    /// Ends the run: goals that are not reached yet are unfinished.
    pub(super) fn finish(&mut self, now_ns: i64) {
        self.robots.iter_mut().for_each(|robot| robot.goals.finish(now_ns));
    }

    /// True if all robots have reached all goals.
    pub(super) fn is_done(&self) -> bool {
        self.robots.iter().all(|robot| robot.reached() == robot.given.len())
    }

    /// Compares the estimates of all robots with the truth.
    fn compare(&mut self) {
        for (robot, member) in self.robots.iter_mut().zip(&self.score.robots) {
            let estimate = robot.pose.newest_in(&robot.map_frame);
            if let (Some(estimate), Some(truth)) = (estimate, member.pose) {
                robot.error.add(libm::hypot(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m));
            }
        }
    }

    /// The report as JSON.
    pub(super) fn to_json(&self, session: &SimulationSession) -> Value {
        let robot = |(robot, member): (&RobotTask, &FleetMember)| {
            let goals: Vec<Value> = robot
                .goals
                .reports()
                .iter()
                .zip(&robot.given)
                .map(|(report, goal)| report::goal_to_json(report, *goal))
                .collect();
            json!({
                "name": robot.name,
                "start": [robot.start.x_m, robot.start.y_m, robot.start.yaw_rad],
                "goals": goals,
                "length_m": member.length_m,
                "wall_contacts": member.wall_contacts,
                "robot_contacts": member.robot_contacts,
                "localization_error_mean_m": robot.error.mean_m(),
                "localization_error_max_m": robot.error.mean_m().map(|_| robot.error.max_m),
            })
        };
        let robots: Vec<Value> = self.robots.iter().zip(&self.score.robots).map(robot).collect();
        json!({ "robots": robots, "run": session.report().to_json() })
    }

    /// Prints the report.
    ///
    /// # Errors
    /// A failed write.
    pub(super) fn print(&self, session: &SimulationSession, out: &mut dyn Write) -> io::Result<()> {
        session.report().write_text(out)?;
        for (robot, member) in self.robots.iter().zip(&self.score.robots) {
            let error = robot.error.mean_m().map_or("no estimate".to_owned(), |mean_m| {
                format!("localized to {mean_m:.3} m (at most {:.3} m)", robot.error.max_m)
            });
            writeln!(
                out,
                "  {}: {} of {} goals, drove {:.1} m, {error}, touched {} walls and {} robots",
                robot.name,
                robot.reached(),
                robot.given.len(),
                member.length_m,
                member.wall_contacts,
                member.robot_contacts,
            )?;
        }
        let reached: usize = self.robots.iter().map(RobotTask::reached).sum();
        let given: usize = self.robots.iter().map(|robot| robot.given.len()).sum();
        let driven_m: f64 = self.score.robots.iter().map(|robot| robot.length_m).sum();
        writeln!(
            out,
            "  {} robots: {reached} of {given} goals reached, {driven_m:.0} m driven",
            self.robots.len()
        )
    }
}

impl RobotTask {
    fn new(
        session: &SimulationSession,
        profile: &RobotProfile,
        estimators: Estimators,
        name: String,
        start: Pose2,
        given: Vec<Pose2>,
    ) -> Result<Self, GraphError> {
        let (graph, map_frame) = (session.graph(), estimators.navigation.global_frame());
        let goals = GoalDriver::within(graph, &profile.namespace, &map_frame, given.clone())?;
        let pose = RobotPose::new(goals.node(), profile.base())?;
        let error = EstimateError::default();
        Ok(Self { name, start, estimators, goals, given, pose, map_frame, error })
    }

    fn reached(&self) -> usize {
        let is_reached = |report: &&GoalReport| report.outcome == GoalOutcome::Reached;
        self.goals.reports().iter().filter(is_reached).count()
    }
}

impl SessionTask for FleetTask {
    fn before_step(&mut self, simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        self.score.sample(simulation);
        let now_ns = simulation.time_ns();
        if now_ns >= self.next_comparison_ns {
            self.next_comparison_ns = now_ns + COMPARISON_PERIOD_NS;
            self.compare();
        }
        for robot in &mut self.robots {
            let navigation = &robot.estimators.navigation;
            robot.goals.spin_once(now_ns, || navigation.obstacle());
        }
        let is_done = self.robots.iter().all(|robot| robot.goals.is_done());
        if is_done && !self.is_attached { Tick::End } else { Tick::Go }
    }
}
