//! Comparison of a trajectory with ground truth.

use std::collections::BTreeMap;

use periplus_evaluation::{AlignmentMethod, ErrorStatistics, PosePair, PoseRelation, align, ape};
use periplus_geometry::Pose2;

/// Error of a trajectory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Judgement {
    /// Path length \[m\].
    pub(crate) way_m: f64,
    /// After the best rigid alignment \[m\].
    pub(crate) rms_m: f64,
    pub(crate) most_m: f64,
    /// Mean error of relations between passes \[m\], and how many there are.
    pub(crate) loops_m: f64,
    pub(crate) loops: usize,
    /// Errors by path: start \[m\], number, mean error \[m\].
    pub(crate) stretches: Vec<(f64, usize, f64)>,
}

/// Maximum distance of poses of different passes that are compared \[m\], one per metre of path; minimum
/// path between passes \[m\].
const NEAR_M: f64 = 5.0;
const EVERY_M: f64 = 1.0;
const APART_M: f64 = 20.0;
/// Length of path over which errors are averaged \[m\].
const STRETCH_M: f64 = 20.0;

pub(crate) fn judge(truth: &[Pose2], found: &[Pose2]) -> Judgement {
    let mut ways = vec![0.0];
    for pair in truth.windows(2) {
        let step = libm::hypot(pair[1].x_m - pair[0].x_m, pair[1].y_m - pair[0].y_m);
        ways.push(ways[ways.len() - 1] + step);
    }
    let way_m = ways[truth.len() - 1];
    let (rms_m, most_m) = aligned(truth, found);
    let mut picked: Vec<usize> = vec![0];
    for at in 0..truth.len() {
        if ways[at] - ways[picked[picked.len() - 1]] >= EVERY_M {
            picked.push(at);
        }
    }
    let mut errors: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
    for (index, &new) in picked.iter().enumerate() {
        // The nearest of each earlier pass.
        let mut nearest: Option<(f64, usize)> = None;
        for &old in &picked[..=index] {
            let metres =
                libm::hypot(truth[old].x_m - truth[new].x_m, truth[old].y_m - truth[new].y_m);
            let is_near = metres < NEAR_M && ways[new] - ways[old] > APART_M;
            if is_near && nearest.is_none_or(|it| metres < it.0) {
                nearest = Some((metres, old));
            }
            if !is_near && let Some((_, old)) = nearest.take() {
                let known = truth[old].inverse() * truth[new];
                let off = known.inverse() * (found[old].inverse() * found[new]);
                let stretch = (ways[new] / STRETCH_M) as u32;
                errors.entry(stretch).or_default().push(libm::hypot(off.x_m, off.y_m));
            }
        }
    }
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let all: Vec<f64> = errors.values().flatten().copied().collect();
    let stretches =
        errors.iter().map(|(&stretch, of)| (STRETCH_M * f64::from(stretch), of.len(), mean(of)));
    let stretches = stretches.collect();
    Judgement { way_m, rms_m, most_m, loops_m: mean(&all), loops: all.len(), stretches }
}

/// Root mean square and largest distance after the best rigid alignment \[m\].
fn aligned(truth: &[Pose2], found: &[Pose2]) -> (f64, f64) {
    let pair = |(truth, found): (&Pose2, &Pose2)| PosePair {
        stamp_s: 0.0,
        reference: (*truth).into(),
        estimate: (*found).into(),
    };
    let pairs: Vec<PosePair> = truth.iter().zip(found).map(pair).collect();
    let alignment = align(&pairs, AlignmentMethod::Se2).expect("the robot moves");
    let errors_m = ape(&alignment.apply_to(&pairs), PoseRelation::TranslationM);
    let errors = ErrorStatistics::of(&errors_m).expect("there are poses");
    (errors.rmse, errors.max)
}
