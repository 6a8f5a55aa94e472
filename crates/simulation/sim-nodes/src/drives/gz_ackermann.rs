//! `gz-sim-ackermann-steering-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs;
use periplus_physics::drives::{Ackermann, AckermannCommand};
use periplus_physics::{JointId, Kinematic, ModelId, PhysicsWorld, Twist};

use super::build_context::BuildContext;
use super::commands::{Commands, CommandsState};
use super::encoders::angle;
use super::gz_common::{Limiter, limits, next_ns, odometry_publisher, publish, turn};
use super::rate_timer::RateTimer;
use crate::states::OdometryPublisher;
use crate::{Device, DeviceState, SenseContext, StepInterval, gz_topic};

/// Two driven wheels and two steered ones. A steered wheel turns at `steer_p_gain` times its angle
/// error. Odometry is computed from the driven wheels and the mean angle of the steered ones.
///
/// Source: gz-sim 8, `AckermannSteering.cc`.
pub(crate) struct GzAckermann {
    name: String,
    model: ModelId,
    /// Midpoint of the driven wheels, in the model [m].
    centre_m: DVec3,
    /// Left and right.
    driven: [Vec<JointId>; 2],
    steered: [JointId; 2],
    drive: Ackermann,
    gain: f64,
    command_source: CommandSource,
    state: GzAckermannState,
    odometry_publisher: Option<OdometryPublisher>,
}

#[derive(Clone)]
struct GzAckermannState {
    limiter: Limiter,
    before_rad: Option<[f64; 2]>,
    pose: Kinematic,
    publish_timer: RateTimer,
    now_ns: i64,
}

/// Source of commands.
enum CommandSource {
    Twist(Commands),
    /// With `steering_only`: steering angle at the middle of the front axle [rad].
    Angle {
        inbox: Mailbox<std_msgs::Float64>,
        last_rad: f64,
    },
}

/// The current command, and messages that wait.
enum CommandSourceState {
    Twist(CommandsState),
    Angle { pending: Vec<Sample>, last_rad: f64 },
}

impl CommandSource {
    fn save(&self) -> CommandSourceState {
        match self {
            Self::Twist(commands) => CommandSourceState::Twist(commands.save()),
            Self::Angle { inbox, last_rad } => {
                CommandSourceState::Angle { pending: inbox.pending(), last_rad: *last_rad }
            }
        }
    }

    /// Returns false for the state of the other source.
    fn restore(&mut self, saved: &CommandSourceState) -> bool {
        match (self, saved) {
            (Self::Twist(commands), CommandSourceState::Twist(saved)) => commands.restore(saved),
            (
                Self::Angle { inbox, last_rad },
                CommandSourceState::Angle { pending, last_rad: saved_rad },
            ) => {
                inbox.set_pending(pending);
                *last_rad = *saved_rad;
            }
            _ => return false,
        }
        true
    }
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<GzAckermann> {
    let steers_only = context.flag("steering_only");
    let [left, right] = ["left_joint", "right_joint"]
        .map(|name| if steers_only { Some(Vec::new()) } else { context.joints(name, diagnostics) });
    let steered = ["left_steering_joint", "right_steering_joint"]
        .map(|name| context.joint(name, diagnostics));
    let (driven, steered) = ([left?, right?], [steered[0]?, steered[1]?]);
    let node = context.node(diagnostics)?;
    let start_ns = context.setting.start_ns;
    let sub_topic = context.given_text("sub_topic");
    let fallback = if steers_only { "steer_angle" } else { "cmd_vel" };
    let topic = context.gz_topic("topic", sub_topic.as_deref().unwrap_or(fallback));
    let command_source = if steers_only {
        let inbox =
            context.accept(node.mailbox(&gz_topic(&topic), Qos::reliable(1)), diagnostics)?;
        CommandSource::Angle { inbox, last_rad: 0.0 }
    } else {
        CommandSource::Twist(Commands::new(context, &node, &topic, diagnostics)?)
    };
    let drive = Ackermann {
        wheel_separation_m: context.number("wheel_separation"),
        kingpin_width_m: context.number("kingpin_width"),
        wheel_base_m: context.number("wheel_base"),
        steering_limit_rad: context.number("steering_limit"),
        wheel_radius_m: context.number("wheel_radius"),
    };
    Some(GzAckermann {
        name: context.name(),
        model: context.setting.model,
        centre_m: context.middle(&driven.concat()),
        driven,
        steered,
        drive,
        gain: context.number("steer_p_gain"),
        command_source,
        state: GzAckermannState {
            limiter: Limiter::new(limits(context, false)),
            before_rad: None,
            pose: Kinematic::default(),
            publish_timer: RateTimer::for_publisher(
                context.number("odom_publish_frequency"),
                start_ns,
            ),
            now_ns: start_ns,
        },
        odometry_publisher: if steers_only {
            None
        } else {
            Some(odometry_publisher(context, &node, diagnostics)?)
        },
    })
}

impl GzAckermann {
    fn driven_rad(&self, world: &PhysicsWorld) -> [f64; 2] {
        [0, 1].map(|side| self.driven[side].first().map_or(0.0, |&joint| angle(world, joint)))
    }

    /// Returns the joint commands of a step, and the turn rate of the driven axle.
    fn wanted(&mut self, span: StepInterval) -> (AckermannCommand, Twist) {
        match &mut self.command_source {
            CommandSource::Twist(commands) => {
                let Twist { x_m_s, yaw_rad_s, .. } = commands.planar();
                let twist = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
                let twist = self.state.limiter.limited(twist, span);
                let command = self.drive.command(twist);
                // Feasible part for the wheels: no turning in place, no turn tighter than the
                // steering limit.
                let [left, right] = command.wheels_rad_s;
                let yaw_rad_s =
                    (right - left) * self.drive.wheel_radius_m / self.drive.wheel_separation_m;
                (command, Twist { yaw_rad_s, ..twist })
            }
            CommandSource::Angle { inbox, last_rad } => {
                if let Some(angle) = inbox.latest().filter(|angle| angle.data.is_finite()) {
                    *last_rad = angle.data;
                }
                // Turn rate at which driving forward at this speed produces this angle.
                let limit_rad = self.drive.steering_limit_rad.abs();
                let tangent = libm::tan(last_rad.clamp(-limit_rad, limit_rad));
                let twist =
                    Twist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: tangent / self.drive.wheel_base_m };
                (self.drive.command(twist), Twist::default())
            }
        }
    }
}

impl Device for GzAckermann {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        if self.state.before_rad.is_none() {
            self.state.before_rad = Some(self.driven_rad(world));
        }
        let (command, twist) = self.wanted(span);
        for (joint, wanted_rad) in self.steered.into_iter().zip(command.steering_rad) {
            // Never past the angle within a step, however long.
            let missing_rad = wanted_rad - angle(world, joint);
            let most = missing_rad.abs() / span.seconds().max(f64::MIN_POSITIVE);
            turn(world, &[joint], (self.gain * missing_rad).clamp(-most, most));
        }
        for (joints, speed) in self.driven.iter().zip(command.wheels_rad_s) {
            turn(world, joints, speed);
        }
        if matches!(self.command_source, CommandSource::Twist(_)) {
            world.follow_about(self.model, self.centre_m, twist);
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.state.now_ns = moment.time_ns();
        let Some(odometry_publisher) = &self.odometry_publisher else { return };
        let now = self.driven_rad(moment.world);
        let before = self.state.before_rad.replace(now).unwrap_or(now);
        let way_rad = (now[0] - before[0] + now[1] - before[1]) / 2.0;
        let way_m = way_rad * self.drive.wheel_radius_m;
        let [left_rad, right_rad] = self.steered.map(|joint| angle(moment.world, joint));
        let middle_rad = (left_rad + right_rad) / 2.0;
        let turned_rad = way_m * libm::tan(middle_rad) / self.drive.wheel_base_m;
        let displacement = Twist { x_m_s: way_m, y_m_s: 0.0, yaw_rad_s: turned_rad };
        self.state.pose = self.state.pose.advanced(displacement, 1.0);
        let dt_s = moment.span.seconds();
        let speed = |displacement: f64| if dt_s > 0.0 { displacement / dt_s } else { 0.0 };
        let twist = Twist { x_m_s: speed(way_m), y_m_s: 0.0, yaw_rad_s: speed(turned_rad) };
        publish(
            odometry_publisher,
            &mut self.state.publish_timer,
            moment,
            self.state.pose.pose(),
            twist,
        );
    }

    fn next_ns(&self) -> Option<i64> {
        next_ns(
            self.state.limiter.changes(),
            self.state.now_ns,
            &self.state.publish_timer,
            self.odometry_publisher.as_ref()?,
        )
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.limiter.reset();
        match &mut self.command_source {
            CommandSource::Twist(commands) => commands.reset(),
            CommandSource::Angle { inbox, last_rad } => {
                drop(inbox.drain());
                *last_rad = 0.0;
            }
        }
        self.state.before_rad = None;
        self.state.pose = Kinematic::default();
        self.state.publish_timer.restart(time_ns);
        self.state.now_ns = time_ns;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.command_source.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, commands)) = saved.get::<(GzAckermannState, CommandSourceState)>() else {
            return false;
        };
        self.state = state.clone();
        self.command_source.restore(commands)
    }
}
