//! `gz-sim-diff-drive-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_graph::{Mailbox, Qos};
use periplus_msgs::std_msgs;
use periplus_physics::{JointId, ModelId, Twist, World};

use super::beat::Beat;
use super::commands::Commands;
use super::encoders::Encoders;
use super::gz_common::{Limiter, limits, next_ns, tell, teller, turn};
use super::order::Order;
use super::rolling::RollingMean;
use crate::states::Teller;
use crate::{Device, Moment, Span, gz_topic};

/// Every left wheel gets one speed, every right wheel the other: `(v ∓ w separation / 2) / radius`.
/// Odometry is that of the first wheel on each side, from zero; its speeds are means over ten
/// steps. `/model/<m>/enable` stops it and lets it go again.
///
/// Source: gz-sim 8, `DiffDrive.cc`; gz-math 7, `DiffDriveOdometry`.
pub(crate) struct GzDiffDrive {
    name: String,
    model: ModelId,
    centre_m: DVec3,
    left: Vec<JointId>,
    right: Vec<JointId>,
    radius_m: f64,
    separation_m: f64,
    limiter: Limiter,
    commands: Commands,
    enable: Mailbox<std_msgs::Bool>,
    is_enabled: bool,
    encoders: Encoders,
    speeds: RollingMean<2>,
    teller: Teller,
    tells: Beat,
    now_ns: i64,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<GzDiffDrive> {
    let left = order.joints("left_joint", diagnostics);
    let right = order.joints("right_joint", diagnostics);
    let (left, right) = (left?, right?);
    let node = order.node(diagnostics)?;
    let topic = order.gz_topic("topic", "cmd_vel");
    let enable = gz_topic(&order.below_model("enable"));
    let (radius_m, separation_m) = (order.number("wheel_radius"), order.number("wheel_separation"));
    let start_ns = order.setting.start_ns;
    Some(GzDiffDrive {
        name: order.name(),
        model: order.setting.model,
        centre_m: order.middle(&[left.as_slice(), right.as_slice()].concat()),
        encoders: Encoders::new([*left.first()?, *right.first()?], radius_m, separation_m),
        left,
        right,
        radius_m,
        separation_m,
        limiter: Limiter::new(limits(order, true)),
        commands: Commands::new(order, &node, &topic, diagnostics)?,
        enable: order.accept(node.mailbox(&enable, Qos::reliable(1)), diagnostics)?,
        is_enabled: true,
        speeds: RollingMean::default(),
        teller: teller(order, &node, diagnostics)?,
        tells: Beat::telling(order.number("odom_publish_frequency"), start_ns),
        now_ns: start_ns,
    })
}

impl Device for GzDiffDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        self.encoders.begin(world);
        let heard = self.commands.planar();
        if let Some(enable) = self.enable.latest() {
            self.is_enabled = enable.data;
        }
        let wanted = if self.is_enabled {
            heard
        } else {
            self.commands.stop();
            Twist::default()
        };
        let twist = self.limiter.limited(Twist { y_m_s: 0.0, ..wanted }, span);
        let aside_m_s = twist.yaw_rad_s * self.separation_m / 2.0;
        turn(world, &self.left, (twist.x_m_s - aside_m_s) / self.radius_m);
        turn(world, &self.right, (twist.x_m_s + aside_m_s) / self.radius_m);
        world.follow_about(self.model, self.centre_m, twist);
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        self.now_ns = moment.time_ns();
        self.encoders.observe(moment.world, moment.span.seconds());
        let odometry = self.encoders.odometry;
        self.speeds.push([odometry.twist.x_m_s, odometry.twist.yaw_rad_s]);
        let [x_m_s, yaw_rad_s] = self.speeds.mean();
        let twist = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
        tell(&self.teller, &mut self.tells, moment, odometry.pose.pose(), twist);
    }

    fn next_ns(&self) -> Option<i64> {
        next_ns(self.limiter.changes(), self.now_ns, &self.tells, &self.teller)
    }

    fn reset(&mut self, time_ns: i64) {
        self.limiter.reset();
        self.commands.reset();
        drop(self.enable.drain());
        self.is_enabled = true;
        self.encoders.reset();
        self.speeds.clear();
        self.tells.restart(time_ns);
        self.now_ns = time_ns;
    }
}
