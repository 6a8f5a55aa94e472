//! Action servers.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, Weak};

use periplus_msgs::action_msgs::{
    CancelGoal, CancelGoalRequest, CancelGoalResponse, GoalStatusArray,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::{Action, Message, Service};

use super::cancel::goals_to_cancel;
use super::goal::{GoalEvent, GoalId, GoalState};
use super::table::{Ended, Table};
use super::{FEEDBACK_QOS, Names, STATUS_QOS};
use crate::actor::Io;
use crate::common::lock;
use crate::event_queue::{Event, EventQueue, Key, Rank};
use crate::node::{Node, NodeCore};
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::service::{OwnServer, Reply, Request, ServerReaction};
use crate::{Actor, GraphError, Publisher};

/// Settings of an action server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionSettings {
    /// Time for which the result of a finished goal is kept for late requests \[ns\].
    pub result_timeout_ns: i64,
}

/// Ten seconds, as in ROS 2 since Iron.
impl Default for ActionSettings {
    fn default() -> Self {
        Self { result_timeout_ns: 10_000_000_000 }
    }
}

/// Decides if a goal may be canceled.
type MayCancel = Box<dyn Fn(GoalId) -> bool + Send + Sync>;

/// Callback for a new goal.
type OnGoal<A> = Box<dyn Fn(NewGoal<A>) + Send + Sync>;

pub(super) struct Core<A: Action> {
    node: Weak<NodeCore>,
    event_queue: Weak<EventQueue>,
    settings: ActionSettings,
    table: Mutex<Table<A>>,
    feedback: Publisher<A::FeedbackMessage>,
    status: Publisher<GoalStatusArray>,
    on_goal: OnGoal<A>,
    may_cancel: MayCancel,
}

/// Action server that is polled; goals wait in a queue. All cancel requests are accepted;
/// [`GoalHandle::is_canceling`] reports them.
#[must_use = "dropping this removes the action"]
pub struct ActionServer<A: Action> {
    waiting: Arc<Mutex<VecDeque<NewGoal<A>>>>,
    _ends: Ends,
}

/// The services of an action while this exists.
struct Ends {
    _servers: [OwnServer; 3],
}

impl<A: Action> ActionServer<A> {
    /// Returns the oldest goal that waits to be accepted.
    #[must_use]
    pub fn take(&self) -> Option<NewGoal<A>> {
        lock(&self.waiting).pop_front()
    }
}

impl Node {
    /// Creates an action server.
    ///
    /// # Errors
    /// When the name is not valid, a topic or service of it has another type, or another
    /// node serves it.
    pub fn action_server<A: Action>(
        &self,
        name: &str,
        settings: ActionSettings,
    ) -> Result<ActionServer<A>, GraphError> {
        let waiting = Arc::new(Mutex::new(VecDeque::new()));
        let queue = waiting.clone();
        let on_goal = Box::new(move |goal| lock(&queue).push_back(goal));
        let ends = ends::<A>(self, name, settings, on_goal, Box::new(|_| true))?;
        Ok(ActionServer { waiting, _ends: ends })
    }
}

impl<S: Send + 'static> Actor<S> {
    /// Creates an action server. `on_goal` gets each new goal and accepts or drops it; `on_cancel`
    /// decides if a goal may be canceled, which [`GoalHandle::is_canceling`] then reports.
    ///
    /// # Errors
    /// As [`Node::action_server`].
    pub fn serve_action<A: Action>(
        &mut self,
        name: &str,
        settings: ActionSettings,
        on_goal: impl FnMut(&mut S, NewGoal<A>, &mut Io<'_, S>) + Send + 'static,
        on_cancel: impl FnMut(&mut S, GoalId, &mut Io<'_, S>) -> bool + Send + 'static,
    ) -> Result<(), GraphError> {
        let (take, ask) = (self.act(on_goal), self.act(on_cancel));
        let on_goal = Box::new(move |goal| {
            let mut goal = Some(goal);
            take(&mut |on_goal, state, io| {
                if let Some(goal) = goal.take() {
                    on_goal(state, goal, io);
                }
            });
        });
        let may_cancel = Box::new(move |id| {
            let mut may = false;
            ask(&mut |on_cancel, state, io| may = on_cancel(state, id, io));
            may
        });
        let ends = ends::<A>(self.node(), name, settings, on_goal, may_cancel)?;
        self.keep(ends);
        Ok(())
    }
}

fn ends<A: Action>(
    node: &Node,
    name: &str,
    settings: ActionSettings,
    on_goal: OnGoal<A>,
    may_cancel: MayCancel,
) -> Result<Ends, GraphError> {
    let names = Names::new(node, name)?;
    let core = Arc::new(Core::<A> {
        node: Arc::downgrade(&node.0),
        event_queue: Arc::downgrade(&node.0.event_queue()),
        settings,
        table: Mutex::new(Table::new()),
        feedback: node.publisher(&names.end("feedback"), FEEDBACK_QOS)?,
        status: node.publisher(&names.end("status"), STATUS_QOS)?,
        on_goal,
        may_cancel,
    });
    let [send, cancel, result] = [core.clone(), core.clone(), core.clone()];
    let servers = [
        end::<A::SendGoal>(node, &names.end("send_goal"), move |question, reply| {
            send.asked(&question, reply);
        })?,
        end::<CancelGoal>(node, &names.end("cancel_goal"), move |question, reply| {
            answer(reply, cancel.cancel(&question));
        })?,
        end::<A::GetResult>(node, &names.end("get_result"), move |question, reply| {
            let ended =
                lock(&result.table).ask(GoalId::from(A::goal_id_of_request(&question)), reply);
            send_result::<A>(ended);
        })?,
    ];
    // Late subscribers learn that there are no goals yet.
    core.status.publish(GoalStatusArray::default());
    Ok(Ends { _servers: servers })
}

/// A service whose responses may be sent later.
fn end<S: Service>(
    node: &Node,
    name: &str,
    react: impl Fn(Arc<S::Request>, Reply) + Send + Sync + 'static,
) -> Result<OwnServer, GraphError> {
    let react = move |request: Request| match request.payload.message::<S::Request>() {
        Ok(question) => react(question, request.reply),
        Err(error) => request.reply.undecodable(&error),
    };
    let reaction = ServerReaction { node: Arc::downgrade(&node.0), react: Box::new(react) };
    node.0.server(name, TypeOf::service::<S>(), Some(reaction))
}

fn answer<T: Message>(reply: Reply, response: T) {
    reply.send(Ok(Arc::new(Payload::typed(Arc::new(response)))));
}

/// Sends a result to the callers that wait for it.
fn send_result<A: Action>(ended: Option<Ended<A>>) {
    let Some((state, result, waiting)) = ended else { return };
    for reply in waiting {
        answer(reply, A::get_result_response(state.number(), (*result).clone()));
    }
}

impl<A: Action> Core<A> {
    fn now_ns(&self) -> i64 {
        self.node.upgrade().map_or(0, |node| node.core.common.clock.now_ns())
    }

    fn asked(self: &Arc<Self>, question: &Arc<<A::SendGoal as Service>::Request>, reply: Reply) {
        let (id, goal) = A::goal_of_request(question);
        let id = GoalId::from(id);
        let goal = Arc::new(goal.clone());
        let new = NewGoal { core: self.clone(), id, goal, reply: Some(reply) };
        if lock(&self.table).has(id) {
            // The goal id is in use: dropping the new goal rejects it.
            return;
        }
        (self.on_goal)(new);
    }

    fn cancel(&self, request: &CancelGoalRequest) -> CancelGoalResponse {
        let records = lock(&self.table).records();
        let (meant, return_code) = goals_to_cancel(request, &records);
        let mut response = CancelGoalResponse { return_code, ..Default::default() };
        for id in &meant {
            // Not under the lock: the callback may use the goal.
            if (self.may_cancel)(*id) && lock(&self.table).apply(*id, GoalEvent::Cancel) {
                let standing = records.iter().find(|goal| goal.id == *id);
                response.goals_canceling.extend(standing.map(|standing| standing.info()));
            }
        }
        if !response.goals_canceling.is_empty() {
            self.publish_states();
        } else if !meant.is_empty() {
            response.return_code = CancelGoalResponse::ERROR_REJECTED;
        }
        response
    }

    fn publish_states(&self) {
        let states = lock(&self.table).statuses();
        self.status.publish(states);
    }

    fn end(self: &Arc<Self>, id: GoalId, event: GoalEvent, result: A::Result) -> bool {
        let ended = lock(&self.table).end(id, event, Arc::new(result));
        let Some(ended) = ended else { return false };
        self.publish_states();
        send_result::<A>(Some(ended));
        self.expire_later(id);
        true
    }

    fn expire_later(self: &Arc<Self>, id: GoalId) {
        let (Some(node), Some(event_queue)) = (self.node.upgrade(), self.event_queue.upgrade())
        else {
            return;
        };
        let key = Key {
            time_ns: self.now_ns().saturating_add(self.settings.result_timeout_ns),
            node: node.full_name.clone(),
            rank: Rank::Timer,
            name: "".into(),
            sequence: 0,
            ordinal: node.next_ordinal(),
        };
        event_queue.add(key, Arc::new(Expiry { core: Arc::downgrade(self), id }));
    }
}

/// The time at which a goal is removed.
struct Expiry<A: Action> {
    core: Weak<Core<A>>,
    id: GoalId,
}

impl<A: Action> Event for Expiry<A> {
    fn happen(&self, _: &Key) {
        if let Some(core) = self.core.upgrade() {
            lock(&core.table).forget(self.id);
        }
    }
}

/// A new goal. Dropping it rejects it.
#[must_use = "dropping a new goal rejects it"]
pub struct NewGoal<A: Action> {
    core: Arc<Core<A>>,
    id: GoalId,
    goal: Arc<A::Goal>,
    reply: Option<Reply>,
}

impl<A: Action> NewGoal<A> {
    /// The goal message.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// Rejects the goal.
    pub fn reject(self) {}

    /// Accepts the goal for later, or for now if [`GoalHandle::execute`] is called. None when the
    /// goal id is in use.
    #[must_use = "dropping the handle cancels the goal"]
    pub fn accept(mut self) -> Option<GoalHandle<A>> {
        let accepted_ns = self.core.now_ns();
        let mut table = lock(&self.core.table);
        if table.has(self.id) {
            return None;
        }
        table.accept(self.id, accepted_ns);
        drop(table);
        if let Some(reply) = self.reply.take() {
            answer(reply, A::send_goal_response(true, Time::of_ns(accepted_ns)));
        }
        self.core.publish_states();
        Some(GoalHandle { core: self.core.clone(), id: self.id, goal: self.goal.clone() })
    }
}

impl<A: Action> Drop for NewGoal<A> {
    fn drop(&mut self) {
        if let Some(reply) = self.reply.take() {
            answer(reply, A::send_goal_response(false, Time::of_ns(self.core.now_ns())));
        }
    }
}

/// A goal that is being executed. Dropping it before its end marks it as canceled.
pub struct GoalHandle<A: Action> {
    core: Arc<Core<A>>,
    id: GoalId,
    goal: Arc<A::Goal>,
}

impl<A: Action> GoalHandle<A> {
    /// The goal message.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// State of the goal.
    #[must_use]
    pub fn state(&self) -> GoalState {
        lock(&self.core.table).state(self.id)
    }

    /// True if cancellation was requested.
    #[must_use]
    pub fn is_canceling(&self) -> bool {
        self.state() == GoalState::Canceling
    }

    /// Starts execution. False if it has started already or is being canceled.
    pub fn execute(&self) -> bool {
        let began = lock(&self.core.table).apply(self.id, GoalEvent::Execute);
        if began {
            self.core.publish_states();
        }
        began
    }

    /// Publishes feedback.
    pub fn feedback(&self, feedback: A::Feedback) {
        if self.core.feedback.is_heard() {
            self.core.feedback.publish(A::feedback_message(self.id.into(), feedback));
        }
    }

    /// Ends the goal with success. False without effect if it never started or is over.
    pub fn succeed(&self, result: A::Result) -> bool {
        self.core.end(self.id, GoalEvent::Succeed, result)
    }

    /// Ends the goal as failed. False as for [`GoalHandle::succeed`].
    pub fn abort(&self, result: A::Result) -> bool {
        self.core.end(self.id, GoalEvent::Abort, result)
    }

    /// Ends the goal as canceled. False if no cancellation was requested.
    pub fn canceled(&self, result: A::Result) -> bool {
        self.core.end(self.id, GoalEvent::Canceled, result)
    }
}

impl<A: Action> Drop for GoalHandle<A> {
    fn drop(&mut self) {
        lock(&self.core.table).apply(self.id, GoalEvent::Cancel);
        self.core.end(self.id, GoalEvent::Canceled, A::Result::default());
    }
}
