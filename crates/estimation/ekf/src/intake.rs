//! Conversion of sensor readings to measurements.

use nalgebra::{Matrix3, SMatrix};
use periplus_geometry::{DQuat, DVec3, Pose};

use crate::settings::Source;
use crate::state::{Estimate, Measurement, Variable, three};

type Six = SMatrix<f64, 6, 6>;

/// Largest element of a rotation matrix that counts as zero.
const MIN_ROTATION_RATIO: f64 = 1e-6;

/// Pose from a driver.
#[derive(Clone, Copy, Debug)]
pub struct PoseReading {
    /// Stamp \[ns\].
    pub time_ns: i64,
    /// Pose of the robot.
    pub frame_from_base: Pose,
    /// Covariance of x, y, z and rotations about them, row-major.
    pub covariance: [f64; 36],
    /// Transform of that frame into the world frame.
    pub world_from_frame: Pose,
}

/// Velocities from a driver.
#[derive(Clone, Copy, Debug)]
pub struct TwistReading {
    /// Stamp \[ns\].
    pub time_ns: i64,
    /// Linear velocity of the sensor origin \[m/s\].
    pub linear: DVec3,
    /// Angular velocity \[rad/s\].
    pub angular: DVec3,
    /// Covariance of both, row-major.
    pub covariance: [f64; 36],
    /// Pose of the sensor on the robot.
    pub base_from_sensor: Pose,
}

/// Reading of an IMU.
#[derive(Clone, Copy, Debug)]
pub struct ImuReading {
    /// Stamp \[ns\].
    pub time_ns: i64,
    /// Orientation and its covariance; none if the IMU has no orientation.
    pub world_from_sensor: Option<(DQuat, [f64; 9])>,
    /// Angular velocity \[rad/s\] and its covariance.
    pub angular: Option<(DVec3, [f64; 9])>,
    /// Linear acceleration \[m/s²\], including gravity if the IMU includes it, and its covariance.
    pub acceleration: Option<(DVec3, [f64; 9])>,
    /// Pose of the sensor on the robot.
    pub base_from_sensor: Pose,
}

/// Converter from the readings of one input to measurements, with the state for `differential` and
/// `relative`.
#[derive(Clone, Debug)]
pub struct Intake {
    source: Source,
    last: Option<(i64, Pose, Six)>,
    first: Option<Pose>,
}

impl Intake {
    /// Creates the converter of an input.
    #[must_use]
    pub fn new(source: Source) -> Self {
        Self { source, last: None, first: None }
    }

    /// Returns the input.
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Resets the state.
    pub fn forget(&mut self) {
        (self.last, self.first) = (None, None);
    }

    /// Converts a pose. With `differential` it becomes the velocity since the previous pose, and
    /// the first pose has no result.
    pub fn pose(&mut self, reading: &PoseReading) -> Option<Measurement> {
        let mut mask = [false; 6];
        mask.copy_from_slice(&self.source.mask[..6]);
        if !mask.contains(&true) {
            return None;
        }
        let covariance = Six::from_row_slice(&reading.covariance);
        if self.source.is_differential {
            return self.difference(reading, covariance, mask);
        }
        let turn = rotation(reading.world_from_frame.rotation);
        let mut world_from_base = reading.world_from_frame * reading.frame_from_base;
        if self.source.is_relative {
            let first = *self.first.get_or_insert(world_from_base);
            world_from_base = first.inverse() * world_from_base;
        }
        let mut measurement = self.blank(reading.time_ns, 0);
        let rpy = world_from_base.rpy();
        let place = world_from_base.translation;
        let numbers = [place.x, place.y, place.z, rpy.roll, rpy.pitch, rpy.yaw];
        fill(&mut measurement, Variable::X, numbers, &covariance, mask, &turn);
        Some(measurement)
    }

    /// Returns the velocity between two poses in the base frame.
    fn difference(
        &mut self,
        reading: &PoseReading,
        covariance: Six,
        mask: [bool; 6],
    ) -> Option<Measurement> {
        let pose = reading.frame_from_base;
        let (last_ns, last, last_covariance) =
            self.last.replace((reading.time_ns, pose, covariance))?;
        let time_s = (reading.time_ns - last_ns) as f64 * 1e-9;
        if time_s <= 0.0 {
            return None;
        }
        let moved = last.inverse() * pose;
        let (way, turned) = (moved.translation / time_s, moved.rpy());
        let numbers =
            [way.x, way.y, way.z, turned.roll / time_s, turned.pitch / time_s, turned.yaw / time_s];
        // Both poses contribute, as in `robot_localization`.
        let covariance = (covariance + last_covariance) * time_s;
        let mut measurement = self.blank(reading.time_ns, 0);
        // Selected axes of the frame are mapped to those of the robot along them.
        let turn = rotation(pose.rotation.conjugate());
        fill_as_seen(&mut measurement, numbers, &covariance, mask, &turn);
        Some(measurement)
    }

    /// Converts velocities; `estimate` has the turn rate, which adds velocity at a sensor off the
    /// centre.
    pub fn twist(
        &mut self,
        reading: &TwistReading,
        estimate: Option<&Estimate>,
    ) -> Option<Measurement> {
        let mut mask = [false; 6];
        mask.copy_from_slice(&self.source.mask[6..12]);
        if !mask.contains(&true) {
            return None;
        }
        let Pose { translation, rotation: base_from_sensor } = reading.base_from_sensor;
        let rate = estimate.map_or(DVec3::ZERO, |it| three(&it.state, Variable::Vroll));
        let linear = base_from_sensor * reading.linear + translation.cross(rate);
        let angular = base_from_sensor * reading.angular;
        let covariance = Six::from_row_slice(&reading.covariance);
        let mut measurement = self.blank(reading.time_ns, 1);
        let numbers = [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z];
        fill(
            &mut measurement,
            Variable::Vx,
            numbers,
            &covariance,
            mask,
            &rotation(base_from_sensor),
        );
        Some(measurement)
    }

    /// Converts orientation, turn rate and acceleration to separate measurements.
    pub fn imu(
        &mut self,
        reading: &ImuReading,
        estimate: Option<&Estimate>,
        gravity_mps2: f64,
    ) -> Vec<Measurement> {
        let Pose { rotation: base_from_sensor, .. } = reading.base_from_sensor;
        let world_from_base = reading
            .world_from_sensor
            .map(|(world_from_sensor, _)| world_from_sensor * base_from_sensor.conjugate());
        let attitude = reading.world_from_sensor.zip(world_from_base).and_then(
            |((_, covariance), world_from_base)| {
                let mut six = [0.0; 36];
                place(&mut six, 3, &turned(&covariance, &rotation(base_from_sensor)));
                let reading = PoseReading {
                    time_ns: reading.time_ns,
                    frame_from_base: Pose { translation: DVec3::ZERO, rotation: world_from_base },
                    covariance: six,
                    world_from_frame: Pose::IDENTITY,
                };
                self.pose(&reading)
            },
        );
        let rate = reading.angular.and_then(|(angular, covariance)| {
            let mut six = [0.0; 36];
            place(&mut six, 3, &Matrix3::from_row_slice(&covariance));
            let mut reading = TwistReading {
                time_ns: reading.time_ns,
                linear: DVec3::ZERO,
                angular,
                covariance: six,
                base_from_sensor: reading.base_from_sensor,
            };
            // An IMU measures no velocity, so its lever arm is irrelevant.
            reading.base_from_sensor.translation = DVec3::ZERO;
            self.twist(&reading, None)
        });
        let push = reading.acceleration.and_then(|(measured, covariance)| {
            let mask = [self.source.mask[12], self.source.mask[13], self.source.mask[14]];
            if !mask.contains(&true) {
                return None;
            }
            let mut push = base_from_sensor * measured;
            if self.source.removes_gravity {
                let known = estimate.map(|it| it.world_from_base().rotation);
                let world_from_base = world_from_base.or(known).unwrap_or(DQuat::IDENTITY);
                push -= world_from_base.conjugate() * DVec3::new(0.0, 0.0, gravity_mps2);
            }
            let mut measurement = self.blank(reading.time_ns, 2);
            let turn = rotation(base_from_sensor);
            let covariance = turned(&covariance, &turn);
            let mask = led(mask, &turn);
            for row in 0..3 {
                let at = Variable::Ax.at() + row;
                (measurement.state[at], measurement.mask[at]) = (push[row], mask[row]);
            }
            let mut view = measurement.covariance.fixed_view_mut::<3, 3>(12, 12);
            view.copy_from(&covariance);
            Some(measurement)
        });
        [attitude, rate, push].into_iter().flatten().collect()
    }

    fn blank(&self, time_ns: i64, part: usize) -> Measurement {
        let mut blank = Measurement::empty(time_ns, self.source.name.clone());
        blank.most_deviations = self.source.most_deviations[part];
        blank
    }
}

/// Writes six variables from an index on, with rotated covariance and mask.
fn fill(
    measurement: &mut Measurement,
    from: Variable,
    numbers: [f64; 6],
    covariance: &Six,
    mask: [bool; 6],
    turn: &Matrix3<f64>,
) {
    let mut both = Six::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(turn);
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(turn);
    let covariance = both * covariance * both.transpose();
    put(measurement, from, numbers, &covariance, both_led(mask, turn));
}

/// Writes velocities between poses likewise.
fn fill_as_seen(
    measurement: &mut Measurement,
    numbers: [f64; 6],
    covariance: &Six,
    mask: [bool; 6],
    turn: &Matrix3<f64>,
) {
    // Roll, pitch and yaw keep their indices; only the linear axes rotate.
    let way = led([mask[0], mask[1], mask[2]], turn);
    let mask = [way[0], way[1], way[2], mask[3], mask[4], mask[5]];
    put(measurement, Variable::Vx, numbers, covariance, mask);
}

fn put(
    measurement: &mut Measurement,
    from: Variable,
    numbers: [f64; 6],
    covariance: &Six,
    mask: [bool; 6],
) {
    let at = from.at();
    for row in 0..6 {
        (measurement.state[at + row], measurement.mask[at + row]) = (numbers[row], mask[row]);
    }
    measurement.covariance.fixed_view_mut::<6, 6>(at, at).copy_from(covariance);
}

/// Returns the axes that are measured after a rotation: all to which a measured one contributes.
fn led(mask: [bool; 3], turn: &Matrix3<f64>) -> [bool; 3] {
    std::array::from_fn(|row| {
        (0..3).any(|column| mask[column] && turn[(row, column)].abs() > MIN_ROTATION_RATIO)
    })
}

fn both_led(mask: [bool; 6], turn: &Matrix3<f64>) -> [bool; 6] {
    let [a, b, c] = led([mask[0], mask[1], mask[2]], turn);
    let [d, e, f] = led([mask[3], mask[4], mask[5]], turn);
    [a, b, c, d, e, f]
}

fn rotation(turn: DQuat) -> Matrix3<f64> {
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turn * axis);
    Matrix3::from_fn(|row, column| columns[column][row])
}

fn turned(covariance: &[f64; 9], turn: &Matrix3<f64>) -> Matrix3<f64> {
    turn * Matrix3::from_row_slice(covariance) * turn.transpose()
}

/// Writes a 3x3 matrix to the diagonal of a row-major 6x6 matrix.
fn place(six: &mut [f64; 36], from: usize, three: &Matrix3<f64>) {
    for row in 0..3 {
        for column in 0..3 {
            six[(from + row) * 6 + from + column] = three[(row, column)];
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use periplus_geometry::Rpy;

    use super::*;
    use crate::settings::Kind;
    use crate::state::{Covariance, STATE_DIMENSIONS, State};

    fn intake(kind: Kind, taken: &[Variable]) -> Intake {
        let mut mask = [false; STATE_DIMENSIONS];
        taken.iter().for_each(|it| mask[it.at()] = true);
        Intake::new(Source {
            name: "it".into(),
            kind,
            topic: "it".into(),
            mask,
            queue: 10,
            is_differential: false,
            is_relative: false,
            removes_gravity: false,
            most_deviations: [f64::INFINITY; 3],
        })
    }

    fn turn(yaw: f64) -> DQuat {
        Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch: 0.0, yaw }).rotation
    }

    fn diagonal(of: [f64; 6]) -> [f64; 36] {
        std::array::from_fn(|at| if at % 7 == 0 { of[at / 7] } else { 0.0 })
    }

    #[test]
    fn a_sensor_that_is_mounted_turned_tells_of_the_robots_axes() {
        let mut intake = intake(Kind::Twist, &[Variable::Vx]);
        let reading = TwistReading {
            time_ns: 0,
            linear: DVec3::new(1.0, 0.0, 0.0),
            angular: DVec3::ZERO,
            covariance: diagonal([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]),
            base_from_sensor: Pose { translation: DVec3::ZERO, rotation: turn(FRAC_PI_2) },
        };
        let measured = intake.twist(&reading, None).expect("a velocity");
        assert!((measured.state[Variable::Vy.at()] - 1.0).abs() < 1e-12);
        let (vx, vy) = (Variable::Vx.at(), Variable::Vy.at());
        assert_eq!((measured.mask[vx], measured.mask[vy]), (false, true));
        assert!((measured.covariance[(vy, vy)] - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_sensor_off_the_middle_feels_the_turning() {
        // 2 m ahead of the centre of a robot that rotates in place at 0.5 rad/s: 1 m/s to the left.
        let mut intake = intake(Kind::Twist, &[Variable::Vx, Variable::Vy]);
        let (state, covariance) = (State::zeros(), Covariance::identity());
        let mut turning = Estimate { time_ns: 0, state, covariance };
        turning.state[Variable::Vyaw.at()] = 0.5;
        let reading = TwistReading {
            time_ns: 0,
            linear: DVec3::new(0.0, 1.0, 0.0),
            angular: DVec3::ZERO,
            covariance: [0.0; 36],
            base_from_sensor: Pose::from_xyz(2.0, 0.0, 0.0),
        };
        let measured = intake.twist(&reading, Some(&turning)).expect("a velocity");
        assert!(measured.state[Variable::Vy.at()].abs() < 1e-12, "{}", measured.state);
    }

    #[test]
    fn an_imu_upside_down_with_its_gravity() {
        let mut intake = intake(Kind::Imu, &[Variable::Yaw, Variable::Vyaw, Variable::Az]);
        intake.source.removes_gravity = true;
        let over = Pose::from_xyz_rpy([0.0; 3], Rpy { roll: PI, pitch: 0.0, yaw: 0.0 });
        let reading = ImuReading {
            time_ns: 0,
            // The robot faces along y; the IMU is mounted upside down.
            world_from_sensor: Some((turn(FRAC_PI_2) * over.rotation, [0.01; 9])),
            angular: Some((DVec3::new(0.0, 0.0, -0.3), [0.01; 9])),
            acceleration: Some((DVec3::new(0.0, 0.0, -9.8), [0.01; 9])),
            base_from_sensor: over,
        };
        let measured = intake.imu(&reading, None, 9.8);
        let value = |variable: Variable| {
            let one = measured.iter().find(|it| it.mask[variable.at()]);
            one.map(|it| it.state[variable.at()]).expect("it is measured")
        };
        assert!((value(Variable::Yaw) - FRAC_PI_2).abs() < 1e-9);
        assert!((value(Variable::Vyaw) - 0.3).abs() < 1e-9);
        assert!(value(Variable::Az).abs() < 1e-9);
    }

    #[test]
    fn poses_as_velocities_and_from_the_first() {
        let pose = |time_ns: i64, x_m: f64| PoseReading {
            time_ns,
            frame_from_base: Pose::from_xyz(x_m, 0.0, 0.0),
            covariance: diagonal([0.1; 6]),
            world_from_frame: Pose::IDENTITY,
        };
        let mut differential = intake(Kind::Pose, &[Variable::X]);
        differential.source.is_differential = true;
        assert_eq!(differential.pose(&pose(0, 5.0)), None);
        let measured = differential.pose(&pose(500_000_000, 6.0)).expect("a velocity");
        let vx = Variable::Vx.at();
        assert!(measured.mask[vx] && !measured.mask[0]);
        assert!((measured.state[vx] - 2.0).abs() < 1e-12);
        assert!((measured.covariance[(vx, vx)] - 0.1).abs() < 1e-12);

        let mut relative = intake(Kind::Pose, &[Variable::X]);
        relative.source.is_relative = true;
        let places = [5.0, 6.0].map(|x_m| relative.pose(&pose(0, x_m)).map(|it| it.state[0]));
        assert_eq!(places, [Some(0.0), Some(1.0)]);
    }
}
