//! Inputs and outputs that all behaviors share.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{GraphError, Node};
use periplus_motion::tables::BehaviorServerParams;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::LogThrottle;

use crate::costmap_2d::frames::Listener;
use crate::costmap_subscriber::CollisionChecker;
use crate::velocity_topics::{VelocityPublisher, uses_stamped_velocity};

use super::behavior::{FailureReason, MotionFailure};

/// Age of the pose of the robot \[s\] that is allowed in any case, in spite of `transform_tolerance`: five periods of
/// a slow odometry of 10 Hz.
const MIN_POSE_TOLERANCE_S: f64 = 0.5;

/// Input of an assisted teleoperation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TeleopInput {
    /// Last command.
    pub(super) command: Twist2,
    /// True once `preempt_teleop` was received.
    pub(super) is_preempted: bool,
}

/// Robot as the behaviors see and move it.
pub(super) struct BehaviorWorld {
    pub(super) params: BehaviorServerParams,
    pub(super) teleop: TeleopInput,
    pub(super) tf: Listener,
    /// Topics that exist while the node is configured.
    ports: Option<Ports>,
    log: LogThrottle,
    /// Time of the last cycle \[ns\].
    now_ns: i64,
}

struct Ports {
    checker: CollisionChecker,
    velocity: VelocityPublisher,
}

impl BehaviorWorld {
    pub(super) fn new(node: &Node, params: BehaviorServerParams) -> Result<Self, GraphError> {
        let (teleop, tf) = (TeleopInput::default(), Listener::new(node)?);
        Ok(Self { params, teleop, tf, ports: None, log: LogThrottle::default(), now_ns: 0 })
    }

    pub(super) fn release(&self) -> Nav2Release {
        self.params.node.compat
    }

    pub(super) fn uses_stamped_velocity(&self) -> bool {
        uses_stamped_velocity(self.params.node.enable_stamped_cmd_vel, self.release())
    }

    pub(super) fn open(&mut self, node: &Node) -> Result<(), GraphError> {
        let params = &self.params;
        self.ports = Some(Ports {
            checker: CollisionChecker::new(
                node,
                &params.local_costmap_topic,
                &params.local_footprint_topic,
            )?,
            velocity: VelocityPublisher::new(node, "cmd_vel", self.uses_stamped_velocity())?,
        });
        Ok(())
    }

    pub(super) fn close(&mut self) {
        self.ports = None;
    }

    /// Frame in which motions are measured: Humble has one frame for all.
    pub(super) fn frame(&self) -> &str {
        match self.release() {
            Nav2Release::Humble => self.params.global_frame.as_deref().unwrap_or("odom"),
            _ => &self.params.local_frame,
        }
    }

    /// Processes received transforms, costmaps and footprints.
    pub(super) fn receive(&mut self, node: &Node) {
        self.tf.listen();
        self.now_ns = node.now_ns();
        let Some(ports) = &mut self.ports else { return };
        if let Err(why) = ports.checker.receive(&self.tf, &self.params.robot_base_frame) {
            self.report("bad-costmap", &why, node);
        }
    }

    /// Newest pose of the robot in [`Self::frame`].
    ///
    /// # Errors
    /// When there is none, or it is older than `transform_tolerance` and 0.5 s: the robot would move blindly.
    pub(super) fn pose(&self) -> Result<Pose2, MotionFailure> {
        let base = &self.params.robot_base_frame;
        let failed = |why: String| MotionFailure {
            reason: FailureReason::Transform,
            text: format!("the pose of the robot is not available: {why}"),
        };
        let found = self.tf.at(self.frame(), base, 0);
        let (pose, time_ns) = found.map_err(|why| failed(why.to_string()))?;
        let tolerance_s = self.params.transform_tolerance_s.max(MIN_POSE_TOLERANCE_S);
        let age_s = (self.now_ns - time_ns) as f64 * 1e-9;
        // Time zero is that of static transforms.
        if time_ns != 0 && age_s > tolerance_s {
            let frame = self.frame();
            return Err(failed(format!(
                "the transform from `{base}` to `{frame}` is {age_s:.2} s old; at most {tolerance_s} s are allowed \
                 (`transform_tolerance`): check the node that publishes it"
            )));
        }
        Ok(Pose2::from(pose))
    }

    /// Returns true if the robot collides at none of these poses. Without costmap and footprint it
    /// collides everywhere.
    pub(super) fn are_free(&mut self, poses: impl IntoIterator<Item = Pose2>, node: &Node) -> bool {
        let Some(ports) = &self.ports else { return false };
        let checked = ports.checker.check(&self.tf, self.frame());
        let are_free = checked.map(|is_free| poses.into_iter().all(is_free));
        self.checked(are_free, node)
    }

    /// Returns true if the robot collides nowhere on its motion over these poses, from the one at which it is; it may
    /// leave obstacles that it touches. Without costmap and footprint it collides everywhere.
    pub(super) fn is_motion_free(
        &mut self,
        poses: impl IntoIterator<Item = Pose2>,
        node: &Node,
    ) -> bool {
        let Some(ports) = &self.ports else { return false };
        let is_free = ports.checker.is_motion_free(&self.tf, self.frame(), poses);
        self.checked(is_free, node)
    }

    /// Result of a check; false, and a report, if it was not possible.
    fn checked(&mut self, result: Result<bool, String>, node: &Node) -> bool {
        result.unwrap_or_else(|why| {
            let text = format!("collisions cannot be checked, so the robot stops: {why}");
            self.report("no-collision-check", &text, node);
            false
        })
    }

    fn report(&mut self, code: &'static str, text: &str, node: &Node) {
        self.log.report(&Diagnostic::error(code, text), node);
    }

    /// Publishes a velocity.
    pub(super) fn drive(&self, velocity: Twist2, now_ns: i64) {
        let Some(ports) = &self.ports else { return };
        let header = Header::at(now_ns, &self.params.robot_base_frame);
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
        ports.velocity.publish_planar(header, [vx_m_s, vy_m_s, wz_rad_s]);
    }

    /// Forgets transforms after a jump of time.
    pub(super) fn forget(&mut self) {
        self.tf.forget();
    }
}
