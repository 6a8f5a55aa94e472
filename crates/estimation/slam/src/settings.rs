//! What can be set.

use periplus_scan_matching::{CloudSettings, FieldSettings, RegisterSettings};

/// What can be set. The defaults are meant to fit every scanner and building.
#[derive(Clone, Debug)]
pub struct Settings {
    /// A scan is kept after so much motion \[m\] ...
    pub keyframe_distance_m: f64,
    /// ... or turn \[rad\] from the last one kept.
    pub keyframe_rotation_rad: f64,
    /// Nearer readings are not used \[m\].
    pub range_min_m: f32,
    /// Readings from farther away are not used \[m\].
    pub range_max_m: f32,
    /// How clouds are made.
    pub cloud: CloudSettings,
    /// How scans are laid onto those before.
    pub register: RegisterSettings,
    /// The field in which a scan is searched for among those before.
    pub local_field: FieldSettings,
    /// The field in which closures of loops are searched.
    pub loop_field: FieldSettings,
    /// Scans before that a new one is laid onto.
    pub local_scans: usize,
    /// Whether loops are closed.
    pub closes_loops: bool,
    /// Side of a cell of the map \[m\].
    pub resolution_m: f64,
    /// Beams of a key scan that are kept for drawing, at most.
    pub drawn_beams: usize,
    /// Sweeps of the last refinement.
    pub refine_sweeps: usize,
    /// Neighbours that each scan is held against in the last refinement.
    pub refine_neighbours: usize,
    /// Slices of work in the background that follow a scan, at most; each takes some milliseconds.
    pub slices_per_scan: usize,
    /// Steps of the solver, at most, after a closure.
    pub solve_steps: usize,
    /// Whether kept scans go when a newer one shows the same from the same place: in a bounded area the
    /// map then stays bounded, however long the robot drives, and follows what changes.
    pub is_lifelong: bool,
    /// Whether the pose of each scan stays known. Without it there are at most two for each kept scan, so
    /// that a robot that stands still costs no memory: for runs without an end.
    pub keeps_each_pose: bool,
    /// Whether the map is audited while the robot drives, when there is no other work in the background:
    /// see [`Slam::contradictions`](crate::Slam::contradictions). [`Slam::finish`](crate::Slam::finish)
    /// audits it anyway.
    pub audits_live: bool,
}

impl Settings {
    /// Which readings are used \[m\].
    pub(crate) fn used_m(&self) -> [f32; 2] {
        [self.range_min_m, self.range_max_m]
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            keyframe_distance_m: 0.35,
            keyframe_rotation_rad: 0.26,
            range_min_m: 0.0,
            range_max_m: 60.0,
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
            local_scans: 8,
            closes_loops: true,
            resolution_m: 0.05,
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
