//! Publishers of the filter.

use periplus_ekf::{Estimate, Variable};
use periplus_geometry::DVec3;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue};
use periplus_msgs::geometry_msgs::{
    Accel, AccelWithCovariance, AccelWithCovarianceStamped, PoseWithCovariance, Twist,
    TwistWithCovariance, Vector3,
};
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf_ros::pose;

/// Publishers.
pub(crate) struct Outputs {
    odometry: Publisher<Odometry>,
    acceleration: Option<Publisher<AccelWithCovarianceStamped>>,
    pub(crate) tf: Publisher<TFMessage>,
    diagnostics: Publisher<DiagnosticArray>,
}

impl Outputs {
    pub(crate) fn new(node: &Node, publishes_acceleration: bool) -> Result<Self, GraphError> {
        Ok(Self {
            acceleration: acceleration(node, publishes_acceleration)?,
            odometry: node.publisher("odometry/filtered", Qos::reliable(10))?,
            tf: node.publisher("/tf", Qos::reliable(100))?,
            diagnostics: node.publisher("/diagnostics", Qos::reliable(10))?,
        })
    }

    /// Advertises `accel/filtered`, or removes it.
    pub(crate) fn set_acceleration(
        &mut self,
        node: &Node,
        publishes_acceleration: bool,
    ) -> Result<(), GraphError> {
        if self.acceleration.is_some() != publishes_acceleration {
            self.acceleration = acceleration(node, publishes_acceleration)?;
        }
        Ok(())
    }

    pub(crate) fn publish(&self, estimate: &Estimate, world: &str, base: &str) {
        let (linear, angular) = estimate.twist();
        self.odometry.publish(Odometry {
            header: Header::at(estimate.time_ns, world),
            child_frame_id: base.to_owned(),
            pose: PoseWithCovariance {
                pose: pose(estimate.world_from_base()),
                covariance: estimate.covariance_of(Variable::X),
            },
            twist: TwistWithCovariance {
                twist: Twist { linear: vector(linear), angular: vector(angular) },
                covariance: estimate.covariance_of(Variable::Vx),
            },
        });
        if let Some(acceleration) = &self.acceleration {
            let mut covariance = [0.0; 36];
            for row in 0..3 {
                for column in 0..3 {
                    let at = Variable::Ax.at();
                    covariance[row * 6 + column] = estimate.covariance[(at + row, at + column)];
                }
            }
            let accel = Accel { linear: vector(estimate.acceleration()), ..Accel::default() };
            acceleration.publish(AccelWithCovarianceStamped {
                header: Header::at(estimate.time_ns, base),
                accel: AccelWithCovariance { accel, covariance },
            });
        }
    }

    /// Publishes the diagnostics: what blocks the node, and rejected measurements.
    pub(crate) fn publish_health(&self, health: &Health<'_>, time_ns: i64) {
        let status = vec![health.to_message()];
        self.diagnostics.publish(DiagnosticArray { header: Header::at(time_ns, ""), status });
    }
}

fn acceleration(
    node: &Node,
    is_published: bool,
) -> Result<Option<Publisher<AccelWithCovarianceStamped>>, GraphError> {
    is_published.then(|| node.publisher("accel/filtered", Qos::reliable(10))).transpose()
}

/// Health of the filter.
pub(crate) struct Health<'a> {
    pub(crate) node: &'a str,
    pub(crate) trouble: Option<&'a str>,
    pub(crate) estimate: Option<&'a Estimate>,
    pub(crate) refused: &'a [(String, u64)],
}

impl Health<'_> {
    fn to_message(&self) -> DiagnosticStatus {
        let refused = self.refused.iter().map(|(source, count)| KeyValue {
            key: format!("{source} not believed"),
            value: count.to_string(),
        });
        let (level, message) = match (self.trouble, self.estimate) {
            (Some(trouble), _) => (DiagnosticStatus::ERROR, trouble),
            (None, None) => (DiagnosticStatus::WARN, "nothing has been measured yet"),
            (None, Some(_)) => (DiagnosticStatus::OK, "the filter runs"),
        };
        DiagnosticStatus {
            level,
            name: format!("{}: filter", self.node.trim_start_matches('/')),
            message: message.to_owned(),
            hardware_id: String::new(),
            values: refused.collect(),
        }
    }
}

fn vector(vector: DVec3) -> Vector3 {
    Vector3 { x: vector.x, y: vector.y, z: vector.z }
}
