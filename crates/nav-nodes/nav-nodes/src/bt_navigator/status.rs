//! Reason for which the robot moves or does not.

use std::fmt;

use periplus_behavior_tree::BehaviorTree;

/// Error that a server of the navigator answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServerError {
    /// Name of the action or service.
    pub server: String,
    /// Tree node that called it.
    pub tree_node: String,
    /// Error code of the result; 0 where the release has none.
    pub code: u16,
    /// Message of the result.
    pub message: String,
}

impl fmt::Display for ServerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.code, self.message.is_empty()) {
            (0, true) => write!(f, "{} failed", self.server),
            (0, false) => write!(f, "{} failed: {}", self.server, self.message),
            (code, true) => write!(f, "{} failed with code {code}", self.server),
            (code, false) => write!(f, "{} failed with code {code}: {}", self.server, self.message),
        }
    }
}

/// Activity of the navigator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NavigatorStatus {
    /// Action that is being executed.
    pub action: Option<String>,
    /// ID of its tree.
    pub tree: String,
    /// Names of the tree nodes that are running, in the order of the tree.
    pub running: Vec<String>,
    /// Number of recoveries since the goal was received.
    pub recoveries: i64,
    /// Error that a server answered last, until that server succeeds.
    pub last_error: Option<ServerError>,
    /// Outcome of the last goal, in words; empty before the first one.
    pub last_outcome: String,
}

impl NavigatorStatus {
    pub(super) fn of_tree(action: &str, tree: &BehaviorTree) -> Self {
        let name = |leaf: periplus_behavior_tree::TreeNodeInfo| match *leaf.name == *leaf.type_name
        {
            true => leaf.name.to_string(),
            false => format!("{} ({})", leaf.type_name, leaf.name),
        };
        let recoveries = tree.blackboard().get("number_recoveries");
        Self {
            action: Some(action.to_owned()),
            tree: tree.id().to_owned(),
            running: tree.running_leaves().map(name).collect(),
            recoveries: recoveries.and_then(|value| value.as_i64()).unwrap_or_default(),
            ..Self::default()
        }
    }
}

impl fmt::Display for NavigatorStatus {
    /// One sentence, such as `navigate_to_pose: Spin (2 recoveries); last error: ...`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.action {
            None if self.last_outcome.is_empty() => f.write_str("no goal")?,
            None => write!(f, "no goal; {}", self.last_outcome)?,
            Some(action) => {
                let running = match &self.running[..] {
                    [] => "between two steps".to_owned(),
                    running => running.join(", "),
                };
                write!(f, "{action}: {running}")?;
                match self.recoveries {
                    0 => {}
                    1 => f.write_str(" (1 recovery)")?,
                    count => write!(f, " ({count} recoveries)")?,
                }
            }
        }
        match &self.last_error {
            Some(error) => write!(f, "; last error: {error}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_a_sentence() {
        let error = ServerError {
            server: "compute_path_to_pose".into(),
            tree_node: "ComputePathToPose".into(),
            code: 206,
            message: "the goal is occupied".into(),
        };
        let status = NavigatorStatus {
            action: Some("navigate_to_pose".into()),
            running: vec!["Spin".into()],
            recoveries: 2,
            last_error: Some(error),
            ..NavigatorStatus::default()
        };
        let expected = "navigate_to_pose: Spin (2 recoveries); last error: compute_path_to_pose \
            failed with code 206: the goal is occupied";
        assert_eq!(status.to_string(), expected);
        assert_eq!(NavigatorStatus::default().to_string(), "no goal");
    }
}
