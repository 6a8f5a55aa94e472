//! `gz-sim-ackermann-steering-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_graph::{Mailbox, Qos};
use periplus_msgs::std_msgs;
use periplus_physics::drives::{Ackermann, AckermannCommand};
use periplus_physics::{JointId, Kinematic, ModelId, Twist, World};

use super::beat::Beat;
use super::commands::Commands;
use super::encoders::angle;
use super::gz_common::{Limiter, limits, next_ns, tell, teller, turn};
use super::order::Order;
use crate::states::Teller;
use crate::{Device, Moment, Span, gz_topic};

/// Two driven wheels and two steered ones. A steered wheel turns towards its angle at
/// `steer_p_gain` times the angle that is missing; odometry is counted from the driven wheels along
/// the mean angle of the steered ones.
///
/// Source: gz-sim 8, `AckermannSteering.cc`.
pub(crate) struct GzAckermann {
    name: String,
    model: ModelId,
    /// The middle between the driven wheels, in the model [m].
    centre_m: DVec3,
    /// Left and right.
    driven: [Vec<JointId>; 2],
    steered: [JointId; 2],
    drive: Ackermann,
    gain: f64,
    limiter: Limiter,
    told: Told,
    before_rad: Option<[f64; 2]>,
    pose: Kinematic,
    teller: Option<Teller>,
    tells: Beat,
    now_ns: i64,
}

/// Where commands come from.
enum Told {
    Twist(Commands),
    /// With `steering_only`, an angle of the middle of the front axle [rad].
    Angle {
        inbox: Mailbox<std_msgs::Float64>,
        last_rad: f64,
    },
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<GzAckermann> {
    let steers_only = order.flag("steering_only");
    let [left, right] = ["left_joint", "right_joint"]
        .map(|name| if steers_only { Some(Vec::new()) } else { order.joints(name, diagnostics) });
    let steered =
        ["left_steering_joint", "right_steering_joint"].map(|name| order.joint(name, diagnostics));
    let (driven, steered) = ([left?, right?], [steered[0]?, steered[1]?]);
    let node = order.node(diagnostics)?;
    let start_ns = order.setting.start_ns;
    let sub_topic = order.given_text("sub_topic");
    let usual = if steers_only { "steer_angle" } else { "cmd_vel" };
    let topic = order.gz_topic("topic", sub_topic.as_deref().unwrap_or(usual));
    let told = if steers_only {
        let inbox = order.accept(node.mailbox(&gz_topic(&topic), Qos::reliable(1)), diagnostics)?;
        Told::Angle { inbox, last_rad: 0.0 }
    } else {
        Told::Twist(Commands::new(order, &node, &topic, diagnostics)?)
    };
    let drive = Ackermann {
        wheel_separation_m: order.number("wheel_separation"),
        kingpin_width_m: order.number("kingpin_width"),
        wheel_base_m: order.number("wheel_base"),
        steering_limit_rad: order.number("steering_limit"),
        wheel_radius_m: order.number("wheel_radius"),
    };
    Some(GzAckermann {
        name: order.name(),
        model: order.setting.model,
        centre_m: order.middle(&driven.concat()),
        driven,
        steered,
        drive,
        gain: order.number("steer_p_gain"),
        limiter: Limiter::new(limits(order, false)),
        told,
        before_rad: None,
        pose: Kinematic::default(),
        teller: if steers_only { None } else { Some(teller(order, &node, diagnostics)?) },
        tells: Beat::telling(order.number("odom_publish_frequency"), start_ns),
        now_ns: start_ns,
    })
}

impl GzAckermann {
    fn driven_rad(&self, world: &World) -> [f64; 2] {
        [0, 1].map(|side| self.driven[side].first().map_or(0.0, |&joint| angle(world, joint)))
    }

    /// What the joints should do in a step, and the turn rate of the driven axle.
    fn wanted(&mut self, span: Span) -> (AckermannCommand, Twist) {
        match &mut self.told {
            Told::Twist(commands) => {
                let Twist { x_m_s, yaw_rad_s, .. } = commands.planar();
                let twist = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
                let twist = self.limiter.limited(twist, span);
                let command = self.drive.command(twist);
                // What the wheels can do of it: no turning in place, no tighter than the limit.
                let [left, right] = command.wheels_rad_s;
                let yaw_rad_s =
                    (right - left) * self.drive.wheel_radius_m / self.drive.wheel_separation_m;
                (command, Twist { yaw_rad_s, ..twist })
            }
            Told::Angle { inbox, last_rad } => {
                if let Some(angle) = inbox.latest().filter(|angle| angle.data.is_finite()) {
                    *last_rad = angle.data;
                }
                // Driving ahead at a speed that makes this angle needs this turn rate.
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

    fn act(&mut self, world: &mut World, span: Span) {
        if self.before_rad.is_none() {
            self.before_rad = Some(self.driven_rad(world));
        }
        let (command, twist) = self.wanted(span);
        for (joint, wanted_rad) in self.steered.into_iter().zip(command.steering_rad) {
            // Never past the angle within a step, however long that is.
            let missing_rad = wanted_rad - angle(world, joint);
            let most = missing_rad.abs() / span.seconds().max(f64::MIN_POSITIVE);
            turn(world, &[joint], (self.gain * missing_rad).clamp(-most, most));
        }
        for (joints, speed) in self.driven.iter().zip(command.wheels_rad_s) {
            turn(world, joints, speed);
        }
        if matches!(self.told, Told::Twist(_)) {
            world.follow_about(self.model, self.centre_m, twist);
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        self.now_ns = moment.time_ns();
        let Some(teller) = &self.teller else { return };
        let now = self.driven_rad(moment.world);
        let before = self.before_rad.replace(now).unwrap_or(now);
        let way_rad = (now[0] - before[0] + now[1] - before[1]) / 2.0;
        let way_m = way_rad * self.drive.wheel_radius_m;
        let [left_rad, right_rad] = self.steered.map(|joint| angle(moment.world, joint));
        let middle_rad = (left_rad + right_rad) / 2.0;
        let turned_rad = way_m * libm::tan(middle_rad) / self.drive.wheel_base_m;
        let way = Twist { x_m_s: way_m, y_m_s: 0.0, yaw_rad_s: turned_rad };
        self.pose = self.pose.moved(way, 1.0);
        let dt_s = moment.span.seconds();
        let speed = |way: f64| if dt_s > 0.0 { way / dt_s } else { 0.0 };
        let twist = Twist { x_m_s: speed(way_m), y_m_s: 0.0, yaw_rad_s: speed(turned_rad) };
        tell(teller, &mut self.tells, moment, self.pose.pose(), twist);
    }

    fn next_ns(&self) -> Option<i64> {
        next_ns(self.limiter.changes(), self.now_ns, &self.tells, self.teller.as_ref()?)
    }

    fn reset(&mut self, time_ns: i64) {
        self.limiter.reset();
        match &mut self.told {
            Told::Twist(commands) => commands.reset(),
            Told::Angle { inbox, last_rad } => {
                drop(inbox.drain());
                *last_rad = 0.0;
            }
        }
        self.before_rad = None;
        self.pose = Kinematic::default();
        self.tells.restart(time_ns);
        self.now_ns = time_ns;
    }
}
