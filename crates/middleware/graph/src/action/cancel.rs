//! Selection of the goals that a cancel request matches.

use periplus_msgs::action_msgs::{CancelGoalRequest, CancelGoalResponse, GoalInfo};
use periplus_msgs::builtin_interfaces::Time;

use super::GoalId;
use super::goal::{GoalEvent, GoalState};

/// The fields of a goal that cancel requests are matched against.
#[derive(Clone, Copy, Debug)]
pub(super) struct GoalRecord {
    pub(super) id: GoalId,
    pub(super) accepted_ns: i64,
    pub(super) state: GoalState,
}

impl GoalRecord {
    pub(super) fn info(&self) -> GoalInfo {
        GoalInfo { goal_id: self.id.into(), stamp: Time::of_ns(self.accepted_ns) }
    }
}

/// Returns the goals that the request matches and that can be canceled, and the return code of the
/// response if there is none.
///
/// Without id and time all goals match; with an id that one; with a time those accepted up to then;
/// with both, the union. Source: `rcl_action_process_cancel_request`.
pub(super) fn goals_to_cancel(
    request: &CancelGoalRequest,
    goals: &[GoalRecord],
) -> (Vec<GoalId>, i8) {
    let id = GoalId::from(&request.goal_info.goal_id);
    let time_ns = request.goal_info.stamp.ns();
    let can_stop = |goal: &&GoalRecord| goal.state.after(GoalEvent::Cancel).is_some();
    if id != GoalId::NONE && time_ns == 0 {
        return match goals.iter().find(|goal| goal.id == id) {
            None => (Vec::new(), CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID),
            Some(goal) if can_stop(&goal) => (vec![id], CancelGoalResponse::ERROR_NONE),
            Some(_) => (Vec::new(), CancelGoalResponse::ERROR_GOAL_TERMINATED),
        };
    }
    let until_ns = if time_ns == 0 { i64::MAX } else { time_ns };
    let is_meant = |goal: &&GoalRecord| goal.accepted_ns <= until_ns || goal.id == id;
    let meant = goals.iter().filter(can_stop).filter(is_meant).map(|goal| goal.id);
    (meant.collect(), CancelGoalResponse::ERROR_NONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_and_times_choose_goals() {
        let id = |number: u8| GoalId([number; 16]);
        let goal =
            |number: u8, accepted_ns: i64, state| GoalRecord { id: id(number), accepted_ns, state };
        let goals = [
            goal(1, 10, GoalState::Executing),
            goal(2, 20, GoalState::Accepted),
            goal(3, 20, GoalState::Succeeded),
            goal(4, 30, GoalState::Canceling),
        ];
        let check = |number: u8, time_ns: i64, expected: &[u8], code: i8| {
            let goal_info = GoalInfo { goal_id: id(number).into(), stamp: Time::of_ns(time_ns) };
            let (meant, said) = goals_to_cancel(&CancelGoalRequest { goal_info }, &goals);
            let expected: Vec<GoalId> = expected.iter().map(|number| id(*number)).collect();
            assert_eq!((meant, said), (expected, code), "{number} {time_ns}");
        };
        check(0, 0, &[1, 2], 0);
        check(2, 0, &[2], 0);
        check(9, 0, &[], CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID);
        check(3, 0, &[], CancelGoalResponse::ERROR_GOAL_TERMINATED);
        check(4, 0, &[], CancelGoalResponse::ERROR_GOAL_TERMINATED);
        check(0, 10, &[1], 0);
        check(0, 9, &[], 0);
        check(2, 10, &[1, 2], 0);
        check(9, 30, &[1, 2], 0);
    }
}
