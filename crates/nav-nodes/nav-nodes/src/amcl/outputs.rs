//! Publishers of pose, particles, transform and status.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_localization::{Amcl, LocalizationState, LocalizationStatus};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::geometry_msgs::{PoseArray, PoseWithCovarianceStamped};
use periplus_msgs::nav2_msgs::ParticleCloud;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf_ros::{pose_with_covariance, transform};

use crate::amcl::messages::{particle_cloud, pose_array};

/// Name of the topic `pose_hypotheses` in earlier releases; both are published for one release.
const OLD_HYPOTHESES_TOPIC: &str = "localization_rivals";

/// Publishers of the node.
pub(crate) struct Outputs {
    pose: Publisher<PoseWithCovarianceStamped>,
    cloud: Publisher<ParticleCloud>,
    /// Particles as in ROS 1.
    ros1_cloud: Publisher<PoseArray>,
    tf: Publisher<TFMessage>,
    status: Publisher<DiagnosticStatus>,
    hypotheses: Publisher<PoseArray>,
    /// Name of `pose_hypotheses` in earlier releases.
    rivals: Publisher<PoseArray>,
    has_reported_old_topic: bool,
    diagnostics: Publisher<DiagnosticArray>,
}

impl Outputs {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            pose: node.publisher("amcl_pose", Qos::latched(1))?,
            cloud: node.publisher("particle_cloud", Qos::sensor_data())?,
            ros1_cloud: node.publisher("particlecloud", Qos::sensor_data())?,
            tf: node.publisher("/tf", Qos::reliable(100))?,
            status: node.publisher("localization_status", Qos::latched(1))?,
            hypotheses: node.publisher("pose_hypotheses", Qos::latched(1))?,
            rivals: node.publisher(OLD_HYPOTHESES_TOPIC, Qos::latched(1))?,
            has_reported_old_topic: false,
            diagnostics: node.publisher("/diagnostics", Qos::reliable(10))?,
        })
    }

    /// Notice that the old name of `pose_hypotheses` has subscribers; once.
    pub(crate) fn old_topic_notice(&mut self) -> Option<Diagnostic> {
        if self.has_reported_old_topic || !self.rivals.is_heard() {
            return None;
        }
        self.has_reported_old_topic = true;
        let message = format!("the topic `{OLD_HYPOTHESES_TOPIC}` is deprecated");
        Some(
            Diagnostic::warning("old-topic", message)
                .help("subscribe to `pose_hypotheses`; the next release has only that topic"),
        )
    }

    /// Publishes the particles at a time.
    pub(crate) fn publish_particles(&self, amcl: &Amcl, time_ns: i64, frame: &str) {
        let particles = amcl.particles();
        if self.cloud.is_heard() {
            self.cloud.publish(particle_cloud(particles, time_ns, frame));
        }
        if self.ros1_cloud.is_heard() {
            let all = (0..particles.len()).map(|index| particles.pose(index));
            self.ros1_cloud.publish(pose_array(all, time_ns, frame));
        }
    }

    pub(crate) fn publish_pose(&self, amcl: &Amcl, time_ns: i64, frame: &str) {
        if let Some(estimate) = amcl.estimate() {
            let (pose, covariance) = (estimate.pose, estimate.covariance);
            self.pose.publish(pose_with_covariance(pose, covariance.to_rows(), time_ns, frame));
        }
    }

    /// Publishes `map_from_odom` with a time stamp until which it is valid.
    pub(crate) fn publish_transform(
        &self,
        map_from_odom: Pose2,
        until_ns: i64,
        (map, odom): (&str, &str),
    ) {
        self.tf.publish(transform(map, odom, map_from_odom, until_ns));
    }

    /// Publishes the status of localization.
    pub(crate) fn publish_status(&self, health: &Health<'_>, time_ns: i64, frame: &str) {
        let status = health.to_message();
        self.status.publish(status.clone());
        let poses = health.status.hypotheses.iter().map(|it| it.mean);
        let hypotheses = pose_array(poses, time_ns, frame);
        self.rivals.publish(hypotheses.clone());
        self.hypotheses.publish(hypotheses);
        self.diagnostics
            .publish(DiagnosticArray { header: Header::at(time_ns, ""), status: vec![status] });
    }
}

/// Status of the node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Health<'a> {
    /// Full name of the node.
    pub(crate) node: &'a str,
    pub(crate) status: &'a LocalizationStatus,
    /// Error that keeps the node from localizing.
    pub(crate) trouble: Option<&'a str>,
    pub(crate) amcl: Option<&'a Amcl>,
}

/// Name of a state in messages.
pub(crate) fn state_name(state: LocalizationState) -> &'static str {
    match state {
        LocalizationState::Unset => "unset",
        LocalizationState::Tracking => "tracking",
        LocalizationState::Ambiguous => "ambiguous",
        LocalizationState::Lost => "lost",
    }
}

impl Health<'_> {
    fn to_message(self) -> DiagnosticStatus {
        let state = self.status.state;
        let level = match state {
            _ if self.trouble.is_some() => DiagnosticStatus::ERROR,
            LocalizationState::Tracking => DiagnosticStatus::OK,
            LocalizationState::Ambiguous | LocalizationState::Unset => DiagnosticStatus::WARN,
            LocalizationState::Lost => DiagnosticStatus::ERROR,
        };
        let reason = self.trouble.unwrap_or(&self.status.reason);
        let mut values = vec![pair("state", state_name(state).to_owned())];
        if let Some(fit) = self.status.inlier_ratio {
            values.push(pair("scan on walls [%]", format!("{:.0}", 100.0 * fit)));
        }
        if let Some(amcl) = self.amcl {
            values.push(pair("particles", amcl.particles().len().to_string()));
            if let Some(estimate) = amcl.estimate() {
                let Pose2 { x_m, y_m, yaw_rad } = estimate.pose;
                values.push(pair("pose", format!("{x_m:.3} {y_m:.3} {yaw_rad:.4}")));
                let spread = estimate.covariance;
                values.push(pair("spread [m]", format!("{:.3}", spread.radius_m())));
                values.push(pair("spread [rad]", format!("{:.4}", libm::sqrt(spread.yaw))));
            }
        }
        for (index, other) in self.status.hypotheses.iter().enumerate() {
            let Pose2 { x_m, y_m, yaw_rad } = other.mean;
            let percent = 100.0 * other.weight;
            let value = format!("{x_m:.3} {y_m:.3} {yaw_rad:.4} by {percent:.0} %");
            values.push(pair(&format!("rival {}", index + 1), value));
        }
        DiagnosticStatus {
            level,
            name: format!("{}: localization", self.node.trim_start_matches('/')),
            message: format!("{}: {reason}", state_name(state)),
            hardware_id: String::new(),
            values,
        }
    }
}

fn pair(key: &str, value: String) -> KeyValue {
    KeyValue { key: key.to_owned(), value }
}
