//! `libgazebo_ros_p3d.so` of ROS 1 and ROS 2.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_graph::Qos;
use periplus_msgs::geometry_msgs;
use periplus_physics::{LinkId, LinkState, PhysicsWorld};
use periplus_plugin_specs::Family;
use periplus_sensors::Streams;

use super::geometry::vector;
use super::noise::noisy;
use super::odometry::{OdometryPublisher, diagonal};
use crate::drives::{Body, BuildContext, RateTimer, unscoped};
use crate::{Device, DeviceState, SenseContext, publisher_qos};

/// Frame names that denote the world.
const WORLDS: [&str; 4] = ["world", "/world", "map", "/map"];

/// The true pose of a link as odometry, in the world or in another link, with noise on the
/// velocities only and the square of its deviation as every variance.
///
/// Source: `gazebo_plugins/src/gazebo_ros_p3d.cpp` of `gazebo_ros_pkgs`: the twist is in world axes
/// (the original turns it once more, the wrong way, where the frame is a link; here it is in that
/// link's axes). Links that were merged over fixed joints are found, with their original pose.
pub(crate) struct P3d {
    name: String,
    body: Body,
    reference: Option<LinkId>,
    offset: Pose,
    noise: f64,
    streams: Streams,
    odometry_publisher: OdometryPublisher,
    publish_timer: RateTimer,
}

pub(crate) fn build(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Option<P3d> {
    let is_ros1 = context.plugin.known.family == Family::ClassicRos1;
    let [body_name, frame_name, rate, xyz, rpy, noise] = if is_ros1 {
        ["bodyName", "frameName", "updateRate", "xyzOffset", "rpyOffset", "gaussianNoise"]
    } else {
        ["body_name", "frame_name", "update_rate", "xyz_offset", "rpy_offset", "gaussian_noise"]
    };
    let link_name = context.given_text(body_name)?;
    let origin = context.plugin.values.origin(body_name);
    let body = context.body(link_name.trim(), origin, diagnostics)?;
    let frame = context.text(frame_name);
    let reference = if WORLDS.contains(&frame.trim()) {
        None
    } else {
        let mut unknown = Diagnostics::new();
        let origin = context.plugin.values.origin(frame_name);
        let found = context.link(frame.trim(), origin, &mut unknown);
        if found.is_none() {
            let message = format!("there is no link `{frame}`; the pose is published in the world");
            diagnostics.push(Diagnostic::warning("frame-missing", message).at(origin));
        }
        found
    };
    let node = context.node(diagnostics)?;
    let topic = if is_ros1 { context.given_text("topicName")? } else { "odom".to_owned() };
    let fallback = if is_ros1 { Qos::reliable(1) } else { Qos::sensor_data() };
    let qos = publisher_qos(&context.plugin.ros, &topic, fallback);
    let noise = context.number(noise);
    let mut odometry_publisher =
        OdometryPublisher::between(frame, unscoped(link_name.trim()).to_owned());
    odometry_publisher.odometry = Some(context.accept(node.publisher(&topic, qos), diagnostics)?);
    odometry_publisher.pose_covariance = diagonal([noise * noise; 6]);
    odometry_publisher.twist_covariance = odometry_publisher.pose_covariance;
    let [roll, pitch, yaw] = context.triple(rpy);
    Some(P3d {
        name: context.name(),
        body,
        reference,
        offset: Pose::from_xyz_rpy(context.triple(xyz), Rpy { roll, pitch, yaw }),
        noise,
        streams: Streams::new(context.setting.seed, context.name()),
        odometry_publisher,
        publish_timer: RateTimer::for_publisher(context.number(rate), context.setting.start_ns),
    })
}

impl P3d {
    /// Returns pose and velocities in the published frame.
    fn measured(&self, world: &PhysicsWorld) -> Option<(Pose, DVec3, DVec3)> {
        let LinkState { world_from_link, linear_m_s, angular_rad_s } = self.body.state(world)?;
        let (mut pose, mut linear, mut angular) = (world_from_link, linear_m_s, angular_rad_s);
        if let Some(reference) = self.reference {
            let frame = world.link_state(reference)?;
            let frame_from_world = frame.world_from_link.inverse();
            pose = frame_from_world * pose;
            linear = frame_from_world.rotation * (linear - frame.linear_m_s);
            angular = frame_from_world.rotation * (angular - frame.angular_rad_s);
        }
        // The offset translates along the axes of the frame and rotates after the pose's own
        // rotation.
        let shifted = Pose {
            translation: pose.translation + self.offset.translation,
            rotation: (self.offset.rotation * pose.rotation).normalize(),
        };
        Some((shifted, linear, angular))
    }
}

impl Device for P3d {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        let Some(number) = self.publish_timer.due_number(now_ns) else { return };
        if !self.odometry_publisher.has_subscribers() {
            return;
        }
        let Some((pose, linear, angular)) = self.measured(moment.world) else { return };
        let mut stream = self.streams.tick(number);
        let twist = geometry_msgs::Twist {
            linear: vector(noisy(linear, self.noise, &mut stream)),
            angular: vector(noisy(angular, self.noise, &mut stream)),
        };
        self.odometry_publisher.publish(now_ns, pose, twist);
    }

    fn next_ns(&self) -> Option<i64> {
        self.publish_timer.next_ns().filter(|_| self.odometry_publisher.has_subscribers())
    }

    fn reset(&mut self, time_ns: i64) {
        self.publish_timer.restart(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.publish_timer.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.publish_timer)
    }
}
