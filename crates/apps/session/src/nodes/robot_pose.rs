//! Pose of a robot on its map: read from `/tf`, and given to AMCL.

use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::TransformKind;
use periplus_tf_ros::Frames;

/// Number of messages with transforms that are kept between two reads.
const TRANSFORM_DEPTH: usize = 500;

/// Variances of x, y \[m²\] and yaw \[rad²\] in the covariance of an initial pose: 0.5 m and 15 degrees, as RViz
/// publishes them.
const INITIAL_VARIANCES: [(usize, f64); 3] = [(0, 0.25), (7, 0.25), (35, 0.068_538_9)];

/// Message that makes AMCL start at a pose in the frame `map`, as RViz's tool "2D Pose Estimate" publishes it.
#[must_use]
pub fn initial_pose_message(map_from_base: Pose2) -> PoseWithCovarianceStamped {
    let mut message = PoseWithCovarianceStamped::default();
    message.header.frame_id = "map".into();
    message.pose.pose = periplus_tf_ros::pose(map_from_base);
    for (index, variance) in INITIAL_VARIANCES {
        message.pose.covariance[index] = variance;
    }
    message
}

/// Reader of the newest poses of a robot in other frames.
pub struct RobotPose {
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    frames: Frames,
    base: String,
}

impl RobotPose {
    /// Subscribes to the transforms of the node's namespace.
    ///
    /// # Errors
    /// When the graph refuses the subscriptions.
    pub fn new(node: &Node, base: &str) -> Result<Self, GraphError> {
        Ok(Self {
            moving: node.mailbox("/tf", Qos::reliable(TRANSFORM_DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(TRANSFORM_DEPTH))?,
            frames: Frames::default(),
            base: base.to_owned(),
        })
    }

    /// Newest pose of the robot in a frame, on the floor; none before the transforms between them were published.
    pub fn newest_in(&mut self, frame: &str) -> Option<Pose2> {
        for (mailbox, kind) in
            [(&self.fixed, TransformKind::Fixed), (&self.moving, TransformKind::Moving)]
        {
            for message in mailbox.drain() {
                self.frames.take(&message, kind);
            }
        }
        let (frame_from_base, _) = self.frames.at(frame, &self.base, 0).ok()?;
        Some(Pose2::from(frame_from_base))
    }
}
