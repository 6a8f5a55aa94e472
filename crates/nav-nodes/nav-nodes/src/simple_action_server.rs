//! Action server with one running goal, as all servers of Nav2 have it.
//!
//! A goal that arrives while another one runs is *pending*; the node looks for it in its work loop
//! and takes it ([`SimpleActionServer::accept_pending_goal`]) or ends the current one, after which the
//! pending goal starts. A pending goal that is overtaken by a newer one is aborted. Goals are rejected
//! while the server is inactive.
//!
//! The server is a part of the state of a node; [`serve_simple_action`] connects it to the graph. A
//! node works in callbacks and never waits: `start` begins the work on the current goal, which goes on
//! in timers or alarms until the node calls [`SimpleActionServer::finish`].
//!
//! Source: `nav2_ros_common/simple_action_server.hpp` (main), `nav2_util` in releases before.

use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_graph::{ActionSettings, Actor, GoalId, GoalState, GraphError, Io, Level};
use periplus_msgs::{Action, Nav2Action};

use crate::nav2_actions::{Nav2GoalHandle, NewNav2Goal, serve_nav2_action};

/// Action server with one running and at most one pending goal.
pub struct SimpleActionServer<A: Action> {
    current: Option<Nav2GoalHandle<A>>,
    pending: Option<Nav2GoalHandle<A>>,
    is_preempt_requested: bool,
    is_active: bool,
    /// True from the start of a goal until the node finishes its work.
    is_running: bool,
}

impl<A: Action> Default for SimpleActionServer<A> {
    /// An inactive server.
    fn default() -> Self {
        Self {
            current: None,
            pending: None,
            is_preempt_requested: false,
            is_active: false,
            is_running: false,
        }
    }
}

/// Effect of a new goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GoalArrival {
    /// The goal was rejected.
    Rejected,
    /// The goal waits for the running one.
    Pending,
    /// The goal is the current one; its work has to start.
    Started,
}

fn is_active_goal<A: Action>(handle: &Option<Nav2GoalHandle<A>>) -> bool {
    handle.as_ref().is_some_and(|handle| !handle.state().is_over())
}

/// Ends a goal: canceled if that was requested, else aborted.
fn terminate<A: Action>(slot: &mut Option<Nav2GoalHandle<A>>, result: A::Result) {
    let Some(handle) = slot.take() else { return };
    if handle.is_canceling() {
        handle.canceled(result);
    } else {
        handle.abort(result);
    }
}

impl<A: Action> SimpleActionServer<A> {
    /// Accepts goals from now on.
    pub fn activate(&mut self) {
        self.is_active = true;
    }

    /// Rejects goals from now on, and ends all with default results. Returns true if a goal was
    /// running; its work has to stop.
    pub fn deactivate(&mut self) -> bool {
        self.is_active = false;
        self.terminate_all(A::Result::default());
        std::mem::take(&mut self.is_running)
    }

    /// True while goals are accepted.
    #[must_use]
    pub fn is_server_active(&self) -> bool {
        self.is_active
    }

    /// True while the work on a goal goes on.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.is_running
    }

    fn receive(&mut self, new: NewNav2Goal<A>) -> GoalArrival {
        let Some(handle) = new.accept() else { return GoalArrival::Rejected };
        handle.execute();
        if self.is_running || is_active_goal(&self.current) {
            terminate(&mut self.pending, A::Result::default());
            self.pending = Some(handle);
            self.is_preempt_requested = true;
            return GoalArrival::Pending;
        }
        self.current = Some(handle);
        self.is_running = true;
        GoalArrival::Started
    }

    /// True if a goal may be canceled: it is the current or the pending one, and not over.
    fn may_cancel(&self, id: GoalId) -> bool {
        let both = [&self.current, &self.pending];
        both.into_iter().any(|slot| {
            is_active_goal(slot) && slot.as_ref().is_some_and(|handle| handle.id() == id)
        })
    }

    /// The current goal; none if it is over.
    #[must_use]
    pub fn current_goal(&self) -> Option<Arc<A::Goal>> {
        self.current.as_ref().filter(|handle| !handle.state().is_over()).map(|it| it.goal().clone())
    }

    /// Id of the current goal; none if it is over.
    #[must_use]
    pub fn current_goal_id(&self) -> Option<GoalId> {
        self.current.as_ref().filter(|handle| !handle.state().is_over()).map(Nav2GoalHandle::id)
    }

    /// The pending goal.
    #[must_use]
    pub fn pending_goal(&self) -> Option<Arc<A::Goal>> {
        self.pending.as_ref().filter(|handle| !handle.state().is_over()).map(|it| it.goal().clone())
    }

    /// True once a goal is pending.
    #[must_use]
    pub fn is_preempt_requested(&self) -> bool {
        self.is_preempt_requested
    }

    /// True if cancellation was requested, of the pending goal if there is one, else of the current.
    #[must_use]
    pub fn is_cancel_requested(&self) -> bool {
        let newest = self.pending.as_ref().or(self.current.as_ref());
        newest.is_some_and(|handle| handle.state() == GoalState::Canceling)
    }

    /// Makes the pending goal the current one, and aborts the one before. None without a pending goal.
    pub fn accept_pending_goal(&mut self) -> Option<Arc<A::Goal>> {
        let pending = self.pending.take().filter(|handle| !handle.state().is_over())?;
        if let Some(old) = self.current.take() {
            // A goal that is being canceled is aborted, too: another one takes over.
            old.abort(A::Result::default());
        }
        self.is_preempt_requested = false;
        let goal = pending.goal().clone();
        self.current = Some(pending);
        Some(goal)
    }

    /// Ends the pending goal: canceled if that was requested, else aborted.
    pub fn terminate_pending_goal(&mut self) {
        terminate(&mut self.pending, A::Result::default());
        self.is_preempt_requested = false;
    }

    /// Ends the current goal: canceled if that was requested, else aborted.
    pub fn terminate_current(&mut self, result: A::Result) {
        terminate(&mut self.current, result);
    }

    /// Ends the current and the pending goal.
    pub fn terminate_all(&mut self, result: A::Result) {
        terminate(&mut self.current, result.clone());
        terminate(&mut self.pending, result);
        self.is_preempt_requested = false;
    }

    /// Ends the current goal with success.
    pub fn succeeded_current(&mut self, result: A::Result) {
        if let Some(handle) = self.current.take() {
            handle.succeed(result);
        }
    }

    /// Publishes feedback on the current goal.
    pub fn publish_feedback(&self, feedback: A::Feedback) {
        if let Some(handle) = self.current.as_ref().filter(|handle| !handle.state().is_over()) {
            handle.feedback(feedback);
        }
    }

    /// Ends the work on the current goal, which is aborted if it is not over. Returns true if the
    /// pending goal became the current one, so that its work has to start.
    #[must_use = "the pending goal has to be started"]
    pub fn finish(&mut self) -> bool {
        terminate(&mut self.current, A::Result::default());
        self.is_running = self.accept_pending_goal().is_some();
        if !self.is_running {
            self.pending = None;
            self.is_preempt_requested = false;
        }
        self.is_running
    }
}

/// Reason why a node rejects a goal: a text for the log, since a client only learns of the rejection.
pub type RejectionReason = String;

/// Serves an action with a [`SimpleActionServer`] in the state of a node, in the form of a release.
///
/// `server` finds it in the state. `validate` decides if a goal is acceptable, or returns the reason why
/// not, which is logged. `start` begins the work on the current goal.
///
/// # Errors
/// When the name is not valid, a topic or service of it has another type, or another node serves it.
pub fn serve_simple_action<A: Nav2Action, S: Send + 'static>(
    actor: &mut Actor<S>,
    release: Nav2Release,
    name: &str,
    settings: ActionSettings,
    server: impl Fn(&mut S) -> Option<&mut SimpleActionServer<A>> + Clone + Send + 'static,
    mut validate: impl FnMut(&mut S, &A::Goal, &mut Io<'_, S>) -> Result<(), RejectionReason>
    + Send
    + 'static,
    mut start: impl FnMut(&mut S, &mut Io<'_, S>) + Send + 'static,
) -> Result<(), GraphError> {
    let (of_goal, of_cancel, action) = (server.clone(), server, name.to_owned());
    serve_nav2_action::<A, S>(
        actor,
        release,
        name,
        settings,
        move |state, new, io| {
            if !of_goal(state).is_some_and(|server| server.is_active) {
                let text = format!("rejected a goal of `{action}`: the server is inactive");
                return io.node().log(Level::Info, text);
            }
            if let Err(reason) = validate(state, new.goal(), io) {
                let text = format!("rejected a goal of `{action}`: {reason}");
                return io.node().log(Level::Error, text);
            }
            let Some(server) = of_goal(state) else { return };
            if server.receive(new) == GoalArrival::Started {
                start(state, io);
            }
        },
        move |state, id, _| of_cancel(state).is_some_and(|server| server.may_cancel(id)),
    )
}
