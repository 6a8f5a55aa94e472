//! Action server of ROS 1 with one running goal: the topics `goal`, `cancel`, `status`, `feedback` and `result`.
//!
//! A goal that arrives while another one runs is the next goal and requests preemption; the node accepts it, by which
//! the running one ends as preempted, or ends the running one itself.
//!
//! Source: `actionlib` (Noetic): `simple_action_server.h`, `action_server_base.h`, `server_goal_handle_imp.h`.

use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::actionlib_msgs::{GoalID, GoalStatus, GoalStatusArray};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::move_base_msgs::{
    MoveBaseActionFeedback, MoveBaseActionGoal, MoveBaseActionResult, MoveBaseFeedback,
    MoveBaseGoal, MoveBaseResult,
};
use periplus_msgs::std_msgs::Header;

/// Period of the status messages \[ns\].
pub(super) const STATUS_PERIOD_NS: i64 = 200_000_000;

/// Time for which a goal is in the status after its end \[ns\].
const STATUS_TIMEOUT_NS: i64 = 5_000_000_000;

const REPLACED: &str = "another goal replaced it";
const TOO_OLD: &str = "its stamp is before that of the last cancel request";

/// A goal and its state.
#[derive(Clone, Debug)]
struct TrackedGoal {
    id: GoalID,
    /// State by the numbers of [`GoalStatus`].
    status: u8,
    text: String,
    goal: MoveBaseGoal,
    /// Time of its end \[ns\].
    ended_ns: Option<i64>,
}

impl TrackedGoal {
    fn message(&self) -> GoalStatus {
        GoalStatus { goal_id: self.id.clone(), status: self.status, text: self.text.clone() }
    }
}

/// Action server of ROS 1.
pub(super) struct ActionServer {
    node_name: String,
    goals: Vec<TrackedGoal>,
    /// Id of the accepted goal.
    current: Option<String>,
    /// Id of the goal that waits.
    next: Option<String>,
    is_preempt_requested: bool,
    is_next_canceled: bool,
    last_cancel_ns: i64,
    /// Number of ids made for goals without one.
    id_count: u64,
    status: Publisher<GoalStatusArray>,
    feedback: Publisher<MoveBaseActionFeedback>,
    result: Publisher<MoveBaseActionResult>,
}

impl ActionServer {
    /// Creates the publishers of an action of a name.
    pub(super) fn new(node: &Node, action: &str) -> Result<Self, GraphError> {
        let qos = Qos::reliable(50);
        Ok(Self {
            node_name: node.full_name().to_owned(),
            goals: Vec::new(),
            current: None,
            next: None,
            is_preempt_requested: false,
            is_next_canceled: false,
            last_cancel_ns: 0,
            id_count: 0,
            status: node.publisher(&format!("{action}/status"), qos)?,
            feedback: node.publisher(&format!("{action}/feedback"), qos)?,
            result: node.publisher(&format!("{action}/result"), qos)?,
        })
    }

    fn find(&mut self, id: Option<&String>) -> Option<&mut TrackedGoal> {
        let id = id?;
        self.goals.iter_mut().find(|goal| goal.id.id == *id)
    }

    /// Receives a goal.
    pub(super) fn receive_goal(&mut self, message: &MoveBaseActionGoal, now_ns: i64) {
        let mut id = message.goal_id.clone();
        if self.goals.iter().any(|goal| goal.id.id == id.id) {
            if let Some(goal) = self.find(Some(&id.id))
                && goal.status == GoalStatus::RECALLING
            {
                self.end(&id.id, GoalStatus::RECALLED, TOO_OLD, now_ns);
            }
            return;
        }
        if id.id.is_empty() {
            self.id_count += 1;
            let time_s = now_ns as f64 * 1e-9;
            id.id = format!("{}-{}-{time_s:.9}", self.node_name, self.id_count);
        }
        let sent_ns = id.stamp.ns();
        if sent_ns == 0 {
            id.stamp = Time::of_ns(now_ns);
        }
        let name = id.id.clone();
        self.goals.push(TrackedGoal {
            id: id.clone(),
            status: GoalStatus::PENDING,
            text: String::new(),
            goal: message.goal.clone(),
            ended_ns: None,
        });
        if sent_ns != 0 && sent_ns <= self.last_cancel_ns {
            return self.end(&name, GoalStatus::RECALLED, TOO_OLD, now_ns);
        }
        let stamp_ns = id.stamp.ns();
        let is_newer =
            |goal: Option<&mut TrackedGoal>| goal.is_none_or(|goal| stamp_ns >= goal.id.stamp.ns());
        let (current, next) = (self.current.clone(), self.next.clone());
        if !is_newer(self.find(current.as_ref())) || !is_newer(self.find(next.as_ref())) {
            return self.end(&name, GoalStatus::RECALLED, REPLACED, now_ns);
        }
        if let Some(before) = self.next.replace(name) {
            self.end(&before, GoalStatus::RECALLED, REPLACED, now_ns);
        }
        self.is_next_canceled = false;
        self.is_preempt_requested |= self.current.is_some();
        self.publish_status(now_ns);
    }

    /// Receives a request to cancel: of one goal, of all before a time, or of all.
    pub(super) fn receive_cancel(&mut self, request: &GoalID, now_ns: i64) {
        let stamp_ns = request.stamp.ns();
        let is_meant = |goal: &TrackedGoal| {
            (request.id.is_empty() && stamp_ns == 0)
                || (!request.id.is_empty() && goal.id.id == request.id)
                || (stamp_ns != 0 && goal.id.stamp.ns() <= stamp_ns)
        };
        let is_known = self.goals.iter().any(|goal| goal.id.id == request.id);
        for goal in self.goals.iter_mut().filter(|goal| is_meant(goal)) {
            match goal.status {
                GoalStatus::PENDING => goal.status = GoalStatus::RECALLING,
                GoalStatus::ACTIVE => goal.status = GoalStatus::PREEMPTING,
                _ => continue,
            }
            if self.current.as_ref() == Some(&goal.id.id) {
                self.is_preempt_requested = true;
            } else if self.next.as_ref() == Some(&goal.id.id) {
                self.is_next_canceled = true;
            }
        }
        if !request.id.is_empty() && !is_known {
            // The goal may arrive later.
            self.goals.push(TrackedGoal {
                id: request.clone(),
                status: GoalStatus::RECALLING,
                text: String::new(),
                goal: MoveBaseGoal::default(),
                ended_ns: Some(now_ns),
            });
        }
        self.last_cancel_ns = self.last_cancel_ns.max(stamp_ns);
        self.publish_status(now_ns);
    }

    /// Returns true if a goal waits to be accepted.
    pub(super) fn has_new_goal(&self) -> bool {
        self.next.is_some()
    }

    /// Returns true if the current goal has to end: it was cancelled, or a new one waits.
    pub(super) fn is_preempt_requested(&self) -> bool {
        self.is_preempt_requested
    }

    /// Accepts the goal that waits; the current one ends as preempted.
    pub(super) fn accept_new_goal(&mut self, now_ns: i64) -> Option<MoveBaseGoal> {
        let next = self.next.take()?;
        if let Some(old) = self.current.take() {
            self.end(&old, GoalStatus::PREEMPTED, REPLACED, now_ns);
        }
        self.is_preempt_requested = std::mem::take(&mut self.is_next_canceled);
        self.current = Some(next.clone());
        let goal = self.find(Some(&next))?;
        let is_canceled = goal.status == GoalStatus::RECALLING;
        goal.status = if is_canceled { GoalStatus::PREEMPTING } else { GoalStatus::ACTIVE };
        "accepted".clone_into(&mut goal.text);
        let goal = goal.goal.clone();
        self.publish_status(now_ns);
        Some(goal)
    }

    /// Ends the current goal with success.
    pub(super) fn succeed(&mut self, text: &str, now_ns: i64) {
        self.end_current(GoalStatus::SUCCEEDED, text, now_ns);
    }

    /// Ends the current goal as failed.
    pub(super) fn abort(&mut self, text: &str, now_ns: i64) {
        self.end_current(GoalStatus::ABORTED, text, now_ns);
    }

    /// Ends the current goal as preempted.
    pub(super) fn preempt(&mut self, text: &str, now_ns: i64) {
        self.end_current(GoalStatus::PREEMPTED, text, now_ns);
    }

    fn end_current(&mut self, status: u8, text: &str, now_ns: i64) {
        self.is_preempt_requested = false;
        if let Some(current) = self.current.take() {
            self.end(&current, status, text, now_ns);
        }
    }

    /// Ends a goal and publishes its result.
    fn end(&mut self, id: &String, status: u8, text: &str, now_ns: i64) {
        let Some(goal) = self.find(Some(id)) else { return };
        goal.status = status;
        text.clone_into(&mut goal.text);
        goal.ended_ns = Some(now_ns);
        let result = MoveBaseActionResult {
            header: Header::at(now_ns, ""),
            status: goal.message(),
            result: MoveBaseResult::default(),
        };
        self.result.publish(result);
        self.publish_status(now_ns);
    }

    /// Publishes feedback on the current goal.
    pub(super) fn publish_feedback(&mut self, feedback: MoveBaseFeedback, now_ns: i64) {
        let current = self.current.clone();
        let Some(goal) = self.find(current.as_ref()) else { return };
        let status = goal.message();
        let header = Header::at(now_ns, "");
        self.feedback.publish(MoveBaseActionFeedback { header, status, feedback });
    }

    /// Publishes the states of all goals, and forgets those that ended some time ago.
    pub(super) fn publish_status(&mut self, now_ns: i64) {
        self.goals.retain(|goal| {
            goal.ended_ns
                .is_none_or(|ended_ns| (0..STATUS_TIMEOUT_NS).contains(&(now_ns - ended_ns)))
        });
        self.status.publish(GoalStatusArray {
            header: Header::at(now_ns, ""),
            status_list: self.goals.iter().map(TrackedGoal::message).collect(),
        });
    }

    /// Forgets all goals and times, after a jump of the clock.
    pub(super) fn forget(&mut self) {
        self.goals.clear();
        (self.current, self.next) = (None, None);
        (self.is_preempt_requested, self.is_next_canceled) = (false, false);
        self.last_cancel_ns = 0;
    }
}
