//! Inertial measurement units.

use periplus_geometry::DVec3;
use periplus_graph::Publisher;
use periplus_msgs::geometry_msgs::{Quaternion, Vector3};
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_scene::{Noise, NoiseKind};
use periplus_sensors::{Imu, Motion, OrientationReference};

use super::port::{Port, Style};
use super::{Made, Mount, Order, Timer};
use crate::{Device, Moment};

struct ImuDevice {
    mount: Mount,
    timer: Timer,
    imu: Imu,
    /// How it moved when it was made, and moves again after a reset.
    start: Option<Motion>,
    outs: Vec<(String, Publisher<sensor_msgs::Imu>)>,
}

pub(super) fn device(order: Order<'_, '_>, spec: &periplus_scene::Imu) -> Made {
    let mut spec = spec.clone();
    // ROS 1 plugins have one noise for everything.
    let noise =
        order.ports.iter().filter_map(|port| port.given("gaussianNoise")).fold(0.0, f64::max);
    for own in spec.angular_velocity.iter_mut().chain(&mut spec.linear_acceleration) {
        if noise > 0.0 && own.kind == NoiseKind::None {
            *own = Noise { kind: NoiseKind::Gaussian, stddev: noise, ..Noise::default() };
        }
    }
    let reference = reference(&order, &spec)?;
    let mut outs = Vec::new();
    for port in &order.ports {
        outs.push((port.frame.clone(), port.publisher(&port.topic(order.post, "/imu"))?));
    }
    let mut imu = Imu::new(&spec, Some(reference), order.mount.streams());
    let start = order.mount.motion(order.post.setting.world);
    if let Some(start) = &start {
        imu.pass(order.post.setting.start_ns, start);
    }
    Ok(Box::new(ImuDevice {
        timer: Timer::new(order.post, &order.ports),
        mount: order.mount,
        imu,
        start,
        outs,
    }))
}

/// ROS plugins measure against the world unless told to take the start (REP 145); gz-sensors
/// against the start unless the file names a frame.
fn reference(
    order: &Order<'_, '_>,
    spec: &periplus_scene::Imu,
) -> Result<OrientationReference, super::Failed> {
    let from_start = |port: &Port| match port.style {
        Style::Ros2 => port.flag("initial_orientation_as_reference"),
        Style::Ros1 => port.flag("initialOrientationAsReference"),
        Style::Gz => true,
    };
    let scene = order.post.setting.scene;
    let heading_rad = scene.spherical_coordinates.as_ref().map_or(0.0, |globe| globe.heading_rad);
    let written = OrientationReference::read(spec, heading_rad, scene.gravity_m_s2)?;
    let usual = if order.ports.iter().all(from_start) {
        OrientationReference::START
    } else {
        OrientationReference::WORLD
    };
    let classic = order.ports.iter().any(|port| port.style != Style::Gz);
    Ok(if classic { usual } else { written.unwrap_or(usual) })
}

impl Device for ImuDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.timer.due(time_ns) else { return };
        let Some(motion) = self.mount.motion(moment.world) else { return };
        if !self.outs.iter().any(|(_, out)| out.is_heard()) {
            self.imu.pass(time_ns, &motion);
            return;
        }
        let mut stream = self.mount.streams().tick(tick.number);
        let gravity = moment.world.gravity_m_s2();
        let reading = self.imu.measure(time_ns, &motion, gravity, &mut stream);
        let [turn, force] = self.imu.variances().map(diagonal);
        let mut orientation_covariance = [0.0; 9];
        let mut orientation = Quaternion::default();
        match reading.orientation {
            Some(q) => orientation = Quaternion { x: q.x, y: q.y, z: q.z, w: q.w },
            // REP 145: not reported.
            None => orientation_covariance[0] = -1.0,
        }
        for (frame, out) in self.outs.iter().filter(|(_, out)| out.is_heard()) {
            out.publish(sensor_msgs::Imu {
                header: Header::at(time_ns, frame),
                orientation: orientation.clone(),
                orientation_covariance,
                angular_velocity: vector(reading.angular_velocity_rad_s),
                angular_velocity_covariance: turn,
                linear_acceleration: vector(reading.linear_acceleration_m_s2),
                linear_acceleration_covariance: force,
            });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let is_heard = self.outs.iter().any(|(_, out)| out.is_heard());
        self.timer.next_ns().filter(|_| is_heard)
    }

    fn reset(&mut self, time_ns: i64) {
        self.timer.reset(time_ns);
        self.imu.reset();
        if let Some(start) = &self.start {
            self.imu.pass(time_ns, start);
        }
    }
}

/// A covariance of independent axes.
pub(super) fn diagonal(variances: [f64; 3]) -> [f64; 9] {
    let [x, y, z] = variances;
    [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z]
}

pub(super) fn vector(v: DVec3) -> Vector3 {
    Vector3 { x: v.x, y: v.y, z: v.z }
}
