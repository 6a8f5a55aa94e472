//! What the drives of gz-sim have in common.

use periplus_diagnostics::Diagnostics;
use periplus_graph::Node;
use periplus_physics::{Command, JointId, Twist, World, drives::Limits};

use super::beat::{Beat, earlier};
use super::order::Order;
use crate::states::{Teller, planar_twist};
use crate::{Moment, Span};

/// In a world without physics, speeds that still change are given anew this often [ns]: the step
/// of an ordinary world.
const CHANGING_STEP_NS: i64 = 1_000_000;

/// Where odometry and transform of a drive of gz-sim go: `/model/<m>/odometry` and `/model/<m>/tf`,
/// from the frame `<m>/odom` to `<m>/<canonical link>`. Covariances are zero.
pub(crate) fn teller(
    order: &Order<'_>,
    node: &Node,
    diagnostics: &mut Diagnostics,
) -> Option<Teller> {
    let model = order.model_name();
    let parent = order.given_text("frame_id").unwrap_or_else(|| format!("{model}/odom"));
    let child = order.given_text("child_frame_id").unwrap_or_else(|| {
        let canonical = order.canonical_link().unwrap_or_default();
        format!("{model}/{canonical}")
    });
    Teller::between(parent, child)
        .on(order, node, &order.gz_topic("odom_topic", "odometry"), diagnostics)?
        .with_tf(order, node, &order.gz_topic("tf_topic", "tf"), diagnostics)
}

/// Limits of the forward and the turning speed: `min_velocity` and its like for both, then those of
/// each.
pub(crate) fn limits(order: &Order<'_>, has_each: bool) -> [Limits; 2] {
    let one = |kind: &str| {
        let bounds = |quantity: &str| {
            let bound = |side: &str, free: f64| {
                let both = order.plugin.values.number(&format!("{side}_{quantity}"));
                let own = if has_each {
                    order.plugin.values.number(&format!("{side}_{kind}_{quantity}"))
                } else {
                    None
                };
                own.or(both).unwrap_or(free)
            };
            [bound("min", f64::NEG_INFINITY), bound("max", f64::INFINITY)]
        };
        Limits {
            velocity: bounds("velocity"),
            acceleration: bounds("acceleration"),
            jerk: bounds("jerk"),
        }
    };
    [one("linear"), one("angular")]
}

/// A twist within limits, step by step.
#[derive(Clone, Debug)]
pub(crate) struct Limiter {
    linear: Limits,
    angular: Limits,
    last: Twist,
    before_last: Twist,
    changes: bool,
}

impl Limiter {
    pub(crate) fn new([linear, angular]: [Limits; 2]) -> Self {
        let (last, before_last) = Default::default();
        Self { linear, angular, last, before_last, changes: false }
    }

    /// What becomes of a wanted twist in a step.
    pub(crate) fn limited(&mut self, wanted: Twist, span: Span) -> Twist {
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

    /// Whether the last step changed it, so that the next may too.
    pub(crate) fn changes(&self) -> bool {
        self.changes
    }
}

/// When a drive that acts at each step wants to act again \[ns\].
pub(crate) fn next_ns(changes: bool, now_ns: i64, tells: &Beat, teller: &Teller) -> Option<i64> {
    let acting = changes.then_some(now_ns + CHANGING_STEP_NS);
    earlier(acting, tells.next_ns().filter(|_| teller.is_heard()))
}

/// Turns wheels at a speed \[rad/s\], with whatever effort their joints allow.
pub(crate) fn turn(world: &mut World, joints: &[JointId], target: f64) {
    for &joint in joints {
        world.command(joint, Command::Velocity { target, max_effort: f64::INFINITY });
    }
}

/// Tells odometry if it is time and somebody listens.
pub(crate) fn tell(
    teller: &Teller,
    tells: &mut Beat,
    moment: &Moment<'_>,
    pose: periplus_geometry::Pose,
    twist: Twist,
) {
    let now_ns = moment.time_ns();
    if tells.due(now_ns) && teller.is_heard() {
        teller.tell(now_ns, pose, planar_twist(twist));
    }
}
