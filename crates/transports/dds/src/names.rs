//! DDS names of topics, services and types.
//!
//! Source: ROS 2's design article "Topic and Service name mapping to DDS", and the implementation
//! of `rmw`.

pub use periplus_transport::names::{message, type_of};

/// Purpose of a DDS topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// A topic of ROS.
    Topic,
    /// Requests of a service.
    Request,
    /// Responses of a service.
    Reply,
}

/// DDS topic of a ROS topic.
#[must_use]
pub fn topic(name: &str) -> String {
    format!("rt{name}")
}

/// DDS topics of a service: request and response.
#[must_use]
pub fn service(name: &str) -> (String, String) {
    (format!("rq{name}Request"), format!("rr{name}Reply"))
}

/// Purpose and ROS name of a DDS topic; none for topics outside ROS.
#[must_use]
pub fn of_ros(topic: &str) -> Option<(Use, &str)> {
    let (prefix, name) = topic.split_at_checked(2)?;
    let (kind, name) = match prefix {
        "rt" => (Use::Topic, name),
        "rq" => (Use::Request, name.strip_suffix("Request")?),
        "rr" => (Use::Reply, name.strip_suffix("Reply")?),
        _ => return None,
    };
    (name.len() > 1 && name.starts_with('/')).then_some((kind, name))
}

/// DDS types of a service: request and response.
#[must_use]
pub fn service_types(name: &str) -> (String, String) {
    (type_of(&format!("{name}_Request")), type_of(&format!("{name}_Response")))
}

/// Service type of the DDS type of its request or response.
#[must_use]
pub fn service_of(type_name: &str) -> Option<String> {
    let name = message(type_name)?;
    let name = name.strip_suffix("_Request").or_else(|| name.strip_suffix("_Response"))?;
    Some(name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_to_dds_and_back() {
        assert_eq!(topic("/demo/scan"), "rt/demo/scan");
        assert_eq!(of_ros("rt/demo/scan"), Some((Use::Topic, "/demo/scan")));
        let (request, reply) = service("/add");
        assert_eq!((&*request, &*reply), ("rq/addRequest", "rr/addReply"));
        assert_eq!(of_ros(&request), Some((Use::Request, "/add")));
        assert_eq!(of_ros(&reply), Some((Use::Reply, "/add")));
        let (request, reply) = service_types("std_srvs/srv/Trigger");
        assert_eq!(request, "std_srvs::srv::dds_::Trigger_Request_");
        assert_eq!(reply, "std_srvs::srv::dds_::Trigger_Response_");
        for name in [request, reply] {
            assert_eq!(service_of(&name).as_deref(), Some("std_srvs/srv/Trigger"));
        }
    }

    #[test]
    fn what_is_not_of_ros_is_let_alone() {
        for name in ["", "r", "rt", "rtscan", "rt/", "Square", "rq/add", "ros_discovery_info", "é"]
        {
            assert_eq!(of_ros(name), None, "{name}");
        }
        assert_eq!(service_of("sensor_msgs::msg::dds_::LaserScan_"), None);
    }
}
