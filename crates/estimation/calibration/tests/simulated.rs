//! Calibrations of thirty simulated robots with known errors.
#![allow(clippy::unwrap_used, reason = "tests")]

use periplus_calibration::{
    CalibrationError, DifferentialDrive, DriveCalibration, DriveParameter, ImuSample,
    ScannerDisplacement, WheelSample, WheelTrack, calibrate_drive, calibrate_imu, lidar_noise,
    match_scans, range_bias, refine_with_slam,
};
use periplus_geometry::{LaserScan2, Pose2, ScannerMounting, Stream};

/// Walls of a room with niches and a box: ends in the frame of the world \[m\].
const WALLS: [[f64; 4]; 14] = [
    [-4.0, -3.0, 4.0, -3.0],
    [4.0, -3.0, 4.0, 1.0],
    [4.0, 1.0, 5.0, 1.0],
    [5.0, 1.0, 5.0, 3.5],
    [5.0, 3.5, -1.0, 3.5],
    [-1.0, 3.5, -1.0, 3.0],
    [-1.0, 3.0, -4.0, 3.0],
    [-4.0, 3.0, -4.0, 0.5],
    [-4.0, 0.5, -4.5, 0.0],
    [-4.5, 0.0, -4.0, -3.0],
    [2.4, -1.4, 3.0, -1.1],
    [3.0, -1.1, 2.7, -0.5],
    [2.7, -0.5, 2.1, -0.8],
    [2.1, -0.8, 2.4, -1.4],
];

const BEAM_COUNT: usize = 360;
/// Time between scans, and between samples of the wheels \[s\].
const SCAN_PERIOD_S: f64 = 0.4;
const WHEEL_PERIOD_S: f64 = 0.02;

/// A robot with its errors.
struct Robot {
    drive: DifferentialDrive,
    scanner: Pose2,
    delay_s: f64,
    range_std_m: f64,
    range_bias_m: f64,
    dropout: f64,
    gyro: Gyro,
}

/// Errors of a gyroscope.
#[derive(Default)]
struct Gyro {
    bias_rad_s: f64,
    /// Standard deviation of a sample \[rad/s\].
    std_rad_s: f64,
    scale_ratio: f64,
    delay_s: f64,
}

impl Robot {
    /// Nominal robot with errors of a few percent, centimetres and degrees.
    fn random(number: u64) -> Self {
        let mut stream = Stream::keyed(11, "robot", number);
        let mut around = |value: f64, half: f64| value + half * (2.0 * stream.unit() - 1.0);
        Self {
            drive: DifferentialDrive {
                left_radius_m: around(0.08, 0.003),
                right_radius_m: around(0.08, 0.003),
                wheel_distance_m: around(0.35, 0.02),
            },
            scanner: Pose2::new(around(0.1, 0.1), around(0.0, 0.05), around(0.0, 0.2)),
            delay_s: around(0.0, 0.08),
            range_std_m: around(0.012, 0.006),
            dropout: around(0.03, 0.03),
            range_bias_m: around(0.0, 0.03),
            gyro: Gyro {
                bias_rad_s: around(0.0, 0.02),
                std_rad_s: around(0.006, 0.004),
                scale_ratio: around(1.0, 0.03),
                delay_s: around(0.0, 0.05),
            },
        }
    }
}

const NOMINAL: DifferentialDrive =
    DifferentialDrive { left_radius_m: 0.08, right_radius_m: 0.08, wheel_distance_m: 0.35 };

/// Range along a ray \[m\].
fn cast(x: f64, y: f64, angle_rad: f64) -> f64 {
    let (v, u) = libm::sincos(angle_rad);
    let hit = |[ax, ay, bx, by]: &[f64; 4]| {
        let (ex, ey) = (bx - ax, by - ay);
        let cross = u * ey - v * ex;
        let (dx, dy) = (ax - x, ay - y);
        let (along, part) = ((dx * ey - dy * ex) / cross, (dx * v - dy * u) / cross);
        (along > 0.0 && (0.0..=1.0).contains(&part)).then_some(along)
    };
    WALLS.iter().filter_map(hit).fold(f64::INFINITY, f64::min)
}

struct Recording {
    track: WheelTrack,
    scans: Vec<LaserScan2>,
    imu: Vec<ImuSample>,
}

/// Drives for a while with speeds of a function of time, and records wheels and scans.
fn record(
    robot: &Robot,
    duration_s: f64,
    number: u64,
    speeds: impl Fn(f64) -> (f64, f64),
) -> Recording {
    let mut stream = Stream::keyed(12, "drive", number);
    let (mut pose, mut left_rad, mut right_rad) = (Pose2::new(-0.5, -0.5, 0.0), 0.0, 0.0);
    let (mut samples, mut poses) = (Vec::new(), Vec::new());
    let (mut imu, mut imu_stream) = (Vec::new(), Stream::keyed(13, "imu", number));
    // In steps of 1 ms; wheels are sampled every 20 ms.
    let step_s = 1e-3;
    for tick in 0..=(duration_s / step_s) as usize {
        let stamp_s = tick as f64 * step_s;
        poses.push(pose);
        if tick % (WHEEL_PERIOD_S / step_s).round() as usize == 0 {
            samples.push(WheelSample { stamp_s, left_rad, right_rad });
        }
        let (speed_m_s, turn_rad_s) = speeds(stamp_s);
        let (left, right) = robot.drive.wheel_angles(speed_m_s * step_s, turn_rad_s * step_s);
        (left_rad, right_rad) = (left_rad + left, right_rad + right);
        pose = pose * robot.drive.motion(left, right);
        // At 100 Hz, with the rate of the middle of the last 10 ms.
        if tick % 10 == 0 {
            let gyro = &robot.gyro;
            let noise = gyro.std_rad_s * imu_stream.normal();
            let rate_rad_s = gyro.scale_ratio * turn_rad_s + gyro.bias_rad_s + noise;
            let mut level = || 0.05 * imu_stream.normal();
            imu.push(ImuSample {
                stamp_s: stamp_s + gyro.delay_s,
                angular_velocity_rad_s: [0.0, 0.0, rate_rad_s],
                acceleration_m_s2: [0.1 + level(), level(), 9.806_65 - 0.2 + level()],
            });
        }
    }
    let count = ((duration_s - 1.0) / SCAN_PERIOD_S) as usize;
    let scan = |index: usize| {
        // The stamp is the time of measurement and the delay.
        let time_s = 0.3 + index as f64 * SCAN_PERIOD_S;
        let at = poses[(time_s / step_s).round() as usize] * robot.scanner;
        let angle_min_rad = -std::f64::consts::PI;
        let angle_increment_rad = std::f64::consts::TAU / BEAM_COUNT as f64;
        let range = |beam: usize| {
            let angle_rad = at.yaw_rad + angle_min_rad + beam as f64 * angle_increment_rad;
            let range_m = cast(at.x_m, at.y_m, angle_rad)
                + robot.range_bias_m
                + robot.range_std_m * stream.normal();
            if stream.unit() < robot.dropout { f32::INFINITY } else { range_m as f32 }
        };
        LaserScan2 {
            time_ns: ((time_s + robot.delay_s) * 1e9).round() as i64,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad,
            angle_increment_rad,
            time_increment_s: 0.0,
            range_min_m: 0.1,
            range_max_m: 20.0,
            ranges_m: (0..BEAM_COUNT).map(range).collect(),
        }
    };
    let scans = (0..count).map(scan).collect();
    Recording { track: WheelTrack::new(samples), scans, imu }
}

/// Curves to both sides, turns on the spot, forward and backward.
fn varied(time_s: f64) -> (f64, f64) {
    (0.35 * libm::cos(0.5 * time_s), 0.9 * libm::sin(1.3 * time_s) + 0.3 * libm::cos(0.37 * time_s))
}

fn calibrate(recording: &Recording) -> Result<DriveCalibration, CalibrationError> {
    calibrate_drive(&recording.track, &displacements(recording), &NOMINAL, 0.2)
}

fn displacements(recording: &Recording) -> Vec<ScannerDisplacement> {
    let start = |from_s: f64, to_s: f64| recording.track.motion(&NOMINAL, from_s, to_s);
    match_scans(&recording.scans, 0.9 * SCAN_PERIOD_S, start)
}

#[test]
fn errors_of_thirty_robots_are_recovered() {
    for number in 0..30 {
        let robot = Robot::random(number);
        let recording = record(&robot, 60.0, number, varied);
        let found = calibrate(&recording).unwrap();
        let check = |name: &str, value: f64, expected: f64, max_error: f64| {
            let error = value - expected;
            assert!(
                error.abs() < max_error,
                "robot {number}, {name}: {error}\n{:?}",
                DriveCalibration { residuals: Vec::new(), ..found.clone() }
            );
        };
        let (drive, scanner) = (robot.drive, robot.scanner);
        let radius = |value, expected| check("radius", value, expected, 0.003 * expected);
        radius(found.left_radius_m.value, drive.left_radius_m);
        radius(found.right_radius_m.value, drive.right_radius_m);
        let distance_m = drive.wheel_distance_m;
        check("distance", found.wheel_distance_m.value, distance_m, 0.003 * distance_m);
        check("x", found.scanner_x_m.value, scanner.x_m, 0.005);
        check("y", found.scanner_y_m.value, scanner.y_m, 0.005);
        check("yaw", found.scanner_yaw_rad.value, scanner.yaw_rad, 0.3_f64.to_radians());
        check("delay", found.delay_s.value, robot.delay_s, 0.005);
        let noise = lidar_noise(&recording.scans).unwrap();
        check("noise", noise.std_m.value, robot.range_std_m, 0.1 * robot.range_std_m);
        check("dropout", noise.dropout_ratio.value, robot.dropout, 0.005);
        let bias = range_bias(&recording.scans, &noise).unwrap();
        check("range bias", bias.value, robot.range_bias_m, 0.005);
    }
}

/// Stops for 6 s of every 20 s.
fn with_stops(time_s: f64) -> (f64, f64) {
    if time_s % 20.0 < 6.0 { (0.0, 0.0) } else { varied(time_s) }
}

#[test]
fn gyroscopes_of_ten_robots_are_recovered() {
    for number in 0..10 {
        let robot = Robot::random(number);
        let recording = record(&robot, 60.0, number, with_stops);
        let displacements = displacements(&recording);
        let found = calibrate(&recording).unwrap();
        let imu = calibrate_imu(
            &recording.imu,
            Some(&recording.track),
            &displacements,
            found.delay_s.value,
            0.2,
        )
        .unwrap();
        let gyro = &robot.gyro;
        let check = |name: &str, value: f64, expected: f64, max_error: f64| {
            assert!(
                (value - expected).abs() < max_error,
                "robot {number}, {name}: {value}\n{imu:?}"
            );
        };
        let noise = imu.gyroscope.unwrap()[2];
        check("rate", imu.rate_hz, 100.0, 1e-6);
        check("bias", noise.bias.value, gyro.bias_rad_s, 1e-3);
        // The standard deviation of a sample is the density times the root of the rate.
        check("noise", noise.noise_density.value * 10.0, gyro.std_rad_s, 0.1 * gyro.std_rad_s);
        check("scale", imu.scale_ratio.unwrap().value, gyro.scale_ratio, 0.005);
        check("delay", imu.delay_s.unwrap().value, gyro.delay_s, 0.005);
        let accelerometer = imu.accelerometer.unwrap();
        check("bias of x", accelerometer[0].bias.value, 0.1, 0.01);
        check("bias of z", accelerometer[2].bias.value, -0.2, 0.01);
    }
}

#[test]
fn what_a_drive_without_stops_and_turns_does_not_show_is_named() {
    let robot = Robot::random(4);
    let recording = record(&robot, 20.0, 0, |time_s| (0.3 * libm::sin(0.7 * time_s), 0.0));
    let displacements = displacements(&recording);
    let track = Some(&recording.track);
    let imu = calibrate_imu(&recording.imu, track, &displacements, 0.0, 0.2).unwrap();
    assert!(imu.gyroscope.is_none() && imu.scale_ratio.is_none());
    assert!(imu.missing[0].contains("at rest") && imu.missing[1].contains("turn"), "{imu:?}");
    assert!(calibrate_imu(&recording.imu[..50], track, &displacements, 0.0, 0.2).is_none());
}

/// SLAM instead of pairs of scans is as exact.
#[test]
fn robots_are_recovered_with_slam() {
    for number in 0..3 {
        let robot = Robot { range_bias_m: 0.0, ..Robot::random(number) };
        let recording = record(&robot, 60.0, number, varied);
        let found = calibrate(&recording).unwrap();
        let found = refine_with_slam(&found, &recording.track, &recording.scans).unwrap();
        let ratio = |a: f64, b: f64| (a / b - 1.0).abs();
        assert!(ratio(found.left_radius_m.value, robot.drive.left_radius_m) < 0.003);
        assert!(ratio(found.right_radius_m.value, robot.drive.right_radius_m) < 0.003);
        assert!(ratio(found.wheel_distance_m.value, robot.drive.wheel_distance_m) < 0.003);
        assert!((found.scanner_x_m.value - robot.scanner.x_m).abs() < 0.005, "{number}");
        assert!((found.scanner_y_m.value - robot.scanner.y_m).abs() < 0.005, "{number}");
        assert!((found.scanner_yaw_rad.value - robot.scanner.yaw_rad).abs() < 0.005, "{number}");
    }
}

#[test]
fn standard_errors_are_those_of_repeated_drives() {
    let robot = Robot::random(3);
    // Errors in standard errors, over ten drives with other noise.
    let mut squares = Vec::new();
    for number in 100..110 {
        let found = calibrate(&record(&robot, 30.0, number, varied)).unwrap();
        for (found, expected) in [
            (found.wheel_distance_m, robot.drive.wheel_distance_m),
            (found.scanner_x_m, robot.scanner.x_m),
            (found.scanner_yaw_rad, robot.scanner.yaw_rad),
            (found.delay_s, robot.delay_s),
        ] {
            squares.push(libm::pow((found.value - expected) / found.standard_error, 2.0));
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((0.25..4.0).contains(&mean), "{mean} {squares:?}");
}

#[test]
fn a_straight_drive_does_not_determine_the_mount() {
    let robot = Robot::random(5);
    let recording = record(&robot, 20.0, 0, |time_s| (0.3 * libm::sin(0.7 * time_s), 0.0));
    let error = calibrate(&recording).unwrap_err();
    assert!(matches!(error, CalibrationError::NotObservable(_)), "{error:?}");
    assert!(error.to_string().contains("turn on the spot"), "{error}");
}

#[test]
fn turns_on_the_spot_do_not_determine_the_yaw_of_a_scanner_in_the_centre() {
    let mut robot = Robot::random(6);
    robot.scanner = Pose2::new(0.0, 0.0, 0.1);
    robot.range_bias_m = 0.0;
    let recording = record(&robot, 20.0, 0, |time_s| (0.0, 0.8 * libm::sin(0.9 * time_s)));
    let Err(CalibrationError::NotObservable(missing)) = calibrate(&recording) else {
        panic!("a turn on the spot has no direction");
    };
    assert!(missing.parameters.contains(&DriveParameter::ScannerYaw), "{missing:?}");
}

#[test]
fn short_recordings_are_refused() {
    let robot = Robot::random(7);
    let recording = record(&robot, 5.0, 0, varied);
    assert!(matches!(calibrate(&recording), Err(CalibrationError::TooFew(_))));
}
