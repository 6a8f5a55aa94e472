//! Who is told where the robot is.

use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_localization::{Amcl, State, Status};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::geometry_msgs::{PoseArray, PoseWithCovarianceStamped};
use periplus_msgs::nav2_msgs::ParticleCloud;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf_ros::transform;

use crate::amcl::messages::{cloud, pose_with_covariance, poses};

/// Topics that are published.
pub(crate) struct Outputs {
    pose: Publisher<PoseWithCovarianceStamped>,
    cloud: Publisher<ParticleCloud>,
    /// As ROS 1 has it.
    cloud_of_ros1: Publisher<PoseArray>,
    tf: Publisher<TFMessage>,
    status: Publisher<DiagnosticStatus>,
    rivals: Publisher<PoseArray>,
    diagnostics: Publisher<DiagnosticArray>,
}

impl Outputs {
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            pose: node.publisher("amcl_pose", Qos::latched(1))?,
            cloud: node.publisher("particle_cloud", Qos::sensor_data())?,
            cloud_of_ros1: node.publisher("particlecloud", Qos::sensor_data())?,
            tf: node.publisher("/tf", Qos::reliable(100))?,
            status: node.publisher("localization_status", Qos::latched(1))?,
            rivals: node.publisher("localization_rivals", Qos::latched(1))?,
            diagnostics: node.publisher("/diagnostics", Qos::reliable(10))?,
        })
    }

    /// The particles, as they were at a time.
    pub(crate) fn publish_particles(&self, amcl: &Amcl, time_ns: i64, frame: &str) {
        let particles = amcl.particles();
        if self.cloud.is_heard() {
            self.cloud.publish(cloud(particles, time_ns, frame));
        }
        if self.cloud_of_ros1.is_heard() {
            let all = (0..particles.len()).map(|index| particles.pose(index));
            self.cloud_of_ros1.publish(poses(all, time_ns, frame));
        }
    }

    pub(crate) fn publish_pose(&self, amcl: &Amcl, time_ns: i64, frame: &str) {
        if let Some(estimate) = amcl.estimate() {
            let (pose, covariance) = (estimate.pose, estimate.covariance);
            self.pose.publish(pose_with_covariance(pose, covariance, time_ns, frame));
        }
    }

    /// `map_from_odom`, which holds until a time.
    pub(crate) fn publish_transform(
        &self,
        map_from_odom: Pose2,
        until_ns: i64,
        (map, odom): (&str, &str),
    ) {
        self.tf.publish(transform(map, odom, map_from_odom, until_ns));
    }

    /// How sure the robot is, and why.
    pub(crate) fn publish_status(&self, health: &Health<'_>, time_ns: i64, frame: &str) {
        let status = health.to_message();
        self.status.publish(status.clone());
        let rivals = health.status.rivals.iter().map(|rival| rival.mean);
        self.rivals.publish(poses(rivals, time_ns, frame));
        self.diagnostics
            .publish(DiagnosticArray { header: Header::at(time_ns, ""), status: vec![status] });
    }
}

/// How it goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Health<'a> {
    /// Full name of the node.
    pub(crate) node: &'a str,
    pub(crate) status: &'a Status,
    /// What keeps the node from its work.
    pub(crate) trouble: Option<&'a str>,
    pub(crate) amcl: Option<&'a Amcl>,
}

/// A state in a word, as it is published.
pub(crate) fn word(state: State) -> &'static str {
    match state {
        State::Unset => "unset",
        State::Tracking => "tracking",
        State::Ambiguous => "ambiguous",
        State::Lost => "lost",
    }
}

impl Health<'_> {
    fn to_message(self) -> DiagnosticStatus {
        let state = self.status.state;
        let level = match state {
            _ if self.trouble.is_some() => DiagnosticStatus::ERROR,
            State::Tracking => DiagnosticStatus::OK,
            State::Ambiguous | State::Unset => DiagnosticStatus::WARN,
            State::Lost => DiagnosticStatus::ERROR,
        };
        let why = self.trouble.unwrap_or(&self.status.reason);
        let mut values = vec![pair("state", word(state).to_owned())];
        if let Some(fit) = self.status.fit {
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
        for (number, rival) in self.status.rivals.iter().enumerate() {
            let Pose2 { x_m, y_m, yaw_rad } = rival.mean;
            let words = format!("{x_m:.3} {y_m:.3} {yaw_rad:.4} by {:.0} %", 100.0 * rival.weight);
            values.push(pair(&format!("rival {}", number + 1), words));
        }
        DiagnosticStatus {
            level,
            name: format!("{}: localization", self.node.trim_start_matches('/')),
            message: format!("{}: {why}", word(state)),
            hardware_id: String::new(),
            values,
        }
    }
}

fn pair(key: &str, value: String) -> KeyValue {
    KeyValue { key: key.to_owned(), value }
}
