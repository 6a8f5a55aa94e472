//! Odometry of a drive as messages.

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{geometry_msgs, nav_msgs, tf2_msgs};
use periplus_ros2_control::{PlanarPose, PlanarTwist};

use crate::drives::RateTimer;
use crate::states::{TF_QOS, diagonal, pose, transform};

/// Depth of the topics of controllers, the default of ROS 2.
const DEFAULT_QOS: Qos = Qos::reliable(10);

/// Topics and frames of odometry.
#[derive(Clone, Debug)]
pub(super) struct OdometryTopics {
    pub(super) odometry: &'static str,
    /// Topic of the transform; `None` for none.
    pub(super) tf: Option<&'static str>,
    pub(super) odom_frame: String,
    pub(super) base_frame: String,
    pub(super) pose_variances: Vec<f64>,
    pub(super) twist_variances: Vec<f64>,
    /// Rate of publication [Hz]; zero for each update.
    pub(super) rate_hz: f64,
    /// False for odometry without a pose.
    pub(super) has_pose: bool,
}

/// Publishers of odometry.
pub(super) struct OdometryOutput {
    topics: OdometryTopics,
    odometry: Publisher<nav_msgs::Odometry>,
    tf: Option<Publisher<tf2_msgs::TFMessage>>,
}

impl OdometryOutput {
    pub(super) fn new(node: &Node, topics: OdometryTopics) -> Result<Self, GraphError> {
        let odometry = node.publisher(topics.odometry, DEFAULT_QOS)?;
        let tf = topics.tf.map(|topic| node.publisher(topic, TF_QOS)).transpose()?;
        Ok(Self { topics, odometry, tf })
    }

    pub(super) fn timer(&self, start_ns: i64) -> RateTimer {
        RateTimer::for_publisher(self.topics.rate_hz, start_ns)
    }

    pub(super) fn publish(&self, time_ns: i64, planar: PlanarPose, twist: PlanarTwist) {
        let odom_from_base = pose_of(planar);
        let OdometryTopics { odom_frame, base_frame, .. } = &self.topics;
        if let Some(tf) = self.tf.as_ref().filter(|tf| tf.is_heard()) {
            let transform = transform(time_ns, odom_frame, base_frame, odom_from_base);
            tf.publish(tf2_msgs::TFMessage { transforms: vec![transform] });
        }
        if !self.odometry.is_heard() {
            return;
        }
        let covariance = |variances: &[f64]| {
            diagonal(std::array::from_fn(|index| variances.get(index).copied().unwrap_or_default()))
        };
        let shown = if self.topics.has_pose { odom_from_base } else { Pose::IDENTITY };
        self.odometry.publish(nav_msgs::Odometry {
            header: Header::at(time_ns, odom_frame),
            child_frame_id: base_frame.clone(),
            pose: geometry_msgs::PoseWithCovariance {
                pose: pose(shown),
                covariance: covariance(&self.topics.pose_variances),
            },
            twist: geometry_msgs::TwistWithCovariance {
                twist: twist_message(twist),
                covariance: covariance(&self.topics.twist_variances),
            },
        });
    }
}

/// Returns a planar velocity as a message.
pub(super) fn twist_message(twist: PlanarTwist) -> geometry_msgs::Twist {
    let mut message = geometry_msgs::Twist::default();
    (message.linear.x, message.linear.y) = (twist.x_m_s, twist.y_m_s);
    message.angular.z = twist.yaw_rad_s;
    message
}

fn pose_of(planar: PlanarPose) -> Pose {
    let (sine, cosine) = libm::sincos(planar.heading_rad / 2.0);
    Pose {
        translation: DVec3::new(planar.x_m, planar.y_m, 0.0),
        rotation: DQuat::from_xyzw(0.0, 0.0, sine, cosine),
    }
}
