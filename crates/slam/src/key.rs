//! Scans that are kept.

use std::sync::Arc;

use periplus_base::Pose2;
use periplus_matching::Cloud;

/// A scan that is kept.
pub(crate) struct Key {
    pub(crate) cloud: Cloud,
    /// Ends of beams for drawing, in the base's frame \[m\].
    pub(crate) ends: Arc<[[f32; 2]]>,
    /// Length of the way from the first one \[m\], a turn counted as a little way.
    pub(crate) travel_m: f64,
}

/// Where a scan that came in was, relative to one that is kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track {
    pub(crate) time_ns: i64,
    pub(crate) key: usize,
    pub(crate) key_from_base: Pose2,
}
