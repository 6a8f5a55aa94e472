//! Message conversion between ROS and Gazebo.

use std::any::TypeId;
use std::marker::PhantomData;

use periplus_graph::{EndpointId, GraphError, Node, Publisher, Qos, Sample};
use periplus_gz_msgs::{AsRos, Dialect, ImuFortress, Message, Pairs, bare_name, each_pair};
use periplus_msgs::Message as RosMessage;

/// Conversion between a ROS type and the equivalent Gazebo type.
pub(crate) trait Convert: Send + Sync {
    /// Encodes a ROS message for Gazebo; none if Gazebo has no equivalent value.
    fn to_gazebo(&self, sample: &Sample) -> Option<Vec<u8>>;

    /// Creates a publisher in the graph for messages of Gazebo.
    fn feed(&self, node: &Node, topic: &str, qos: Qos) -> Result<Box<dyn Feed>, GraphError>;
}

/// Publishes messages of Gazebo in a graph.
pub(crate) trait Feed: Send + Sync {
    /// Publishes a message; false if it has no equivalent in ROS.
    fn take(&self, bytes: &[u8]) -> bool;
    fn is_heard(&self) -> bool;
    fn id(&self) -> EndpointId;
}

struct Converts<R, G>(PhantomData<fn() -> (R, G)>);

impl<R: RosMessage, G: AsRos<R>> Convert for Converts<R, G> {
    fn to_gazebo(&self, sample: &Sample) -> Option<Vec<u8>> {
        let ros = sample.message::<R>().ok()?;
        Some(G::from_ros(&ros)?.encode())
    }

    fn feed(&self, node: &Node, topic: &str, qos: Qos) -> Result<Box<dyn Feed>, GraphError> {
        let publisher = node.publisher::<R>(topic, qos)?;
        Ok(Box::new(Feeds::<R, G> { publisher, of: PhantomData }))
    }
}

struct Feeds<R, G> {
    publisher: Publisher<R>,
    of: PhantomData<fn() -> G>,
}

impl<R: RosMessage, G: AsRos<R>> Feed for Feeds<R, G> {
    fn take(&self, bytes: &[u8]) -> bool {
        let ros = G::decode(bytes).ok().and_then(|message| message.to_ros());
        let is_sound = ros.is_some();
        if let Some(ros) = ros {
            self.publisher.publish(ros);
        }
        is_sound
    }

    fn is_heard(&self) -> bool {
        self.publisher.is_heard()
    }

    fn id(&self) -> EndpointId {
        self.publisher.id()
    }
}

/// True if the name is that of the type, with or without `msg` in the middle (ROS 1).
fn is_ros(name: &str, wanted: &str) -> bool {
    name == wanted || name.replace("/msg/", "/") == wanted
}

/// True if the full name is that of the Gazebo type.
fn is_gazebo<G: Message>(wanted: &str) -> bool {
    let is_fortress = Dialect::of(wanted) == Some(Dialect::Ignition);
    let is_layout = match TypeId::of::<G>() {
        id if id == TypeId::of::<ImuFortress>() => is_fortress,
        _ => G::NAME != "IMU" || !is_fortress,
    };
    bare_name(wanted) == Some(G::NAME) && is_layout
}

/// Returns the conversion between a ROS type and a Gazebo type by their full names, with the ROS 2
/// spelling of the former.
pub(crate) fn between(ros: &str, gazebo: &str) -> Option<(&'static str, Box<dyn Convert>)> {
    struct Find<'a> {
        ros: &'a str,
        gazebo: &'a str,
        found: Option<(&'static str, Box<dyn Convert>)>,
    }
    impl Pairs for Find<'_> {
        fn pair<R: RosMessage, G: AsRos<R>>(&mut self) {
            if is_ros(R::TYPE_NAME, self.ros) && is_gazebo::<G>(self.gazebo) {
                self.found = Some((R::TYPE_NAME, Box::new(Converts::<R, G>(PhantomData))));
            }
        }
    }
    let mut find = Find { ros, gazebo, found: None };
    each_pair(&mut find);
    find.found
}

/// Gazebo types that a ROS type can be converted to, without release prefixes; the default first.
#[must_use]
pub fn gazebo_types(ros: &str) -> Vec<&'static str> {
    struct Collect<'a>(&'a str, Vec<&'static str>);
    impl Pairs for Collect<'_> {
        fn pair<R: RosMessage, G: AsRos<R>>(&mut self) {
            if is_ros(R::TYPE_NAME, self.0) && !self.1.contains(&G::NAME) {
                self.1.push(G::NAME);
            }
        }
    }
    let mut collect = Collect(ros, Vec::new());
    each_pair(&mut collect);
    collect.1
}

/// ROS types that a Gazebo type, given by its full name, can be converted to.
#[must_use]
pub fn ros_types(gazebo: &str) -> Vec<&'static str> {
    struct Collect<'a>(&'a str, Vec<&'static str>);
    impl Pairs for Collect<'_> {
        fn pair<R: RosMessage, G: AsRos<R>>(&mut self) {
            if is_gazebo::<G>(self.0) {
                self.1.push(R::TYPE_NAME);
            }
        }
    }
    let mut collect = Collect(gazebo, Vec::new());
    each_pair(&mut collect);
    collect.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_found_by_all_their_names() {
        for ros in ["sensor_msgs/msg/LaserScan", "sensor_msgs/LaserScan"] {
            for gazebo in ["gz.msgs.LaserScan", "ignition.msgs.LaserScan"] {
                let found = between(ros, gazebo).map(|(name, _)| name);
                assert_eq!(found, Some("sensor_msgs/msg/LaserScan"));
            }
        }
        assert!(between("sensor_msgs/msg/LaserScan", "gz.msgs.Twist").is_none());
        assert!(between("sensor_msgs/msg/LaserScan", "LaserScan").is_none());
    }

    #[test]
    fn what_a_type_can_be_is_listed_the_usual_first() {
        assert_eq!(gazebo_types("nav_msgs/msg/Odometry"), ["Odometry", "OdometryWithCovariance"]);
        assert_eq!(gazebo_types("sensor_msgs/msg/Imu"), ["IMU"]);
        assert_eq!(ros_types("gz.msgs.IMU"), ["sensor_msgs/msg/Imu"]);
        assert_eq!(ros_types("ignition.msgs.IMU"), ["sensor_msgs/msg/Imu"]);
        assert_eq!(
            ros_types("gz.msgs.Pose_V"),
            ["geometry_msgs/msg/PoseArray", "tf2_msgs/msg/TFMessage"]
        );
        assert!(ros_types("gz.msgs.Unheard").is_empty());
    }
}
