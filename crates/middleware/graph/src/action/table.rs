//! The goals of an action server.

use std::sync::Arc;

use periplus_msgs::Action;
use periplus_msgs::action_msgs::{GoalStatus, GoalStatusArray};

use super::GoalId;
use super::cancel::GoalRecord;
use super::goal::{GoalEvent, GoalState};
use crate::service::Reply;

pub(super) struct Table<A: Action> {
    goals: Vec<Entry<A>>,
}

struct Entry<A: Action> {
    standing: GoalRecord,
    result: Option<Arc<A::Result>>,
    /// Callers that wait for the result.
    waiting: Vec<Reply>,
}

/// A finished goal: state, result, and the callers to send it to.
pub(super) type Ended<A> = (GoalState, Arc<<A as Action>::Result>, Vec<Reply>);

impl<A: Action> Table<A> {
    pub(super) fn new() -> Self {
        Self { goals: Vec::new() }
    }

    pub(super) fn has(&self, id: GoalId) -> bool {
        self.goals.iter().any(|goal| goal.standing.id == id)
    }

    pub(super) fn accept(&mut self, id: GoalId, accepted_ns: i64) {
        let standing = GoalRecord { id, accepted_ns, state: GoalState::Accepted };
        self.goals.push(Entry { standing, result: None, waiting: Vec::new() });
    }

    fn find(&mut self, id: GoalId) -> Option<&mut Entry<A>> {
        self.goals.iter_mut().find(|goal| goal.standing.id == id)
    }

    pub(super) fn state(&self, id: GoalId) -> GoalState {
        let goal = self.goals.iter().find(|goal| goal.standing.id == id);
        goal.map_or(GoalState::Unknown, |goal| goal.standing.state)
    }

    /// Applies an event; false if the transition is not allowed.
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

    /// Ends a goal; none if the transition is not allowed.
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

    /// Adds a caller that waits for a result; returns it with the result if that is known.
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

    /// Removes a finished goal.
    pub(super) fn forget(&mut self, id: GoalId) {
        self.goals.retain(|goal| goal.standing.id != id || !goal.standing.state.is_over());
    }

    pub(super) fn records(&self) -> Vec<GoalRecord> {
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
