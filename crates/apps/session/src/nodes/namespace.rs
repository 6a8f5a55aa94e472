//! Namespaces of the nodes beside a robot.

use periplus_graph::{Graph, GraphError, Node, NodeSettings};

/// Topics of transforms, of which each robot in a namespace has its own.
const TRANSFORM_TOPICS: [&str; 2] = ["/tf", "/tf_static"];

/// Name of the map of all robots.
const MAP_TOPIC: &str = "/map";

/// Namespace of the nodes beside a robot, as the launch files of Nav2 for several robots set it: topics, actions and
/// transforms of a robot are within it, under the names that they have for a single robot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RobotNamespace {
    /// With a slash at the start and none at the end; empty for the root.
    prefix: String,
    shares_map: bool,
}

impl RobotNamespace {
    /// Namespace of this name; `/` and the empty text are the root.
    #[must_use]
    pub fn new(namespace: &str) -> Self {
        let name = namespace.trim_matches('/');
        let prefix = if name.is_empty() { String::new() } else { format!("/{name}") };
        Self { prefix, shares_map: false }
    }

    /// The same namespace with `/map` as the map of its robot.
    #[must_use]
    pub fn sharing_map(self) -> Self {
        Self { shares_map: true, ..self }
    }

    /// True for the namespace of a single robot.
    #[must_use]
    pub fn is_root(&self) -> bool {
        self.prefix.is_empty()
    }

    /// Name without slashes; empty for the root.
    #[must_use]
    pub fn name(&self) -> &str {
        self.prefix.trim_start_matches('/')
    }

    /// Full name of a topic of the robot, written without a slash.
    #[must_use]
    pub fn topic(&self, name: &str) -> String {
        format!("{}/{name}", self.prefix)
    }

    /// True if a full name is within the namespace.
    #[must_use]
    pub fn contains(&self, name: &str) -> bool {
        name.strip_prefix(&self.prefix).is_some_and(|rest| rest.starts_with('/'))
    }

    /// Settings of a node of the robot.
    #[must_use]
    pub fn settings(&self, node: &str) -> NodeSettings {
        self.with_rules(NodeSettings::new(node).namespace(&self.prefix))
    }

    /// Adds the remappings of the robot to a node that is within its namespace.
    #[must_use]
    pub fn with_rules(&self, mut settings: NodeSettings) -> NodeSettings {
        if self.is_root() {
            return settings;
        }
        for topic in TRANSFORM_TOPICS {
            settings = settings.remap(topic, &format!("{}{topic}", self.prefix));
        }
        if self.shares_map {
            settings = settings.remap(&format!("{}{MAP_TOPIC}", self.prefix), MAP_TOPIC);
        }
        settings
    }

    /// Creates a node of the robot.
    ///
    /// # Errors
    /// When the graph has a node of this name.
    pub fn node(&self, graph: &Graph, name: &str) -> Result<Node, GraphError> {
        graph.node(self.settings(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(namespace: &RobotNamespace, topic: &str, expected: &str) {
        let names = namespace.settings("amcl").names().unwrap();
        assert_eq!(names.topic(topic).unwrap(), expected);
    }

    #[test]
    fn a_robot_has_its_own_transforms() {
        let robot = RobotNamespace::new("robot_3/");
        check(&robot, "/tf", "/robot_3/tf");
        check(&robot, "scan", "/robot_3/scan");
        check(&robot, "map", "/robot_3/map");
        check(&robot, "/clock", "/clock");
        check(&robot.sharing_map(), "map", "/map");
    }

    #[test]
    fn a_single_robot_has_the_usual_names() {
        for root in ["/", ""].map(RobotNamespace::new) {
            check(&root, "/tf", "/tf");
            check(&root, "scan", "/scan");
            assert!(root.contains("/robot_3/scan") && root.is_root());
        }
    }

    #[test]
    fn a_name_that_only_begins_alike_is_outside() {
        let robot = RobotNamespace::new("/robot_1");
        assert!(robot.contains("/robot_1/scan"));
        assert!(!robot.contains("/robot_10/scan") && !robot.contains("/robot_1"));
    }
}
