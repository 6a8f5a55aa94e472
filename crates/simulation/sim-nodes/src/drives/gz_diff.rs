//! `gz-sim-diff-drive-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs;
use periplus_physics::{JointId, ModelId, PhysicsWorld, Twist};

use super::build_context::BuildContext;
use super::commands::{Commands, CommandsState};
use super::encoders::Encoders;
use super::gz_common::{Limiter, limits, next_ns, odometry_publisher, publish, turn};
use super::rate_timer::RateTimer;
use super::rolling_mean::RollingMean;
use crate::states::OdometryPublisher;
use crate::{Device, DeviceState, SenseContext, StepInterval, gz_topic};

/// All left wheels get one speed, all right wheels the other: `(v ∓ w separation / 2) / radius`.
/// Odometry is that of the first wheel on each side, from zero; its velocities are means over ten
/// steps. `/model/<m>/enable` disables and enables the drive.
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
    commands: Commands,
    enable: Mailbox<std_msgs::Bool>,
    state: GzDiffState,
    odometry_publisher: OdometryPublisher,
}

#[derive(Clone)]
struct GzDiffState {
    limiter: Limiter,
    is_enabled: bool,
    encoders: Encoders,
    speeds: RollingMean<2>,
    publish_timer: RateTimer,
    now_ns: i64,
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<GzDiffDrive> {
    let left = context.joints("left_joint", diagnostics);
    let right = context.joints("right_joint", diagnostics);
    let (left, right) = (left?, right?);
    let node = context.node(diagnostics)?;
    let topic = context.gz_topic("topic", "cmd_vel");
    let enable = gz_topic(&context.below_model("enable"));
    let (radius_m, separation_m) =
        (context.number("wheel_radius"), context.number("wheel_separation"));
    let start_ns = context.setting.start_ns;
    Some(GzDiffDrive {
        name: context.name(),
        model: context.setting.model,
        centre_m: context.middle(&[left.as_slice(), right.as_slice()].concat()),
        state: GzDiffState {
            limiter: Limiter::new(limits(context, true)),
            is_enabled: true,
            encoders: Encoders::new([*left.first()?, *right.first()?], radius_m, separation_m),
            speeds: RollingMean::default(),
            publish_timer: RateTimer::for_publisher(
                context.number("odom_publish_frequency"),
                start_ns,
            ),
            now_ns: start_ns,
        },
        left,
        right,
        radius_m,
        separation_m,
        commands: Commands::new(context, &node, &topic, diagnostics)?,
        enable: context.accept(node.mailbox(&enable, Qos::reliable(1)), diagnostics)?,
        odometry_publisher: odometry_publisher(context, &node, diagnostics)?,
    })
}

impl Device for GzDiffDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        self.state.encoders.begin(world);
        let heard = self.commands.planar();
        if let Some(enable) = self.enable.latest() {
            self.state.is_enabled = enable.data;
        }
        let wanted = if self.state.is_enabled {
            heard
        } else {
            self.commands.stop();
            Twist::default()
        };
        let twist = self.state.limiter.limited(Twist { y_m_s: 0.0, ..wanted }, span);
        let aside_m_s = twist.yaw_rad_s * self.separation_m / 2.0;
        turn(world, &self.left, (twist.x_m_s - aside_m_s) / self.radius_m);
        turn(world, &self.right, (twist.x_m_s + aside_m_s) / self.radius_m);
        world.follow_about(self.model, self.centre_m, twist);
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.state.now_ns = moment.time_ns();
        self.state.encoders.observe(moment.world, moment.span.seconds());
        let odometry = self.state.encoders.odometry;
        self.state.speeds.push([odometry.twist.x_m_s, odometry.twist.yaw_rad_s]);
        let [x_m_s, yaw_rad_s] = self.state.speeds.mean();
        let twist = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
        publish(
            &self.odometry_publisher,
            &mut self.state.publish_timer,
            moment,
            odometry.pose.pose(),
            twist,
        );
    }

    fn next_ns(&self) -> Option<i64> {
        next_ns(
            self.state.limiter.changes(),
            self.state.now_ns,
            &self.state.publish_timer,
            &self.odometry_publisher,
        )
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.limiter.reset();
        self.commands.reset();
        drop(self.enable.drain());
        self.state.is_enabled = true;
        self.state.encoders.reset();
        self.state.speeds.clear();
        self.state.publish_timer.restart(time_ns);
        self.state.now_ns = time_ns;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save(), self.enable.pending()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        type Saved = (GzDiffState, CommandsState, Vec<Sample>);
        let Some((state, commands, enables)) = saved.get::<Saved>() else { return false };
        self.state = state.clone();
        self.commands.restore(commands);
        self.enable.set_pending(enables);
        true
    }
}
