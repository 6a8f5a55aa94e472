//! Actions: long-running tasks with feedback and cancellation.
//!
//! An action `name` is three services and two topics: `name/_action/send_goal`, `cancel_goal`,
//! `get_result`, and `feedback`, `status`. Source: ROS 2's design article "Actions",
//! `rcl_action/action_server.c` and `rclcpp_action/server.cpp`.

mod cancel;
mod client;
mod dynamic;
mod goal;
mod info;
mod server;
mod table;

pub use client::{ActionClient, GoalProgress, SentGoal};
pub use dynamic::{DynamicActionClient, DynamicGoal, DynamicProgress};
pub use goal::{GoalEvent, GoalId, GoalState};
pub use info::ActionInfo;
pub use server::{ActionServer, ActionSettings, GoalHandle, NewGoal};

use crate::node::Node;
use crate::{GraphError, Qos};

/// QoS of the status topic.
const STATUS_QOS: Qos = Qos::latched(1);

/// QoS of the feedback topic.
const FEEDBACK_QOS: Qos = Qos::reliable(10);

/// Full names of the services and topics of an action.
pub(crate) struct Names {
    pub(crate) action: String,
}

impl Names {
    fn new(node: &Node, action: &str) -> Result<Self, GraphError> {
        Ok(Self { action: node.names().topic(action)? })
    }

    fn end(&self, end: &str) -> String {
        format!("{}/_action/{end}", self.action)
    }
}
