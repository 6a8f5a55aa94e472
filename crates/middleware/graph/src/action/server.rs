//! Who works on goals.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, Weak};

use periplus_msgs::action_msgs::{
    CancelGoal, CancelGoalRequest, CancelGoalResponse, GoalStatusArray,
};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::{Action, Message, Service};

use super::cancel::meant;
use super::goal::{GoalEvent, GoalId, GoalState};
use super::table::{Ended, Table};
use super::{FEEDBACK_QOS, Names, STATUS_QOS};
use crate::actor::Io;
use crate::agenda::{Agenda, Event, Key, Rank};
use crate::common::lock;
use crate::node::{Node, NodeCore};
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::service::{OwnServer, Reply, Request, ServerReaction};
use crate::{Actor, GraphError, Publisher};

/// How a server treats its goals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionSettings {
    /// How long a goal that is over is remembered, for who asks late \[ns\].
    pub result_timeout_ns: i64,
}

/// Ten seconds, as in ROS 2 since Iron.
impl Default for ActionSettings {
    fn default() -> Self {
        Self { result_timeout_ns: 10_000_000_000 }
    }
}

/// Whether a goal may be stopped.
type MayCancel = Box<dyn Fn(GoalId) -> bool + Send + Sync>;

/// What is done with a new goal.
type OnGoal<A> = Box<dyn Fn(NewGoal<A>) + Send + Sync>;

pub(super) struct Core<A: Action> {
    node: Weak<NodeCore>,
    agenda: Weak<Agenda>,
    settings: ActionSettings,
    table: Mutex<Table<A>>,
    feedback: Publisher<A::FeedbackMessage>,
    status: Publisher<GoalStatusArray>,
    on_goal: OnGoal<A>,
    may_cancel: MayCancel,
}

/// Works on the goals of an action; the goals wait until somebody looks. Who asks to stop a goal
/// is told yes; [`GoalHandle::is_canceling`] tells who works on it.
#[must_use = "the action is gone when this is dropped"]
pub struct ActionServer<A: Action> {
    waiting: Arc<Mutex<VecDeque<NewGoal<A>>>>,
    _ends: Ends,
}

/// The services of an action, as long as this is there.
struct Ends {
    _servers: [OwnServer; 3],
}

impl<A: Action> ActionServer<A> {
    /// The oldest goal that waits to be accepted.
    #[must_use]
    pub fn take(&self) -> Option<NewGoal<A>> {
        lock(&self.waiting).pop_front()
    }
}

impl Node {
    /// Works on the goals of an action.
    ///
    /// # Errors
    /// When the name is not valid, a topic or service of it has another type, or another node works
    /// on its goals.
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
    /// Works on the goals of an action. `on_goal` gets each new goal, to accept it or not;
    /// `on_cancel` says whether a goal may be stopped, and the one who works on it sees that in
    /// [`GoalHandle::is_canceling`].
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
        agenda: Arc::downgrade(&node.0.agenda()),
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
            let ended = lock(&result.table).ask(GoalId::from(A::asked_result(&question)), reply);
            tell::<A>(ended);
        })?,
    ];
    // Who comes late knows that there are no goals yet.
    core.status.publish(GoalStatusArray::default());
    Ok(Ends { _servers: servers })
}

/// A service whose answers may take their time.
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

/// Tells a result to those who wait for it.
fn tell<A: Action>(ended: Option<Ended<A>>) {
    let Some((state, result, waiting)) = ended else { return };
    for reply in waiting {
        answer(reply, A::give_result(state.number(), (*result).clone()));
    }
}

impl<A: Action> Core<A> {
    fn now_ns(&self) -> i64 {
        self.node.upgrade().map_or(0, |node| node.core.common.clock.now_ns())
    }

    fn asked(self: &Arc<Self>, question: &Arc<<A::SendGoal as Service>::Request>, reply: Reply) {
        let (id, goal) = A::sent_goal(question);
        let id = GoalId::from(id);
        let goal = Arc::new(goal.clone());
        let new = NewGoal { core: self.clone(), id, goal, reply: Some(reply) };
        if lock(&self.table).has(id) {
            // There is a goal of this name: dropping the new one refuses it.
            return;
        }
        (self.on_goal)(new);
    }

    fn cancel(&self, request: &CancelGoalRequest) -> CancelGoalResponse {
        let standings = lock(&self.table).standings();
        let (meant, return_code) = meant(request, &standings);
        let mut response = CancelGoalResponse { return_code, ..Default::default() };
        for id in &meant {
            // Not under the lock: who works on the goal may look at it.
            if (self.may_cancel)(*id) && lock(&self.table).apply(*id, GoalEvent::Cancel) {
                let standing = standings.iter().find(|goal| goal.id == *id);
                response.goals_canceling.extend(standing.map(|standing| standing.info()));
            }
        }
        if !response.goals_canceling.is_empty() {
            self.tell_states();
        } else if !meant.is_empty() {
            response.return_code = CancelGoalResponse::ERROR_REJECTED;
        }
        response
    }

    fn tell_states(&self) {
        let states = lock(&self.table).statuses();
        self.status.publish(states);
    }

    fn end(self: &Arc<Self>, id: GoalId, event: GoalEvent, result: A::Result) -> bool {
        let ended = lock(&self.table).end(id, event, Arc::new(result));
        let Some(ended) = ended else { return false };
        self.tell_states();
        tell::<A>(Some(ended));
        self.expire_later(id);
        true
    }

    fn expire_later(self: &Arc<Self>, id: GoalId) {
        let (Some(node), Some(agenda)) = (self.node.upgrade(), self.agenda.upgrade()) else {
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
        agenda.add(key, Arc::new(Expiry { core: Arc::downgrade(self), id }));
    }
}

/// The time at which a goal is forgotten.
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

/// A goal that somebody sent. If it is dropped, it is refused.
#[must_use = "a goal that nobody accepts is refused"]
pub struct NewGoal<A: Action> {
    core: Arc<Core<A>>,
    id: GoalId,
    goal: Arc<A::Goal>,
    reply: Option<Reply>,
}

impl<A: Action> NewGoal<A> {
    /// What is to be done.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Its name.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// It will not be done.
    pub fn reject(self) {}

    /// It will be done: later, or now if [`GoalHandle::execute`] is called. None when another goal
    /// has its name.
    #[must_use = "a goal that nobody works on is stopped"]
    pub fn accept(mut self) -> Option<GoalHandle<A>> {
        let accepted_ns = self.core.now_ns();
        let mut table = lock(&self.core.table);
        if table.has(self.id) {
            return None;
        }
        table.accept(self.id, accepted_ns);
        drop(table);
        if let Some(reply) = self.reply.take() {
            answer(reply, A::accept_goal(true, Time::of_ns(accepted_ns)));
        }
        self.core.tell_states();
        Some(GoalHandle { core: self.core.clone(), id: self.id, goal: self.goal.clone() })
    }
}

impl<A: Action> Drop for NewGoal<A> {
    fn drop(&mut self) {
        if let Some(reply) = self.reply.take() {
            answer(reply, A::accept_goal(false, Time::of_ns(self.core.now_ns())));
        }
    }
}

/// A goal that is worked on. If it is dropped before its end, it counts as stopped.
pub struct GoalHandle<A: Action> {
    core: Arc<Core<A>>,
    id: GoalId,
    goal: Arc<A::Goal>,
}

impl<A: Action> GoalHandle<A> {
    /// What is to be done.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Its name.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.id
    }

    /// How far it is.
    #[must_use]
    pub fn state(&self) -> GoalState {
        lock(&self.core.table).state(self.id)
    }

    /// Whether it is to be stopped.
    #[must_use]
    pub fn is_canceling(&self) -> bool {
        self.state() == GoalState::Canceling
    }

    /// Work begins. False when it has already, or is to be stopped.
    pub fn execute(&self) -> bool {
        let began = lock(&self.core.table).apply(self.id, GoalEvent::Execute);
        if began {
            self.core.tell_states();
        }
        began
    }

    /// Tells how far it is.
    pub fn feedback(&self, feedback: A::Feedback) {
        if self.core.feedback.is_heard() {
            self.core.feedback.publish(A::tell_feedback(self.id.into(), feedback));
        }
    }

    /// It is done. False, and nothing told, when that cannot be: it never began, or is over.
    pub fn succeed(&self, result: A::Result) -> bool {
        self.core.end(self.id, GoalEvent::Succeed, result)
    }

    /// It cannot be done. False as for [`GoalHandle::succeed`].
    pub fn abort(&self, result: A::Result) -> bool {
        self.core.end(self.id, GoalEvent::Abort, result)
    }

    /// It was stopped as asked. False when nobody asked.
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
