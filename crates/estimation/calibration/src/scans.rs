//! Displacements of a scanner by scan matching.

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{
    Cloud, CloudSettings, Placed, RegisterSettings, Symmetric3, register,
};

/// Minimum part of the points of a scan with a correspondence.
const MIN_MATCHED_RATIO: f64 = 0.5;

/// Settings of the registration: a narrow kernel at the end, since the scans are of the same scene.
const REGISTER: RegisterSettings = RegisterSettings {
    reach_m: [0.5, 0.15],
    scale_m: [0.3, 0.1],
    steps: 12,
    sigma_m: 0.02,
    independent: 0.5,
    degenerate: 0.01,
};

/// Displacement of a scanner between two scans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScannerDisplacement {
    /// Stamp of the first scan \[s\].
    pub from_s: f64,
    /// Stamp of the second scan \[s\].
    pub to_s: f64,
    /// Pose of the scanner at the second scan in its frame at the first.
    pub from_from_to: Pose2,
    /// Information matrix of x, y \[1/m²\] and yaw \[1/rad²\], up to a common factor.
    pub information: [[f64; 3]; 3],
}

/// Matches pairs of scans, each at least `period_s` after the one before, in order of time. `start` returns
/// the expected displacement between two stamps \[s\], for example from odometry; without it a pair is
/// matched from the displacement of the pair before. Pairs without enough correspondences are left out.
///
/// The mounting of the scans is not used: displacements are in the frame of the scanner.
#[must_use]
pub fn match_scans(
    scans: &[LaserScan2],
    period_s: f64,
    start: impl Fn(f64, f64) -> Option<Pose2>,
) -> Vec<ScannerDisplacement> {
    let mut displacements = Vec::new();
    let mut last: Option<(f64, Cloud)> = None;
    let mut before = Pose2::IDENTITY;
    for scan in scans {
        let to_s = scan.time_ns as f64 * 1e-9;
        if last.as_ref().is_some_and(|(from_s, _)| to_s - from_s < period_s) {
            continue;
        }
        let cloud = cloud(scan);
        if let Some((from_s, target)) = &last {
            let expected = start(*from_s, to_s).unwrap_or(before);
            let (moving, target) = ([Placed::alone(&cloud)], [Placed::alone(target)]);
            let fit = register(&moving, &target, expected, None, &REGISTER);
            if fit.matched >= MIN_MATCHED_RATIO {
                before = fit.target_from_moving;
                displacements.push(ScannerDisplacement {
                    from_s: *from_s,
                    to_s,
                    from_from_to: fit.target_from_moving,
                    information: rows(fit.information),
                });
            }
        }
        last = Some((to_s, cloud));
    }
    displacements
}

fn rows(it: Symmetric3) -> [[f64; 3]; 3] {
    [[it.xx, it.xy, it.xt], [it.xy, it.yy, it.yt], [it.xt, it.yt, it.tt]]
}

/// Points of a scan in the frame of the scanner.
fn cloud(scan: &LaserScan2) -> Cloud {
    let beam = |(index, &range_m): (usize, &f32)| {
        let is_return = range_m >= scan.range_min_m && range_m < scan.range_max_m;
        let (sine, cosine) = libm::sincosf(scan.beam_angle_rad(index) as f32);
        is_return.then_some([range_m * cosine, range_m * sine])
    };
    let step_rad = scan.beam_step_rad() as f32;
    let beams = scan.ranges_m.iter().enumerate().map(beam);
    Cloud::new(beams, [0.0; 2], step_rad, &CloudSettings { spacing_m: 0.01, most_points: 720 })
}
