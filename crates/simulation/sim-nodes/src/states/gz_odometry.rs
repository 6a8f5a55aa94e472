//! `gz-sim-odometry-publisher-system`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_graph::{Publisher, Qos};
use periplus_msgs::{geometry_msgs, nav_msgs};
use periplus_sensors::Streams;

use super::geometry::vector;
use super::noise::noisy;
use super::odometry::{Teller, diagonal};
use crate::drives::{Beat, Body, Order, RollingMean};
use crate::{Device, Moment, Span, gz_topic};

/// The true pose of a model as odometry. Velocities are those between steps: the linear one is the
/// mean of ten, the angular one is not. Noise is on the velocities only; the topic with covariances
/// has the square of its deviation as every variance, the plain one has none.
///
/// In two dimensions the height is left out, while roll and pitch are not, and velocities are along
/// the heading; in three everything is in the axes of the body.
///
/// Source: gz-sim 8, `OdometryPublisher.cc`.
pub(crate) struct GzOdometry {
    name: String,
    body: Body,
    offset: Pose,
    is_flat: bool,
    noise: f64,
    streams: Streams,
    before: Option<Pose>,
    linear: RollingMean<3>,
    teller: Teller,
    with_covariance: Teller,
    tells: Beat,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<GzOdometry> {
    let model = order.model_name();
    let frame = |parameter: &str, usual: &str| {
        order.given_text(parameter).unwrap_or_else(|| format!("{model}/{usual}"))
    };
    let parent = frame("odom_frame", "odom");
    let child = frame("robot_base_frame", "base_footprint");
    let node = order.node(diagnostics)?;
    let noise = order.number("gaussian_noise");
    let topic = order.gz_topic("odom_topic", "odometry");
    let teller = Teller::between(parent.clone(), child.clone())
        .on(order, &node, &topic, diagnostics)?
        .with_tf(order, &node, &order.gz_topic("tf_topic", "pose"), diagnostics)?;
    let topic = order.gz_topic("odom_covariance_topic", "odometry_with_covariance");
    let mut with_covariance = Teller::between(parent, child);
    with_covariance.pose_covariance = diagonal([noise * noise; 6]);
    with_covariance.twist_covariance = with_covariance.pose_covariance;
    let publisher: Publisher<nav_msgs::Odometry> =
        order.accept(node.publisher(&gz_topic(&topic), Qos::reliable(1)), diagnostics)?;
    with_covariance.odometry = Some(publisher);
    let [roll, pitch, yaw] = order.triple("rpy_offset");
    Some(GzOdometry {
        name: order.name(),
        body: Body::of_model(order)?,
        offset: Pose::from_xyz_rpy(order.triple("xyz_offset"), Rpy { roll, pitch, yaw }),
        is_flat: order.plugin.values.integer("dimensions") != Some(3),
        noise,
        streams: Streams::new(order.setting.seed, order.name()),
        before: None,
        linear: RollingMean::default(),
        teller,
        with_covariance,
        tells: Beat::telling(order.number("odom_publish_frequency"), order.setting.start_ns),
    })
}

impl GzOdometry {
    /// Linear and angular velocity of a step, in the axes that are told.
    fn velocities(&self, before: Pose, now: Pose, span: Span) -> (DVec3, DVec3) {
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

    fn act(&mut self, world: &mut periplus_physics::World, _span: Span) {
        if self.before.is_none() {
            self.before = self.body.state(world).map(|state| state.world_from_link * self.offset);
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let Some(state) = self.body.state(moment.world) else { return };
        let now = state.world_from_link * self.offset;
        let before = self.before.replace(now).unwrap_or(now);
        if moment.span.length_ns <= 0 {
            return;
        }
        let (linear, angular) = self.velocities(before, now, moment.span);
        self.linear.push(linear.to_array());
        let now_ns = moment.time_ns();
        let Some(number) = self.tells.due_number(now_ns) else { return };
        if !self.teller.is_heard() && !self.with_covariance.is_heard() {
            return;
        }
        let mut stream = self.streams.tick(number);
        let linear = DVec3::from_array(self.linear.mean());
        let twist = geometry_msgs::Twist {
            linear: vector(noisy(linear, self.noise, &mut stream)),
            angular: vector(noisy(angular, self.noise, &mut stream)),
        };
        let mut pose = now;
        if self.is_flat {
            pose.translation.z = 0.0;
        }
        self.teller.tell(now_ns, pose, twist.clone());
        self.with_covariance.tell(now_ns, pose, twist);
    }

    fn next_ns(&self) -> Option<i64> {
        let heard = self.teller.is_heard() || self.with_covariance.is_heard();
        self.tells.next_ns().filter(|_| heard)
    }

    fn reset(&mut self, time_ns: i64) {
        self.before = None;
        self.linear.clear();
        self.tells.restart(time_ns);
    }
}
