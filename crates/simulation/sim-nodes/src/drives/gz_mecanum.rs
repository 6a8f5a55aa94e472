//! `gz-sim-mecanum-drive-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_physics::drives::{Mecanum, MecanumWheels};
use periplus_physics::{JointId, Kinematic, ModelId, PhysicsWorld, Twist};

use super::build_context::BuildContext;
use super::commands::{Commands, CommandsState};
use super::encoders::angle;
use super::gz_common::{Limiter, limits, next_ns, odometry_publisher, publish, turn};
use super::rate_timer::RateTimer;
use crate::states::OdometryPublisher;
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// Four mecanum wheels. Gazebo models the rollers by friction directions, so with physics the robot
/// moves sideways only as far as contacts allow.
///
/// Source: gz-sim 8, `MecanumDrive.cc`.
pub(crate) struct GzMecanumDrive {
    name: String,
    model: ModelId,
    centre_m: DVec3,
    /// Front left, front right, back left, back right.
    wheels: [Vec<JointId>; 4],
    drive: Mecanum,
    commands: Commands,
    state: GzMecanumState,
    odometry_publisher: OdometryPublisher,
}

#[derive(Clone)]
struct GzMecanumState {
    limiter: Limiter,
    before_rad: Option<[f64; 4]>,
    pose: Kinematic,
    publish_timer: RateTimer,
    now_ns: i64,
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<GzMecanumDrive> {
    let names = ["front_left_joint", "front_right_joint", "back_left_joint", "back_right_joint"];
    let [front_left, front_right, back_left, back_right] =
        names.map(|name| context.joints(name, diagnostics));
    let wheels = [front_left?, front_right?, back_left?, back_right?];
    let node = context.node(diagnostics)?;
    let start_ns = context.setting.start_ns;
    Some(GzMecanumDrive {
        name: context.name(),
        model: context.setting.model,
        centre_m: context.middle(&wheels.concat()),
        wheels,
        drive: Mecanum {
            wheelbase_m: context.number("wheelbase"),
            wheel_separation_m: context.number("wheel_separation"),
            wheel_radius_m: context.number("wheel_radius"),
        },
        commands: Commands::new(
            context,
            &node,
            &context.gz_topic("topic", "cmd_vel"),
            diagnostics,
        )?,
        state: GzMecanumState {
            limiter: Limiter::new(limits(context, true)),
            before_rad: None,
            pose: Kinematic::default(),
            publish_timer: RateTimer::for_publisher(
                context.number("odom_publish_frequency"),
                start_ns,
            ),
            now_ns: start_ns,
        },
        odometry_publisher: odometry_publisher(context, &node, diagnostics)?,
    })
}

impl GzMecanumDrive {
    fn angles_rad(&self, world: &PhysicsWorld) -> [f64; 4] {
        std::array::from_fn(|place| {
            self.wheels[place].first().map_or(0.0, |&joint| angle(world, joint))
        })
    }
}

impl Device for GzMecanumDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        if self.state.before_rad.is_none() {
            self.state.before_rad = Some(self.angles_rad(world));
        }
        let twist = self.state.limiter.limited(self.commands.planar(), span);
        let MecanumWheels { front_left, front_right, back_left, back_right } =
            self.drive.wheels(twist);
        let speeds = [front_left, front_right, back_left, back_right];
        for (joints, speed) in self.wheels.iter().zip(speeds) {
            turn(world, joints, speed);
        }
        world.follow_about(self.model, self.centre_m, twist);
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.state.now_ns = moment.time_ns();
        let now = self.angles_rad(moment.world);
        let before = self.state.before_rad.replace(now).unwrap_or(now);
        let [front_left, front_right, back_left, back_right] =
            std::array::from_fn(|place| now[place] - before[place]);
        // Displacement of this step as a twist over one second.
        let displacement =
            self.drive.twist(MecanumWheels { front_left, front_right, back_left, back_right });
        self.state.pose = self.state.pose.advanced(displacement, 1.0);
        let dt_s = moment.span.seconds();
        let speed = |displacement: f64| if dt_s > 0.0 { displacement / dt_s } else { 0.0 };
        let twist = Twist {
            x_m_s: speed(displacement.x_m_s),
            y_m_s: speed(displacement.y_m_s),
            yaw_rad_s: speed(displacement.yaw_rad_s),
        };
        publish(
            &self.odometry_publisher,
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
            &self.odometry_publisher,
        )
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.limiter.reset();
        self.commands.reset();
        self.state.before_rad = None;
        self.state.pose = Kinematic::default();
        self.state.publish_timer.restart(time_ns);
        self.state.now_ns = time_ns;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, commands)) = saved.get::<(GzMecanumState, CommandsState)>() else {
            return false;
        };
        self.state = state.clone();
        self.commands.restore(commands);
        true
    }
}
