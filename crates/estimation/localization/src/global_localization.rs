//! Global localization: all poses on the map that fit a scan.

use periplus_geometry::Pose2;
use periplus_scan_matching::Peak;

use crate::branch_and_bound::{BranchAndBound, CandidateLimits};
use crate::likelihood_map::{CellState, LikelihoodMap};
use crate::likelihood_pyramid::LikelihoodPyramid;
use crate::pose_threshold::PoseThreshold;

/// Maximum number of cells of the search grid; larger maps are searched on coarser cells.
const MAX_CELL_COUNT: f64 = 4e6;
/// Maximum number of cells along one side.
const MAX_SIDE_CELL_COUNT: f64 = 60_000.0;
/// Minimum cell size \[m\]. Finer cells take longer and find nothing more: the refinement does the
/// rest.
const MIN_CELL_M: f64 = 0.1;
/// Maximum number of beam end points that are scored (EXPERIMENTS.md, step 22).
const MAX_POINTS: usize = 45;
/// Minimum score of a candidate pose. A pose with 60 % of the scan on walls scores higher.
const MIN_SCORE_RATIO: f64 = 0.42;
/// Minimum score of a candidate, as a fraction of the best one (EXPERIMENTS.md, step 22).
const MIN_SCORE_FRACTION: f64 = 0.8;
/// Number and separation of the candidates of a search over the map.
const MAP_LIMITS: CandidateLimits =
    CandidateLimits { max_count: 200, separation: PoseThreshold::new(0.4, 0.3) };
/// Work budget of a search \[lookups\]. Beyond it only candidates above [`NARROWED_SCORE_FRACTION`] are searched
/// for; after twice the budget the search ends.
const MAX_LOOKUP_COUNT: u64 = 16_000_000;
const NARROWED_SCORE_FRACTION: f64 = 0.92;
const NARROWED_SCORE_RATIO: f64 = 0.5;
/// Number and separation of the candidates of a search around a pose.
const WINDOW_LIMITS: CandidateLimits =
    CandidateLimits { max_count: 6, separation: PoseThreshold::new(0.3, 0.2) };
const WINDOW_SCORE_FRACTION: f64 = 0.85;
const MAX_WINDOW_LOOKUP_COUNT: u64 = 600_000;

/// Search index of a map for global localization.
#[derive(Clone, Debug)]
pub(crate) struct GlobalLocalizer {
    pyramid: LikelihoodPyramid,
}

impl GlobalLocalizer {
    pub(crate) fn new(map: &LikelihoodMap) -> Self {
        let info = map.info();
        let corners = [(0, 0), (info.width, 0), (0, info.height), (info.width, info.height)]
            .map(|(column, row)| info.point_at(column as f64, row as f64));
        let span = |values: [f64; 4]| {
            let low = values.into_iter().fold(f64::INFINITY, f64::min);
            let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
            (0.5 * (low + high), 0.5 * (high - low))
        };
        let (x_m, half_x_m) = span(corners.map(|corner| corner.0));
        let (y_m, half_y_m) = span(corners.map(|corner| corner.1));
        let min_cell_m = libm::sqrt(4.0 * half_x_m * half_y_m / MAX_CELL_COUNT);
        let min_side_cell_m = 2.0 * half_x_m.max(half_y_m) / MAX_SIDE_CELL_COUNT;
        let cell_m = info.resolution_m.max(MIN_CELL_M).max(min_cell_m).max(min_side_cell_m);
        let corners = [[x_m - half_x_m, y_m - half_y_m], [x_m + half_x_m, y_m + half_y_m]];
        let free = map.cell_centers(CellState::Free);
        let pyramid = LikelihoodPyramid::new(map.obstacles(), free, corners, cell_m);
        Self { pyramid }
    }

    /// Starts a search for the poses that fit the end points of a scan, in the base frame \[m\],
    /// with a score of at least `min_score` (0 to 1).
    pub(crate) fn start_search(&self, ends: &[[f32; 2]], min_score: f64) -> BranchAndBound {
        let (points, step_rad) = self.subsampled(ends);
        BranchAndBound::new(
            &self.pyramid,
            &points,
            step_rad,
            (min_score.max(MIN_SCORE_RATIO), MIN_SCORE_FRACTION),
            None,
        )
    }

    /// Continues a search by about `max_lookups` lookups.
    pub(crate) fn advance(&self, search: &mut BranchAndBound, max_lookups: u64) {
        search.advance(&self.pyramid, max_lookups, &MAP_LIMITS);
        if search.lookup_count() > MAX_LOOKUP_COUNT && !search.is_done() {
            search.narrow(NARROWED_SCORE_FRACTION, NARROWED_SCORE_RATIO);
        }
        if search.lookup_count() > 2 * MAX_LOOKUP_COUNT {
            search.stop();
        }
    }

    /// Score of a scan's end points at a pose, as the search computes it.
    pub(crate) fn score(&self, ends: &[[f32; 2]], pose: Pose2) -> f64 {
        let (points, _) = self.subsampled(ends);
        self.pyramid.score(&points, pose)
    }

    /// Poses that fit the end points of a scan, in the base frame \[m\], best first.
    pub(crate) fn peaks(&self, ends: &[[f32; 2]]) -> Vec<Peak> {
        let mut search = self.start_search(ends, 0.0);
        while !search.is_done() {
            self.advance(&mut search, MAX_LOOKUP_COUNT / 4);
        }
        search.into_peaks().0
    }

    /// As [`GlobalLocalizer::peaks`], within half a window around a pose along each axis of the map
    /// \[m\] and in heading \[rad\].
    pub(crate) fn peaks_near(
        &self,
        ends: &[[f32; 2]],
        pose: Pose2,
        half_window: PoseThreshold,
    ) -> Vec<Peak> {
        let (points, step_rad) = self.subsampled(ends);
        let min_scores = (MIN_SCORE_RATIO, WINDOW_SCORE_FRACTION);
        let window = Some((pose, half_window));
        let mut search = BranchAndBound::new(&self.pyramid, &points, step_rad, min_scores, window);
        search.advance(&self.pyramid, MAX_WINDOW_LOOKUP_COUNT, &WINDOW_LIMITS);
        search.into_peaks().0
    }

    /// At most [`MAX_POINTS`] of the end points, and the heading step \[rad\].
    fn subsampled(&self, ends: &[[f32; 2]]) -> (Vec<[f32; 2]>, f64) {
        let step = ends.len().div_ceil(MAX_POINTS).max(1);
        let points: Vec<[f32; 2]> = ends.iter().step_by(step).copied().collect();
        let farthest_m = points.iter().map(|[x, y]| x * x + y * y).fold(0.0, f32::max).sqrt();
        // The farthest_m point moves by one cell per heading step.
        let step_rad = (self.pyramid.cell_m / f64::from(farthest_m).max(0.1)).clamp(0.02, 0.1);
        (points, step_rad)
    }
}
