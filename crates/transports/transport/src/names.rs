//! Type names of ROS 2 on networks, which are those of DDS.
//!
//! Source: the type names of `rosidl_typesupport_fastrtps` and `rmw_cyclonedds`.

/// Network name of a message type: `pkg::msg::dds_::T_` for `pkg/msg/T`.
#[must_use]
pub fn type_of(name: &str) -> String {
    let (path, last) = name.rsplit_once('/').unwrap_or(("", name));
    let path = path.replace('/', "::");
    if path.is_empty() { format!("dds_::{last}_") } else { format!("{path}::dds_::{last}_") }
}

/// Message type of a network name; none for types outside ROS.
#[must_use]
pub fn message(type_name: &str) -> Option<String> {
    let (path, last) = type_name.rsplit_once("::")?;
    let path = path.strip_suffix("dds_")?.strip_suffix("::")?;
    let last = last.strip_suffix('_')?;
    (path.split("::").all(is_word) && is_word(last))
        .then(|| format!("{}/{last}", path.replace("::", "/")))
}

/// True for a valid part of a type name: letters, digits and underscores, as in IDL and ROS.
fn is_word(part: &str) -> bool {
    !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_there_and_back() {
        let (ros, there) = ("sensor_msgs/msg/LaserScan", "sensor_msgs::msg::dds_::LaserScan_");
        assert_eq!(type_of(ros), there);
        assert_eq!(message(there).as_deref(), Some(ros));
        assert_eq!(type_of("std_srvs/srv/Trigger"), "std_srvs::srv::dds_::Trigger_");
    }

    #[test]
    fn what_is_not_of_ros_is_let_alone() {
        for name in ["", "ShapeType", "a::b", "::dds_::X_", "a::dds_::_", "dds_::X_"] {
            assert_eq!(message(name), None, "{name}");
        }
    }

    #[test]
    fn parts_that_are_no_words_would_not_come_back_the_same() {
        for name in ["a:::b::dds_::X_", "a::b/c::dds_::X_", "a:::dds_::X_", "a::dds_::X\0_"] {
            assert_eq!(message(name), None, "{name:?}");
        }
    }
}
