//! Goals of navigation and what became of them.

use std::collections::BTreeMap;

use periplus_bags::BagTopic;
use periplus_msgs::Message;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::{action_msgs, actionlib_msgs};

use super::{Mark, MarkKind};

/// Last parts of the names of goal topics: RViz, `move_base`, others.
const GOAL_NAMES: [&str; 3] = ["goal_pose", "goal", "goal_update"];

/// Actions with which navigation works off a goal; they are no goals of the user.
const INNER_ACTIONS: [&str; 9] = [
    "compute_path_to_pose",
    "compute_path_through_poses",
    "follow_path",
    "smooth_path",
    "spin",
    "backup",
    "drive_on_heading",
    "assisted_teleop",
    "wait",
];

/// Maximum number of goals whose state is known.
const MAX_GOALS: usize = 1000;

/// Goals of a topic.
pub(in super::super) struct GoalMarks;

impl GoalMarks {
    pub(super) fn new(topic: &BagTopic) -> Option<Self> {
        let last_part = topic.name.rsplit('/').next().unwrap_or_default();
        let is_goal = topic.type_name == PoseStamped::TYPE_NAME && GOAL_NAMES.contains(&last_part);
        is_goal.then_some(Self)
    }

    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        let Ok(goal) = PoseStamped::decode_cdr(data) else { return Vec::new() };
        let (at, frame) = (&goal.pose.position, &goal.header.frame_id);
        let text = format!("({:.2}, {:.2}) m in `{frame}`", at.x, at.y);
        vec![Mark::new(time_ns, MarkKind::Goal, text)]
    }
}

/// State of a goal in the terms of all versions of ROS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GoalState {
    Waiting,
    Active,
    Reached,
    Aborted,
    Canceled,
}

/// Goals of an action.
pub(in super::super) struct ActionMarks {
    action: String,
    is_ros1: bool,
    states: BTreeMap<Vec<u8>, GoalState>,
}

impl ActionMarks {
    pub(super) fn new(topic: &BagTopic) -> Option<Self> {
        let is_ros1 = match topic.type_name.as_str() {
            action_msgs::GoalStatusArray::TYPE_NAME => false,
            actionlib_msgs::GoalStatusArray::TYPE_NAME => true,
            _ => return None,
        };
        let ending = if is_ros1 { "/status" } else { "/_action/status" };
        let action = topic.name.strip_suffix(ending)?;
        let last_part = action.rsplit('/').next().unwrap_or_default();
        let is_goal = !INNER_ACTIONS.contains(&last_part);
        is_goal.then(|| Self { action: last_part.to_owned(), is_ros1, states: BTreeMap::new() })
    }

    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        let goals = if self.is_ros1 { ros1_goals(data) } else { ros2_goals(data) };
        // Servers list old goals for a while; those that are not listed any more are forgotten.
        if self.states.len() > MAX_GOALS {
            self.states.retain(|id, _| goals.iter().any(|(other, _)| other == id));
        }
        let mut marks = Vec::new();
        for (id, state) in goals {
            let before = self.states.insert(id, state);
            if before == Some(state) {
                continue;
            }
            let is_new = before.is_none_or(|before| before == GoalState::Waiting);
            let found = match state {
                GoalState::Active if is_new => Some((MarkKind::Goal, "accepted")),
                GoalState::Waiting | GoalState::Active => None,
                GoalState::Reached => Some((MarkKind::GoalReached, "reached")),
                GoalState::Aborted => Some((MarkKind::GoalAborted, "aborted")),
                GoalState::Canceled => Some((MarkKind::GoalCanceled, "canceled")),
            };
            let mark = |(kind, what)| Mark::new(time_ns, kind, format!("{}: {what}", self.action));
            marks.extend(found.map(mark));
        }
        marks
    }
}

fn ros2_goals(data: &[u8]) -> Vec<(Vec<u8>, GoalState)> {
    use action_msgs::GoalStatus;
    let Ok(message) = action_msgs::GoalStatusArray::decode_cdr(data) else { return Vec::new() };
    let state = |status: i8| match status {
        GoalStatus::STATUS_ACCEPTED
        | GoalStatus::STATUS_EXECUTING
        | GoalStatus::STATUS_CANCELING => GoalState::Active,
        GoalStatus::STATUS_SUCCEEDED => GoalState::Reached,
        GoalStatus::STATUS_CANCELED => GoalState::Canceled,
        GoalStatus::STATUS_ABORTED => GoalState::Aborted,
        _ => GoalState::Waiting,
    };
    let goals = message.status_list.into_iter();
    goals.map(|one| (one.goal_info.goal_id.uuid.to_vec(), state(one.status))).collect()
}

fn ros1_goals(data: &[u8]) -> Vec<(Vec<u8>, GoalState)> {
    use actionlib_msgs::GoalStatus;
    let Ok(message) = actionlib_msgs::GoalStatusArray::decode_cdr(data) else { return Vec::new() };
    let state = |status: u8| match status {
        GoalStatus::ACTIVE | GoalStatus::PREEMPTING => GoalState::Active,
        GoalStatus::SUCCEEDED => GoalState::Reached,
        GoalStatus::PREEMPTED | GoalStatus::RECALLED => GoalState::Canceled,
        GoalStatus::ABORTED | GoalStatus::REJECTED | GoalStatus::LOST => GoalState::Aborted,
        _ => GoalState::Waiting,
    };
    let goals = message.status_list.into_iter();
    goals.map(|one| (one.goal_id.id.into_bytes(), state(one.status))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topic(name: &str, type_name: &str) -> BagTopic {
        BagTopic {
            name: name.into(),
            type_name: type_name.into(),
            encoding: "cdr".into(),
            schema_encoding: String::new(),
            schema: Vec::new(),
            metadata: BTreeMap::new(),
        }
    }

    fn status(statuses: &[(u8, i8)]) -> Vec<u8> {
        let mut message = action_msgs::GoalStatusArray::default();
        for (goal, status) in statuses {
            let mut one = action_msgs::GoalStatus { status: *status, ..Default::default() };
            one.goal_info.goal_id.uuid[0] = *goal;
            message.status_list.push(one);
        }
        message.to_cdr().unwrap()
    }

    #[test]
    fn each_change_of_a_goal_is_one_mark() {
        let name = "/navigate_to_pose/_action/status";
        let topic = topic(name, action_msgs::GoalStatusArray::TYPE_NAME);
        let mut marks = ActionMarks::new(&topic).expect("an action");
        let mut kinds = |statuses: &[(u8, i8)]| -> Vec<MarkKind> {
            marks.detect(0, &status(statuses)).into_iter().map(|mark| mark.kind).collect()
        };
        assert_eq!(kinds(&[(1, 1)]), [MarkKind::Goal]);
        assert_eq!(kinds(&[(1, 2)]), []);
        assert_eq!(kinds(&[(1, 6), (2, 2)]), [MarkKind::GoalAborted, MarkKind::Goal]);
        assert_eq!(kinds(&[(1, 6), (2, 4)]), [MarkKind::GoalReached]);
        assert_eq!(kinds(&[(1, 6), (2, 4), (3, 5)]), [MarkKind::GoalCanceled]);
    }

    #[test]
    fn inner_actions_are_no_goals() {
        let new = |name| ActionMarks::new(&topic(name, action_msgs::GoalStatusArray::TYPE_NAME));
        assert!(new("/follow_path/_action/status").is_none());
        assert!(new("/robot/follow_waypoints/_action/status").is_some());
        assert!(new("/status").is_none());
        let old = topic("/move_base/status", actionlib_msgs::GoalStatusArray::TYPE_NAME);
        assert!(ActionMarks::new(&old).is_some());
    }

    #[test]
    fn poses_on_goal_topics_are_goals() {
        assert!(GoalMarks::new(&topic("/move_base_simple/goal", PoseStamped::TYPE_NAME)).is_some());
        assert!(GoalMarks::new(&topic("/goal_pose", "std_msgs/msg/String")).is_none());
        assert!(GoalMarks::new(&topic("/pose", PoseStamped::TYPE_NAME)).is_none());
        let mut goal = PoseStamped::default();
        (goal.pose.position.x, goal.header.frame_id) = (1.5, "map".into());
        let marks = GoalMarks.detect(3, &goal.to_cdr().unwrap());
        assert_eq!(marks, [Mark::new(3, MarkKind::Goal, "(1.50, 0.00) m in `map`")]);
    }
}
