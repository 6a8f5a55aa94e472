//! Topics of the node.

use periplus_controllers::ControlReport;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{GraphError, Level, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{PoseStamped, Twist};
use periplus_msgs::move_base_msgs::RecoveryStatus;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

use crate::velocity_topics::twist;

/// Publishers of the node.
pub(super) struct Outputs {
    velocity: Publisher<Twist>,
    pub(super) current_goal: Publisher<PoseStamped>,
    pub(super) recovery_status: Publisher<RecoveryStatus>,
    /// Path of the global planner.
    plan: Publisher<Path>,
    /// Part of it that the local planner follows.
    global_plan: Publisher<Path>,
    /// Motion that the local planner has selected.
    local_plan: Publisher<Path>,
}

impl Outputs {
    /// Creates the topics of planners with such names.
    pub(super) fn new(
        node: &Node,
        action: &str,
        global_planner: &str,
        local_planner: &str,
    ) -> Result<Self, GraphError> {
        let qos = Qos::reliable(1);
        Ok(Self {
            velocity: node.publisher("cmd_vel", qos)?,
            current_goal: node.publisher("~/current_goal", qos)?,
            recovery_status: node.publisher(&format!("{action}/recovery_status"), qos)?,
            plan: node.publisher(&format!("~/{global_planner}/plan"), qos)?,
            global_plan: node.publisher(&format!("~/{local_planner}/global_plan"), qos)?,
            local_plan: node.publisher(&format!("~/{local_planner}/local_plan"), qos)?,
        })
    }

    /// Publishes a velocity in the base frame. One that is not finite is refused.
    pub(super) fn publish_velocity(&self, node: &Node, velocity: Twist2) {
        if !velocity.is_finite() {
            return node.log(Level::Error, "a velocity that is not finite is not published");
        }
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
        self.velocity.publish(twist([vx_m_s, vy_m_s, 0.0, 0.0, 0.0, wz_rad_s]));
    }

    pub(super) fn publish_plan(&self, header: &Header, poses: &[Pose2]) {
        self.plan.publish(path(header, poses));
    }

    pub(super) fn publish_global_plan(&self, header: &Header, poses: &[Pose2]) {
        if self.global_plan.is_heard() {
            self.global_plan.publish(path(header, poses));
        }
    }

    /// Publishes the trajectory that a local planner has selected.
    pub(super) fn publish_report(&self, header: &Header, report: &ControlReport<'_>) {
        let ControlReport::Trajectories(evaluation) = report else { return };
        if self.local_plan.is_heard() {
            let best = evaluation.best().map(|best| best.trajectory.poses.as_slice());
            self.local_plan.publish(path(header, best.unwrap_or_default()));
        }
    }
}

/// Converts poses to a path.
pub(super) fn path(header: &Header, poses: &[Pose2]) -> Path {
    let stamped = |it: &Pose2| PoseStamped { header: header.clone(), pose: pose(*it) };
    Path { header: header.clone(), poses: poses.iter().map(stamped).collect() }
}
