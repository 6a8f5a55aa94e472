//! `gz-sim-odometry-publisher-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_graph::{Publisher, Qos};
use periplus_msgs::{geometry_msgs, nav_msgs};
use periplus_sensors::Streams;

use super::geometry::vector;
use super::noise::noisy;
use super::odometry::{OdometryPublisher, diagonal};
use crate::drives::{Body, BuildContext, RateTimer, RollingMean};
use crate::{Device, DeviceState, SenseContext, StepInterval, gz_topic};

/// The true pose of a model as odometry. Velocities are differences between steps: the linear one is
/// averaged over ten, the angular one is not. Noise applies to the velocities only; on the topic
/// with covariances every variance is the square of its deviation, on the plain one zero.
///
/// With two dimensions the height is omitted, roll and pitch are not, and velocities are along the
/// heading; with three everything is in the axes of the body.
///
/// Source: gz-sim 8, `OdometryPublisher.cc`.
pub(crate) struct GzOdometry {
    name: String,
    body: Body,
    offset: Pose,
    is_flat: bool,
    noise: f64,
    streams: Streams,
    state: GzOdometryState,
    odometry_publisher: OdometryPublisher,
    with_covariance: OdometryPublisher,
}

#[derive(Clone)]
struct GzOdometryState {
    before: Option<Pose>,
    linear: RollingMean<3>,
    publish_timer: RateTimer,
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<GzOdometry> {
    let model = context.model_name();
    let frame = |parameter: &str, fallback: &str| {
        context.given_text(parameter).unwrap_or_else(|| format!("{model}/{fallback}"))
    };
    let parent = frame("odom_frame", "odom");
    let child = frame("robot_base_frame", "base_footprint");
    let node = context.node(diagnostics)?;
    let noise = context.number("gaussian_noise");
    let topic = context.gz_topic("odom_topic", "odometry");
    let odometry_publisher = OdometryPublisher::between(parent.clone(), child.clone())
        .on(context, &node, &topic, diagnostics)?
        .with_gz_tf(context, &node, &context.gz_topic("tf_topic", "pose"), diagnostics)?;
    let topic = context.gz_topic("odom_covariance_topic", "odometry_with_covariance");
    let mut with_covariance = OdometryPublisher::between(parent, child);
    with_covariance.pose_covariance = diagonal([noise * noise; 6]);
    with_covariance.twist_covariance = with_covariance.pose_covariance;
    let publisher: Publisher<nav_msgs::Odometry> =
        context.accept(node.publisher(&gz_topic(&topic), Qos::reliable(1)), diagnostics)?;
    with_covariance.odometry = Some(publisher);
    let [roll, pitch, yaw] = context.triple("rpy_offset");
    Some(GzOdometry {
        name: context.name(),
        body: Body::of_model(context)?,
        offset: Pose::from_xyz_rpy(context.triple("xyz_offset"), Rpy { roll, pitch, yaw }),
        is_flat: context.plugin.values.integer("dimensions") != Some(3),
        noise,
        streams: Streams::new(context.setting.seed, context.name()),
        state: GzOdometryState {
            before: None,
            linear: RollingMean::default(),
            publish_timer: RateTimer::for_publisher(
                context.number("odom_publish_frequency"),
                context.setting.start_ns,
            ),
        },
        odometry_publisher,
        with_covariance,
    })
}

impl GzOdometry {
    /// Returns linear and angular velocity of a step, in the published axes.
    fn velocities(&self, before: Pose, now: Pose, span: StepInterval) -> (DVec3, DVec3) {
        let dt_s = span.seconds();
        let way_m = now.translation - before.translation;
        let turn = (now.rotation * before.rotation.conjugate()).normalize();
        let Rpy { roll, pitch, yaw } = periplus_geometry::rpy_from_quaternion(turn);
        let angular = now.rotation.conjugate() * (DVec3::new(roll, pitch, yaw) / dt_s);
        if self.is_flat {
            let (sine, cosine) = libm::sincos(now.rpy().yaw);
            let ahead = cosine * way_m.x + sine * way_m.y;
            let left = cosine * way_m.y - sine * way_m.x;
            (DVec3::new(ahead, left, 0.0) / dt_s, DVec3::new(0.0, 0.0, angular.z))
        } else {
            (now.rotation.conjugate() * way_m / dt_s, angular)
        }
    }
}

impl Device for GzOdometry {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut periplus_physics::PhysicsWorld, _span: StepInterval) {
        if self.state.before.is_none() {
            self.state.before =
                self.body.state(world).map(|state| state.world_from_link * self.offset);
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let Some(state) = self.body.state(moment.world) else { return };
        let now = state.world_from_link * self.offset;
        let before = self.state.before.replace(now).unwrap_or(now);
        if moment.span.length_ns <= 0 {
            return;
        }
        let (linear, angular) = self.velocities(before, now, moment.span);
        self.state.linear.push(linear.to_array());
        let now_ns = moment.time_ns();
        let Some(number) = self.state.publish_timer.due_number(now_ns) else { return };
        if !self.odometry_publisher.has_subscribers() && !self.with_covariance.has_subscribers() {
            return;
        }
        let mut stream = self.streams.tick(number);
        let linear = DVec3::from_array(self.state.linear.mean());
        let twist = geometry_msgs::Twist {
            linear: vector(noisy(linear, self.noise, &mut stream)),
            angular: vector(noisy(angular, self.noise, &mut stream)),
        };
        let mut pose = now;
        if self.is_flat {
            pose.translation.z = 0.0;
        }
        self.odometry_publisher.publish(now_ns, pose, twist.clone());
        self.with_covariance.publish(now_ns, pose, twist);
    }

    fn next_ns(&self) -> Option<i64> {
        let heard =
            self.odometry_publisher.has_subscribers() || self.with_covariance.has_subscribers();
        self.state.publish_timer.next_ns().filter(|_| heard)
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.before = None;
        self.state.linear.clear();
        self.state.publish_timer.restart(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.state.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.state)
    }
}
