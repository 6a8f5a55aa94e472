//! Action clients.

use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use periplus_geometry::Stream;
use periplus_msgs::Action;
use periplus_msgs::action_msgs::{CancelGoal, CancelGoalRequest, GoalInfo, GoalStatusArray};
use periplus_msgs::builtin_interfaces::Time;

use super::goal::{GoalId, GoalState};
use super::{FEEDBACK_QOS, Names, STATUS_QOS};
use crate::common::lock;
use crate::node::Node;
use crate::{CallError, Client, GraphError, Mailbox, Pending};

/// Sends goals of an action.
pub struct ActionClient<A: Action> {
    name: String,
    ids: Ids,
    send: Client<A::SendGoal>,
    result: Arc<Client<A::GetResult>>,
    cancel: Client<CancelGoal>,
    feedback: Mailbox<A::FeedbackMessage>,
    status: Mailbox<GoalStatusArray>,
}

/// Generates goal ids. They follow from the node name, the time, and a counter, so that a run in
/// lockstep generates the same ids again.
pub(super) struct Ids {
    node: Node,
    count: AtomicU64,
}

impl Ids {
    pub(super) fn new(node: &Node) -> Self {
        Self { node: node.clone(), count: AtomicU64::new(0) }
    }

    pub(super) fn next(&self) -> GoalId {
        let number = self.count.fetch_add(1, Ordering::Relaxed);
        let seed = self.node.now_ns().cast_unsigned();
        let mut stream = Stream::keyed(seed, self.node.full_name(), number);
        let mut id = [0; 16];
        for half in id.chunks_exact_mut(8) {
            half.copy_from_slice(&stream.bits().to_le_bytes());
        }
        // RFC 9562: version 4, made of random bits.
        id[6] = id[6] & 0x0f | 0x40;
        id[8] = id[8] & 0x3f | 0x80;
        GoalId(id)
    }
}

impl Node {
    /// Creates an action client. The action server may appear later.
    ///
    /// # Errors
    /// When the name is not valid, or a topic or service of it has another type.
    pub fn action_client<A: Action>(&self, name: &str) -> Result<ActionClient<A>, GraphError> {
        let names = Names::new(self, name)?;
        Ok(ActionClient {
            ids: Ids::new(self),
            send: self.client(&names.end("send_goal"))?,
            result: Arc::new(self.client(&names.end("get_result"))?),
            cancel: self.client(&names.end("cancel_goal"))?,
            feedback: self.mailbox(&names.end("feedback"), FEEDBACK_QOS)?,
            status: self.mailbox(&names.end("status"), STATUS_QOS)?,
            name: names.action,
        })
    }
}

impl<A: Action> ActionClient<A> {
    /// Full name of the action.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// True if an action server is available.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.send.is_ready() && self.result.is_ready() && self.cancel.is_ready()
    }

    /// Sends a goal. [`SentGoal::look`] reports its progress once the graph has advanced.
    #[must_use]
    pub fn send(&self, goal: A::Goal) -> SentGoal<A> {
        let id = self.ids.next();
        let stage = Stage::Sent(self.send.call(A::send_goal_request(id.into(), goal)));
        SentGoal { id, result: self.result.clone(), stage: Mutex::new(stage) }
    }

    /// Returns the feedback received since the last call, for the goals of all clients.
    #[must_use]
    pub fn feedback(&self) -> Vec<(GoalId, A::Feedback)> {
        let feedback_messages = self.feedback.drain();
        feedback_messages
            .iter()
            .map(|message| {
                let (id, feedback) = A::feedback_of_message(message);
                (GoalId::from(id), feedback.clone())
            })
            .collect()
    }

    /// Returns the states of all goals if they have changed since the last call.
    #[must_use]
    pub fn states(&self) -> Option<Vec<(GoalId, GoalState)>> {
        let message = self.status.latest()?;
        let each = message.status_list.iter();
        let state = |goal: &periplus_msgs::action_msgs::GoalStatus| {
            (GoalId::from(&goal.goal_info.goal_id), GoalState::of_number(goal.status))
        };
        Some(each.map(state).collect())
    }

    /// Requests cancellation of a goal.
    #[must_use]
    pub fn cancel(&self, id: GoalId) -> Pending<CancelGoal> {
        self.ask_cancel(id, Time::default())
    }

    /// Requests cancellation of all goals, of all clients.
    #[must_use]
    pub fn cancel_all(&self) -> Pending<CancelGoal> {
        self.ask_cancel(GoalId::NONE, Time::default())
    }

    /// Requests cancellation of all goals that were accepted up to a time \[ns\].
    #[must_use]
    pub fn cancel_before(&self, time_ns: i64) -> Pending<CancelGoal> {
        self.ask_cancel(GoalId::NONE, Time::of_ns(time_ns))
    }

    fn ask_cancel(&self, id: GoalId, stamp: Time) -> Pending<CancelGoal> {
        let goal_info = GoalInfo { goal_id: id.into(), stamp };
        self.cancel.call(CancelGoalRequest { goal_info })
    }
}

/// Progress of a goal.
#[derive(Clone, Debug, PartialEq)]
pub enum GoalProgress<R> {
    /// Sent; not answered yet.
    Sent,
    /// Rejected by the server.
    Rejected,
    /// Accepted; the result is pending.
    Accepted,
    /// Finished: the final state and the result.
    Over(GoalState, Arc<R>),
    /// The call failed.
    Failed(CallError),
}

/// A goal that was sent.
pub struct SentGoal<A: Action> {
    id: GoalId,
    result: Arc<Client<A::GetResult>>,
    stage: Mutex<Stage<A>>,
}

enum Stage<A: Action> {
    Sent(Pending<A::SendGoal>),
    Accepted(Pending<A::GetResult>),
    Done(GoalProgress<A::Result>),
}

impl<A: Action> SentGoal<A> {
    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// Returns the progress of the goal.
    #[must_use]
    pub fn look(&self) -> GoalProgress<A::Result> {
        let mut stage = lock(&self.stage);
        let next = match &*stage {
            Stage::Sent(pending) => pending.take().map(|answer| match answer {
                Ok(answer) if A::acceptance_of_response(&answer).0 => {
                    Stage::Accepted(self.result.call(A::get_result_request(self.id.into())))
                }
                Ok(_) => Stage::Done(GoalProgress::Rejected),
                Err(error) => Stage::Done(GoalProgress::Failed(error)),
            }),
            Stage::Accepted(pending) => pending.take().map(|answer| {
                Stage::Done(match answer {
                    Ok(answer) => {
                        let (status, result) = A::result_of_response(&answer);
                        let state = GoalState::of_number(status);
                        GoalProgress::Over(state, Arc::new(result.clone()))
                    }
                    Err(error) => GoalProgress::Failed(error),
                })
            }),
            Stage::Done(_) => None,
        };
        if let Some(next) = next {
            *stage = next;
        }
        match &*stage {
            Stage::Sent(_) => GoalProgress::Sent,
            Stage::Accepted(_) => GoalProgress::Accepted,
            Stage::Done(progress) => progress.clone(),
        }
    }
}
