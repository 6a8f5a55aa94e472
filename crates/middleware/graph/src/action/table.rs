//! The goals of a server.

use std::sync::Arc;

use periplus_msgs::Action;
use periplus_msgs::action_msgs::{GoalStatus, GoalStatusArray};

use super::GoalId;
use super::cancel::Standing;
use super::goal::{GoalEvent, GoalState};
use crate::service::Reply;

pub(super) struct Table<A: Action> {
    goals: Vec<Entry<A>>,
}

struct Entry<A: Action> {
    standing: Standing,
    result: Option<Arc<A::Result>>,
    /// Who waits for the result.
    waiting: Vec<Reply>,
}

/// What is to be told to whom, now that a goal is over.
pub(super) type Ended<A> = (GoalState, Arc<<A as Action>::Result>, Vec<Reply>);

impl<A: Action> Table<A> {
    pub(super) fn new() -> Self {
        Self { goals: Vec::new() }
    }

    pub(super) fn has(&self, id: GoalId) -> bool {
        self.goals.iter().any(|goal| goal.standing.id == id)
    }

    pub(super) fn accept(&mut self, id: GoalId, accepted_ns: i64) {
        let standing = Standing { id, accepted_ns, state: GoalState::Accepted };
        self.goals.push(Entry { standing, result: None, waiting: Vec::new() });
    }

    fn find(&mut self, id: GoalId) -> Option<&mut Entry<A>> {
        self.goals.iter_mut().find(|goal| goal.standing.id == id)
    }

    pub(super) fn state(&self, id: GoalId) -> GoalState {
        let goal = self.goals.iter().find(|goal| goal.standing.id == id);
        goal.map_or(GoalState::Unknown, |goal| goal.standing.state)
    }

    /// Whether this could happen.
    pub(super) fn apply(&mut self, id: GoalId, event: GoalEvent) -> bool {
        let Some(goal) = self.find(id) else { return false };
        match goal.standing.state.after(event) {
            Some(state) => {
                goal.standing.state = state;
                true
            }
            None => false,
        }
    }

    /// The end of a goal; none when it cannot end so.
    pub(super) fn end(
        &mut self,
        id: GoalId,
        event: GoalEvent,
        result: Arc<A::Result>,
    ) -> Option<Ended<A>> {
        if !self.apply(id, event) {
            return None;
        }
        let goal = self.find(id)?;
        goal.result = Some(result.clone());
        Some((goal.standing.state, result, std::mem::take(&mut goal.waiting)))
    }

    /// Lets somebody wait for a result; or gives the reply back with what is to be answered.
    pub(super) fn ask(&mut self, id: GoalId, reply: Reply) -> Option<Ended<A>> {
        let Some(goal) = self.find(id) else {
            return Some((GoalState::Unknown, Arc::default(), vec![reply]));
        };
        match &goal.result {
            Some(result) => Some((goal.standing.state, result.clone(), vec![reply])),
            None => {
                goal.waiting.push(reply);
                None
            }
        }
    }

    /// A goal that is over is forgotten.
    pub(super) fn forget(&mut self, id: GoalId) {
        self.goals.retain(|goal| goal.standing.id != id || !goal.standing.state.is_over());
    }

    pub(super) fn standings(&self) -> Vec<Standing> {
        self.goals.iter().map(|goal| goal.standing).collect()
    }

    pub(super) fn statuses(&self) -> GoalStatusArray {
        let status = |goal: &Entry<A>| GoalStatus {
            goal_info: goal.standing.info(),
            status: goal.standing.state.number(),
        };
        GoalStatusArray { status_list: self.goals.iter().map(status).collect() }
    }
}
