//! Inertial measurement units.

mod reference;

use periplus_geometry::{DQuat, DVec3, Stream};

pub use reference::OrientationReference;

use crate::{Motion, NoiseModel, Streams};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Reading of an IMU, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuMeasurement {
    /// `reference_from_sensor`; `None` without orientation output.
    pub orientation: Option<DQuat>,
    /// Angular velocity [rad/s].
    pub angular_velocity_rad_s: DVec3,
    /// Specific force: acceleration minus gravity, so that z reads +9.8 at rest (REP 145) [m/s²].
    pub linear_acceleration_m_s2: DVec3,
}

/// An inertial measurement unit.
///
/// A real accelerometer integrates velocity over its period. This model does the same: it reports
/// the change of the sensor's velocity (with the lever arm on its link) since the last measurement,
/// divided by the time, in the orientation halfway in between. The sum of all readings times their
/// periods is then the change of velocity, for any motion in between. Gravity is that of the current
/// orientation.
#[derive(Clone, Debug)]
pub struct ImuSensor {
    angular_velocity: [NoiseModel; 3],
    linear_acceleration: [NoiseModel; 3],
    reference: Option<OrientationReference>,
    world_from_reference: Option<DQuat>,
    last: Option<(i64, Motion)>,
}

impl ImuSensor {
    /// Creates an IMU with an orientation reference; without one it reports no orientation.
    #[must_use]
    pub fn new(
        spec: &periplus_scene::ImuSpec,
        reference: Option<OrientationReference>,
        streams: &Streams,
    ) -> Self {
        let noises = |noises: &[periplus_scene::NoiseSpec; 3], group: &str| {
            [0, 1, 2].map(|axis| {
                NoiseModel::new(&noises[axis], streams, &format!("{group}/{}", AXES[axis]))
            })
        };
        Self {
            angular_velocity: noises(&spec.angular_velocity, "angular_velocity"),
            linear_acceleration: noises(&spec.linear_acceleration, "linear_acceleration"),
            reference: reference.filter(|_| spec.enable_orientation),
            world_from_reference: None,
            last: None,
        }
    }

    /// Records the motion of a measurement without subscribers, as the start of the next one. Also
    /// valid before the first measurement.
    pub fn skip(&mut self, now_ns: i64, motion: &Motion) {
        self.update_reference(motion);
        self.last = Some((now_ns, *motion));
    }

    /// Returns the current reading. Without an earlier measurement the acceleration is zero.
    pub fn measure(
        &mut self,
        now_ns: i64,
        motion: &Motion,
        gravity_m_s2: DVec3,
        stream: &mut Stream,
    ) -> ImuMeasurement {
        let mut dt_s = 0.0;
        let mut felt = DVec3::ZERO;
        if let Some((last_ns, last)) = self.last.filter(|(last_ns, _)| *last_ns < now_ns) {
            #[expect(clippy::cast_precision_loss, reason = "a short time")]
            let passed_s = (now_ns - last_ns) as f64 / 1e9;
            dt_s = passed_s;
            let (before, now) =
                (last.world_from_sensor.rotation, motion.world_from_sensor.rotation);
            // Mean of two close rotations, for either sign of the quaternions.
            let nearer = if before.dot(now) < 0.0 { -now } else { now };
            let halfway = (before + nearer).normalize();
            felt = halfway.conjugate() * ((motion.linear_m_s - last.linear_m_s) / dt_s);
        }
        self.skip(now_ns, motion);
        let force = felt - motion.in_sensor(gravity_m_s2);
        let turn = motion.in_sensor(motion.angular_rad_s);
        let mut apply_bias_and_noise = |noises: &mut [NoiseModel; 3], vector: DVec3| {
            let values = vector.to_array();
            let spoiled = [0, 1, 2].map(|axis| noises[axis].apply(values[axis], dt_s, stream));
            DVec3::from_array(spoiled)
        };
        ImuMeasurement {
            angular_velocity_rad_s: apply_bias_and_noise(&mut self.angular_velocity, turn),
            linear_acceleration_m_s2: apply_bias_and_noise(&mut self.linear_acceleration, force),
            orientation: self
                .world_from_reference
                .map(|reference| reference.conjugate() * motion.world_from_sensor.rotation),
        }
    }

    /// Returns the variances of angular velocity [rad²/s²] and linear acceleration [m²/s⁴] along x,
    /// y, z.
    #[must_use]
    pub fn variances(&self) -> [[f64; 3]; 2] {
        let of = |noises: &[NoiseModel; 3]| {
            [0, 1, 2].map(|axis| noises[axis].spec().stddev * noises[axis].spec().stddev)
        };
        [of(&self.angular_velocity), of(&self.linear_acceleration)]
    }

    /// Sets the reference to a current orientation if it is that of the start (a calibration).
    pub fn set_reference(&mut self, world_from_reference: DQuat) {
        if self.reference.is_some() {
            self.world_from_reference = Some(world_from_reference);
        }
    }

    /// Discards the recorded motion, after a teleport of the robot.
    pub fn forget_motion(&mut self) {
        self.last = None;
    }

    /// Resets to the initial state.
    pub fn reset(&mut self) {
        self.last = None;
        self.world_from_reference = None;
        self.angular_velocity.iter_mut().for_each(NoiseModel::reset);
        self.linear_acceleration.iter_mut().for_each(NoiseModel::reset);
    }

    fn update_reference(&mut self, motion: &Motion) {
        if self.world_from_reference.is_none() {
            let start = motion.world_from_sensor.rotation;
            self.world_from_reference = self.reference.map(|reference| match reference {
                OrientationReference::Start { start_from_reference } => {
                    start * start_from_reference
                }
                OrientationReference::World { world_from_reference } => world_from_reference,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use periplus_geometry::{Pose, Rpy};
    use periplus_scene::{NoiseKind, NoiseSpec};

    use super::*;

    const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, -9.8);

    fn silent() -> periplus_scene::ImuSpec {
        periplus_scene::ImuSpec {
            angular_velocity: [NoiseSpec::default(); 3],
            linear_acceleration: [NoiseSpec::default(); 3],
            enable_orientation: true,
            localization: None,
            extra: Vec::new(),
        }
    }

    fn imu(reference: OrientationReference) -> ImuSensor {
        ImuSensor::new(&silent(), Some(reference), &Streams::new(0, "imu"))
    }

    fn near(a: DVec3, b: [f64; 3], within: f64) -> bool {
        a.distance(DVec3::from_array(b)) < within
    }

    fn stream() -> Stream {
        Stream::keyed(0, "", 0)
    }

    #[test]
    fn at_rest_it_feels_the_ground() {
        let mut imu = imu(OrientationReference::WORLD);
        let pitched = Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch: FRAC_PI_2, yaw: 0.0 });
        let level = imu.measure(0, &Motion::at_rest(Pose::IDENTITY), GRAVITY, &mut stream());
        assert_eq!(level.linear_acceleration_m_s2, DVec3::new(0.0, 0.0, 9.8));
        // Nose down: up is behind.
        let down = imu.measure(10, &Motion::at_rest(pitched), GRAVITY, &mut stream());
        assert!(near(down.linear_acceleration_m_s2, [-9.8, 0.0, 0.0], 1e-12), "{down:?}");
    }

    #[test]
    fn falling_it_feels_nothing() {
        let mut imu = imu(OrientationReference::START);
        let fall = |time_s: f64| Motion {
            linear_m_s: GRAVITY * time_s,
            ..Motion::at_rest(Pose::IDENTITY)
        };
        imu.skip(0, &fall(0.0));
        let reading = imu.measure(10_000_000, &fall(0.01), GRAVITY, &mut stream());
        assert!(near(reading.linear_acceleration_m_s2, [0.0; 3], 1e-12), "{reading:?}");
    }

    /// On a circle of 0.5 m at 2 rad/s: 0.5 · 2² = 2 m/s² to the centre, 9.8 up, and 0 along.
    #[test]
    fn on_a_turntable_it_feels_the_centre() {
        let mut imu = imu(OrientationReference::START);
        let at = |time_s: f64| {
            let yaw = Rpy { roll: 0.0, pitch: 0.0, yaw: 2.0 * time_s };
            let link = periplus_physics::LinkState {
                world_from_link: Pose::from_xyz_rpy([3.0, 1.0, 0.0], yaw),
                linear_m_s: DVec3::ZERO,
                angular_rad_s: DVec3::Z * 2.0,
            };
            Motion::on_link(&link, Pose::from_xyz(0.5, 0.0, 0.0))
        };
        imu.skip(0, &at(0.0));
        for tick in 1..200 {
            let time_s = f64::from(tick) * 0.01;
            let now_ns = i64::from(tick) * 10_000_000;
            let reading = imu.measure(now_ns, &at(time_s), GRAVITY, &mut stream());
            assert!(near(reading.linear_acceleration_m_s2, [-2.0, 0.0, 9.8], 1e-4), "{reading:?}");
            assert!(near(reading.angular_velocity_rad_s, [0.0, 0.0, 2.0], 1e-12));
        }
    }

    #[test]
    fn orientations_are_against_the_start_or_the_world() {
        let yaw = |yaw| Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch: 0.0, yaw });
        let last = |reference| {
            let mut imu = imu(reference);
            imu.skip(0, &Motion::at_rest(yaw(0.5)));
            let reading = imu.measure(1, &Motion::at_rest(yaw(0.7)), GRAVITY, &mut stream());
            Pose { rotation: reading.orientation.unwrap(), ..Pose::IDENTITY }.rpy().yaw
        };
        assert!((last(OrientationReference::START) - 0.2).abs() < 1e-12);
        assert!((last(OrientationReference::WORLD) - 0.7).abs() < 1e-12);
    }

    #[test]
    fn noise_comes_on_top_of_every_axis() {
        let noise =
            NoiseSpec { kind: NoiseKind::Gaussian, mean: 1.0, stddev: 0.5, ..NoiseSpec::default() };
        let spec = periplus_scene::ImuSpec { angular_velocity: [noise; 3], ..silent() };
        let streams = Streams::new(1, "imu");
        let mut imu = ImuSensor::new(&spec, None, &streams);
        let mut sum = DVec3::ZERO;
        for tick in 0..10_000_u64 {
            let motion = Motion::at_rest(Pose::IDENTITY);
            let reading = imu.measure(tick as i64, &motion, GRAVITY, &mut streams.tick(tick));
            assert_eq!(reading.orientation, None);
            sum += reading.angular_velocity_rad_s;
        }
        assert!(near(sum / 1e4, [1.0; 3], 0.03), "{sum}");
        assert_eq!(imu.variances(), [[0.25; 3], [0.0; 3]]);
    }
}
