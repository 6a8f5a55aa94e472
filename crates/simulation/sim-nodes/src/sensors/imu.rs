//! Inertial measurement units.

use periplus_geometry::DVec3;
use periplus_graph::Publisher;
use periplus_msgs::geometry_msgs::{Quaternion, Vector3};
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_scene::{NoiseKind, NoiseSpec};
use periplus_sensors::{ImuSensor, Motion, OrientationReference};

use super::port::{Convention, SensorPort};
use super::{DeviceResult, Mount, SensorBuildContext, Timer};
use crate::{Device, DeviceState, SenseContext};

struct ImuDevice {
    mount: Mount,
    state: ImuState,
    /// Initial motion, restored by a reset.
    start: Option<Motion>,
    outputs: Vec<(String, Publisher<sensor_msgs::Imu>)>,
}

#[derive(Clone)]
struct ImuState {
    timer: Timer,
    imu: ImuSensor,
}

pub(super) fn device(
    context: SensorBuildContext<'_, '_>,
    spec: &periplus_scene::ImuSpec,
) -> DeviceResult {
    let mut spec = spec.clone();
    // ROS 1 plugins have a single noise parameter.
    let noise =
        context.ports.iter().filter_map(|port| port.given("gaussianNoise")).fold(0.0, f64::max);
    for own in spec.angular_velocity.iter_mut().chain(&mut spec.linear_acceleration) {
        if noise > 0.0 && own.kind == NoiseKind::None {
            *own = NoiseSpec { kind: NoiseKind::Gaussian, stddev: noise, ..NoiseSpec::default() };
        }
    }
    let reference = reference(&context, &spec)?;
    let mut outputs = Vec::new();
    for port in &context.ports {
        outputs.push((
            port.frame.clone(),
            port.publisher(&port.topic(context.sensor_context, "/imu"))?,
        ));
    }
    let mut imu = ImuSensor::new(&spec, Some(reference), context.mount.streams());
    let start = context.mount.motion(context.sensor_context.setting.world);
    if let Some(start) = &start {
        imu.skip(context.sensor_context.setting.start_ns, start);
    }
    Ok(Box::new(ImuDevice {
        state: ImuState { timer: Timer::new(context.sensor_context, &context.ports), imu },
        mount: context.mount,
        start,
        outputs,
    }))
}

/// ROS plugins measure relative to the world unless configured for the initial orientation (REP
/// 145); gz-sensors relative to the initial orientation unless the file names a frame.
fn reference(
    context: &SensorBuildContext<'_, '_>,
    spec: &periplus_scene::ImuSpec,
) -> Result<OrientationReference, super::SensorBuildError> {
    let from_start = |port: &SensorPort| match port.convention {
        Convention::Ros2 => port.flag("initial_orientation_as_reference"),
        Convention::Ros1 => port.flag("initialOrientationAsReference"),
        Convention::Gz => true,
    };
    let scene = context.sensor_context.setting.scene;
    let heading_rad = scene.spherical_coordinates.as_ref().map_or(0.0, |globe| globe.heading_rad);
    let written = OrientationReference::read(spec, heading_rad, scene.gravity_m_s2)?;
    let fallback = if context.ports.iter().all(from_start) {
        OrientationReference::START
    } else {
        OrientationReference::WORLD
    };
    let classic = context.ports.iter().any(|port| port.convention != Convention::Gz);
    Ok(if classic { fallback } else { written.unwrap_or(fallback) })
}

impl Device for ImuDevice {
    fn name(&self) -> &str {
        &self.mount.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let time_ns = moment.time_ns();
        let Some(tick) = self.state.timer.due(time_ns) else { return };
        let Some(motion) = self.mount.motion(moment.world) else { return };
        if !self.outputs.iter().any(|(_, out)| out.is_heard()) {
            self.state.imu.skip(time_ns, &motion);
            return;
        }
        let mut stream = self.mount.streams().tick(tick.number);
        let gravity = moment.world.gravity_m_s2();
        let reading = self.state.imu.measure(time_ns, &motion, gravity, &mut stream);
        let [turn, force] = self.state.imu.variances().map(diagonal);
        let mut orientation_covariance = [0.0; 9];
        let mut orientation = Quaternion::default();
        match reading.orientation {
            Some(q) => orientation = Quaternion { x: q.x, y: q.y, z: q.z, w: q.w },
            // REP 145: orientation is not available.
            None => orientation_covariance[0] = -1.0,
        }
        for (frame, out) in self.outputs.iter().filter(|(_, out)| out.is_heard()) {
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
        let has_subscribers = self.outputs.iter().any(|(_, out)| out.is_heard());
        self.state.timer.next_ns().filter(|_| has_subscribers)
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.reset(time_ns);
        self.state.imu.reset();
        if let Some(start) = &self.start {
            self.state.imu.skip(time_ns, start);
        }
    }

    fn save(&self) -> DeviceState {
        DeviceState::new(self.state.clone())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        saved.copy_to(&mut self.state)
    }
}

/// Returns the covariance matrix of independent axes.
pub(crate) fn diagonal(variances: [f64; 3]) -> [f64; 9] {
    let [x, y, z] = variances;
    [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z]
}

pub(super) fn vector(v: DVec3) -> Vector3 {
    Vector3 { x: v.x, y: v.y, z: v.z }
}
