//! Goals of the planner server.

use periplus_costmap::Nav2Release;
use periplus_geometry::Pose2;
use periplus_graph::{Io, Level, Node, Qos};
use periplus_msgs::Nav2Action;
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::{
    ComputePathThroughPoses, ComputePathThroughPosesGoal, ComputePathThroughPosesResult,
    ComputePathToPose, ComputePathToPoseGoal, ComputePathToPoseResult,
};
use periplus_msgs::std_msgs::Header;
use periplus_planners::{PlanError, PlanErrorKind, PlanRequest, PlannedPath};
use periplus_tf_ros::pose;

use super::failure::LegFailure;
use super::node::PlannerServer;
use crate::costmap_2d::{CostmapNode, blame};
use crate::simple_action_server::SimpleActionServer;

/// Interval at which a goal looks if the costmap is current \[ns\] (`rclcpp::Rate r(100)`).
const COSTMAP_POLL_NS: i64 = 10_000_000;

/// Action that plans a path.
pub(super) trait PathAction: Nav2Action {
    /// Name of the action.
    const NAME: &'static str;
    /// Server of the action.
    fn server(state: &mut PlannerServer) -> &mut SimpleActionServer<Self>;
    /// Planner that a goal asks for.
    fn planner_id(goal: &Self::Goal) -> &str;
    /// Start that a goal gives; none for the pose of the robot.
    fn start(goal: &Self::Goal) -> Option<&PoseStamped>;
    /// Poses to reach.
    fn poses(goal: &Self::Goal) -> &[PoseStamped];
    /// Result of a plan, or of a failure.
    fn result(outcome: PathOutcome) -> Self::Result;
}

/// Outcome of a goal.
#[derive(Default)]
pub(super) struct PathOutcome {
    path: Path,
    planning_time: Duration,
    /// Number of poses that the path reaches.
    reached: usize,
    /// Number of poses of the goal.
    wanted: usize,
    /// Failure with its text.
    failure: Option<(PlanErrorKind, String)>,
}

impl PathAction for ComputePathToPose {
    const NAME: &'static str = "compute_path_to_pose";

    fn server(state: &mut PlannerServer) -> &mut SimpleActionServer<Self> {
        &mut state.to_pose
    }

    fn planner_id(goal: &ComputePathToPoseGoal) -> &str {
        &goal.planner_id
    }

    fn start(goal: &ComputePathToPoseGoal) -> Option<&PoseStamped> {
        goal.use_start.then_some(&goal.start)
    }

    fn poses(goal: &ComputePathToPoseGoal) -> &[PoseStamped] {
        std::slice::from_ref(&goal.goal)
    }

    fn result(outcome: PathOutcome) -> ComputePathToPoseResult {
        let PathOutcome { path, planning_time, failure, .. } = outcome;
        let (error_code, error_msg) = match failure {
            Some((kind, text)) => (kind.code_to_pose().unwrap_or_default(), text),
            None => (ComputePathToPoseResult::NONE, String::new()),
        };
        ComputePathToPoseResult { path, planning_time, error_code, error_msg }
    }
}

impl PathAction for ComputePathThroughPoses {
    const NAME: &'static str = "compute_path_through_poses";

    fn server(state: &mut PlannerServer) -> &mut SimpleActionServer<Self> {
        &mut state.through_poses
    }

    fn planner_id(goal: &ComputePathThroughPosesGoal) -> &str {
        &goal.planner_id
    }

    fn start(goal: &ComputePathThroughPosesGoal) -> Option<&PoseStamped> {
        goal.use_start.then_some(&goal.start)
    }

    fn poses(goal: &ComputePathThroughPosesGoal) -> &[PoseStamped] {
        &goal.goals.goals
    }

    fn result(outcome: PathOutcome) -> ComputePathThroughPosesResult {
        let PathOutcome { path, planning_time, reached, wanted, failure } = outcome;
        let has_path = !path.poses.is_empty();
        let (error_code, error_msg) = match failure {
            // A partial path is a success with the reason why it ends.
            Some((_, text)) if has_path => (ComputePathThroughPosesResult::NONE, text),
            Some((kind, text)) => (kind.code_through_poses().unwrap_or_default(), text),
            None => (ComputePathThroughPosesResult::NONE, String::new()),
        };
        let last_reached_index = if reached == 0 || reached == wanted {
            ComputePathThroughPosesResult::ALL_GOALS
        } else {
            i16::try_from(reached - 1).unwrap_or(i16::MAX)
        };
        ComputePathThroughPosesResult {
            path,
            last_reached_index,
            planning_time,
            error_code,
            error_msg,
        }
    }
}

/// State of the costmap, as a goal needs it.
enum CostmapState {
    Current,
    Late,
    TimedOut(String),
}

impl PlannerServer {
    /// Begins the work on a goal.
    pub(super) fn start<A: PathAction>(&mut self, io: &mut Io<'_, Self>) {
        io.node().log(Level::Info, format!("Computing a path ({}).", A::NAME));
        let start_ns = io.now_ns();
        self.work::<A>(start_ns, io);
    }

    /// Works on the current goal, and on those that follow it, until one has to wait.
    fn work<A: PathAction>(&mut self, mut start_ns: i64, io: &mut Io<'_, Self>) {
        loop {
            self.waiting.remove(A::NAME);
            if A::server(self).is_cancel_requested() {
                io.node().log(Level::Info, "Goal was canceled. Canceling planning action.");
                A::server(self).terminate_all(A::Result::default());
            } else {
                match self.costmap_state(start_ns, io.now_ns()) {
                    CostmapState::Late => {
                        let again = move |state: &mut Self, io: &mut Io<'_, Self>| {
                            state.work::<A>(start_ns, io);
                        };
                        let alarm = io.alarm(io.now_ns() + COSTMAP_POLL_NS, again);
                        self.waiting.insert(A::NAME, alarm);
                        return;
                    }
                    CostmapState::TimedOut(why) => {
                        let text = format!("Costmap timed out waiting for update: {why}");
                        let error = PlanError::new(PlanErrorKind::Timeout, text);
                        let failure: Box<LegFailure> = error.into();
                        self.fail::<A>(&failure, io);
                    }
                    CostmapState::Current => self.plan::<A>(start_ns, io),
                }
            }
            if !A::server(self).finish() {
                return;
            }
            start_ns = io.now_ns();
        }
    }

    /// Returns the state of the costmap for a goal that has waited since `start_ns`. A costmap without the pose of
    /// the robot counts as current after the same time, so that the goal fails with that reason.
    fn costmap_state(&self, start_ns: i64, now_ns: i64) -> CostmapState {
        let (delay, has_robot) = self
            .costmap
            .with(|costmap| (costmap.delay(now_ns), costmap.robot_pose(now_ns).is_ok()));
        let timeout_s = self.params.costmap_update_timeout_s;
        let waited_s = (now_ns - start_ns) as f64 / 1e9;
        let waits = self.release > Nav2Release::Humble && waited_s <= timeout_s && timeout_s > 0.0;
        match delay {
            // The first transform of a localization is a moment younger than the odometry.
            _ if !has_robot => {
                if waits {
                    CostmapState::Late
                } else {
                    CostmapState::Current
                }
            }
            None => CostmapState::Current,
            // Main does not wait at all then.
            Some(_) if timeout_s <= 0.0 && self.release == Nav2Release::Main => {
                CostmapState::Current
            }
            Some(why) if self.release > Nav2Release::Humble && waited_s > timeout_s => {
                CostmapState::TimedOut(why)
            }
            Some(_) => CostmapState::Late,
        }
    }

    fn plan<A: PathAction>(&mut self, start_ns: i64, io: &mut Io<'_, Self>) {
        if A::server(self).is_preempt_requested() {
            A::server(self).accept_pending_goal();
        }
        let Some(goal) = A::server(self).current_goal() else { return };
        let mut outcome = PathOutcome { wanted: A::poses(&goal).len(), ..Default::default() };
        let failure = self.make_path::<A>(&goal, &mut outcome, io).err();
        let is_partial = outcome.reached > 0 && self.params.allow_partial_planning;
        if let Some(failure) = failure {
            if failure.error.kind == PlanErrorKind::Cancelled {
                A::server(self).terminate_all(A::Result::default());
                return;
            }
            if !is_partial {
                return self.fail::<A>(&failure, io);
            }
            let text = failure.text(self.planner_name(A::planner_id(&goal)));
            io.node().log(Level::Warn, &text);
            let text =
                "Planner server failed to compute full path. Outputting partial path instead.";
            io.node().log(Level::Warn, text);
            outcome.failure = Some((failure.error.kind, text.to_owned()));
        }
        if let Some(plan) = &self.plan {
            plan.publish(outcome.path.clone());
        }
        let elapsed_ns = io.now_ns() - start_ns;
        outcome.planning_time = Duration::of_ns(elapsed_ns);
        self.warn_if_slow(elapsed_ns, io);
        A::server(self).succeeded_current(A::result(outcome));
    }

    fn warn_if_slow(&self, elapsed_ns: i64, io: &mut Io<'_, Self>) {
        let hertz = self.params.expected_planner_frequency_hz;
        if hertz > 0.0 && elapsed_ns as f64 > 1e9 / hertz {
            let text = format!(
                "Planner loop missed its desired rate of {hertz:.4} Hz. Current loop rate is {:.4} Hz",
                1e9 / elapsed_ns as f64
            );
            io.node().log(Level::Warn, text);
        }
    }

    /// Plans all legs of a goal, and adds them to the outcome.
    fn make_path<A: PathAction>(
        &mut self,
        goal: &A::Goal,
        outcome: &mut PathOutcome,
        io: &mut Io<'_, Self>,
    ) -> Result<(), Box<LegFailure>> {
        let now_ns = io.now_ns();
        if A::poses(goal).is_empty() {
            return Err(PlanError::new(PlanErrorKind::NoViapoints, "No viapoints given").into());
        }
        let planner = self
            .find_planner(A::planner_id(goal))
            .map_err(|text| PlanError::new(PlanErrorKind::InvalidPlanner, text))?;
        let mut start = self.start_pose(A::start(goal), now_ns)?;
        outcome.path.header =
            self.costmap.with(|costmap| Header::at(now_ns, &costmap.params().global_frame));
        for wanted in A::poses(goal) {
            let transformed = self.costmap.with(|costmap| costmap.global_pose(wanted));
            let leg_goal = transformed.map_err(|why| {
                let text = format!("Unable to transform poses to global frame: {why}");
                PlanError::new(PlanErrorKind::Transform, text)
            })?;
            let plan = self.make_leg(planner, start, leg_goal, io)?;
            start = plan.poses.last().copied().unwrap_or(start);
            // The first pose of a leg is the last one of the leg before; Humble has it twice.
            let is_doubled = outcome.reached > 0 && self.release > Nav2Release::Humble;
            let poses = plan.poses.iter().skip(usize::from(is_doubled));
            let header = outcome.path.header.clone();
            self.show_unsmoothed(&header, &plan.unsmoothed, io.node());
            let stamped = |it: &Pose2| PoseStamped { header: header.clone(), pose: pose(*it) };
            outcome.path.poses.extend(poses.map(stamped));
            outcome.reached += 1;
        }
        Ok(())
    }

    fn start_pose(
        &self,
        given: Option<&PoseStamped>,
        now_ns: i64,
    ) -> Result<Pose2, Box<LegFailure>> {
        self.costmap.with(|costmap| match given {
            Some(given) => costmap.global_pose(given).map_err(|why| {
                let text = format!("Unable to transform poses to global frame: {why}");
                PlanError::new(PlanErrorKind::Transform, text).into()
            }),
            None => costmap.robot_pose(now_ns).map_err(|finding| {
                let help: String = finding.help.iter().map(|help| format!("; {help}")).collect();
                let text = format!("Unable to get start pose: {}{help}", finding.message);
                PlanError::new(PlanErrorKind::Transform, text).into()
            }),
        })
    }

    /// Publishes the path before smoothing, for planners that smooth.
    fn show_unsmoothed(&mut self, header: &Header, poses: &[Pose2], node: &Node) {
        if poses.is_empty() {
            return;
        }
        if self.unsmoothed.is_none() {
            match node.publisher("unsmoothed_plan", Qos::reliable(1)) {
                Ok(publisher) => self.unsmoothed = Some(publisher),
                Err(error) => node.log(Level::Error, error),
            }
        }
        if let Some(publisher) = self.unsmoothed.as_ref().filter(|publisher| publisher.is_heard()) {
            let stamped = |it: &Pose2| PoseStamped { header: header.clone(), pose: pose(*it) };
            let poses = poses.iter().map(stamped).collect();
            publisher.publish(Path { header: header.clone(), poses });
        }
    }

    /// Plans one leg.
    fn make_leg(
        &mut self,
        planner: usize,
        start: Pose2,
        goal: Pose2,
        io: &mut Io<'_, Self>,
    ) -> Result<PlannedPath, Box<LegFailure>> {
        let slot = &mut self.planners[planner];
        let id = slot.id.clone();
        let Some(planner) = &mut slot.planner else {
            let error = PlanError::new(PlanErrorKind::Unknown, "the server is not configured");
            return Err(error.into());
        };
        let (node, start_ns) = (io.node(), io.now_ns());
        let max_s = planner.max_planning_time_s();
        let planned = self.costmap.with(|costmap: &mut CostmapNode| {
            let Some(view) = costmap.view() else {
                let error = PlanError::new(PlanErrorKind::Unknown, "the costmap is not configured");
                return Err(error.into());
            };
            let planned = planner.plan(PlanRequest {
                costmap: view,
                start,
                goal,
                is_cancelled: &mut || false,
                is_out_of_time: &mut || {
                    let elapsed_s = (node.now_ns() - start_ns) as f64 / 1e9;
                    max_s.is_some_and(|max_s| elapsed_s > max_s)
                },
            });
            let plan = planned.map_err(|error| {
                let blame = error
                    .obstruction
                    .blocking
                    .and_then(|blocking| blame(costmap.costmap.as_ref()?, blocking.cell));
                Box::new(LegFailure { error, leg: Some((start, goal)), blame })
            })?;
            if let (Some(cell), Some(layered)) = (plan.cleared_cell, &mut costmap.costmap) {
                layered.costmap_mut().set(cell, periplus_costmap::cost::FREE);
            }
            Ok::<PlannedPath, Box<LegFailure>>(plan)
        })?;
        if planned.poses.is_empty() {
            let text = format!("{id} generated a empty path");
            let error = PlanError::new(PlanErrorKind::NoValidPath, text);
            return Err(Box::new(LegFailure { error, leg: Some((start, goal)), blame: None }));
        }
        Ok(planned)
    }

    /// Ends the current goal with an error.
    fn fail<A: PathAction>(&mut self, failure: &LegFailure, io: &mut Io<'_, Self>) {
        let goal = A::server(self).current_goal();
        let id = goal.as_ref().map(|goal| A::planner_id(goal)).unwrap_or_default();
        let text = failure.text(self.planner_name(id));
        io.node().log(Level::Warn, &text);
        let failure = Some((failure.error.kind, text));
        let result = A::result(PathOutcome { failure, ..Default::default() });
        A::server(self).terminate_current(result);
    }
}
