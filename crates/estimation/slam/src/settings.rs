//! Settings of graph SLAM.

use periplus_scan_matching::{CloudSettings, FieldSettings, RegisterSettings};

use crate::tables::SlamToolboxParams;

/// Settings of graph SLAM. The defaults suit every scanner and building.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Minimum distance between keyframes \[m\] (default 0.35); a keyframe is inserted after this distance
    /// ...
    pub keyframe_distance_m: f64,
    /// ... or turn \[rad\] from the last one kept.
    pub keyframe_rotation_rad: f64,
    /// Nearer readings are not used \[m\].
    pub range_min_m: f32,
    /// Readings from farther away are not used \[m\].
    pub range_max_m: f32,
    /// Construction of point clouds.
    pub cloud: CloudSettings,
    /// Registration of scans.
    pub register: RegisterSettings,
    /// The field in which a scan is searched for among those before.
    pub local_field: FieldSettings,
    /// The field in which closures of loops are searched.
    pub loop_field: FieldSettings,
    /// Scans before that a new one is laid onto.
    pub local_scans: usize,
    /// True to close loops (default).
    pub closes_loops: bool,
    /// Side of a cell of the map \[m\].
    pub resolution_m: f64,
    /// Beams of a key scan that are kept for drawing, at most.
    pub drawn_beams: usize,
    /// Sweeps of the last refinement.
    pub refine_sweeps: usize,
    /// Neighbours that each keyframe is compared with in the last refinement (default 10).
    pub refine_neighbours: usize,
    /// Slices of work in the background that follow a scan, at most; each takes some milliseconds.
    pub slices_per_scan: usize,
    /// Steps of the solver, at most, after a closure.
    pub solve_steps: usize,
    /// True to remove keyframes that newer ones make redundant (default false): in a bounded area the map
    /// stays bounded, however long the robot drives, and follows changes.
    pub is_lifelong: bool,
    /// True to keep the pose of each scan (default). Otherwise at most two per keyframe are kept, so that a
    /// robot at rest uses no memory: for runs without an end.
    pub keeps_each_pose: bool,
    /// True to audit the map while mapping, when no other background work is left (default false): see
    /// [`Slam::contradictions`](crate::Slam::contradictions). [`Slam::finish`](crate::Slam::finish) audits
    /// it anyway.
    pub audits_live: bool,
}

impl Settings {
    /// Range of readings that are used: minimum, maximum \[m\].
    pub(crate) fn used_m(&self) -> [f32; 2] {
        [self.range_min_m, self.range_max_m]
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::from(&SlamToolboxParams::default())
    }
}

impl From<&SlamToolboxParams> for Settings {
    fn from(params: &SlamToolboxParams) -> Self {
        Self {
            keyframe_distance_m: params.minimum_travel_distance_m,
            keyframe_rotation_rad: params.minimum_travel_heading_rad,
            range_min_m: params.min_laser_range_m as f32,
            range_max_m: params.max_laser_range_m as f32,
            local_scans: params.scan_buffer_size,
            closes_loops: params.do_loop_closing,
            resolution_m: params.resolution_m,
            cloud: CloudSettings::default(),
            register: RegisterSettings::default(),
            local_field: FieldSettings {
                sigma_m: 0.1,
                most_half_m: 20.0,
                levels: 3,
                resolution_m: 0.1,
            },
            loop_field: FieldSettings {
                sigma_m: 0.12,
                most_half_m: 20.0,
                levels: 5,
                resolution_m: 0.1,
            },
            drawn_beams: 720,
            refine_sweeps: 4,
            refine_neighbours: 10,
            slices_per_scan: usize::MAX,
            solve_steps: 8,
            is_lifelong: false,
            keeps_each_pose: true,
            audits_live: false,
        }
    }
}
