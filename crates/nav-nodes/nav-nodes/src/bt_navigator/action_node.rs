//! Tree nodes that are clients of an action server.
//!
//! A node never waits: it sends its goal in one tick and looks for the answer in the next ones. Timeouts
//! count the time of the graph.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError};
use periplus_costmap::Nav2Release;
use periplus_graph::{GoalProgress, GoalState, Level, Pending};
use periplus_msgs::action_msgs::CancelGoal;
use periplus_msgs::{Action, Nav2Action};

use super::shared::{CancelingGoal, Shared};
use super::status::ServerError;
use crate::nav2_actions::{Nav2ActionClient, Nav2SentGoal};

pub(super) type Goal<T> = <<T as TreeAction>::Action as Action>::Goal;
pub(super) type ActionResult<T> = <<T as TreeAction>::Action as Action>::Result;
pub(super) type Feedback<T> = <<T as TreeAction>::Action as Action>::Feedback;

/// Error code of a goal that the server rejected, in main.
const GOAL_REJECTED: u16 = 1;
/// Error code of a goal that could not be sent, in main.
const SEND_GOAL_FAILURE: u16 = 2;

/// End of a goal.
pub(super) enum End<'a, R> {
    Succeeded(&'a R),
    Aborted(&'a R),
    Canceled,
    /// No server, no answer, or the goal was rejected.
    Failed,
}

/// Action that a tree node calls.
pub(super) trait TreeAction: Default + Send + 'static {
    /// The action.
    type Action: Nav2Action;
    /// Name of the action server, unless the port `server_name` names one.
    const SERVER: &'static str;
    /// Error code of a server that does not answer.
    const TIMEOUT: u16;

    /// Goal from the ports.
    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError>;

    /// Adopts changed ports while the goal is running; true if the goal has to be sent again.
    fn update(&mut self, _run: &mut NodeRun<'_>, _goal: &mut Goal<Self>) -> bool {
        false
    }

    /// Writes feedback to ports.
    fn feedback(_run: &mut NodeRun<'_>, _feedback: Feedback<Self>) -> Result<(), TreeError> {
        Ok(())
    }

    /// Error code and message of a result.
    fn error(result: &ActionResult<Self>) -> (u16, &str);

    /// Writes a result to ports, apart from the error.
    fn finish(
        &self,
        _run: &mut NodeRun<'_>,
        _end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        Ok(())
    }

    /// Status for an aborted goal.
    fn aborted(&self) -> NodeStatus {
        NodeStatus::Failure
    }
}

/// Name of a server, and its client.
type NamedClient<T> = (String, Arc<Nav2ActionClient<<T as TreeAction>::Action>>);

/// Tree node with its client.
pub(super) struct ActionNode<T: TreeAction> {
    shared: Arc<Shared>,
    action: T,
    client: Option<NamedClient<T>>,
    goal: Goal<T>,
    sent: Option<Nav2SentGoal<T::Action>>,
    /// End of the last goal. A node whose parent does not reset it returns its status again.
    over: Option<(GoalState, Arc<ActionResult<T>>)>,
    /// Time at which the goal was sent, or at which the node began to wait for the server \[ns\].
    since_ns: i64,
}

impl<T: TreeAction> ActionNode<T> {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        let (action, goal) = (T::default(), Goal::<T>::default());
        Self { shared, action, client: None, goal, sent: None, over: None, since_ns: 0 }
    }

    /// Name of the server and its client, which is created at first use.
    fn client(&mut self, run: &NodeRun<'_>) -> Result<NamedClient<T>, TreeError> {
        let name = run.input_text("server_name").filter(|name| !name.is_empty());
        let name = name.unwrap_or_else(|| T::SERVER.to_owned());
        if let Some((known, client)) = &self.client
            && *known == name
        {
            return Ok((name, client.clone()));
        }
        let client = Nav2ActionClient::new(&self.shared.node, self.shared.release, &name);
        let client = Arc::new(client.map_err(|error| run.error(error.to_string()))?);
        self.client = Some((name.clone(), client.clone()));
        Ok((name, client))
    }

    fn send(&mut self, client: &Nav2ActionClient<T::Action>, now_ns: i64) {
        self.sent = Some(client.send(self.goal.clone()));
        self.since_ns = now_ns;
    }

    /// Maximum time until an answer \[ns\].
    fn server_timeout_ns(&self, run: &NodeRun<'_>) -> i64 {
        let given_ms = run.input_i64("server_timeout");
        given_ms.map_or(self.shared.params.server_timeout_ns(), |ms| ms.saturating_mul(1_000_000))
    }

    /// Fails without a result.
    fn fail(
        &mut self,
        run: &mut NodeRun<'_>,
        server: &str,
        code: Option<u16>,
        message: String,
    ) -> Result<NodeStatus, TreeError> {
        self.sent = None;
        self.shared.node.log(Level::Warn, format!("{}: {message}", run.name()));
        self.action.finish(run, &End::Failed)?;
        set_error(run, code, &message)?;
        self.report(run, server, code.unwrap_or_default(), message);
        Ok(NodeStatus::Failure)
    }

    fn report(&self, run: &NodeRun<'_>, server: &str, code: u16, message: String) {
        let tree_node = run.name().to_owned();
        self.shared.report_error(ServerError {
            server: server.to_owned(),
            tree_node,
            code,
            message,
        });
    }

    /// Error code of main; earlier releases do not set one.
    fn main_code(&self, code: u16) -> Option<u16> {
        (self.shared.release == Nav2Release::Main).then_some(code)
    }

    fn begin(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.goal = self.action.goal(run)?;
        (self.sent, self.over) = (None, None);
        self.since_ns = run.now_ns();
        run.set_running();
        Ok(())
    }

    fn end(
        &mut self,
        run: &mut NodeRun<'_>,
        server: &str,
        state: GoalState,
        result: &ActionResult<T>,
    ) -> Result<NodeStatus, TreeError> {
        self.sent = None;
        match state {
            GoalState::Succeeded => {
                self.action.finish(run, &End::Succeeded(result))?;
                set_error(run, Some(0), "")?;
                self.shared.report_success(server);
                Ok(NodeStatus::Success)
            }
            GoalState::Canceled => {
                self.action.finish(run, &End::Canceled)?;
                set_error(run, Some(0), "")?;
                Ok(NodeStatus::Success)
            }
            _ => {
                self.action.finish(run, &End::Aborted(result))?;
                let (code, message) = T::error(result);
                set_error(run, Some(code), message)?;
                self.report(run, server, code, message.to_owned());
                Ok(self.action.aborted())
            }
        }
    }
}

fn set_error(run: &mut NodeRun<'_>, code: Option<u16>, message: &str) -> Result<(), TreeError> {
    if let Some(code) = code {
        run.set_output("error_code_id", i64::from(code))?;
    }
    run.set_output("error_msg", message)
}

impl<T: TreeAction> BehaviorNode for ActionNode<T> {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let now_ns = run.now_ns();
        let (server, client) = self.client(run)?;
        if run.status() != NodeStatus::Running {
            if let Some((state, result)) = self.over.clone().filter(|_| run.status().is_active()) {
                return self.end(run, &server, state, &result);
            }
            self.begin(run)?;
        }
        let Some(sent) = &self.sent else {
            if client.is_ready() {
                self.send(&client, now_ns);
                return Ok(NodeStatus::Running);
            }
            if now_ns - self.since_ns < self.shared.params.wait_for_service_ns() {
                return Ok(NodeStatus::Running);
            }
            let message = format!("the action server `{server}` is not available");
            return self.fail(run, &server, self.main_code(SEND_GOAL_FAILURE), message);
        };
        match sent.look() {
            GoalProgress::Sent if now_ns - self.since_ns < self.server_timeout_ns(run) => {
                Ok(NodeStatus::Running)
            }
            GoalProgress::Sent => {
                let message = format!(
                    "Timed out while waiting for action server to acknowledge goal request for {server}"
                );
                self.abandon(client);
                self.fail(run, &server, Some(T::TIMEOUT), message)
            }
            GoalProgress::Rejected => {
                let message = "Goal was rejected by the action server.".to_owned();
                self.fail(run, &server, self.main_code(GOAL_REJECTED), message)
            }
            GoalProgress::Failed(error) => {
                let message = format!("Failed to send goal to the action server: {error}");
                self.fail(run, &server, self.main_code(SEND_GOAL_FAILURE), message)
            }
            GoalProgress::Accepted => {
                let id = sent.id();
                let own = client.feedback().into_iter().filter(|(of, _)| *of == id);
                if let Some((_, feedback)) = own.last() {
                    T::feedback(run, feedback)?;
                }
                if self.action.update(run, &mut self.goal) {
                    self.send(&client, now_ns);
                }
                Ok(NodeStatus::Running)
            }
            GoalProgress::Over(state, result) => {
                self.over = Some((state, result.clone()));
                self.end(run, &server, state, &result)
            }
        }
    }

    fn halt(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        if run.status() != NodeStatus::Running {
            return Ok(());
        }
        if let Some((_, client)) = self.client.clone() {
            self.abandon(client);
        }
        self.action.finish(run, &End::Canceled)
    }
}

impl<T: TreeAction> ActionNode<T> {
    /// Cancels the goal; also one that is accepted later.
    fn abandon(&mut self, client: Arc<Nav2ActionClient<T::Action>>) {
        if let Some(sent) = self.sent.take() {
            self.shared.add_canceling(Canceling { client, sent, request: None });
        }
    }
}

/// Goal that is being canceled.
struct Canceling<A: Nav2Action> {
    client: Arc<Nav2ActionClient<A>>,
    sent: Nav2SentGoal<A>,
    request: Option<Pending<CancelGoal>>,
}

impl<A: Nav2Action> CancelingGoal for Canceling<A> {
    fn is_over(&mut self) -> bool {
        match self.sent.look() {
            GoalProgress::Sent => false,
            GoalProgress::Accepted => {
                if self.request.is_none() {
                    self.request = Some(self.client.cancel(self.sent.id()));
                }
                false
            }
            _ => true,
        }
    }
}
