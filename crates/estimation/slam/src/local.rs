//! Matching of a scan against the last keyframes.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::{
    Agreement, Cloud, Fit, Placed, Prior, RegisterSettings, ScoreField, Symmetric3, Window,
    agreement, register,
};

use crate::graph::Graph;
use crate::keyframe::Keyframe;
use crate::settings::Settings;

/// Points of a scan that are searched with.
const SEARCH_POINTS: usize = 120;
/// The same of a stretch.
const MAX_STRETCH_POINTS: usize = 350;
/// A scan of which fewer points find partners is not where it was searched.
const MIN_MATCHED_RATIO: f64 = 0.45;
/// Number of scans and iterations for comparing start poses.
const FEW_SCANS: usize = 3;
const FEW_STEPS: usize = 5;
/// A fit that matches less than this part of what is usual is doubted.
const POOR_MATCH_RATIO: f64 = 0.75;
/// Weights of the odometry prior where it is doubted, and the squared Mahalanobis distance by which such a
/// match must be better.
const DOUBTED_PRIOR_FACTOR: f64 = 0.1;
const DISTRUSTED_PRIOR_FACTOR: f64 = 0.004;
const DISTRUST_SQUARED_SIGMAS: f64 = 20.0;
/// Scans that agree on less than the first part of what both can see are in doubt; where they agree on
/// more than the second they belong together.
const DOUBTFUL_AGREEMENT_RATIO: f64 = 0.75;
const SURE_AGREEMENT_RATIO: f64 = 0.9;
/// Maximum agreement with the scans before of a scan that belongs elsewhere: half of the points that both can
/// see contradict each other by chance.
pub(crate) const MAX_CONTRADICTING_AGREEMENT_RATIO: f64 = 0.6;
/// Range over which the heading step is computed: with the range of most points, ends move by a cell per
/// step \[m\].
const ARM_M: std::ops::Range<f64> = 2.0..12.0;

/// Result of matching a scan.
pub(crate) struct LocalMatch {
    pub(crate) fit: Fit,
    /// Information of scans and odometry together.
    pub(crate) information: Symmetric3,
    /// Information for the uncertainty of a path.
    pub(crate) doubted: Symmetric3,
    /// True if the scan matches; otherwise the pose is the one by odometry.
    pub(crate) is_matched: bool,
    /// True if it matches although scans contradict each other there.
    pub(crate) is_doubted: bool,
    /// Agreement of the points seen by both the scan and those before it, if fewer points than usual find
    /// partners; else 1. Low if the scan may belong elsewhere.
    pub(crate) agreeing: f64,
}

/// Keyframes that a new scan is matched against: the last ones, nearby, from the first of a component on.
pub(crate) fn neighbours(
    keyframes: &[Keyframe],
    graph: &Graph,
    most: usize,
    first: usize,
) -> Vec<usize> {
    let Some(last) = keyframes.len().checked_sub(1) else { return Vec::new() };
    let here = graph.poses[last];
    (first..keyframes.len())
        .rev()
        .take(3 * most)
        .filter(|&keyframe| {
            let pose = graph.poses[keyframe];
            libm::hypot(pose.x_m - here.x_m, pose.y_m - here.y_m) < 7.0
        })
        .take(most)
        .collect()
}

/// Clouds of some keys in the frame of one.
pub(crate) struct Group(Vec<(Cloud, Pose2)>);

impl Group {
    pub(crate) fn new(clouds: impl Iterator<Item = (Cloud, Pose2)>) -> Self {
        Self(clouds.collect())
    }

    pub(crate) fn placed(&self) -> Vec<Placed<'_>> {
        let placed = self.0.iter().map(|(cloud, pose)| Placed { cloud, group_from_cloud: *pose });
        placed.collect()
    }
}

/// Clouds of some keys in the frame of one.
pub(crate) fn grouped(keyframes: &[Keyframe], graph: &Graph, of: &[usize], frame: usize) -> Group {
    Group::new(
        of.iter().map(|&keyframe| (keyframes[keyframe].cloud(), graph.between(frame, keyframe))),
    )
}

/// Points of clouds in the frame of their group.
pub(crate) fn points_of(group: &[Placed<'_>]) -> Vec<[f32; 2]> {
    let mut points = Vec::with_capacity(group.iter().map(|it| it.cloud.points().len()).sum());
    for placed in group {
        let pose = placed.group_from_cloud;
        let (s, c) = libm::sincos(pose.yaw_rad);
        let (s, c) = (s as f32, c as f32);
        let (x, y) = (pose.x_m as f32, pose.y_m as f32);
        points.extend(
            placed.cloud.points().iter().map(|p| [c * p.x - s * p.y + x, s * p.x + c * p.y + y]),
        );
    }
    points
}

/// Some points of a cloud, evenly.
pub(crate) fn sampled(cloud: &Cloud, most: usize) -> Vec<[f32; 2]> {
    let every = cloud.points().len().div_ceil(most).max(1);
    cloud.points().iter().step_by(every).map(|p| [p.x, p.y]).collect()
}

/// Points that are not nearer than a spacing to each other, and not too far away; a lattice of cells
/// keeps one each.
pub(crate) fn spread(points: &[[f32; 2]], spacing_m: f32, most_m: f32) -> Vec<[f32; 2]> {
    let mut cells: Vec<(i32, i32, u32)> = points
        .iter()
        .enumerate()
        .filter(|(_, p)| p[0] * p[0] + p[1] * p[1] < most_m * most_m)
        .map(|(index, p)| {
            ((p[0] / spacing_m).floor() as i32, (p[1] / spacing_m).floor() as i32, index as u32)
        })
        .collect();
    cells.sort_unstable();
    cells.dedup_by_key(|it| (it.0, it.1));
    let every = cells.len().div_ceil(MAX_STRETCH_POINTS).max(1);
    cells.iter().step_by(every).map(|it| points[it.2 as usize]).collect()
}

/// From one heading to the next, so that points move by about a cell \[rad\].
pub(crate) fn heading_step(points: &[[f32; 2]], resolution_m: f32) -> f64 {
    let mut ranges: Vec<f32> = points.iter().map(|p| p[0] * p[0] + p[1] * p[1]).collect();
    if ranges.is_empty() {
        return 0.02;
    }
    let at = ranges.len() * 3 / 4;
    let (_, range, _) = ranges.select_nth_unstable_by(at, f32::total_cmp);
    f64::from(resolution_m) / f64::from(range.sqrt()).clamp(ARM_M.start, ARM_M.end)
}

/// Finds a scan among the keys before. `frame_from_base` is where odometry has it in the frame of the
/// first of `group`, with this covariance.
pub(crate) fn match_locally(
    cloud: &Cloud,
    group: &[Placed<'_>],
    frame_from_base: Pose2,
    covariance: &Symmetric3,
    settings: &Settings,
    searches: bool,
    inlier_ratio: f64,
) -> LocalMatch {
    let information = covariance.inverse().unwrap_or(Symmetric3::diagonal(1.0, 1.0, 1.0));
    let mut prior = Prior { target_from_moving: frame_from_base, information };
    let moving = [Placed::alone(cloud)];
    // A few scans and iterations suffice to compare start poses.
    let few = &group[..group.len().min(FEW_SCANS)];
    let quick = RegisterSettings { steps: FEW_STEPS, ..settings.register };
    let fit_from = |start, prior: &Prior| register(&moving, few, start, Some(prior), &quick);
    let finish = |fit: &Fit, prior: &Prior| {
        let how = close_by(&settings.register);
        register(&moving, group, fit.target_from_moving, Some(prior), &how)
    };
    let mut best = fit_from(frame_from_base, &prior);
    let is_poor = |fit: &Fit| fit.matched < MIN_MATCHED_RATIO.max(POOR_MATCH_RATIO * inlier_ratio);
    if searches || is_poor(&best) {
        let points = sampled(cloud, SEARCH_POINTS);
        let step_rad = heading_step(&points, settings.local_field.resolution_m);
        let middle = [frame_from_base.x_m as f32, frame_from_base.y_m as f32];
        let field = ScoreField::new(&points_of(group), middle, &settings.local_field);
        let sigmas = [covariance.largest_shift().sqrt(), covariance.tt.sqrt()];
        let window = Window {
            middle: frame_from_base,
            half_m: [(3.0 * sigmas[0]).clamp(0.15, 2.5); 2],
            half_rad: (3.0 * sigmas[1]).clamp(0.08, 1.6),
            step_rad,
        };
        if let (Some(peak), _) = field.search(&points, &window, 0.15, None) {
            let fit = fit_from(peak.pose, &prior);
            if fit.cost < best.cost {
                best = fit;
            }
        }
        let seen = |fit: &Fit| against(cloud, group, fit.target_from_moving).share();
        // Perhaps the wheels slipped, or odometry stood still while the robot did not. First not far
        // away, with less trust in odometry; then, where scans contradict each other and do not only
        // see different things, all around, with hardly any.
        let stages = [
            (
                DOUBTED_PRIOR_FACTOR,
                [(6.0 * sigmas[0]).clamp(0.4, 1.0); 2],
                (6.0 * sigmas[1]).clamp(0.4, 0.8),
            ),
            (DISTRUSTED_PRIOR_FACTOR, [(9.0 * sigmas[0]).clamp(1.0, 3.0); 2], std::f64::consts::PI),
        ];
        for (trust, half_m, half_rad) in stages {
            if !is_poor(&best)
                || (trust == DISTRUSTED_PRIOR_FACTOR && seen(&best) >= DOUBTFUL_AGREEMENT_RATIO)
            {
                break;
            }
            prior.information = information * trust;
            let window = Window { half_m, half_rad, ..window };
            let (Some(peak), _) = field.search(&points, &window, 0.25, None) else { continue };
            let fit = fit_from(peak.pose, &prior);
            if fit.cost + DISTRUST_SQUARED_SIGMAS < best.cost
                && fit.matched > 1.2 * best.matched
                && seen(&fit) > SURE_AGREEMENT_RATIO.max(seen(&best))
            {
                let fit = finish(&fit, &prior);
                let information = prior.information + fit.information;
                return LocalMatch {
                    fit,
                    information,
                    doubted: information,
                    is_matched: true,
                    is_doubted: false,
                    agreeing: 1.0,
                };
            }
        }
    }
    let fit = finish(&best, &Prior { information, ..prior });
    let is_matched = fit.matched > MIN_MATCHED_RATIO * 0.7;
    let agreeing = match is_matched {
        true if is_poor(&fit) => against(cloud, group, fit.target_from_moving).share(),
        true => 1.0,
        false => 0.0,
    };
    if !is_matched {
        best.target_from_moving = frame_from_base;
        let doubted = doubted(&information, 0.0);
        let is_doubted = false;
        return LocalMatch { fit: best, information, doubted, is_matched, is_doubted, agreeing };
    }
    let doubted = doubted(&information, fit.firmness) + fit.information;
    let information = information + fit.information;
    LocalMatch { fit, information, doubted, is_matched, is_doubted: false, agreeing }
}

/// Reduces the weight of scans against odometry where the two differ and scans contradict each other as
/// well.
///
/// Rising floor in front of the scanner gives lines that move along with the robot, and so do people
/// walking beside it: a scan fits them at a wrong pose, where other points are then seen through. Hedges
/// are so rough that a match along them drifts. `typical` is the covariance of an ordinary odometry step: a
/// match farther off counts less, the less scans agree there and, within the bounds of odometry, the
/// rougher they are.
pub(crate) fn reweighted(
    located: LocalMatch,
    cloud: &Cloud,
    group: &[Placed<'_>],
    frame_from_base: Pose2,
    typical: &Symmetric3,
    settings: &Settings,
) -> LocalMatch {
    let found = located.fit.target_from_moving;
    let off = [
        found.x_m - frame_from_base.x_m,
        found.y_m - frame_from_base.y_m,
        normalize_angle(found.yaw_rad - frame_from_base.yaw_rad),
    ];
    let Some(information) = typical.inverse() else { return located };
    let distance = information.quadratic(off);
    if distance < ORDINARY_STEP_SQUARED_SIGMAS {
        return located;
    }
    let seen = against(cloud, group, found);
    let part = ((seen.share() - LEAST_WEIGHT_AGREEMENT_RATIO)
        / (FULL_WEIGHT_AGREEMENT_RATIO - LEAST_WEIGHT_AGREEMENT_RATIO))
        .clamp(MIN_WEIGHT_RATIO, 1.0);
    let smooth = settings.register.sigma_m / located.fit.rms_m.max(settings.register.sigma_m);
    let rough = if distance < POSSIBLE_STEP_SQUARED_SIGMAS { smooth * smooth } else { 1.0 };
    let trusted = (part * part) * (part * part) * rough;
    if trusted > UNCHANGED_WEIGHT_RATIO {
        return located;
    }
    let information = information * (1.0 / trusted);
    let prior = Prior { target_from_moving: frame_from_base, information };
    let how = close_by(&settings.register);
    let mut fit = register(&[Placed::alone(cloud)], group, frame_from_base, Some(&prior), &how);
    // Wheels that slipped, or that were counted late, do not change how well scans agree.
    if against(cloud, group, fit.target_from_moving).share() < seen.share() - WORSE_AGREEMENT_RATIO
    {
        return LocalMatch { is_doubted: true, ..located };
    }
    fit.information = fit.information * trusted;
    let information = information * trusted + fit.information;
    LocalMatch { fit, information, is_doubted: true, ..located }
}

/// True if a match is clearly better than another one.
pub(crate) fn is_better(
    cloud: &Cloud,
    group: &[Placed<'_>],
    one: &LocalMatch,
    other: &LocalMatch,
) -> bool {
    if !one.is_matched || one.fit.matched < BETTER_MATCH_FACTOR * other.fit.matched {
        return false;
    }
    let seen = |it: &LocalMatch| against(cloud, group, it.fit.target_from_moving).share();
    !other.is_matched
        || seen(one) > (seen(other) + BETTER_AGREEMENT_RATIO).min(SURE_AGREEMENT_RATIO)
}

/// Information for the uncertainty of a path; `typical` is the covariance of an ordinary odometry step.
pub(crate) fn uncertain(located: &LocalMatch, typical: &Symmetric3) -> Symmetric3 {
    let firmness = if located.is_doubted { 0.0 } else { located.fit.firmness };
    match typical.inverse() {
        Some(information) => doubted(&information, firmness) + located.fit.information,
        None => located.doubted,
    }
}

/// Squared Mahalanobis distance from odometry up to which a step is ordinary.
const ORDINARY_STEP_SQUARED_SIGMAS: f64 = 1.0;
/// Beyond this the step cannot be an ordinary one: 99.9 % for 3 degrees of freedom.
const POSSIBLE_STEP_SQUARED_SIGMAS: f64 = 16.3;
/// Agreement at which scans have full weight, and almost none; minimum weight before its fourth power.
const FULL_WEIGHT_AGREEMENT_RATIO: f64 = 0.95;
const LEAST_WEIGHT_AGREEMENT_RATIO: f64 = 0.65;
const MIN_WEIGHT_RATIO: f64 = 0.05;
/// Minimum ratio of matched points and minimum difference of agreement for a clearly better match.
const BETTER_MATCH_FACTOR: f64 = 1.1;
const BETTER_AGREEMENT_RATIO: f64 = 0.05;
/// Decrease of the agreement that shows that following odometry is wrong.
const WORSE_AGREEMENT_RATIO: f64 = 0.02;
/// Scans that keep more than this part of their weight are left as they are.
const UNCHANGED_WEIGHT_RATIO: f64 = 0.9;

/// Weight of odometry in the uncertainty of a path where walls leave a direction free. Along a corridor its
/// errors have one sign: they add up instead of averaging out, so that odometry counts less than its
/// scatter suggests.
fn doubted(information: &Symmetric3, firmness: f64) -> Symmetric3 {
    *information * (FREE_DIRECTION_FACTOR + (1.0 - FREE_DIRECTION_FACTOR) * firmness)
}

/// Compares a scan with the first few of a group in both directions.
fn against(cloud: &Cloud, group: &[Placed<'_>], group_from_cloud: Pose2) -> Agreement {
    let mut sum = Agreement::default();
    for one in group.iter().take(3) {
        let one_from_cloud = one.group_from_cloud.inverse() * group_from_cloud;
        sum += both_ways(cloud, one.cloud, one_from_cloud, TOLERANCE_M);
    }
    sum
}

/// Compares each scan of one group with the nearest few of another in both directions.
pub(crate) fn against_nearest(
    new: &[Placed<'_>],
    old: &[Placed<'_>],
    old_from_new: Pose2,
    few: usize,
) -> Agreement {
    let mut sum = Agreement::default();
    for one in new {
        let old_from_one = old_from_new * one.group_from_cloud;
        let mut near: Vec<(f64, &Placed<'_>)> =
            old.iter().map(|it| (apart(it.group_from_cloud, old_from_one).0, it)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, other) in near.iter().take(few) {
            let other_from_one = other.group_from_cloud.inverse() * old_from_one;
            sum += both_ways(one.cloud, other.cloud, other_from_one, TOLERANCE_M);
        }
    }
    sum
}

/// Compares two scans: each against the points of the other.
pub(crate) fn both_ways(a: &Cloud, b: &Cloud, b_from_a: Pose2, tolerance_m: f32) -> Agreement {
    let mut sum = agreement(a, b, b_from_a, tolerance_m);
    sum += agreement(b, a, b_from_a.inverse(), tolerance_m);
    sum
}

/// Weight of odometry where walls leave a direction free: errors of 3 % over a hundred steps are as likely
/// as their scatter implies only if one step errs by that much more.
const FREE_DIRECTION_FACTOR: f64 = 0.15;
/// Maximum distance of two points of the same surface \[m\].
const TOLERANCE_M: f32 = 0.2;

/// Minimum uncertainty between consecutive keyframes: the beams of a scan share errors, and walls are not
/// straight. One standard deviation.
const FLOOR_M: f64 = 0.008;
const FLOOR_RAD: f64 = 0.0025;

/// Returns the information with that uncertainty added.
pub(crate) fn floored(information: &Symmetric3) -> Symmetric3 {
    let some = *information + Symmetric3::diagonal(1e-2, 1e-2, 1e-2);
    let floor = Symmetric3::diagonal(FLOOR_M * FLOOR_M, FLOOR_M * FLOOR_M, FLOOR_RAD * FLOOR_RAD);
    some.inverse().and_then(|covariance| (covariance + floor).inverse()).unwrap_or(some)
}

/// Settings for a registration whose start is good.
pub(crate) fn close_by(settings: &RegisterSettings) -> RegisterSettings {
    RegisterSettings { reach_m: [0.3, 0.2], scale_m: [0.2, 0.1], steps: 6, ..*settings }
}

/// Shift and turn between two poses.
pub(crate) fn apart(a: Pose2, b: Pose2) -> (f64, f64) {
    (libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m), normalize_angle(a.yaw_rad - b.yaw_rad).abs())
}
