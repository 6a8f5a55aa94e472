//! Parts shared by the drives of gz-sim.

use periplus_diagnostics::Diagnostics;
use periplus_graph::Node;
use periplus_physics::{JointCommand, JointId, PhysicsWorld, Twist, drives::SpeedLimits};

use super::build_context::BuildContext;
use super::rate_timer::{RateTimer, earlier};
use crate::states::{OdometryPublisher, planar_twist};
use crate::{SenseContext, StepInterval};

/// Interval of new commands in a world without physics while speeds still change [ns]: the default
/// step of a world.
const CHANGING_STEP_NS: i64 = 1_000_000;

/// Creates the odometry publisher of a gz-sim drive: topics `/model/<m>/odometry` and
/// `/model/<m>/tf`, from frame `<m>/odom` to `<m>/<canonical link>`. Covariances are zero.
pub(crate) fn odometry_publisher(
    context: &BuildContext<'_>,
    node: &Node,
    diagnostics: &mut Diagnostics,
) -> Option<OdometryPublisher> {
    let model = context.model_name();
    let parent = context.given_text("frame_id").unwrap_or_else(|| format!("{model}/odom"));
    let child = context.given_text("child_frame_id").unwrap_or_else(|| {
        let canonical = context.canonical_link().unwrap_or_default();
        format!("{model}/{canonical}")
    });
    OdometryPublisher::between(parent, child)
        .on(context, node, &context.gz_topic("odom_topic", "odometry"), diagnostics)?
        .with_gz_tf(context, node, &context.gz_topic("tf_topic", "tf"), diagnostics)
}

/// Reads the limits of linear and angular velocity: `min_velocity` etc. for both, overridden by
/// those of each.
pub(crate) fn limits(context: &BuildContext<'_>, has_each: bool) -> [SpeedLimits; 2] {
    let one = |kind: &str| {
        let bounds = |quantity: &str| {
            let bound = |side: &str, free: f64| {
                let both = context.plugin.values.number(&format!("{side}_{quantity}"));
                let own = if has_each {
                    context.plugin.values.number(&format!("{side}_{kind}_{quantity}"))
                } else {
                    None
                };
                own.or(both).unwrap_or(free)
            };
            [bound("min", f64::NEG_INFINITY), bound("max", f64::INFINITY)]
        };
        SpeedLimits {
            velocity: bounds("velocity"),
            acceleration: bounds("acceleration"),
            jerk: bounds("jerk"),
        }
    };
    [one("linear"), one("angular")]
}

/// Limits of a twist, applied step by step.
#[derive(Clone, Debug)]
pub(crate) struct Limiter {
    linear: SpeedLimits,
    angular: SpeedLimits,
    last: Twist,
    before_last: Twist,
    changes: bool,
}

impl Limiter {
    pub(crate) fn new([linear, angular]: [SpeedLimits; 2]) -> Self {
        let (last, before_last) = Default::default();
        Self { linear, angular, last, before_last, changes: false }
    }

    /// Returns the limited twist of a step.
    pub(crate) fn limited(&mut self, wanted: Twist, span: StepInterval) -> Twist {
        let (last, before) = (self.last, self.before_last);
        let dt_s = span.seconds();
        let linear = |wanted, last, before| self.linear.limited(wanted, last, before, dt_s);
        let now = Twist {
            x_m_s: linear(wanted.x_m_s, last.x_m_s, before.x_m_s),
            y_m_s: linear(wanted.y_m_s, last.y_m_s, before.y_m_s),
            yaw_rad_s: self.angular.limited(
                wanted.yaw_rad_s,
                last.yaw_rad_s,
                before.yaw_rad_s,
                dt_s,
            ),
        };
        (self.last, self.before_last, self.changes) = (now, last, now != last);
        now
    }

    pub(crate) fn reset(&mut self) {
        (self.last, self.before_last, self.changes) = Default::default();
    }

    /// Returns true if the last step changed the twist, so that the next can too.
    pub(crate) fn changes(&self) -> bool {
        self.changes
    }
}

/// Returns the next action of a drive that acts in every step \[ns\].
pub(crate) fn next_ns(
    changes: bool,
    now_ns: i64,
    publish_timer: &RateTimer,
    odometry_publisher: &OdometryPublisher,
) -> Option<i64> {
    let for_controller = changes.then_some(now_ns + CHANGING_STEP_NS);
    earlier(
        for_controller,
        publish_timer.next_ns().filter(|_| odometry_publisher.has_subscribers()),
    )
}

/// Rotates wheels at a speed \[rad/s\] with any effort that their joints allow.
pub(crate) fn turn(world: &mut PhysicsWorld, joints: &[JointId], target: f64) {
    for &joint in joints {
        world.command(joint, JointCommand::Velocity { target, max_effort: f64::INFINITY });
    }
}

/// Publishes odometry if it is due and has subscribers.
pub(crate) fn publish(
    odometry_publisher: &OdometryPublisher,
    publish_timer: &mut RateTimer,
    moment: &SenseContext<'_>,
    pose: periplus_geometry::Pose,
    twist: Twist,
) {
    let now_ns = moment.time_ns();
    if publish_timer.due(now_ns) && odometry_publisher.has_subscribers() {
        odometry_publisher.publish(now_ns, pose, planar_twist(twist));
    }
}
