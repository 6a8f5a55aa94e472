//! Odometry messages and transforms.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_graph::{Node, Publisher, Qos};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{geometry_msgs, nav_msgs, tf2_msgs};

use super::geometry;
use crate::drives::BuildContext;
use crate::publisher_qos;

/// Variance of height, roll and pitch in Gazebo's plugins: unknown.
const UNKNOWN: f64 = 1e12;

/// QoS of transforms, as in `tf2_ros`.
pub(crate) const TF_QOS: Qos = Qos::reliable(100);

/// Returns the diagonal covariance matrix of variances: x, y, z, roll, pitch, yaw.
pub(crate) fn diagonal(variances: [f64; 6]) -> [f64; 36] {
    let mut covariance = [0.0; 36];
    for (index, variance) in variances.into_iter().enumerate() {
        covariance[index * 7] = variance;
    }
    covariance
}

/// Returns the covariance of a robot in the plane.
pub(crate) fn planar_covariance(x_m2: f64, y_m2: f64, yaw_rad2: f64) -> [f64; 36] {
    diagonal([x_m2, y_m2, UNKNOWN, UNKNOWN, UNKNOWN, yaw_rad2])
}

/// Publishes the pose between two frames as odometry and transform.
pub(crate) struct OdometryPublisher {
    pub(crate) parent_frame: String,
    pub(crate) child_frame: String,
    pub(crate) pose_covariance: [f64; 36],
    pub(crate) twist_covariance: [f64; 36],
    pub(crate) odometry: Option<Publisher<nav_msgs::Odometry>>,
    pub(crate) tf: Option<Publisher<tf2_msgs::TFMessage>>,
}

impl OdometryPublisher {
    /// Creates a publisher without covariances and topics.
    pub(crate) fn between(parent_frame: String, child_frame: String) -> Self {
        Self {
            parent_frame,
            child_frame,
            pose_covariance: [0.0; 36],
            twist_covariance: [0.0; 36],
            odometry: None,
            tf: None,
        }
    }

    /// Creates the publisher of a drive of `gazebo_ros` for ROS 2, from its parameters.
    pub(crate) fn of_gazebo_ros(
        context: &BuildContext<'_>,
        node: &Node,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let frames = ["odometry_frame", "robot_base_frame"].map(|name| context.text(name));
        let [parent_frame, child_frame] = frames;
        let mut publisher = Self::between(parent_frame, child_frame);
        let variances =
            ["covariance_x", "covariance_y", "covariance_yaw"].map(|name| context.number(name));
        publisher.pose_covariance = planar_covariance(variances[0], variances[1], variances[2]);
        publisher.twist_covariance = publisher.pose_covariance;
        if context.flag("publish_odom") {
            publisher = publisher.on(context, node, "odom", diagnostics)?;
        }
        if context.flag("publish_odom_tf") {
            publisher = publisher.with_tf(context, node, "/tf", diagnostics)?;
        }
        Some(publisher)
    }

    /// Adds a topic of odometry.
    pub(crate) fn on(
        mut self,
        context: &BuildContext<'_>,
        node: &Node,
        topic: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let qos = publisher_qos(&context.plugin.ros, topic, Qos::reliable(1));
        self.odometry = Some(context.accept(node.publisher(topic, qos), diagnostics)?);
        Some(self)
    }

    /// Adds a topic of transforms.
    pub(crate) fn with_tf(
        mut self,
        context: &BuildContext<'_>,
        node: &Node,
        topic: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        self.tf = Some(context.accept(node.publisher(topic, TF_QOS), diagnostics)?);
        Some(self)
    }

    /// Adds a topic of transforms of Gazebo, unless it is `/tf` and the launch file's bridges leave it out: then
    /// another node, such as an odometry filter, publishes these transforms.
    pub(crate) fn with_gz_tf(
        self,
        context: &BuildContext<'_>,
        node: &Node,
        topic: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        if topic != "/tf" || context.setting.bridges_transforms {
            return self.with_tf(context, node, topic, diagnostics);
        }
        let name = &context.site.plugin.name;
        let message = format!("the transforms of plugin `{name}` on `/tf` are not bridged to ROS");
        let hint = Diagnostic::hint("tf-not-bridged", message).at(context.origin());
        let help = "another node must publish them, such as the `ekf_node` of robot_localization; or add `/tf` to \
                    the bridge, of type `tf2_msgs/msg/TFMessage` and `gz.msgs.Pose_V`";
        diagnostics.push(hint.help(help));
        Some(self)
    }

    /// Returns true if any topic has subscribers.
    pub(crate) fn has_subscribers(&self) -> bool {
        self.odometry.as_ref().is_some_and(Publisher::is_heard)
            || self.tf.as_ref().is_some_and(Publisher::is_heard)
    }

    /// Publishes the pose of the child frame in the parent frame, and its velocity in its own axes.
    pub(crate) fn publish(
        &self,
        time_ns: i64,
        parent_from_child: Pose,
        twist: geometry_msgs::Twist,
    ) {
        if let Some(tf) = self.tf.as_ref().filter(|tf| tf.is_heard()) {
            let (parent, child) = (&self.parent_frame, &self.child_frame);
            let transform = geometry::transform(time_ns, parent, child, parent_from_child);
            tf.publish(tf2_msgs::TFMessage { transforms: vec![transform] });
        }
        if let Some(odometry) = self.odometry.as_ref().filter(|odometry| odometry.is_heard()) {
            odometry.publish(nav_msgs::Odometry {
                header: Header::at(time_ns, &self.parent_frame),
                child_frame_id: self.child_frame.clone(),
                pose: geometry_msgs::PoseWithCovariance {
                    pose: geometry::pose(parent_from_child),
                    covariance: self.pose_covariance,
                },
                twist: geometry_msgs::TwistWithCovariance {
                    twist,
                    covariance: self.twist_covariance,
                },
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_entries_of_a_covariance() {
        let covariance = planar_covariance(1.0, 2.0, 3.0);
        let entries: Vec<(usize, f64)> =
            covariance.into_iter().enumerate().filter(|(_, value)| *value != 0.0).collect();
        assert_eq!(entries, [(0, 1.0), (7, 2.0), (14, 1e12), (21, 1e12), (28, 1e12), (35, 3.0)]);
    }
}
