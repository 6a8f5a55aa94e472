//! Client that sends goals one after the other and records their outcomes.

use std::fmt;

use periplus_geometry::Pose2;
use periplus_graph::{ActionClient, GoalProgress, GoalState, Graph, GraphError, Node, SentGoal};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::{NavigateToPose, NavigateToPoseGoal};

use crate::nodes::namespace::RobotNamespace;

/// Time that goals are sent again after a rejection \[ns\]: the map or a transform may not exist yet.
const PATIENCE_NS: i64 = 20_000_000_000;

/// Time between two attempts to send a goal \[ns\].
const RETRY_NS: i64 = 500_000_000;

/// Outcome of a goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GoalOutcome {
    /// The navigator reports success.
    Reached,
    /// The navigator gave up.
    Aborted {
        /// Error code of the result; 0 without one.
        code: u16,
        /// Message of the result; may be empty.
        message: String,
    },
    /// Another client canceled it.
    Canceled,
    /// The navigator did not accept it.
    Rejected,
    /// Not sent: navigation was not ready, for this reason.
    NotReady(String),
    /// The run ended before.
    Unfinished,
}

impl fmt::Display for GoalOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reached => f.write_str("reached"),
            Self::Aborted { code: 0, message } if message.is_empty() => f.write_str("aborted"),
            Self::Aborted { code: 0, message } => write!(f, "aborted: {message}"),
            Self::Aborted { code, message } if message.is_empty() => {
                write!(f, "aborted with error code {code}")
            }
            Self::Aborted { code, message } => {
                write!(f, "aborted with error code {code}: {message}")
            }
            Self::Canceled => f.write_str("canceled"),
            Self::Rejected => f.write_str("rejected by the navigator"),
            Self::NotReady(reason) => write!(f, "not sent, navigation is not ready: {reason}"),
            Self::Unfinished => f.write_str("not finished when the run ended"),
        }
    }
}

/// A goal and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalReport {
    /// Pose to reach, in the global frame of the navigator.
    pub goal: Pose2,
    /// Outcome.
    pub outcome: GoalOutcome,
    /// Simulated time from sending the goal to its end \[s\].
    pub time_s: f64,
    /// Number of recoveries.
    pub recoveries: i64,
}

/// State of the goal that is driven to.
enum Progress {
    /// To be sent at this time \[ns\].
    Due(i64),
    /// Sent at the time \[ns\].
    Sent(SentGoal<NavigateToPose>, i64),
    /// All goals have ended.
    Done,
}

/// Client that sends goals to the navigator, the next one when one has ended.
pub struct GoalDriver {
    client: ActionClient<NavigateToPose>,
    frame: String,
    goals: Vec<Pose2>,
    progress: Progress,
    first_attempt_ns: Option<i64>,
    recoveries: i64,
    reports: Vec<GoalReport>,
    node: Node,
}

impl GoalDriver {
    /// Creates the client; goals are poses in `frame`.
    ///
    /// # Errors
    /// When the graph refuses the node.
    pub fn new(graph: &Graph, frame: &str, goals: Vec<Pose2>) -> Result<Self, GraphError> {
        Self::within(graph, &RobotNamespace::default(), frame, goals)
    }

    /// Creates the client of a robot's navigator.
    ///
    /// # Errors
    /// When the graph refuses the node.
    pub fn within(
        graph: &Graph,
        namespace: &RobotNamespace,
        frame: &str,
        goals: Vec<Pose2>,
    ) -> Result<Self, GraphError> {
        let node = namespace.node(graph, "periplus_navigate")?;
        Ok(Self {
            client: node.action_client("navigate_to_pose")?,
            frame: frame.to_owned(),
            goals,
            progress: Progress::Due(0),
            first_attempt_ns: None,
            recoveries: 0,
            reports: Vec::new(),
            node,
        })
    }

    /// Adds a goal behind the others.
    pub fn push(&mut self, goal: Pose2) {
        self.goals.push(goal);
        if self.is_done() {
            self.progress = Progress::Due(0);
        }
    }

    /// Node of the client.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.node
    }

    /// Returns true once all goals have ended.
    #[must_use]
    pub fn is_done(&self) -> bool {
        matches!(self.progress, Progress::Done)
    }

    /// Reports of the goals that have ended.
    #[must_use]
    pub fn reports(&self) -> &[GoalReport] {
        &self.reports
    }

    /// Number of goals.
    #[must_use]
    pub fn goal_count(&self) -> usize {
        self.goals.len()
    }

    /// Works on the goals at a simulated time \[ns\]; `obstacle` returns why the navigator cannot plan yet, and is
    /// called only when a goal is due.
    pub fn spin_once(&mut self, now_ns: i64, obstacle: impl FnOnce() -> Option<String>) {
        for (_, feedback) in self.client.feedback() {
            self.recoveries = i64::from(feedback.number_of_recoveries);
        }
        let index = self.reports.len();
        let Some(goal) = self.goals.get(index).copied() else {
            self.progress = Progress::Done;
            return;
        };
        match &self.progress {
            Progress::Done => {}
            Progress::Due(due_ns) if now_ns < *due_ns => {}
            Progress::Due(_) => self.send(goal, now_ns, obstacle),
            Progress::Sent(sent, since_ns) => {
                let since_ns = *since_ns;
                match sent.look() {
                    GoalProgress::Rejected => self.wait(goal, now_ns, GoalOutcome::Rejected),
                    GoalProgress::Over(state, result) => {
                        let outcome = match state {
                            GoalState::Succeeded => GoalOutcome::Reached,
                            GoalState::Canceled => GoalOutcome::Canceled,
                            _ => GoalOutcome::Aborted {
                                code: result.error_code,
                                message: result.error_msg.to_string(),
                            },
                        };
                        self.end(goal, outcome, since_ns, now_ns);
                    }
                    GoalProgress::Failed(error) => {
                        let message = error.to_string();
                        let outcome = GoalOutcome::Aborted { code: 0, message };
                        self.end(goal, outcome, since_ns, now_ns);
                    }
                    _ => {}
                }
            }
        }
    }

    fn send(&mut self, goal: Pose2, now_ns: i64, obstacle: impl FnOnce() -> Option<String>) {
        self.first_attempt_ns.get_or_insert(now_ns);
        let no_server = || Some("there is no action `navigate_to_pose`".to_owned());
        let obstacle = if self.client.is_ready() { obstacle() } else { no_server() };
        if let Some(reason) = obstacle {
            self.wait(goal, now_ns, GoalOutcome::NotReady(reason));
            return;
        }
        let mut pose = PoseStamped::default();
        pose.header.frame_id = self.frame.as_str().into();
        pose.pose = periplus_tf_ros::pose(goal);
        let message = NavigateToPoseGoal { pose, ..NavigateToPoseGoal::default() };
        self.recoveries = 0;
        self.progress = Progress::Sent(self.client.send(message), now_ns);
    }

    /// Tries again for a while, as at the start the map or a transform is missing; then the goal ends with an outcome.
    fn wait(&mut self, goal: Pose2, now_ns: i64, outcome: GoalOutcome) {
        let first_ns = self.first_attempt_ns.unwrap_or(now_ns);
        if now_ns - first_ns < PATIENCE_NS {
            self.progress = Progress::Due(now_ns + RETRY_NS);
        } else {
            self.end(goal, outcome, first_ns, now_ns);
        }
    }

    fn end(&mut self, goal: Pose2, outcome: GoalOutcome, since_ns: i64, now_ns: i64) {
        let time_s = (now_ns - since_ns) as f64 * 1e-9;
        self.reports.push(GoalReport { goal, outcome, time_s, recoveries: self.recoveries });
        self.first_attempt_ns = None;
        self.progress = if self.reports.len() == self.goals.len() {
            Progress::Done
        } else {
            Progress::Due(now_ns)
        };
    }

    /// Ends the run: the goal that is driven to and those after it are unfinished.
    pub fn finish(&mut self, now_ns: i64) {
        let since_ns = match self.progress {
            Progress::Sent(_, since_ns) => since_ns,
            _ => now_ns,
        };
        while let Some(goal) = self.goals.get(self.reports.len()).copied() {
            self.end(goal, GoalOutcome::Unfinished, since_ns, now_ns);
        }
    }
}
