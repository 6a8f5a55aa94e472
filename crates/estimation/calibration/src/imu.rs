//! Noise, bias, scale and delay of an inertial sensor on a robot.

use nalgebra::{Matrix2, Vector2};

use crate::allan::{ImuNoise, imu_noise_of_parts};
use crate::estimated::Estimated;
use crate::scans::ScannerDisplacement;
use crate::wheels::WheelTrack;

/// Standard gravity \[m/s²\].
const GRAVITY_M_S2: f64 = 9.806_65;
/// Shortest time at rest that is used, and the time after a motion that is left out \[s\].
const MIN_REST_S: f64 = 1.0;
const SETTLING_S: f64 = 0.3;
/// Rotation of a wheel in a second below which it is at rest \[rad/s\].
const MAX_REST_RAD_S: f64 = 1e-3;
/// Step of the search of the delay \[s\].
const DELAY_STEP_S: f64 = 0.005;
/// Minimum number of displacements for scale and delay.
const MIN_DISPLACEMENT_COUNT: usize = 20;
/// Maximum standard errors of a scale and of a delay \[s\] that count as observed.
const MAX_SCALE_ERROR_RATIO: f64 = 0.05;
const MAX_DELAY_ERROR_S: f64 = 0.05;

/// Reading of an inertial sensor, as in `sensor_msgs/Imu`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuSample {
    /// Stamp \[s\].
    pub stamp_s: f64,
    /// Angular velocity about x, y, z \[rad/s\].
    pub angular_velocity_rad_s: [f64; 3],
    /// Linear acceleration along x, y, z \[m/s²\].
    pub acceleration_m_s2: [f64; 3],
}

/// Calibration of an inertial sensor with z up.
#[derive(Clone, Debug, PartialEq)]
pub struct ImuCalibration {
    /// Rate of the samples \[Hz\].
    pub rate_hz: f64,
    /// Time at rest \[s\].
    pub rest_s: f64,
    /// Noise of the gyroscope at rest, about x, y, z \[rad/s\].
    pub gyroscope: Option<[ImuNoise; 3]>,
    /// Noise of the accelerometer at rest, along x, y, z \[m/s²\]; the bias of z without gravity. Those of x and y
    /// contain the tilt of the robot.
    pub accelerometer: Option<[ImuNoise; 3]>,
    /// Measured rotation about z relative to the true one.
    pub scale_ratio: Option<Estimated>,
    /// Delay \[s\]: a sample with the stamp t was measured at t - delay by the clock of the wheels.
    pub delay_s: Option<Estimated>,
    /// Values that the recording does not determine, with the reason.
    pub missing: Vec<String>,
}

/// Calibrates an inertial sensor: its noise from the times at which the wheels do not turn (all of the recording
/// without wheels), scale and delay of the rotation about z from the rotations of the scanner, whose stamps have the
/// delay `scan_delay_s`. None with fewer than 100 samples.
#[must_use]
pub fn calibrate_imu(
    samples: &[ImuSample],
    track: Option<&WheelTrack>,
    displacements: &[ScannerDisplacement],
    scan_delay_s: f64,
    max_delay_s: f64,
) -> Option<ImuCalibration> {
    let mut samples = samples.to_vec();
    samples.sort_by(|a, b| a.stamp_s.total_cmp(&b.stamp_s));
    samples.dedup_by_key(|it| it.stamp_s);
    let (first, last) = (samples.first()?, samples.last()?);
    if samples.len() < 100 {
        return None;
    }
    let period_s = (last.stamp_s - first.stamp_s) / (samples.len() - 1) as f64;
    let parts = rest_parts(&samples, track);
    let rest_s = parts.iter().map(|it| it.len() as f64 * period_s).sum();
    let axis = |value: &dyn Fn(&ImuSample) -> f64| {
        let values: Vec<Vec<f64>> = parts.iter().map(|it| it.iter().map(value).collect()).collect();
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        imu_noise_of_parts(&values, period_s)
    };
    let three = |value: &dyn Fn(&ImuSample, usize) -> f64| -> Option<[ImuNoise; 3]> {
        Some([axis(&|it| value(it, 0))?, axis(&|it| value(it, 1))?, axis(&|it| value(it, 2))?])
    };
    let gyroscope = three(&|it, axis| it.angular_velocity_rad_s[axis]);
    let accelerometer =
        three(&|it, axis| it.acceleration_m_s2[axis] - if axis == 2 { GRAVITY_M_S2 } else { 0.0 });
    let mut missing = Vec::new();
    if gyroscope.is_none() {
        missing.push(
            "bias and noise of the IMU: the robot was at rest for fewer than 100 samples; stop it for a minute"
                .to_owned(),
        );
    } else if gyroscope.iter().flatten().all(|it| it.bias_instability.is_none()) {
        missing.push(format!(
            "bias instability of the gyroscope: {rest_s:.0} s at rest are too short; record hours at rest"
        ));
    }
    let rotation = rotation(&samples, displacements, scan_delay_s, max_delay_s);
    let (scale_ratio, delay_s) = match rotation {
        Ok((scale, delay)) => (Some(scale), Some(delay)),
        Err(why) => {
            missing.push(format!("scale and delay of the gyroscope: {why}"));
            (None, None)
        }
    };
    Some(ImuCalibration {
        rate_hz: 1.0 / period_s,
        rest_s,
        gyroscope,
        accelerometer,
        scale_ratio,
        delay_s,
        missing,
    })
}

/// Samples of the times at which the wheels are at rest.
fn rest_parts<'a>(samples: &'a [ImuSample], track: Option<&WheelTrack>) -> Vec<&'a [ImuSample]> {
    let Some(track) = track else { return vec![samples] };
    let is_at_rest = |it: &ImuSample| {
        let around = [it.stamp_s - SETTLING_S, it.stamp_s + SETTLING_S];
        let [Some(before), Some(after)] = around.map(|it| track.angles_at(it)) else {
            return false;
        };
        let limit_rad = 2.0 * SETTLING_S * MAX_REST_RAD_S;
        (after.0 - before.0).abs() <= limit_rad && (after.1 - before.1).abs() <= limit_rad
    };
    samples
        .chunk_by(|a, b| is_at_rest(a) == is_at_rest(b))
        .filter(|it| it.first().is_some_and(is_at_rest))
        .filter(|it| it[it.len() - 1].stamp_s - it[0].stamp_s >= MIN_REST_S)
        .collect()
}

/// Scale and delay of the rotation about z.
fn rotation(
    samples: &[ImuSample],
    displacements: &[ScannerDisplacement],
    scan_delay_s: f64,
    max_delay_s: f64,
) -> Result<(Estimated, Estimated), String> {
    // Angles by trapezoids, interpolated linearly.
    let mut angles = vec![0.0];
    let mut angle = 0.0;
    for pair in samples.windows(2) {
        let rates = pair[0].angular_velocity_rad_s[2] + pair[1].angular_velocity_rad_s[2];
        angle += 0.5 * rates * (pair[1].stamp_s - pair[0].stamp_s);
        angles.push(angle);
    }
    let angle_at = |stamp_s: f64| {
        let after = samples.partition_point(|it| it.stamp_s < stamp_s);
        let (a, b) = (samples.get(after.checked_sub(1)?)?, samples.get(after)?);
        let part = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
        Some(angles[after - 1] + part * (angles[after] - angles[after - 1]))
    };
    let turn = |it: &ScannerDisplacement, delay_s: f64| {
        let shift_s = delay_s - scan_delay_s;
        Some(angle_at(it.to_s + shift_s)? - angle_at(it.from_s + shift_s)?)
    };
    let is_covered = |it: &&ScannerDisplacement| {
        turn(it, max_delay_s).is_some() && turn(it, -max_delay_s).is_some()
    };
    let mut covered: Vec<&ScannerDisplacement> = displacements.iter().filter(is_covered).collect();
    let mut found = None;
    // Matches that failed are beyond the residuals of the others.
    for _ in 0..3 {
        if covered.len() < MIN_DISPLACEMENT_COUNT {
            return Err(format!(
                "{} displacements of the scanner are covered by the IMU; {MIN_DISPLACEMENT_COUNT} are needed",
                covered.len()
            ));
        }
        let count = (max_delay_s / DELAY_STEP_S).floor() as i64;
        let fits: Vec<Regression> = (-count..=count)
            .map(|step| {
                let delay_s = step as f64 * DELAY_STEP_S;
                let pairs = covered.iter().filter_map(|it| {
                    Some((it.from_from_to.yaw_rad, it.to_s - it.from_s, turn(it, delay_s)?))
                });
                regression(&pairs.collect::<Vec<_>>())
            })
            .collect::<Option<_>>()
            .ok_or("the robot did not turn, or never changed its rate")?;
        let best = (0..fits.len())
            .min_by(|a, b| fits[*a].squares.total_cmp(&fits[*b].squares))
            .filter(|it| *it > 0 && it + 1 < fits.len())
            .ok_or("the delay is beyond `--max-delay`, or the robot did not turn")?;
        let [below, at, above] = [best - 1, best, best + 1].map(|it| fits[it].squares);
        let curvature = below - 2.0 * at + above;
        if curvature <= 0.0 {
            return Err("the robot did not change its rate of turn".to_owned());
        }
        let offset = 0.5 * (below - above) / curvature;
        let delay_s = (best as f64 - count as f64 + offset) * DELAY_STEP_S;
        let fit = &fits[best];
        let variance = fit.squares / (covered.len() - 3) as f64;
        let delay_error_s = DELAY_STEP_S * (2.0 * variance / curvature).sqrt();
        found = Some((
            Estimated { value: fit.scale, standard_error: (variance * fit.scale_variance).sqrt() },
            Estimated { value: delay_s, standard_error: delay_error_s },
        ));
        let (scale, bias, limit) = (fit.scale, fit.bias_rad_s, 3.3 * variance.sqrt());
        covered.retain(|it| {
            let expected = scale * it.from_from_to.yaw_rad + bias * (it.to_s - it.from_s);
            turn(it, delay_s).is_some_and(|turn| (turn - expected).abs() <= limit)
        });
    }
    found
        .filter(|it| it.0.standard_error <= MAX_SCALE_ERROR_RATIO)
        .filter(|it| it.1.standard_error <= MAX_DELAY_ERROR_S)
        .ok_or_else(|| {
            "the robot did not turn enough; turn to both sides with changing rate".to_owned()
        })
}

/// Measured rotation = scale x rotation + bias x time.
struct Regression {
    scale: f64,
    bias_rad_s: f64,
    squares: f64,
    /// Variance of the scale for residuals of one.
    scale_variance: f64,
}

/// Least squares over rotations, times and measured rotations.
fn regression(pairs: &[(f64, f64, f64)]) -> Option<Regression> {
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (yaw_rad, time_s, measured_rad) in pairs {
        let row = Vector2::new(*yaw_rad, *time_s);
        normal += row * row.transpose();
        right += row * *measured_rad;
    }
    let inverse = normal.try_inverse()?;
    let solution = inverse * right;
    let residual = |(yaw_rad, time_s, measured_rad): &(f64, f64, f64)| {
        measured_rad - solution[0] * yaw_rad - solution[1] * time_s
    };
    Some(Regression {
        scale: solution[0],
        bias_rad_s: solution[1],
        squares: pairs.iter().map(residual).map(|it| it * it).sum(),
        scale_variance: inverse[(0, 0)],
    })
    .filter(|it| it.squares.is_finite() && it.scale_variance.is_finite())
}
