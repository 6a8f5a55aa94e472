//! Topics of the controller server.

use periplus_costmap::Nav2Release;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{GraphError, Level, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs::TrackingFeedback;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

use super::parameters::ControllerServerParams;
use super::reports::ReportPublishers;
use crate::velocity_topics::{VelocityPublisher, uses_stamped_velocity};

/// Publishers of a configured server.
pub(super) struct Outputs {
    velocity: VelocityPublisher,
    transformed: Publisher<Path>,
    /// Path of the goal, which controllers published before main.
    received: Option<Publisher<Path>>,
    tracking: Option<Publisher<TrackingFeedback>>,
    pub(super) reports: ReportPublishers,
}

impl Outputs {
    pub(super) fn new(
        node: &Node,
        params: &ControllerServerParams,
        release: Nav2Release,
        forms: Nav2Release,
    ) -> Result<Self, GraphError> {
        let is_stamped = uses_stamped_velocity(params.enable_stamped_cmd_vel, forms);
        let qos = Qos::reliable(1);
        let is_main = release == Nav2Release::Main;
        let received = (!is_main).then(|| node.publisher("received_global_plan", qos));
        let tracking = is_main.then(|| node.publisher("tracking_feedback", qos));
        Ok(Self {
            velocity: VelocityPublisher::new(node, "cmd_vel", is_stamped)?,
            transformed: node.publisher("transformed_global_plan", qos)?,
            received: received.transpose()?,
            tracking: tracking.transpose()?,
            reports: ReportPublishers::new(node, forms),
        })
    }

    /// Publishes a velocity in the base frame. One that is not finite is refused.
    pub(super) fn publish_velocity(&self, node: &Node, base_frame: &str, velocity: Twist2) {
        if !velocity.is_finite() {
            let text = "Velocity message contains NaNs or Infs! Ignoring as invalid!";
            return node.log(Level::Error, text);
        }
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
        let header = Header::at(node.now_ns(), base_frame);
        self.velocity.publish_planar(header, [vx_m_s, vy_m_s, wz_rad_s]);
    }

    pub(super) fn publish_local_plan(&self, header: &Header, plan: &[Pose2]) {
        if self.transformed.is_heard() {
            self.transformed.publish(path(header, plan));
        }
    }

    pub(super) fn publish_received(&self, plan: &Path) {
        if let Some(received) = &self.received {
            received.publish(plan.clone());
        }
    }

    pub(super) fn publish_tracking(&self, feedback: &TrackingFeedback) {
        if let Some(tracking) = self.tracking.as_ref().filter(|tracking| tracking.is_heard()) {
            tracking.publish(feedback.clone());
        }
    }
}

/// Converts poses to a path.
pub(super) fn path(header: &Header, poses: &[Pose2]) -> Path {
    let stamped = |it: &Pose2| PoseStamped { header: header.clone(), pose: pose(*it) };
    Path { header: header.clone(), poses: poses.iter().map(stamped).collect() }
}
