//! Command-line syntax of `parameter_bridge`.

use periplus_gz_transport::{BridgeDirection, TopicPair};

/// Queue size, the value of `ros_gz_bridge`.
pub(super) const QUEUE_DEPTH: usize = 10;

/// A topic or a service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Spec {
    Topic(TopicPair),
    Service(ServiceSpec),
}

/// Gazebo service to offer in ROS 2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ServiceSpec {
    pub(super) name: String,
    pub(super) ros_type: String,
    /// Gazebo types of request and response, if given.
    pub(super) gz_types: Option<[String; 2]>,
}

impl Spec {
    /// # Errors
    /// A message that names the syntax error.
    pub(super) fn read(word: &str) -> Result<Self, String> {
        let (name, types) = word.split_once('@').ok_or("missing `@` after the name")?;
        if name.is_empty() {
            return Err("missing name before the `@`".into());
        }
        // The order in which `parameter_bridge` searches.
        let found = ['@', '[', ']'].into_iter().find_map(|mark| {
            let (ros, gazebo) = types.split_once(mark)?;
            Some((mark, ros, gazebo))
        });
        if types.contains("/srv/") {
            let (ros_type, gz_types) = match found {
                None => (types, None),
                Some(('@', ros_type, rest)) => {
                    let (request, response) = rest
                        .split_once('@')
                        .ok_or("a service needs two Gazebo types: `@REQUEST@RESPONSE`")?;
                    (ros_type, Some([request.to_owned(), response.to_owned()]))
                }
                Some(_) => return Err("a service has no direction; write `@`".into()),
            };
            let (name, ros_type) = (name.to_owned(), ros_type.to_owned());
            return Ok(Self::Service(ServiceSpec { name, ros_type, gz_types }));
        }
        let (mark, ros_type, gz_type) =
            found.ok_or("missing `@`, `[` or `]` before the Gazebo type")?;
        if ros_type.is_empty() || gz_type.is_empty() {
            return Err("a type is missing".into());
        }
        Ok(Self::Topic(TopicPair {
            ros_topic: name.to_owned(),
            gz_topic: name.to_owned(),
            ros_type: ros_type.to_owned(),
            gz_type: gz_type.to_owned(),
            direction: match mark {
                '[' => BridgeDirection::ToRos,
                ']' => BridgeDirection::ToGazebo,
                _ => BridgeDirection::Both,
            },
            is_lazy: false,
            publisher_queue: QUEUE_DEPTH,
            subscriber_queue: QUEUE_DEPTH,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topic(word: &str) -> Option<(String, String, String, BridgeDirection)> {
        match Spec::read(word) {
            Ok(Spec::Topic(pair)) => {
                Some((pair.gz_topic, pair.ros_type, pair.gz_type, pair.direction))
            }
            _ => None,
        }
    }

    #[test]
    fn the_mark_says_the_direction() {
        for (mark, direction) in [
            ('@', BridgeDirection::Both),
            ('[', BridgeDirection::ToRos),
            (']', BridgeDirection::ToGazebo),
        ] {
            let word = format!("/lidar@sensor_msgs/msg/LaserScan{mark}gz.msgs.LaserScan");
            let (topic, ros, gazebo, found) = topic(&word).expect("a topic");
            assert_eq!((topic.as_str(), ros.as_str()), ("/lidar", "sensor_msgs/msg/LaserScan"));
            assert_eq!((gazebo.as_str(), found), ("gz.msgs.LaserScan", direction));
        }
    }

    #[test]
    fn services_have_srv_in_their_types() {
        let read = |word: &str| match Spec::read(word) {
            Ok(Spec::Service(service)) => Some(service),
            _ => None,
        };
        let bare = read("/world/w/control@ros_gz_interfaces/srv/ControlWorld").expect("one");
        assert_eq!(bare.gz_types, None);
        let told = read(
            "/world/w/control@ros_gz_interfaces/srv/ControlWorld@gz.msgs.WorldControl@gz.msgs.Boolean",
        );
        let types = told.and_then(|service| service.gz_types);
        assert_eq!(types, Some(["gz.msgs.WorldControl".into(), "gz.msgs.Boolean".into()]));
    }

    #[test]
    fn what_is_none_is_refused() {
        for word in [
            "",
            "/lidar",
            "/lidar@",
            "/lidar@sensor_msgs/msg/LaserScan",
            "@sensor_msgs/msg/LaserScan@gz.msgs.LaserScan",
            "/lidar@[gz.msgs.LaserScan",
            "/lidar@sensor_msgs/msg/LaserScan[",
            "/a@ros_gz_interfaces/srv/ControlWorld[gz.msgs.WorldControl",
            "/a@ros_gz_interfaces/srv/ControlWorld@gz.msgs.WorldControl",
        ] {
            assert!(Spec::read(word).is_err(), "{word}");
        }
    }
}
