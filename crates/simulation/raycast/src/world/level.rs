//! Trees for level rays: scanners that turn about a vertical axis, on level floors.
//!
//! Their beams stay within a thin slab between two heights, and meet a small part of the triangles.
//! For a slab in which many rays are cast, a tree over the triangles that reach into it is built once
//! and kept until a fixed part is removed. Results are the same bits with and without.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use crate::local_ray::ROUNDING_RATIO;
use crate::mesh::TriangleMesh;
use crate::ray::Ray;

/// Distance of the slabs' middles \[m\]. Thin enough to leave out most of a shelf, thick enough for a
/// robot that sways on its wheels.
const SLAB_DISTANCE_M: f64 = 0.04;
/// Height by which a slab reaches into its neighbours \[m\]: rays may rise or sink by as much.
const SLAB_OVERLAP_M: f64 = 0.02;
/// Minimum number of triangles for which a separate tree pays off.
const MIN_TRIANGLES: usize = 64;
/// Maximum part of the triangles in a tree for a slab: with more, little is gained.
const MAX_TRIANGLES_FRACTION: usize = 2;
/// Number of rays, as a part of all triangles, after which a slab gets its tree.
const MIN_RAYS_FRACTION: usize = 4;
/// Number of rays traced through all triangles after one that is not level.
const SKIPPED_RAYS: usize = 64;
/// Maximum number of slabs; the one used least recently is replaced.
const MAX_SLAB_COUNT: usize = 8;
/// Maximum distance of rays' origins from the middle of the triangles, in half widths.
const MAX_ORIGIN_RATIO: f64 = 2.0;

/// Number of a slab.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SlabIndex(i64);

/// Limits that distinguish level rays from others.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelLimits {
    middle: [f64; 3],
    max_origin_m: f64,
    max_slope: f64,
}

impl LevelLimits {
    /// `None` if no ray is treated as level.
    pub(super) fn new(mesh: &TriangleMesh) -> Option<Self> {
        let half_width = f64::from(mesh.half_width());
        if mesh.len() < MIN_TRIANGLES || half_width <= 0.0 {
            return None;
        }
        let max_origin_m = MAX_ORIGIN_RATIO * half_width;
        // From the origin to the far side, along the longer of the axes x and y.
        let max_travel_m = max_origin_m + half_width;
        let lengths_m = max_travel_m + max_origin_m + mesh.half_height_m();
        let margin_m = 64.0 * f64::from(ROUNDING_RATIO) * lengths_m;
        let rise_m = SLAB_OVERLAP_M - margin_m;
        let max_slope = rise_m / max_travel_m;
        (max_slope > 0.0).then(|| Self {
            middle: mesh.middle_m.to_array(),
            max_origin_m,
            max_slope,
        })
    }

    /// Returns the slab that a ray stays in while it is above or below the triangles.
    pub(super) fn slab_of(&self, ray: &Ray) -> Option<SlabIndex> {
        let [ox, oy, oz] = ray.origin_m.to_array();
        let [mx, my, mz] = self.middle;
        let near = (ox - mx).abs() <= self.max_origin_m && (oy - my).abs() <= self.max_origin_m;
        #[expect(clippy::cast_possible_truncation, reason = "saturates, far from every triangle")]
        (near && self.is_level(ray))
            .then(|| SlabIndex(((oz - mz) / SLAB_DISTANCE_M).floor() as i64))
    }

    #[inline(always)]
    fn is_level(&self, ray: &Ray) -> bool {
        let direction = ray.direction;
        direction.z.abs() <= self.max_slope * direction.x.abs().max(direction.y.abs())
    }

    /// Returns the number of rays, from the first on, that are treated like it: those in its slab, or
    /// some if it has none.
    pub(super) fn run_length(&self, rays: &[Ray], slab: Option<SlabIndex>) -> usize {
        if slab.is_none() {
            // Rays that do not profit are not looked at one by one.
            return rays.len().min(SKIPPED_RAYS);
        }
        let Some(mut lead) = rays.first() else { return 0 };
        let mut count = 1;
        for ray in &rays[1..] {
            // Most rays start where the one before does.
            let same = if ray.origin_m == lead.origin_m {
                self.is_level(ray)
            } else {
                self.slab_of(ray) == slab
            };
            if !same {
                break;
            }
            lead = ray;
            count += 1;
        }
        count
    }
}

/// A slab in which rays were cast.
#[derive(Debug)]
struct Slab {
    index: SlabIndex,
    rays: usize,
    tree: Tree,
}

#[derive(Debug)]
enum Tree {
    NotYet,
    /// Too many triangles reach into the slab.
    TooLarge,
    Built(Arc<TriangleMesh>),
}

/// Slabs of a world, the one used last at the end.
#[derive(Default)]
pub(super) struct LevelTrees(Mutex<Vec<Slab>>);

impl Clone for LevelTrees {
    /// Slabs are not copied: they are built again where they are needed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for LevelTrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LevelTrees").finish_non_exhaustive()
    }
}

impl LevelTrees {
    /// Forgets all trees, after the triangles have changed.
    pub(super) fn clear(&mut self) {
        self.0.get_mut().unwrap_or_else(PoisonError::into_inner).clear();
    }

    pub(super) fn size_bytes(&self) -> usize {
        let slabs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let size = |slab: &Slab| match &slab.tree {
            Tree::Built(mesh) => mesh.size_bytes(),
            _ => 0,
        };
        slabs.iter().map(size).sum()
    }

    /// Returns the tree for another `rays` rays in a slab, if there is one or it is worth building now.
    pub(super) fn tree(
        &self,
        mesh: &TriangleMesh,
        index: SlabIndex,
        rays: usize,
    ) -> Option<Arc<TriangleMesh>> {
        let mut slabs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let position = slabs.iter().position(|slab| slab.index == index);
        let mut slab = match position {
            Some(position) => slabs.remove(position),
            None => {
                if slabs.len() == MAX_SLAB_COUNT {
                    slabs.remove(0);
                }
                Slab { index, rays: 0, tree: Tree::NotYet }
            }
        };
        slab.rays = slab.rays.saturating_add(rays);
        if matches!(slab.tree, Tree::NotYet) && slab.rays >= mesh.len() / MIN_RAYS_FRACTION {
            slab.tree = build(mesh, index);
        }
        let tree = match &slab.tree {
            Tree::Built(tree) => Some(Arc::clone(tree)),
            _ => None,
        };
        slabs.push(slab);
        tree
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the margin of `LevelLimits` covers it")]
fn build(mesh: &TriangleMesh, SlabIndex(index): SlabIndex) -> Tree {
    let low = index as f64 * SLAB_DISTANCE_M - SLAB_OVERLAP_M;
    let high = (index + 1) as f64 * SLAB_DISTANCE_M + SLAB_OVERLAP_M;
    let max_count = mesh.len() / MAX_TRIANGLES_FRACTION;
    match mesh.level(low as f32, high as f32, max_count) {
        Some(tree) => Tree::Built(Arc::new(tree)),
        None => Tree::TooLarge,
    }
}
