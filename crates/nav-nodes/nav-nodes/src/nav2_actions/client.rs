//! Action clients.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_graph::{ActionClient, GoalId, GoalProgress, GraphError, Node, Pending, SentGoal};
use periplus_msgs::action_msgs::CancelGoal;
use periplus_msgs::{Action, Nav2Action, ReleaseForm};

use super::{WithForm, with_form};

/// Sends goals of a Nav2 action in the form of a release.
pub struct Nav2ActionClient<A: Action>(Box<dyn Sender<A>>);

/// A goal that was sent.
pub struct Nav2SentGoal<A: Action>(Box<dyn Sent<A>>);

impl<A: Nav2Action> Nav2ActionClient<A> {
    /// Creates a client. The action server may appear later.
    ///
    /// # Errors
    /// As [`Node::action_client`].
    pub fn new(node: &Node, release: Nav2Release, name: &str) -> Result<Self, GraphError> {
        with_form::<A, _>(release, Create { node, name, action: PhantomData })
    }
}

impl<A: Action> Nav2ActionClient<A> {
    /// True if an action server is available.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.0.is_ready()
    }

    /// Sends a goal. [`Nav2SentGoal::look`] reports its progress once the graph has advanced.
    #[must_use]
    pub fn send(&self, goal: A::Goal) -> Nav2SentGoal<A> {
        Nav2SentGoal(self.0.send(goal))
    }

    /// Returns the feedback received since the last call, for the goals of all clients.
    #[must_use]
    pub fn feedback(&self) -> Vec<(GoalId, A::Feedback)> {
        self.0.feedback()
    }

    /// Requests cancellation of a goal.
    #[must_use]
    pub fn cancel(&self, id: GoalId) -> Pending<CancelGoal> {
        self.0.cancel(id)
    }
}

impl<A: Action> Nav2SentGoal<A> {
    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.0.id()
    }

    /// Returns the progress of the goal.
    #[must_use]
    pub fn look(&self) -> GoalProgress<A::Result> {
        self.0.look()
    }
}

struct Create<'a, A> {
    node: &'a Node,
    name: &'a str,
    action: PhantomData<A>,
}

impl<A: Nav2Action> WithForm<A> for Create<'_, A> {
    type Output = Result<Nav2ActionClient<A>, GraphError>;

    fn with<F: ReleaseForm<A>>(self) -> Self::Output {
        Ok(Nav2ActionClient(Box::new(self.node.action_client::<F>(self.name)?)))
    }
}

/// A client of any form.
trait Sender<A: Action>: Send + Sync {
    fn is_ready(&self) -> bool;
    fn send(&self, goal: A::Goal) -> Box<dyn Sent<A>>;
    fn feedback(&self) -> Vec<(GoalId, A::Feedback)>;
    fn cancel(&self, id: GoalId) -> Pending<CancelGoal>;
}

impl<A: Action, F: ReleaseForm<A>> Sender<A> for ActionClient<F> {
    fn is_ready(&self) -> bool {
        ActionClient::is_ready(self)
    }

    fn send(&self, goal: A::Goal) -> Box<dyn Sent<A>> {
        Box::new(ActionClient::send(self, F::goal_of_full(goal)))
    }

    fn feedback(&self) -> Vec<(GoalId, A::Feedback)> {
        let each = ActionClient::feedback(self).into_iter();
        each.map(|(id, feedback)| (id, F::full_feedback(feedback))).collect()
    }

    fn cancel(&self, id: GoalId) -> Pending<CancelGoal> {
        ActionClient::cancel(self, id)
    }
}

/// A sent goal of any form.
trait Sent<A: Action>: Send + Sync {
    fn id(&self) -> GoalId;
    fn look(&self) -> GoalProgress<A::Result>;
}

impl<A: Action, F: ReleaseForm<A>> Sent<A> for SentGoal<F> {
    fn id(&self) -> GoalId {
        SentGoal::id(self)
    }

    fn look(&self) -> GoalProgress<A::Result> {
        match SentGoal::look(self) {
            GoalProgress::Sent => GoalProgress::Sent,
            GoalProgress::Rejected => GoalProgress::Rejected,
            GoalProgress::Accepted => GoalProgress::Accepted,
            GoalProgress::Over(state, result) => {
                GoalProgress::Over(state, Arc::new(F::full_result((*result).clone())))
            }
            GoalProgress::Failed(error) => GoalProgress::Failed(error),
        }
    }
}
