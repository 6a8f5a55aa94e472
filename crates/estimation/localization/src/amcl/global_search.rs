//! Search for the robot on the whole map, in slices of bounded work.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;
use periplus_scan_matching::Peak;

use super::Amcl;
use crate::branch_and_bound::{BranchAndBound, Completeness};
use crate::pose_threshold::{PoseThreshold, has_moved};
use crate::scan::MatchingScan;
use crate::shared_maps::PreparedMap;

/// Maximum work of a slice, some milliseconds; more for the first slice, when nothing is known yet
/// (EXPERIMENTS.md, steps 22 and 29).
const SLICE_LOOKUP_COUNT: u64 = 3_000_000;
const FIRST_SLICE_LOOKUP_COUNT: u64 = 11_000_000;
/// Minimum motion between searches.
const SEARCH_INTERVAL: PoseThreshold = PoseThreshold::new(0.5, 0.5);
/// Maximum factor of the motion between searches after failures.
const MAX_BACKOFF_FACTOR: u32 = 3;
/// A scan changed if more than this fraction of the ranges differ by more than this distance.
const CHANGED_FRACTION: f64 = 0.3;
const CHANGED_RANGE_M: f64 = 0.3;

/// Search of the whole map: at most one runs at a time, one slice per scan.
#[derive(Clone, Debug, Default)]
pub(super) struct GlobalSearch {
    /// Search in progress and odometry at its scan.
    running: Option<(BranchAndBound, Pose2)>,
    finished: Option<SearchResult>,
    /// Number of slices on this map.
    slice_count: u64,
    /// Number of lookups in the present update.
    pub(super) lookup_count: u64,
    pub(super) last: Option<LastSearch>,
    /// Number of searches since the last success.
    pub(super) failure_count: u32,
}

/// Candidate poses of a search.
#[derive(Clone, Debug)]
pub(super) struct SearchResult {
    /// Candidates, best first.
    pub(super) peaks: Vec<Peak>,
    pub(super) completeness: Completeness,
    /// Odometry at the scan.
    odom_from_base: Pose2,
}

impl SearchResult {
    /// Candidate poses.
    pub(super) fn poses(&self) -> Vec<Pose2> {
        self.peaks.iter().map(|peak| peak.pose).collect()
    }
}

/// The most recent search.
#[derive(Clone, Debug)]
pub(super) struct LastSearch {
    /// Odometry at the scan.
    pub(super) odom_from_base: Pose2,
    /// Ranges of the scan \[m\].
    ranges_m: Vec<f32>,
    /// Error to return while no new search starts.
    pub(super) error: Box<Diagnostic>,
}

impl LastSearch {
    pub(super) fn new(odom_from_base: Pose2, scan: &MatchingScan, error: Box<Diagnostic>) -> Self {
        let ranges_m = scan.beams.beams.iter().map(|beam| beam.range_m as f32).collect();
        Self { odom_from_base, ranges_m, error }
    }

    pub(super) fn with_error(self, error: Box<Diagnostic>) -> Self {
        Self { error, ..self }
    }

    /// True if a scan differs from that of the search.
    fn differs_from(&self, scan: &MatchingScan) -> bool {
        let beams = &scan.beams.beams;
        let changed_count = beams
            .iter()
            .zip(&self.ranges_m)
            .filter(|(beam, old)| (beam.range_m - f64::from(**old)).abs() > CHANGED_RANGE_M)
            .count();
        beams.len() != self.ranges_m.len()
            || changed_count as f64 > CHANGED_FRACTION * beams.len() as f64
    }
}

impl GlobalSearch {
    pub(super) fn is_running(&self) -> bool {
        self.running.is_some()
    }

    pub(super) fn has_result(&self) -> bool {
        self.finished.is_some()
    }

    /// Drops the search in progress and its result.
    pub(super) fn cancel(&mut self) {
        self.running = None;
        self.finished = None;
    }

    /// Drops everything that depends on the map.
    pub(super) fn reset_map(&mut self) {
        self.cancel();
        self.slice_count = 0;
    }

    /// Drops everything that depends on the origin of odometry.
    pub(super) fn reset_odometry(&mut self) {
        self.cancel();
        self.last = None;
    }

    /// Prepares for a new pose.
    pub(super) fn reset(&mut self) {
        self.reset_odometry();
        self.failure_count = 0;
    }

    /// Takes the result of a finished search, with its candidates predicted by odometry.
    pub(super) fn take_result(&mut self, odom_from_base: Pose2) -> Option<SearchResult> {
        let mut result = self.finished.take()?;
        let step = result.odom_from_base.inverse() * odom_from_base;
        for peak in &mut result.peaks {
            peak.pose = (peak.pose * step).normalized();
        }
        Some(result)
    }

    /// True if a new search is worth its work: the robot moved since the last one, farther after
    /// more failures, or the scan changed.
    pub(super) fn is_due(&self, scan: &MatchingScan, odom_from_base: Pose2) -> bool {
        let factor = f64::from(1 + self.failure_count.min(MAX_BACKOFF_FACTOR - 1));
        let threshold = SEARCH_INTERVAL.scaled(factor);
        self.last.as_ref().is_none_or(|last| {
            has_moved(last.odom_from_base, odom_from_base, threshold) || last.differs_from(scan)
        })
    }

    /// True if the robot moved by more than a threshold since the last search.
    pub(super) fn has_moved_since_last(
        &self,
        odom_from_base: Pose2,
        threshold: PoseThreshold,
    ) -> bool {
        let has_moved =
            |last: &LastSearch| has_moved(last.odom_from_base, odom_from_base, threshold);
        self.last.as_ref().is_none_or(has_moved)
    }
}

impl Amcl {
    /// Starts a search for poses with a score of at least `min_score`, and runs its first slice.
    pub(super) fn start_search(
        &mut self,
        scan: &MatchingScan,
        odom_from_base: Pose2,
        min_score: f64,
    ) {
        let Some(map) = &mut self.map else { return };
        let search = map.localizer().1.start_search(&scan.ends, min_score);
        self.search.running = Some((search, odom_from_base));
        self.search.last = Some(LastSearch::new(odom_from_base, scan, super::no_initial_pose()));
        self.advance_search();
    }

    /// Runs the next slice of the search in progress, if any. Its scan may be an older one.
    pub(super) fn advance_search(&mut self) {
        let Some((mut search, odom_from_base)) = self.search.running.take() else { return };
        let Some(localizer) = self.map.as_ref().and_then(PreparedMap::built_localizer) else {
            return;
        };
        let is_first = self.search.slice_count == 0;
        let max_lookups = if is_first { FIRST_SLICE_LOOKUP_COUNT } else { SLICE_LOOKUP_COUNT };
        self.search.slice_count += 1;
        let lookup_count_before = search.lookup_count();
        localizer.advance(&mut search, max_lookups);
        self.search.lookup_count += search.lookup_count() - lookup_count_before;
        if search.is_done() {
            let (peaks, completeness) = search.into_peaks();
            self.search.finished = Some(SearchResult { peaks, completeness, odom_from_base });
        } else {
            self.search.running = Some((search, odom_from_base));
        }
    }
}
