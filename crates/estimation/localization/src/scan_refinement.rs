//! Scan refinement: Gauss-Newton alignment of beam ends with the likelihood field.
//!
//! Residuals are distances to the nearest wall with a Geman-McClure kernel, which ignores what the
//! map lacks. The pose before is a prior, so that a corridor leaves the direction along it
//! unchanged.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use crate::likelihood_map::LikelihoodMap;
use crate::particles::Covariance2;

/// Kernel widths from the first iteration to the last \[m\].
const SCALES_M: [f64; 7] = [0.3, 0.3, 0.2, 0.15, 0.1, 0.1, 0.1];
/// Standard deviation of the distance between a measured and a mapped wall \[m\].
const SIGMA_M: f64 = 0.04;
/// Number of beams that count as independent, since the errors of adjacent beams are correlated.
const INDEPENDENT_BEAM_COUNT: f64 = 40.0;
/// Step below which the iteration ends.
const MIN_STEP_M: f64 = 2e-4;
const MIN_STEP_RAD: f64 = 1e-4;
/// Minimum number of iterations, minus one: until the kernel has its final width.
const LAST_WIDE_ITERATION_INDEX: usize = 4;
/// Maximum step of an iteration: the range of the linearization.
const MAX_STEP_M: f64 = 0.2;
const MAX_STEP_RAD: f64 = 0.1;
/// Process noise of [`predicted`]: constant parts, and parts that grow with translation and rotation.
const NOISE_M: f64 = 0.01;
const NOISE_RAD: f64 = 0.003;
const MOTION_NOISE_FRACTION: f64 = 0.1;
const NOISE_RAD_PER_M: f64 = 0.05;
/// Standard deviations of a pose of which nothing is belief.
const UNKNOWN_STD_M: f64 = 1.0;
const UNKNOWN_STD_RAD: f64 = 0.5;
/// Standard deviations added by [`inflated`].
const INFLATION_STD_M: f64 = 0.1;
const INFLATION_STD_RAD: f64 = 0.1;

/// Pose with its information matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PoseBelief {
    /// `map_from_base`.
    pub(crate) pose: Pose2,
    /// Inverse of the covariance of `pose`.
    pub(crate) information: Symmetric3,
}

impl PoseBelief {
    /// Covariance of the pose.
    pub(crate) fn covariance(&self) -> Covariance2 {
        let covariance = self.information.inverse().unwrap_or_default();
        let Symmetric3 { xx, xy, yy, tt, .. } = covariance;
        Covariance2 { xx, xy, yy, yaw: tt }
    }
}

/// Result of a refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refinement {
    pub(crate) belief: PoseBelief,
    /// Mean kernel weight of the beam ends, 0 to 1: the fraction at walls.
    pub(crate) fit: f64,
}

/// Refines a pose. The information of the result includes that of the prior.
pub(crate) fn refine_pose(
    map: &LikelihoodMap,
    ends: &[[f32; 2]],
    prior: &PoseBelief,
) -> Refinement {
    let cell_transform = map.cell_transform();
    let weight_per_beam =
        (INDEPENDENT_BEAM_COUNT / ends.len().max(1) as f64).min(1.0) / (SIGMA_M * SIGMA_M);
    let mut pose = prior.pose;
    let mut information = prior.information;
    let mut fit = 0.0;
    for (iteration, scale_m) in SCALES_M.into_iter().enumerate() {
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        let mut hessian = Symmetric3::ZERO;
        let mut gradient = [0.0; 3];
        let mut inliers = 0.0;
        for &[x, y] in ends {
            let (x, y) = (f64::from(x), f64::from(y));
            let (rx, ry) = (cosine * x - sine * y, sine * x + cosine * y);
            let found = map.distance_and_gradient(&cell_transform, pose.x_m + rx, pose.y_m + ry);
            let Some((distance, [gx, gy])) = found else { continue };
            let squared = scale_m * scale_m;
            let kernel = squared / (squared + distance * distance);
            let weight = weight_per_beam * kernel * kernel;
            inliers += kernel;
            let row = [gx, gy, gy * rx - gx * ry];
            hessian.add_outer(row, weight);
            for (sum, part) in gradient.iter_mut().zip(row) {
                *sum += weight * distance * part;
            }
        }
        fit = inliers / ends.len().max(1) as f64;
        let error = [
            pose.x_m - prior.pose.x_m,
            pose.y_m - prior.pose.y_m,
            normalize_angle(pose.yaw_rad - prior.pose.yaw_rad),
        ];
        let prior_gradient = prior.information.times(error);
        information = hessian + prior.information;
        let right_side = [
            -gradient[0] - prior_gradient[0],
            -gradient[1] - prior_gradient[1],
            -gradient[2] - prior_gradient[2],
        ];
        let Some(step) = information.solve(right_side) else { break };
        // Limits the step to the range of the linearization.
        let length_m = libm::hypot(step[0], step[1]);
        let damp =
            (MAX_STEP_M / length_m.max(1e-9)).min(MAX_STEP_RAD / step[2].abs().max(1e-9)).min(1.0);
        pose = Pose2::new(
            pose.x_m + damp * step[0],
            pose.y_m + damp * step[1],
            normalize_angle(pose.yaw_rad + damp * step[2]),
        );
        if iteration >= LAST_WIDE_ITERATION_INDEX
            && length_m < MIN_STEP_M
            && step[2].abs() < MIN_STEP_RAD
        {
            break;
        }
    }
    Refinement { belief: PoseBelief { pose, information }, fit }
}

/// Predicts a pose after an odometry motion, with a tenth of the translation and of the rotation as
/// noise.
pub(crate) fn predicted(belief: &PoseBelief, old_from_new: Pose2) -> PoseBelief {
    let distance_m = libm::hypot(old_from_new.x_m, old_from_new.y_m);
    let turn_rad = normalize_angle(old_from_new.yaw_rad).abs();
    let std_m = NOISE_M + MOTION_NOISE_FRACTION * distance_m;
    let std_rad = NOISE_RAD + MOTION_NOISE_FRACTION * turn_rad + NOISE_RAD_PER_M * distance_m;
    let unknown = || covariance_from_std(UNKNOWN_STD_M, UNKNOWN_STD_RAD);
    let prior = belief.information.inverse().unwrap_or_else(unknown);
    let covariance = prior + covariance_from_std(std_m, std_rad);
    let unknown = || information_from_std(UNKNOWN_STD_M, UNKNOWN_STD_RAD);
    PoseBelief {
        pose: (belief.pose * old_from_new).normalized(),
        information: covariance.inverse().unwrap_or_else(unknown),
    }
}

/// Adds the uncertainty of a short unknown motion.
pub(crate) fn inflated(belief: &PoseBelief) -> PoseBelief {
    let covariance = belief.information.inverse().unwrap_or_default()
        + covariance_from_std(INFLATION_STD_M, INFLATION_STD_RAD);
    PoseBelief { information: covariance.inverse().unwrap_or(belief.information), ..*belief }
}

fn covariance_from_std(std_m: f64, std_rad: f64) -> Symmetric3 {
    Symmetric3::diagonal(std_m * std_m, std_m * std_m, std_rad * std_rad)
}

/// Information of a pose with the given standard deviations.
pub(crate) fn information_from_std(std_m: f64, std_rad: f64) -> Symmetric3 {
    let position = 1.0 / (std_m * std_m);
    Symmetric3::diagonal(position, position, 1.0 / (std_rad * std_rad))
}
