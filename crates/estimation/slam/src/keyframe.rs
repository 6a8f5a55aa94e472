//! Scans that are kept.

use std::ops::Range;
use std::sync::Arc;

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, PackedCloud, PackedPlaces};

use crate::memory::on_64_bits;

/// Size of a keyframe, and of what it points to, without points \[bytes\].
const KEYFRAME_BYTES: usize =
    on_64_bits::<Keyframe>(24) + on_64_bits::<(PackedCloud, PackedPlaces)>(96);

/// A scan that is kept.
#[derive(Clone, Debug)]
pub(crate) struct Keyframe {
    pub(crate) cloud: Arc<PackedCloud>,
    /// Ends of beams for drawing, in the base's frame; none where the cloud holds enough of them.
    pub(crate) ends: Option<Arc<PackedPlaces>>,
    /// Path length from the first keyframe \[m\], rotation included.
    pub(crate) travel_m: f64,
}

impl Keyframe {
    pub(crate) fn new(cloud: &Cloud, ends: Option<PackedPlaces>, travel_m: f64) -> Self {
        Self { cloud: Arc::new(PackedCloud::new(cloud)), ends: ends.map(Arc::new), travel_m }
    }

    /// Its points.
    pub(crate) fn cloud(&self) -> Cloud {
        self.cloud.cloud()
    }

    /// Bytes held, about.
    pub(crate) fn size(&self) -> usize {
        let ends = self.ends.as_ref().map_or(0, |it| it.size());
        self.cloud.size() + ends + KEYFRAME_BYTES
    }
}

/// Returns the keyframes within a range of path length \[m\].
pub(crate) fn between(keyframes: &[Keyframe], from_m: f64, to_m: f64) -> Range<usize> {
    let start = keyframes.partition_point(|keyframe| keyframe.travel_m < from_m);
    start..keyframes.partition_point(|keyframe| keyframe.travel_m <= to_m)
}

/// Pose of a scan relative to a keyframe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrajectoryNode {
    pub(crate) time_ns: i64,
    pub(crate) keyframe: usize,
    pub(crate) keyframe_from_base: Pose2,
}
