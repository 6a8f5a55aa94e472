//! Scans that were used, to be drawn again where they turn out to belong.

use periplus_scan_matching::PackedPlaces;

use super::beams::Beams;
use crate::keyframe::TrajectoryNode;

/// A scan that was used. All particles share it.
pub(super) struct Node {
    /// Node of the front end.
    pub(super) node: TrajectoryNode,
    /// Path length up to it \[m\].
    pub(super) way_m: f64,
    hits: PackedPlaces,
    rims: PackedPlaces,
}

impl Node {
    pub(super) fn new(node: TrajectoryNode, way_m: f64, beams: &Beams) -> Self {
        Self {
            node,
            way_m,
            hits: PackedPlaces::new(&beams.hits, beams.origin),
            rims: PackedPlaces::new(&beams.rims, beams.origin),
        }
    }

    /// The beams that are drawn.
    pub(super) fn beams(&self) -> Beams {
        Beams {
            points: Vec::new(),
            hits: self.hits.iter().collect(),
            rims: self.rims.iter().collect(),
            origin: self.hits.middle(),
        }
    }

    /// Bytes held, about.
    pub(super) fn size(&self) -> usize {
        size_of::<Self>() + self.hits.size() + self.rims.size()
    }
}
