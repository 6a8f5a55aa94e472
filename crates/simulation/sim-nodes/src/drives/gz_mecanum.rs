//! `gz-sim-mecanum-drive-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_physics::drives::{Mecanum, MecanumWheels};
use periplus_physics::{JointId, Kinematic, ModelId, Twist, World};

use super::beat::Beat;
use super::commands::Commands;
use super::encoders::angle;
use super::gz_common::{Limiter, limits, next_ns, tell, teller, turn};
use super::order::Order;
use crate::states::Teller;
use crate::{Device, Moment, Span};

/// Four wheels with slanted rollers. The rollers are a matter of friction directions in Gazebo, so
/// with physics the robot slides sideways only as far as contacts let it.
///
/// Source: gz-sim 8, `MecanumDrive.cc`.
pub(crate) struct GzMecanumDrive {
    name: String,
    model: ModelId,
    centre_m: DVec3,
    /// Front left, front right, back left, back right.
    wheels: [Vec<JointId>; 4],
    drive: Mecanum,
    limiter: Limiter,
    commands: Commands,
    before_rad: Option<[f64; 4]>,
    pose: Kinematic,
    teller: Teller,
    tells: Beat,
    now_ns: i64,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<GzMecanumDrive> {
    let names = ["front_left_joint", "front_right_joint", "back_left_joint", "back_right_joint"];
    let [front_left, front_right, back_left, back_right] =
        names.map(|name| order.joints(name, diagnostics));
    let wheels = [front_left?, front_right?, back_left?, back_right?];
    let node = order.node(diagnostics)?;
    let start_ns = order.setting.start_ns;
    Some(GzMecanumDrive {
        name: order.name(),
        model: order.setting.model,
        centre_m: order.middle(&wheels.concat()),
        wheels,
        drive: Mecanum {
            wheelbase_m: order.number("wheelbase"),
            wheel_separation_m: order.number("wheel_separation"),
            wheel_radius_m: order.number("wheel_radius"),
        },
        limiter: Limiter::new(limits(order, true)),
        commands: Commands::new(order, &node, &order.gz_topic("topic", "cmd_vel"), diagnostics)?,
        before_rad: None,
        pose: Kinematic::default(),
        teller: teller(order, &node, diagnostics)?,
        tells: Beat::telling(order.number("odom_publish_frequency"), start_ns),
        now_ns: start_ns,
    })
}

impl GzMecanumDrive {
    fn angles_rad(&self, world: &World) -> [f64; 4] {
        std::array::from_fn(|place| {
            self.wheels[place].first().map_or(0.0, |&joint| angle(world, joint))
        })
    }
}

impl Device for GzMecanumDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        if self.before_rad.is_none() {
            self.before_rad = Some(self.angles_rad(world));
        }
        let twist = self.limiter.limited(self.commands.planar(), span);
        let MecanumWheels { front_left, front_right, back_left, back_right } =
            self.drive.wheels(twist);
        let speeds = [front_left, front_right, back_left, back_right];
        for (joints, speed) in self.wheels.iter().zip(speeds) {
            turn(world, joints, speed);
        }
        world.follow_about(self.model, self.centre_m, twist);
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        self.now_ns = moment.time_ns();
        let now = self.angles_rad(moment.world);
        let before = self.before_rad.replace(now).unwrap_or(now);
        let [front_left, front_right, back_left, back_right] =
            std::array::from_fn(|place| now[place] - before[place]);
        // The way of this step as a twist over one second.
        let way =
            self.drive.twist(MecanumWheels { front_left, front_right, back_left, back_right });
        self.pose = self.pose.moved(way, 1.0);
        let dt_s = moment.span.seconds();
        let speed = |way: f64| if dt_s > 0.0 { way / dt_s } else { 0.0 };
        let twist = Twist {
            x_m_s: speed(way.x_m_s),
            y_m_s: speed(way.y_m_s),
            yaw_rad_s: speed(way.yaw_rad_s),
        };
        tell(&self.teller, &mut self.tells, moment, self.pose.pose(), twist);
    }

    fn next_ns(&self) -> Option<i64> {
        next_ns(self.limiter.changes(), self.now_ns, &self.tells, &self.teller)
    }

    fn reset(&mut self, time_ns: i64) {
        self.limiter.reset();
        self.commands.reset();
        self.before_rad = None;
        self.pose = Kinematic::default();
        self.tells.restart(time_ns);
        self.now_ns = time_ns;
    }
}
