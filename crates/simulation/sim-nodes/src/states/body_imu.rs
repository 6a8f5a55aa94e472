//! IMUs of ROS 1 that are plugins of a model: `libgazebo_ros_imu.so` and `libhector_gazebo_ros_imu.so`.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DQuat, DVec3, Pose, Rpy};
use periplus_graph::{Publisher, Qos};
use periplus_msgs::geometry_msgs::Quaternion;
use periplus_msgs::sensor_msgs;
use periplus_msgs::std_msgs::Header;
use periplus_scene::{ImuSpec, NoiseKind, NoiseSpec};
use periplus_sensors::{ImuSensor, Motion, NoiseModel, OrientationReference, Streams};

use super::geometry::vector;
use crate::drives::{Body, BuildContext, RateTimer, unscoped};
use crate::sensors::diagonal;
use crate::{Device, DeviceState, SenseContext};

const HECTOR: &str = "hector_gazebo_ros_imu";

/// An IMU on a link. Its orientation is that in the world.
///
/// Source: `gazebo_ros_imu.cpp` of `gazebo_plugins` and of `hector_gazebo_plugins`, `sensor_model.h`. The first measures
/// the acceleration without gravity; the original turns its vectors from the link into the world instead of the other way
/// round, here they are in the link's axes.
pub(crate) struct BodyImu {
    name: String,
    body: Body,
    offset: Pose,
    frame: String,
    streams: Streams,
    publisher: Publisher<sensor_msgs::Imu>,
    has_gravity: bool,
    covariances: Covariances,
    start: Option<Motion>,
    state: BodyImuState,
}

#[derive(Clone)]
struct BodyImuState {
    timer: RateTimer,
    imu: ImuSensor,
    /// Errors of the acceleration, which are those of the level, too.
    acceleration: [NoiseModel; 3],
    heading: NoiseModel,
    measured_ns: Option<i64>,
}

struct Covariances {
    orientation: [f64; 9],
    turn: [f64; 9],
    force: [f64; 9],
}

pub(crate) fn build(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Option<BodyImu> {
    let is_hector = context.plugin.known.id == HECTOR;
    let origin = context.plugin.values.origin("bodyName");
    let (body, link) = match context.given_text("bodyName") {
        Some(link) => {
            let link = link.trim().to_owned();
            (context.body(&link, origin, diagnostics)?, unscoped(&link).to_owned())
        }
        None => (Body::of_model(context)?, context.model().links.first()?.name.clone()),
    };
    // The IMU of `gazebo_plugins` always has its link's frame.
    let frame = if is_hector { context.given_text("frameId") } else { None };
    let noises = Noises::read(context, is_hector);
    let streams = Streams::new(context.setting.seed, context.name());
    let spec = ImuSpec {
        angular_velocity: noises.turn,
        // Errors of the acceleration are those of the level, too: they are added below.
        linear_acceleration: [NoiseSpec::default(); 3],
        enable_orientation: true,
        localization: None,
        extra: Vec::new(),
    };
    let imu = ImuSensor::new(&spec, Some(OrientationReference::WORLD), &streams);
    let acceleration = [0, 1, 2].map(|axis| {
        NoiseModel::new(&noises.force[axis], &streams, &format!("linear_acceleration/{axis}"))
    });
    let gravity_m_s2 = context.setting.scene.gravity_m_s2.length();
    let covariances = noises.covariances(is_hector, gravity_m_s2);
    let topic = context.text("topicName");
    let depth = if is_hector { 10 } else { 1 };
    let node = context.node(diagnostics)?;
    let publisher = context.accept(node.publisher(&topic, Qos::reliable(depth)), diagnostics)?;
    let start_ns = context.setting.start_ns;
    let [roll, pitch, yaw] = if is_hector { [0.0; 3] } else { context.triple("rpyOffset") };
    let mut device = BodyImu {
        name: context.name(),
        body,
        offset: Pose::from_xyz_rpy([0.0; 3], Rpy { roll, pitch, yaw }),
        frame: frame.map_or(link, |frame| frame.trim().to_owned()),
        has_gravity: is_hector,
        covariances,
        publisher,
        start: None,
        state: BodyImuState {
            timer: RateTimer::for_publisher(context.number("updateRate"), start_ns),
            imu,
            acceleration,
            heading: NoiseModel::new(&noises.heading, &streams, "heading"),
            measured_ns: None,
        },
        streams,
    };
    device.start = body.state(context.setting.world).map(|link| device.motion(&link));
    if let Some(start) = &device.start {
        device.state.imu.skip(start_ns, start);
    }
    Some(device)
}

/// Errors of the measured quantities.
struct Noises {
    turn: [NoiseSpec; 3],
    force: [NoiseSpec; 3],
    heading: NoiseSpec,
}

impl Noises {
    fn read(context: &BuildContext<'_>, is_hector: bool) -> Self {
        let common = context.number("gaussianNoise");
        if !is_hector {
            let white = gaussian(common, 0.0, 0.0, 0.0, 0.0);
            return Self { turn: [white; 3], force: [white; 3], heading: NoiseSpec::default() };
        }
        let period_s = match context.number("updateRate") {
            rate_hz if rate_hz > 0.0 => 1.0 / rate_hz,
            // The default step of Gazebo.
            _ => 0.001,
        };
        let three = |prefix: &str, offset: [f64; 3]| {
            let [noise, drift] =
                ["GaussianNoise", "Drift"].map(|name| context.triple(&format!("{prefix}{name}")));
            let frequency = context.triple(&format!("{prefix}DriftFrequency"));
            [0, 1, 2].map(|axis| {
                let white = if common > 0.0 { common } else { noise[axis] };
                gaussian(white, offset[axis], drift[axis], frequency[axis], period_s)
            })
        };
        // Offsets of the orientation are those of an accelerometer that is not level.
        let [roll, pitch, yaw] = context.triple("rpyOffset");
        let or = |given: f64, fallback: f64| if given == 0.0 { fallback } else { given };
        let [x, y, z] = context.triple("accelOffset");
        let level = [or(x, pitch * STANDARD_GRAVITY_M_S2), or(y, -roll * STANDARD_GRAVITY_M_S2), z];
        let heading = gaussian(
            context.number("headingGaussianNoise"),
            or(context.number("headingOffset"), yaw),
            context.number("headingDrift"),
            context.number("headingDriftFrequency"),
            period_s,
        );
        Self {
            turn: three("rate", context.triple("rateOffset")),
            force: three("accel", level),
            heading,
        }
    }

    fn covariances(&self, is_hector: bool, gravity_m_s2: f64) -> Covariances {
        let of = |noises: &[NoiseSpec; 3]| {
            diagonal([0, 1, 2].map(|axis| noises[axis].stddev * noises[axis].stddev))
        };
        let orientation = if !is_hector {
            of(&self.force)
        } else if gravity_m_s2 > 0.0 {
            let level = |axis: usize| {
                let angle_rad = self.force[axis].stddev / gravity_m_s2;
                angle_rad * angle_rad
            };
            diagonal([level(0), level(1), self.heading.stddev * self.heading.stddev])
        } else {
            diagonal([-1.0, -1.0, self.heading.stddev * self.heading.stddev])
        };
        Covariances { orientation, turn: of(&self.turn), force: of(&self.force) }
    }
}

/// Standard gravity as the original rounds it \[m/s²\].
const STANDARD_GRAVITY_M_S2: f64 = 9.8065;

/// White noise with a bias that drifts: `b ← b - dt (f b + N(0, sqrt(2 f) drift))`.
fn gaussian(stddev: f64, mean: f64, drift: f64, frequency_hz: f64, period_s: f64) -> NoiseSpec {
    NoiseSpec {
        kind: NoiseKind::Gaussian,
        stddev,
        mean,
        // One step of the original has the deviation dt sqrt(2 f) drift; that of the model has sqrt(dt) times this.
        dynamic_bias_stddev: drift * libm::sqrt(2.0 * frequency_hz * period_s),
        dynamic_bias_correlation_time_s: if frequency_hz > 0.0 { 1.0 / frequency_hz } else { 0.0 },
        ..NoiseSpec::default()
    }
}

impl BodyImu {
    fn motion(&self, link: &periplus_physics::LinkState) -> Motion {
        // The offset turns the axes of the world, as in the original.
        let mut motion = Motion::on_link(link, Pose::IDENTITY);
        let turned = self.offset.rotation * motion.world_from_sensor.rotation;
        motion.world_from_sensor.rotation = turned.normalize();
        motion
    }
}

impl Device for BodyImu {
    fn name(&self) -> &str {
        &self.name
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        let Some(number) = self.state.timer.due_number(now_ns) else { return };
        let Some(link) = self.body.state(moment.world) else { return };
        let motion = self.motion(&link);
        let last_ns = self.state.measured_ns.replace(now_ns).unwrap_or(now_ns);
        if !self.publisher.is_heard() {
            self.state.imu.skip(now_ns, &motion);
            return;
        }
        let dt_s = (now_ns - last_ns) as f64 * 1e-9;
        let mut stream = self.streams.tick(number);
        let gravity = moment.world.gravity_m_s2();
        let felt = if self.has_gravity { gravity } else { DVec3::ZERO };
        let reading = self.state.imu.measure(now_ns, &motion, felt, &mut stream);
        let error = DVec3::from_array(
            [0, 1, 2].map(|axis| self.state.acceleration[axis].apply(0.0, dt_s, &mut stream)),
        );
        let mut orientation = reading.orientation.unwrap_or(DQuat::IDENTITY);
        if self.has_gravity {
            let heading_rad = self.state.heading.apply(0.0, dt_s, &mut stream);
            let down = motion.in_sensor(gravity);
            let level = match (down.try_normalize(), (down + error).try_normalize()) {
                (Some(true_down), Some(felt_down)) => {
                    DQuat::from_rotation_arc(true_down, felt_down)
                }
                _ => DQuat::IDENTITY,
            };
            orientation = level * orientation * DQuat::from_rotation_z(heading_rad);
        }
        let DQuat { x, y, z, w } = orientation;
        self.publisher.publish(sensor_msgs::Imu {
            header: Header::at(now_ns, &self.frame),
            orientation: Quaternion { x, y, z, w },
            orientation_covariance: self.covariances.orientation,
            angular_velocity: vector(reading.angular_velocity_rad_s),
            angular_velocity_covariance: self.covariances.turn,
            linear_acceleration: vector(reading.linear_acceleration_m_s2 + error),
            linear_acceleration_covariance: self.covariances.force,
        });
    }

    fn next_ns(&self) -> Option<i64> {
        self.state.timer.next_ns().filter(|_| self.publisher.is_heard())
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.timer.restart(time_ns);
        self.state.imu.reset();
        self.state.acceleration.iter_mut().for_each(NoiseModel::reset);
        self.state.heading.reset();
        self.state.measured_ns = None;
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
