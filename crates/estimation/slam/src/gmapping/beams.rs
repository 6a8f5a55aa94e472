//! A scan as particles use it.

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{CloudSettings, Point};

use super::settings::GmappingSettings;
use crate::scan::Ends;

/// Beams that are drawn, at most.
const MAX_DRAWN_BEAMS: usize = 720;

/// A scan in the frame of the base \[m\].
pub(super) struct Beams {
    /// Points to match.
    pub(super) points: Vec<Point>,
    /// Beam ends to draw.
    pub(super) hits: Vec<[f32; 2]>,
    /// Points at which longer beams are cut for drawing.
    pub(super) rims: Vec<[f32; 2]>,
    /// Position of the scanner.
    pub(super) origin: [f32; 2],
}

impl Beams {
    /// `motion` is how the base moved in a second.
    pub(super) fn new(
        scan: &LaserScan2,
        motion: Option<Pose2>,
        settings: &GmappingSettings,
    ) -> Self {
        let most_m = settings.range_max_m.unwrap_or(scan.range_max_m - 0.01);
        let used_m = settings.range_used_m.min(most_m);
        let near = Ends::new(scan, motion, [settings.range_min_m, used_m]);
        let cloud = near.cloud(&CloudSettings::default());
        let points = cloud.points().iter().copied().step_by(settings.skipped_beams + 1).collect();
        let every = near.ends.len().div_ceil(MAX_DRAWN_BEAMS).max(1);
        let [x, y] = near.origin;
        let rims = if used_m < most_m {
            let far = Ends::new(scan, motion, [used_m, most_m]).ends;
            let cut = |[end_x, end_y]: [f32; 2]| {
                let (dx, dy) = (end_x - x, end_y - y);
                let part = used_m / (dx * dx + dy * dy).sqrt().max(used_m);
                [x + part * dx, y + part * dy]
            };
            far.into_iter().step_by(every).flatten().map(cut).collect()
        } else {
            Vec::new()
        };
        let hits = near.ends.iter().step_by(every).filter_map(|end| *end).collect();
        Self { points, hits, rims, origin: near.origin }
    }
}
