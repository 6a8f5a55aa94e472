//! Settings of the particle filter.

use periplus_diagnostics::Diagnostics;

use crate::tables::GMAPPING;

/// Standard deviations of odometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Position, per metre of path.
    pub place_by_way: f64,
    /// Position \[m\], per radian of rotation.
    pub place_by_turn: f64,
    /// Heading \[rad\], per metre of path.
    pub heading_by_way: f64,
    /// Heading, per radian of rotation.
    pub heading_by_turn: f64,
}

/// Settings of the particle filter. The defaults are those of [`GMAPPING`].
#[derive(Clone, Debug, PartialEq)]
pub struct GmappingSettings {
    /// Number of particles.
    pub particles: usize,
    /// Seed of all randomness.
    pub seed: u64,
    /// Number of threads; the result does not depend on it.
    pub threads: usize,
    /// Nearer readings are not used \[m\].
    pub range_min_m: f32,
    /// The map is drawn, and scans are laid onto it, up to here \[m\].
    pub range_used_m: f32,
    /// Maximum range of readings that are used \[m\]; `None` for the scan's own limit.
    pub range_max_m: Option<f32>,
    /// Beams that are left out after each one when scans are laid onto maps.
    pub skipped_beams: usize,
    /// A scan is used after this motion \[m\] ...
    pub update_shift_m: f64,
    /// ... or turn \[rad\] ...
    pub update_turn_rad: f64,
    /// ... or time \[s\] since the last one.
    pub update_time_s: Option<f64>,
    /// In a match a beam that ends a distance d from the map's points counts exp(-d^2 / this) \[m^2\].
    pub match_sigma_m2: f64,
    /// Cells around the end of a beam that are looked at.
    pub kernel_cells: usize,
    /// Steps towards the best fit.
    pub steps: usize,
    /// A scan fits when its beams count more than this together.
    pub least_score: f64,
    /// A beam is likely by exp(-d^2 / this) \[m^2\].
    pub likelihood_sigma_m2: f64,
    /// Smoothing factor of the likelihood for weights.
    pub gain: f64,
    /// Half range around the best match in which the likelihood is sampled \[m, rad\].
    pub sample_range: [f64; 2],
    /// In which steps \[m, rad\].
    pub sample_step: [f64; 2],
    /// Odometry noise.
    pub noise: Noise,
    /// Resampling threshold: effective sample size relative to the number of particles.
    pub resample_share: f64,
    /// Side of a cell of the map \[m\].
    pub resolution_m: f64,
    /// A cell is occupied from this share of hits on.
    pub occupied_share: f64,
    /// The map reaches at least over this: least x and y, most x and y \[m\].
    pub bounds_m: [Option<f64>; 4],
    /// Slices of work of the front end on closures of loops that follow a scan, at most.
    pub slices_per_scan: usize,
    /// True if the pose of each scan is kept. Otherwise at most two are kept for each scan that is used, so
    /// that memory does not grow while the robot stands still.
    pub keeps_each_pose: bool,
}

impl Default for GmappingSettings {
    fn default() -> Self {
        Self::of(&GMAPPING.check([], None, &mut Diagnostics::new()))
    }
}
