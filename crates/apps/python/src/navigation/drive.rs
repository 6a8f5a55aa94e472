//! A drive to a goal, step by step.

use periplus::geometry::Pose2;
use periplus::graph::{GoalProgress, GoalState, SentGoal};
use periplus::msgs::geometry_msgs::PoseStamped;
use periplus::msgs::nav2_msgs::{NavigateToPose, NavigateToPoseGoal, NavigateToPoseResult};
use pyo3::prelude::*;

use super::{NavigationState, PyNavigation};
use crate::errors::runtime_error;
use crate::simulation::{DriveTask, Running};
use crate::work::lock;

/// Time after which a goal that the navigator is not ready for, or rejects, is given up \[ns\]: the map or a transform
/// may not exist yet.
const PATIENCE_NS: i64 = 20_000_000_000;

/// Time between two attempts to send a goal \[ns\].
const RETRY_NS: i64 = 500_000_000;

/// Time that a canceled goal has to end \[ns\].
const CANCEL_NS: i64 = 5_000_000_000;

/// Outcome of a goal.
///
/// >>> from periplus import Simulation, World
/// >>> from periplus.navigation import Navigation
/// >>> navigation = Navigation(Simulation(World.demo(), physics="kinematic"), slam=False)
/// >>> outcome = navigation.go_to((0.5, 0.0, 0.0))
/// >>> outcome.reached, outcome.outcome
/// (True, 'reached')
#[pyclass(name = "GoalOutcome", module = "periplus.navigation", frozen, get_all)]
pub(crate) struct PyGoalOutcome {
    /// One of "reached", "aborted", "canceled", "rejected", "not ready" and "timeout".
    outcome: String,
    /// Error code of the result; 0 for none.
    error_code: u16,
    /// Reason of a failure; with file and line if it is an exception of a plugin.
    message: String,
    /// Simulated time from sending the goal to its end [s].
    time_s: f64,
    /// Number of recoveries of the behavior tree.
    recoveries: i64,
}

#[pymethods]
impl PyGoalOutcome {
    /// True if the navigator reports success.
    #[getter]
    fn reached(&self) -> bool {
        self.outcome == "reached"
    }

    fn __repr__(&self) -> String {
        let Self { outcome, error_code, message, time_s, .. } = self;
        format!("GoalOutcome({outcome:?}, {time_s:.3} s, error_code={error_code}, {message:?})")
    }
}

/// State of a goal.
enum DriveProgress {
    /// To be sent at this time \[ns\], with the reason why it was not before.
    Due(i64, &'static str, String),
    Sent(SentGoal<NavigateToPose>),
    /// Canceled because its time is over, at this time \[ns\].
    Canceled(SentGoal<NavigateToPose>, i64),
}

/// A drive to a goal.
struct Drive {
    goal: Pose2,
    behavior_tree: String,
    start_ns: i64,
    sent_ns: Option<i64>,
    timeout_ns: i64,
    recoveries: i64,
    progress: DriveProgress,
}

impl Drive {
    fn outcome(&self, now_ns: i64, outcome: &str, code: u16, message: String) -> PyGoalOutcome {
        let since_ns = self.sent_ns.unwrap_or(self.start_ns);
        PyGoalOutcome {
            outcome: outcome.to_owned(),
            error_code: code,
            message,
            time_s: (now_ns - since_ns) as f64 * 1e-9,
            recoveries: self.recoveries,
        }
    }

    /// Outcome of a goal that has a result.
    fn ended(&self, now_ns: i64, state: GoalState, result: &NavigateToPoseResult) -> PyGoalOutcome {
        let outcome = match state {
            GoalState::Succeeded => "reached",
            GoalState::Canceled => "canceled",
            _ => "aborted",
        };
        self.outcome(now_ns, outcome, result.error_code, result.error_msg.to_string())
    }

    /// Works on the goal at the present time. Returns the outcome once it has ended.
    fn update(&mut self, state: &NavigationState, now_ns: i64) -> Option<PyGoalOutcome> {
        for (_, feedback) in state.client.feedback() {
            self.recoveries = i64::from(feedback.number_of_recoveries);
        }
        let is_late = now_ns - self.start_ns >= self.timeout_ns;
        match &self.progress {
            DriveProgress::Due(due_ns, outcome, reason) => {
                if is_late || now_ns - self.start_ns >= PATIENCE_NS && !reason.is_empty() {
                    return Some(self.outcome(now_ns, outcome, 0, reason.clone()));
                }
                if now_ns >= *due_ns {
                    self.send(state, now_ns);
                }
                None
            }
            DriveProgress::Sent(sent) => match sent.look() {
                GoalProgress::Rejected => {
                    let reason = "the navigator rejects the goal".to_owned();
                    self.progress = DriveProgress::Due(now_ns + RETRY_NS, "rejected", reason);
                    None
                }
                GoalProgress::Over(end, result) => Some(self.ended(now_ns, end, &result)),
                GoalProgress::Failed(error) => {
                    Some(self.outcome(now_ns, "aborted", 0, error.to_string()))
                }
                _ if is_late => {
                    self.cancel(state, now_ns);
                    None
                }
                _ => None,
            },
            DriveProgress::Canceled(sent, since_ns) => {
                let has_ended = matches!(sent.look(), GoalProgress::Over(..));
                let is_over = has_ended || now_ns - since_ns >= CANCEL_NS;
                let seconds = self.timeout_ns as f64 * 1e-9;
                let message = format!("the goal was not reached within {seconds} s");
                is_over.then(|| self.outcome(now_ns, "timeout", 0, message))
            }
        }
    }

    fn cancel(&mut self, state: &NavigationState, now_ns: i64) {
        let due = DriveProgress::Due(now_ns, "timeout", String::new());
        if let DriveProgress::Sent(sent) = std::mem::replace(&mut self.progress, due) {
            // The result follows.
            let _answer = state.client.cancel(sent.id());
            self.progress = DriveProgress::Canceled(sent, now_ns);
        }
    }

    fn send(&mut self, state: &NavigationState, now_ns: i64) {
        let no_server = || Some("there is no action `navigate_to_pose`".to_owned());
        let is_ready = state.client.is_ready();
        let obstacle = if is_ready { state.navigation.obstacle() } else { no_server() };
        if let Some(reason) = obstacle {
            self.progress = DriveProgress::Due(now_ns + RETRY_NS, "not ready", reason);
            return;
        }
        let mut pose = PoseStamped::default();
        pose.header.frame_id = state.navigation.global_frame().as_str().into();
        pose.pose = periplus::tf_ros::pose(self.goal);
        let behavior_tree = self.behavior_tree.clone();
        self.sent_ns = Some(now_ns);
        self.progress =
            DriveProgress::Sent(state.client.send(NavigateToPoseGoal { pose, behavior_tree }));
    }
}

/// A drive in a simulation.
struct NavigationTask<'a> {
    navigation: &'a PyNavigation,
    drive: Drive,
    outcome: Option<PyGoalOutcome>,
}

impl DriveTask for NavigationTask<'_> {
    fn before_step(&mut self, running: &mut Running) -> bool {
        let now_ns = running.simulation().time_ns();
        let state = lock(&self.navigation.state);
        self.outcome = self.drive.update(&state, now_ns);
        self.outcome.is_some() || self.navigation.raised.is_some()
    }
}

impl PyNavigation {
    /// Steps the simulation until a goal has ended.
    pub(super) fn drive_to(
        &self,
        py: Python<'_>,
        goal: Pose2,
        timeout_s: f64,
        behavior_tree: &str,
    ) -> PyResult<PyGoalOutcome> {
        let simulation = self.simulation.get();
        let now_ns = simulation.with(py, |running| running.simulation().time_ns())?;
        let mut task = NavigationTask {
            navigation: self,
            drive: Drive {
                goal,
                behavior_tree: behavior_tree.to_owned(),
                start_ns: now_ns,
                sent_ns: None,
                timeout_ns: (timeout_s * 1e9) as i64,
                recoveries: 0,
                progress: DriveProgress::Due(now_ns, "timeout", String::new()),
            },
            outcome: None,
        };
        let advanced = simulation.advance_task(py, &mut task);
        if let Some(error) = self.raised.take() {
            return Err(error);
        }
        advanced?;
        task.outcome.ok_or_else(|| runtime_error("the drive has ended without an outcome"))
    }
}
