//! Execution of a goal: send a pose, wait for the navigator, work on the task, go on.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostic;
use periplus_graph::{Alarm, GoalProgress, GoalState, Io, Level, Node, Pending};
use periplus_msgs::Action;
use periplus_msgs::action_msgs::CancelGoal;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geographic_msgs::{GeoPoint, GeoPose};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::WaypointStatus;
use periplus_msgs::nav2_msgs_main::{
    FollowWaypointsResult, NavigateToPose, NavigateToPoseGoal, NavigateToPoseResult,
};
use periplus_msgs::robot_localization::{FromLL, FromLLRequest};

use crate::loop_rate::LoopRate;
use crate::nav2_actions::Nav2SentGoal;
use crate::simple_action_server::SimpleActionServer;

use super::actions::{FollowAction, FollowOutcome, FollowRequest, Waypoints};
use super::node::WaypointFollowerNode;
use super::tasks::TaskOutcome;

/// Time for which the service that converts GPS poses is waited for \[ns\]; the value of Nav2.
const CONVERSION_TIMEOUT_NS: i64 = 1_000_000_000;

/// An action with its running goal.
pub(super) struct Follower<A: Action> {
    pub(super) server: SimpleActionServer<A>,
    run: Option<FollowRun>,
}

impl<A: Action> Default for Follower<A> {
    fn default() -> Self {
        Self { server: SimpleActionServer::default(), run: None }
    }
}

impl<A: Action> Follower<A> {
    /// Rejects goals from now on. Returns the goal of the navigator that has to be canceled.
    pub(super) fn deactivate(&mut self) -> Option<Nav2SentGoal<NavigateToPose>> {
        self.server.deactivate();
        match self.run.take()?.stage {
            FollowStage::Navigating(sent) => Some(sent),
            _ => None,
        }
    }
}

/// Running goal.
struct FollowRun {
    poses: Vec<PoseStamped>,
    index: usize,
    loops_left: u32,
    missed: Vec<WaypointStatus>,
    stage: FollowStage,
    cancellation: Option<Pending<CancelGoal>>,
    rate: LoopRate,
    alarm: Option<Alarm>,
}

/// Work on the present pose.
enum FollowStage {
    /// GPS poses are converted one by one.
    Converting(GpsConversion),
    /// The pose has to be sent.
    Sending,
    /// The navigator drives.
    Navigating(Nav2SentGoal<NavigateToPose>),
    /// The task runs.
    Task,
}

/// Conversion of GPS poses.
struct GpsConversion {
    waypoints: Vec<GeoPose>,
    next: usize,
    pending: Option<Pending<FromLL>>,
    since_ns: i64,
}

/// End of a goal.
enum FollowEnd {
    Succeeded,
    Canceled,
    Failed(u16, String),
}

impl FollowRun {
    fn new(request: FollowRequest, rate: LoopRate, now_ns: i64) -> Self {
        let mut run = Self {
            poses: Vec::new(),
            index: 0,
            loops_left: 0,
            missed: Vec::new(),
            stage: FollowStage::Sending,
            cancellation: None,
            rate,
            alarm: None,
        };
        let first = request.first;
        run.restart(request, now_ns);
        run.index = first;
        run
    }

    /// Starts other waypoints, at the first of them.
    fn restart(&mut self, request: FollowRequest, now_ns: i64) {
        (self.index, self.loops_left) = (0, request.loops);
        self.missed.clear();
        (self.poses, self.stage) = match request.waypoints {
            Waypoints::Poses(poses) => (poses, FollowStage::Sending),
            Waypoints::Gps(waypoints) => {
                let (next, pending, since_ns) = (0, None, now_ns);
                let conversion = GpsConversion { waypoints, next, pending, since_ns };
                (Vec::new(), FollowStage::Converting(conversion))
            }
        };
    }

    /// Notes that the present pose was missed.
    fn miss(&mut self, error_code: u16, error_msg: String) {
        let Some(pose) = self.poses.get(self.index) else { return };
        self.missed.push(WaypointStatus {
            waypoint_status: WaypointStatus::FAILED,
            waypoint_index: u32::try_from(self.index).unwrap_or(u32::MAX),
            waypoint_pose: pose.clone(),
            error_code,
            error_msg,
        });
    }

    /// Goes on to the next pose; ends the goal after the last.
    fn advance(&mut self) -> Option<FollowEnd> {
        self.index += 1;
        self.stage = FollowStage::Sending;
        if self.index < self.poses.len() {
            return None;
        }
        self.index = 0;
        if self.loops_left == 0 {
            return Some(FollowEnd::Succeeded);
        }
        self.loops_left -= 1;
        None
    }
}

/// Starts the current goal of an action.
pub(super) fn begin<A: FollowAction>(
    state: &mut WaypointFollowerNode,
    io: &Io<'_, WaypointFollowerNode>,
) {
    let now_ns = io.now_ns();
    let rate = LoopRate::of_hertz(state.params.loop_rate_hz as f64, now_ns);
    let follower = A::follower(state);
    let Some(goal) = follower.server.current_goal() else {
        if follower.server.finish() {
            begin::<A>(state, io);
        }
        return;
    };
    let request = A::request(&goal);
    let count = request.waypoints.len();
    io.node().log(Level::Info, format_args!("received a goal with {count} waypoints"));
    follower.run = Some(FollowRun::new(request, rate, now_ns));
    cycle::<A>(state, io);
}

/// Works on a goal, and schedules the next cycle or ends the goal.
fn cycle<A: FollowAction>(state: &mut WaypointFollowerNode, io: &Io<'_, WaypointFollowerNode>) {
    let Some(mut run) = A::follower(state).run.take() else { return };
    run.alarm = None;
    let end = step::<A>(state, &mut run, io.now_ns(), io.node());
    let Some(end) = end else {
        let next_ns = run.rate.next(io.now_ns());
        run.alarm = Some(io.alarm(next_ns, |state, io| cycle::<A>(state, io)));
        A::follower(state).run = Some(run);
        return;
    };
    let missed = std::mem::take(&mut run.missed);
    let release = state.params.node.compat;
    let server = &mut A::follower(state).server;
    match end {
        FollowEnd::Succeeded => {
            let text = format!("completed the waypoints; {} were missed", missed.len());
            io.node().log(Level::Info, text);
            server.succeeded_current(A::result(FollowOutcome { missed, ..Default::default() }));
        }
        FollowEnd::Canceled => server.terminate_all(A::result(FollowOutcome::default())),
        FollowEnd::Failed(code, text) => {
            io.node().log(Level::Warn, &text);
            // Releases before main have no codes for these.
            let is_new = code >= FollowWaypointsResult::NO_VALID_WAYPOINTS;
            let code = if is_new && release != Nav2Release::Main { 0 } else { code };
            server.terminate_current(A::result(FollowOutcome { missed, code, text }));
        }
    }
    if A::follower(state).server.finish() {
        begin::<A>(state, io);
    }
}

fn step<A: FollowAction>(
    state: &mut WaypointFollowerNode,
    run: &mut FollowRun,
    now_ns: i64,
    node: &Node,
) -> Option<FollowEnd> {
    if A::follower(state).server.is_cancel_requested() {
        return cancel(state, run);
    }
    if A::follower(state).server.is_preempt_requested()
        && let Some(goal) = A::follower(state).server.accept_pending_goal()
    {
        node.log(Level::Info, "a new goal replaces the waypoints");
        run.restart(A::request(&goal), now_ns);
    }
    if let FollowStage::Converting(conversion) = &mut run.stage {
        let end = convert(state, conversion, &mut run.poses, now_ns, node);
        let is_done = conversion.next >= conversion.waypoints.len();
        if end.is_some() || !is_done {
            return end;
        }
        run.stage = FollowStage::Sending;
        // Poses that could not be converted are left out.
        if run.index >= run.poses.len() {
            run.index = 0;
        }
    }
    if matches!(run.stage, FollowStage::Sending) {
        send(state, run, now_ns, node);
    }
    A::follower(state).server.publish_feedback(A::feedback(run.index));
    if let FollowStage::Navigating(sent) = &run.stage {
        let Err((code, text)) = outcome(&sent.look())? else {
            state.task.start(now_ns);
            run.stage = FollowStage::Task;
            return work(state, run, now_ns, node);
        };
        run.miss(code, text.clone());
        let index = run.index;
        if state.params.stop_on_failure {
            let code = FollowWaypointsResult::STOP_ON_MISSED_WAYPOINT;
            let text =
                format!("waypoint {index} was missed ({text}), and `stop_on_failure` is set");
            return Some(FollowEnd::Failed(code, text));
        }
        node.log(Level::Info, format_args!("waypoint {index} was missed: {text}"));
        return run.advance();
    }
    if matches!(run.stage, FollowStage::Task) {
        return work(state, run, now_ns, node);
    }
    None
}

/// Cancels the goal of the navigator; the goal ends once the navigator has answered.
fn cancel(state: &WaypointFollowerNode, run: &mut FollowRun) -> Option<FollowEnd> {
    let FollowStage::Navigating(sent) = &run.stage else { return Some(FollowEnd::Canceled) };
    let Some(client) = state.navigator.as_ref().filter(|client| client.is_ready()) else {
        return Some(FollowEnd::Canceled);
    };
    match sent.look() {
        GoalProgress::Accepted => {}
        // The navigator knows only a goal that it has answered.
        GoalProgress::Sent => return None,
        _ => return Some(FollowEnd::Canceled),
    }
    let pending = run.cancellation.get_or_insert_with(|| client.cancel(sent.id()));
    pending.take().map(|_| FollowEnd::Canceled)
}

/// Sends the present pose once the navigator is there.
fn send(state: &mut WaypointFollowerNode, run: &mut FollowRun, now_ns: i64, node: &Node) {
    let (Some(client), Some(pose)) = (&state.navigator, run.poses.get_mut(run.index)) else {
        return;
    };
    if !client.is_ready() {
        let text = "waiting for the action server `navigate_to_pose`";
        let finding = Diagnostic::warning("no-navigator", text);
        return state.log.report(&finding.help("start and activate `bt_navigator`"), node);
    }
    pose.header.stamp = Time::of_ns(now_ns);
    let goal = NavigateToPoseGoal { pose: pose.clone(), ..NavigateToPoseGoal::default() };
    run.stage = FollowStage::Navigating(client.send(goal));
}

/// Result of a goal of the navigator: reached, or missed with code and reason; none while it drives.
fn outcome(progress: &GoalProgress<NavigateToPoseResult>) -> Option<Result<(), (u16, String)>> {
    let unknown = FollowWaypointsResult::UNKNOWN;
    match progress {
        GoalProgress::Sent | GoalProgress::Accepted => None,
        GoalProgress::Rejected => {
            Some(Err((unknown, "`navigate_to_pose` rejected the goal".to_owned())))
        }
        GoalProgress::Failed(error) => Some(Err((unknown, error.to_string()))),
        GoalProgress::Over(GoalState::Succeeded, _) => Some(Ok(())),
        GoalProgress::Over(GoalState::Canceled, _) => {
            Some(Err((0, "the navigation was canceled".to_owned())))
        }
        GoalProgress::Over(_, result) => {
            let text = match result.error_msg.as_str() {
                "" => "the navigation was aborted".to_owned(),
                text => text.to_owned(),
            };
            Some(Err((result.error_code, text)))
        }
    }
}

/// Works on the task at the present pose.
fn work(
    state: &mut WaypointFollowerNode,
    run: &mut FollowRun,
    now_ns: i64,
    node: &Node,
) -> Option<FollowEnd> {
    let sent_s = run.poses.get(run.index).map_or(0, |pose| pose.header.stamp.sec);
    match state.task.work(run.index, sent_s, now_ns) {
        TaskOutcome::Running => None,
        TaskOutcome::Done => run.advance(),
        TaskOutcome::Failed(why) => {
            let (index, code) = (run.index, FollowWaypointsResult::TASK_EXECUTOR_FAILED);
            let text = format!("the task at waypoint {index} failed: {why}");
            run.miss(code, text.clone());
            if state.params.stop_on_failure {
                return Some(FollowEnd::Failed(code, text));
            }
            node.log(Level::Warn, text);
            run.advance()
        }
    }
}

/// Converts the next GPS pose.
fn convert(
    state: &WaypointFollowerNode,
    conversion: &mut GpsConversion,
    poses: &mut Vec<PoseStamped>,
    now_ns: i64,
    node: &Node,
) -> Option<FollowEnd> {
    while let Some(waypoint) = conversion.waypoints.get(conversion.next) {
        let failure = match (&conversion.pending, &state.from_ll) {
            (Some(pending), _) => match pending.take()? {
                Ok(response) => {
                    let mut pose = PoseStamped::default();
                    pose.header.frame_id = state.params.global_frame_id.clone();
                    pose.pose.position = response.map_point.clone();
                    pose.pose.orientation = waypoint.orientation.clone();
                    poses.push(pose);
                    None
                }
                Err(error) => Some(error.to_string()),
            },
            (None, Some(client)) if client.is_ready() => {
                let GeoPoint { latitude, longitude, altitude } = waypoint.position;
                let ll_point = GeoPoint { latitude, longitude, altitude };
                conversion.pending = Some(client.call(FromLLRequest { ll_point }));
                return None;
            }
            (None, _) if now_ns - conversion.since_ns < CONVERSION_TIMEOUT_NS => return None,
            (None, _) => Some("the service `/fromLL` is not available".to_owned()),
        };
        let index = conversion.next;
        if let Some(why) = failure {
            let text = format!(
                "GPS waypoint {index} could not be converted: {why}; start `navsat_transform_node` \
                 of robot_localization"
            );
            if state.params.stop_on_failure {
                let code = FollowWaypointsResult::NO_VALID_WAYPOINTS;
                return Some(FollowEnd::Failed(code, text));
            }
            node.log(Level::Warn, text);
        }
        conversion.next += 1;
        (conversion.pending, conversion.since_ns) = (None, now_ns);
    }
    if poses.is_empty() {
        let code = FollowWaypointsResult::NO_VALID_WAYPOINTS;
        return Some(FollowEnd::Failed(code, "no GPS waypoint could be converted".to_owned()));
    }
    None
}
