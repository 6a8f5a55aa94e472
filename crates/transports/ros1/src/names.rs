//! Names and types: ROS 1 beside ROS 2.

use periplus_msgs::TypeRegistry;
use periplus_rosidl::{InterfaceKind, TypeName};

/// Packages of ROS 2 without equivalent in ROS 1: their types are not offered.
const ROS2_PACKAGES: [&str; 10] = [
    "action_msgs",
    "builtin_interfaces",
    "example_interfaces",
    "lifecycle_msgs",
    "nav2_msgs",
    "rcl_interfaces",
    "ros_gz_interfaces",
    "service_msgs",
    "type_description_interfaces",
    "unique_identifier_msgs",
];

/// Messages with another type in ROS 1: ROS 2, ROS 1.
const OTHER_TYPES: [(&str, &str); 1] = [("rcl_interfaces/msg/Log", "rosgraph_msgs/Log")];

/// Types that older ROS 1 programs use for the same bytes: ROS 1, ROS 2.
const OLD_TYPES: [(&str, &str); 1] = [("tf/tfMessage", "tf2_msgs/msg/TFMessage")];

/// Type in ROS 1 of a message or service, such as `sensor_msgs/LaserScan`; none if ROS 1 has no equivalent.
#[must_use]
pub fn ros1_type(ros2: &str) -> Option<String> {
    if let Some((_, ros1)) = OTHER_TYPES.iter().find(|(two, _)| *two == ros2) {
        return Some((*ros1).to_owned());
    }
    let name = TypeName::read(ros2)?;
    let is_offered =
        name.kind != InterfaceKind::Action && !ROS2_PACKAGES.contains(&name.package.as_str());
    is_offered.then(|| name.short())
}

/// Type in ROS 2 of a message of ROS 1, such as `sensor_msgs/msg/LaserScan`; none if the text is no type.
#[must_use]
pub fn ros2_type(ros1: &str) -> Option<String> {
    if let Some((two, _)) = OTHER_TYPES.iter().find(|(_, one)| *one == ros1) {
        return Some((*two).to_owned());
    }
    if let Some((_, two)) = OLD_TYPES.iter().find(|(one, _)| *one == ros1) {
        return Some((*two).to_owned());
    }
    Some(TypeName::read(ros1)?.to_string())
}

/// Type in ROS 2 of a service of ROS 1, such as `std_srvs/srv/Trigger`; none if the text is no type.
#[must_use]
pub fn ros2_service_type(ros1: &str) -> Option<String> {
    let name = TypeName::read(ros1)?;
    Some(TypeName { kind: InterfaceKind::Service, ..name }.to_string())
}

/// Definition of a message of ROS 1 as its connections state it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ros1Type {
    /// Type, such as `sensor_msgs/LaserScan`.
    pub name: String,
    /// MD5 sum.
    pub md5: String,
    /// Definition with all nested types; empty for services.
    pub definition: String,
}

/// Definition of a message by its type in ROS 1; none if it is unknown.
#[must_use]
pub fn message_definition(ros1: &str) -> Option<Ros1Type> {
    let text = TypeRegistry::ros1().registry().ros1_text(&TypeName::read(ros1)?)?;
    Some(Ros1Type { name: ros1.to_owned(), md5: text.md5, definition: text.text })
}

/// Definition of a service by its type in ROS 1; none if it is unknown.
#[must_use]
pub fn service_definition(ros1: &str) -> Option<Ros1Type> {
    let name = TypeName { kind: InterfaceKind::Service, ..TypeName::read(ros1)? };
    let md5 = TypeRegistry::ros1().registry().ros1_service_md5(&name)?;
    Some(Ros1Type { name: ros1.to_owned(), md5, definition: String::new() })
}

/// Name of a node as ROS 1 allows it: without leading underscores.
#[must_use]
pub fn node_name(graph: &str) -> String {
    let parts = graph.split('/').map(|part| part.trim_start_matches('_'));
    parts.collect::<Vec<_>>().join("/")
}

/// Resolves a name of the parameter server against the namespace of its caller: `~a` is private, `a` relative, `/a`
/// global. Slashes are neither doubled nor trailing.
pub(crate) fn resolve(name: &str, caller: &str) -> String {
    let full = if name.starts_with('/') {
        name.to_owned()
    } else if let Some(private) = name.strip_prefix('~') {
        format!("{caller}/{private}")
    } else {
        let namespace = caller.rsplit_once('/').map_or("", |(namespace, _)| namespace);
        format!("{namespace}/{name}")
    };
    let parts = full.split('/').filter(|part| !part.is_empty());
    parts.fold(String::new(), |name, part| name + "/" + part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_have_their_names_in_both() {
        assert_eq!(
            ros1_type("sensor_msgs/msg/LaserScan").as_deref(),
            Some("sensor_msgs/LaserScan")
        );
        assert_eq!(ros1_type("std_srvs/srv/Empty").as_deref(), Some("std_srvs/Empty"));
        assert_eq!(ros1_type("rcl_interfaces/msg/Log").as_deref(), Some("rosgraph_msgs/Log"));
        assert_eq!(ros1_type("rcl_interfaces/msg/ParameterEvent"), None);
        assert_eq!(ros1_type("nav2_msgs/action/Wait"), None);
        assert_eq!(ros2_type("tf/tfMessage").as_deref(), Some("tf2_msgs/msg/TFMessage"));
        assert_eq!(ros2_type("std_msgs/String").as_deref(), Some("std_msgs/msg/String"));
        assert_eq!(ros2_service_type("std_srvs/Empty").as_deref(), Some("std_srvs/srv/Empty"));
    }

    #[test]
    fn sums_are_those_of_ros_noetic() {
        // As `rosmsg md5` and `rossrv md5` of Noetic print them.
        let message = |name: &str| message_definition(name).expect("a known type").md5;
        assert_eq!(message("std_msgs/String"), "992ce8a1687cec8c8bd883ec73ca41d1");
        assert_eq!(message("sensor_msgs/LaserScan"), "90c7ef2dc6895d81024acba2ac42f369");
        assert_eq!(message("rosgraph_msgs/Log"), "acffd30cd6b6de30f120938c17c593fb");
        assert_eq!(message("rosgraph_msgs/Clock"), "a9c97c1d230cfc112e270351a944ee47");
        let service = |name: &str| service_definition(name).expect("a known type").md5;
        assert_eq!(service("std_srvs/Empty"), "d41d8cd98f00b204e9800998ecf8427e");
        assert_eq!(service("std_srvs/Trigger"), "937c9679a518e3a18d831e57125ea522");
        assert_eq!(service("nav_msgs/GetMap"), "6cdd0a18e0aff5b0a3ca2326a89b54ff");
    }

    #[test]
    fn names_are_resolved_as_ros_does() {
        assert_eq!(resolve("a", "/ns/node"), "/ns/a");
        assert_eq!(resolve("~a", "/ns/node"), "/ns/node/a");
        assert_eq!(resolve("/a//b/", "/node"), "/a/b");
        assert_eq!(resolve("/", "/node"), "");
        assert_eq!(node_name("/_periplus_cli_7"), "/periplus_cli_7");
    }
}
