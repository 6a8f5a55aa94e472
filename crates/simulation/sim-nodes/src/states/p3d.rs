//! `libgazebo_ros_p3d.so` of ROS 1 and ROS 2.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_graph::Qos;
use periplus_msgs::geometry_msgs;
use periplus_physics::{LinkId, LinkState, World};
use periplus_plugin_specs::Family;
use periplus_sensors::Streams;

use super::geometry::vector;
use super::noise::noisy;
use super::odometry::{Teller, diagonal};
use crate::drives::{Beat, Body, Order, unscoped};
use crate::{Device, Moment, publisher_qos};

/// Frames that mean the world itself.
const WORLDS: [&str; 4] = ["world", "/world", "map", "/map"];

/// The true pose of a link as odometry, in the world or in another link, with noise on the
/// velocities only and the square of its deviation as every variance.
///
/// Source: `gazebo_plugins/src/gazebo_ros_p3d.cpp` of `gazebo_ros_pkgs`: the twist is in world axes
/// (the original turns it once more, the wrong way, where the frame is a link; here it is in that
/// link's axes). Links that were merged over fixed joints are found, with their own place.
pub(crate) struct P3d {
    name: String,
    body: Body,
    reference: Option<LinkId>,
    offset: Pose,
    noise: f64,
    streams: Streams,
    teller: Teller,
    tells: Beat,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<P3d> {
    let is_ros1 = order.plugin.known.family == Family::ClassicRos1;
    let [body_name, frame_name, rate, xyz, rpy, noise] = if is_ros1 {
        ["bodyName", "frameName", "updateRate", "xyzOffset", "rpyOffset", "gaussianNoise"]
    } else {
        ["body_name", "frame_name", "update_rate", "xyz_offset", "rpy_offset", "gaussian_noise"]
    };
    let link_name = order.given_text(body_name)?;
    let origin = order.plugin.values.origin(body_name);
    let body = order.body(link_name.trim(), origin, diagnostics)?;
    let frame = order.text(frame_name);
    let reference = if WORLDS.contains(&frame.trim()) {
        None
    } else {
        let mut unknown = Diagnostics::new();
        let origin = order.plugin.values.origin(frame_name);
        let found = order.link(frame.trim(), origin, &mut unknown);
        if found.is_none() {
            let message = format!("there is no link `{frame}`; the pose is told in the world");
            diagnostics.push(Diagnostic::warning("frame-missing", message).at(origin));
        }
        found
    };
    let node = order.node(diagnostics)?;
    let topic = if is_ros1 { order.given_text("topicName")? } else { "odom".to_owned() };
    let usual = if is_ros1 { Qos::reliable(1) } else { Qos::sensor_data() };
    let qos = publisher_qos(&order.plugin.ros, &topic, usual);
    let noise = order.number(noise);
    let mut teller = Teller::between(frame, unscoped(link_name.trim()).to_owned());
    teller.odometry = Some(order.accept(node.publisher(&topic, qos), diagnostics)?);
    teller.pose_covariance = diagonal([noise * noise; 6]);
    teller.twist_covariance = teller.pose_covariance;
    let [roll, pitch, yaw] = order.triple(rpy);
    Some(P3d {
        name: order.name(),
        body,
        reference,
        offset: Pose::from_xyz_rpy(order.triple(xyz), Rpy { roll, pitch, yaw }),
        noise,
        streams: Streams::new(order.setting.seed, order.name()),
        teller,
        tells: Beat::telling(order.number(rate), order.setting.start_ns),
    })
}

impl P3d {
    /// Pose and velocities in the frame that is told.
    fn measured(&self, world: &World) -> Option<(Pose, DVec3, DVec3)> {
        let LinkState { world_from_link, linear_m_s, angular_rad_s } = self.body.state(world)?;
        let (mut pose, mut linear, mut angular) = (world_from_link, linear_m_s, angular_rad_s);
        if let Some(reference) = self.reference {
            let frame = world.link_state(reference)?;
            let frame_from_world = frame.world_from_link.inverse();
            pose = frame_from_world * pose;
            linear = frame_from_world.rotation * (linear - frame.linear_m_s);
            angular = frame_from_world.rotation * (angular - frame.angular_rad_s);
        }
        // The offset shifts along the axes of the frame and turns after the pose's own turn.
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

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let now_ns = moment.time_ns();
        let Some(number) = self.tells.due_number(now_ns) else { return };
        if !self.teller.is_heard() {
            return;
        }
        let Some((pose, linear, angular)) = self.measured(moment.world) else { return };
        let mut stream = self.streams.tick(number);
        let twist = geometry_msgs::Twist {
            linear: vector(noisy(linear, self.noise, &mut stream)),
            angular: vector(noisy(angular, self.noise, &mut stream)),
        };
        self.teller.tell(now_ns, pose, twist);
    }

    fn next_ns(&self) -> Option<i64> {
        self.tells.next_ns().filter(|_| self.teller.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.tells.restart(time_ns);
    }
}
