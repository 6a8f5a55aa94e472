//! Triangle meshes with a bounding volume hierarchy.

mod interleaved;
mod level;
mod packet_trace;

use std::fmt;

use periplus_geometry::DVec3;

use crate::bvh::{self, Bounds, LEAF_MASK, MAX_LEAF_TRIANGLES, Node, build, leaf_range};
use crate::local_ray::{BoxTest, LocalRay, distance_margin, reach};
use crate::simd::{Row, V8, splat3};
use crate::traversal::{Leaves, Stack, Step, traverse};
use crate::triangle;

pub(crate) use interleaved::{QueuedRays, RayQueue};
pub(crate) use packet_trace::{Best, GroupStack};

/// Maximum absolute value of a coordinate \[m\].
const MAX_COORDINATE_M: f64 = 1e12;

/// Triangles with a tree over them, in a local frame. Single precision about the middle of the mesh:
/// the error of a distance is about 1e-7 of the mesh's size and of the distance.
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    /// Origin of the tree's frame \[m\].
    pub(crate) middle_m: DVec3,
    pub(crate) low_m: DVec3,
    pub(crate) high_m: DVec3,
    pub(crate) nodes: Vec<Node>,
    pub(crate) blocks: Vec<Block>,
    /// Block and lane of each triangle.
    slots: Vec<u32>,
    /// Maximum extent of a triangle's bounding box \[m\].
    pub(crate) extent: f32,
}

/// Up to eight triangles: `corners[corner][axis]`. Unused lanes have zero area.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) corners: [[Row; 3]; 3],
    /// Triangles as bits, `u32::MAX` in unused lanes. Read as f32, the bits of two triangles compare in
    /// the order of their numbers.
    pub(crate) ids: Row,
}

impl Block {
    const EMPTY: Self =
        Self { corners: [[Row([0.0; 8]); 3]; 3], ids: Row([f32::from_bits(u32::MAX); 8]) };

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> u32 {
        self.ids.0[lane].to_bits()
    }

    /// Returns the corners of the triangle in a lane.
    fn triangle(&self, lane: usize) -> [[f32; 3]; 3] {
        self.corners.each_ref().map(|corner| corner.each_ref().map(|row| row.0[lane]))
    }
}

/// Gathers the triangles of each leaf in a block, and numbers the leaves' blocks. `triangle` returns id
/// and corners of a box's triangle.
fn assemble(
    nodes: &mut [Node],
    boxes: &[Bounds],
    triangle: impl Fn(u32) -> (u32, [[f32; 3]; 3]),
) -> Vec<Block> {
    let mut blocks = Vec::with_capacity(boxes.len() / 4);
    for node in nodes {
        for slot in 0..8 {
            let word = node.child(slot);
            if !node.is_used(slot) || word & LEAF_MASK == 0 {
                continue;
            }
            let (first, count) = leaf_range(word);
            let mut block = Block::EMPTY;
            // In the order of their ids, so that the first of equally near ones has the lowest.
            let mut own = [(u32::MAX, [[0.0; 3]; 3]); MAX_LEAF_TRIANGLES];
            for (own, each) in own.iter_mut().zip(&boxes[first..first + count]) {
                *own = triangle(each.number());
            }
            own.sort_unstable_by_key(|&(id, _)| id);
            for (lane, (id, corners)) in own.into_iter().enumerate().take(count) {
                block.ids.0[lane] = f32::from_bits(id);
                for (rows, corner) in block.corners.iter_mut().zip(corners) {
                    for (row, value) in rows.iter_mut().zip(corner) {
                        row.0[lane] = value;
                    }
                }
            }
            node.set_child(slot, bvh::leaf(blocks.len(), count));
            blocks.push(block);
        }
    }
    blocks
}

/// Reasons that triangles cannot form a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleMeshError {
    /// A triangle refers to a corner that does not exist.
    NoSuchCorner {
        /// Index of the triangle.
        triangle: usize,
    },
    /// A position is not finite or beyond 1e12 m.
    BadPosition {
        /// Index of the position.
        position: usize,
    },
    /// More than 2^28 triangles.
    TooMany,
}

impl fmt::Display for TriangleMeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchCorner { triangle } => {
                write!(f, "triangle {triangle} refers to a position that is not in the list")
            }
            Self::BadPosition { position } => {
                write!(f, "position {position} is not finite or beyond 1e12 m from the origin")
            }
            Self::TooMany => {
                write!(f, "more than {} triangles; split the mesh", bvh::MAX_PRIMITIVE_COUNT)
            }
        }
    }
}

impl std::error::Error for TriangleMeshError {}

/// The nearest triangle so far; `id` is `u32::MAX` when there is none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) distance: f32,
    pub(crate) id: u32,
}

impl Nearest {
    #[inline(always)]
    fn is_worse_than(&self, distance: f32, id: u32) -> bool {
        distance < self.distance || distance == self.distance && id < self.id
    }
}

impl TriangleMesh {
    /// Builds a mesh from positions \[m\] and triangle corners with `threads` threads (0 counts as
    /// 1). The mesh does not depend on the number of threads. Degenerate triangles are kept and
    /// never hit.
    ///
    /// # Errors
    /// When a corner or a position is unusable.
    pub fn new(
        positions_m: &[[f64; 3]],
        triangles: &[[u32; 3]],
        threads: usize,
    ) -> Result<Self, TriangleMeshError> {
        if triangles.len() > bvh::MAX_PRIMITIVE_COUNT {
            return Err(TriangleMeshError::TooMany);
        }
        let usable = |p: &[f64; 3]| p.iter().all(|x| x.abs() <= MAX_COORDINATE_M);
        if let Some(position) = positions_m.iter().position(|p| !usable(p)) {
            return Err(TriangleMeshError::BadPosition { position });
        }
        let known = |t: &[u32; 3]| t.iter().all(|&corner| (corner as usize) < positions_m.len());
        if let Some(triangle) = triangles.iter().position(|t| !known(t)) {
            return Err(TriangleMeshError::NoSuchCorner { triangle });
        }
        let (mut low_m, mut high_m) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &p in positions_m {
            low_m = low_m.min(DVec3::from_array(p));
            high_m = high_m.max(DVec3::from_array(p));
        }
        if positions_m.is_empty() {
            (low_m, high_m) = (DVec3::ZERO, DVec3::ZERO);
        }
        let middle_m = (low_m + high_m) * 0.5;
        #[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
        let local: Vec<[f32; 3]> = positions_m
            .iter()
            .map(|&p| (DVec3::from_array(p) - middle_m).to_array().map(|x| x as f32))
            .collect();
        let mut extent = 0.0_f32;
        let mut boxes: Vec<Bounds> = Vec::with_capacity(triangles.len());
        for (number, triangle) in (0_u32..).zip(triangles) {
            let (bounds, size) = bounds(triangle.map(|corner| local[corner as usize]), number);
            extent = extent.max(size);
            boxes.push(bounds);
        }
        let mut nodes = build(&mut boxes, MAX_LEAF_TRIANGLES, threads);
        let triangle = |id: u32| (id, triangles[id as usize].map(|corner| local[corner as usize]));
        let blocks = assemble(&mut nodes, &boxes, triangle);
        let mut slots = vec![0; triangles.len()];
        for (index, block) in blocks.iter().enumerate() {
            for lane in 0..8 {
                if let Some(slot) = slots.get_mut(block.id(lane) as usize) {
                    #[expect(clippy::cast_possible_truncation, reason = "fewer than 2³¹")]
                    let index = (index * 8 + lane) as u32;
                    *slot = index;
                }
            }
        }
        Ok(Self { middle_m, low_m, high_m, nodes, blocks, slots, extent })
    }

    /// Returns the number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Returns true if there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Returns the memory used by tree and triangles.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks) + size_of_val(&*self.slots)
    }

    /// Returns the middle and half extents of the bounding box \[m\].
    pub(crate) fn bounds_m(&self) -> (DVec3, DVec3) {
        ((self.low_m + self.high_m) / 2.0, (self.high_m - self.low_m) / 2.0)
    }

    /// Collapses triangles to zero area, so that no ray hits them.
    pub(crate) fn erase(&mut self, ids: std::ops::Range<u32>) {
        for id in ids {
            let index = self.slots[id as usize] as usize;
            for row in self.blocks[index / 8].corners.as_flattened_mut() {
                row.0[index % 8] = 0.0;
            }
        }
    }

    /// Returns the unit normal of a triangle by the right-hand rule; zero for a degenerate triangle.
    pub(crate) fn normal(&self, id: u32) -> DVec3 {
        let index = self.slots[id as usize] as usize;
        let block = &self.blocks[index / 8];
        let [a, b, c] = [0, 1, 2].map(|corner: usize| {
            let [x, y, z] = [0, 1, 2].map(|axis: usize| block.corners[corner][axis].0[index % 8]);
            DVec3::new(x.into(), y.into(), z.into())
        });
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// Transforms a ray from the mesh's frame \[m\] to the tree's frame.
    #[inline(always)]
    pub(crate) fn localize(&self, origin_m: DVec3, direction: DVec3, min_m: f64) -> LocalRay {
        LocalRay::new(origin_m - self.middle_m, direction, min_m)
    }

    /// Updates `nearest` with the nearest triangle that `accept` permits. With `ANY` the first
    /// triangle found ends the search.
    #[inline(always)]
    pub(crate) fn trace<V: V8, const ANY: bool>(
        &self,
        ray: &LocalRay,
        nearest: &mut Nearest,
        stack: &mut Stack,
        accept: impl Fn(u32) -> bool,
    ) {
        let margin = distance_margin(self.extent, ray.shear[2]);
        let limit = reach(nearest.distance, margin);
        let rows = RayRows::<V>::new(ray);
        let mut leaves =
            RayLeaves::<V, _, ANY> { blocks: &self.blocks, rows: &rows, margin, nearest, accept };
        traverse(&self.nodes, &BoxTest::<V>::new(ray, margin), limit, stack, &mut leaves);
    }
}

/// Precomputed terms of the triangle test of a ray.
struct RayRows<V> {
    axes: [usize; 3],
    origin: [V; 3],
    shear: [V; 3],
    min: V,
}

impl<V: V8> RayRows<V> {
    #[inline(always)]
    fn new(ray: &LocalRay) -> Self {
        let [x, y, z] = ray.axes;
        let origin = [ray.origin[x], ray.origin[y], ray.origin[z]];
        Self::of(ray.axes, origin, ray.shear, ray.min)
    }

    /// `origin` is in the order of `axes`.
    #[inline(always)]
    fn of(axes: [usize; 3], origin: [f32; 3], shear: [f32; 3], min: f32) -> Self {
        Self { axes, origin: splat3(origin), shear: splat3(shear), min: V::splat(min) }
    }

    #[inline(always)]
    fn corner(&self, corner: &[Row; 3]) -> [V; 3] {
        [
            V::load(&corner[self.axes[0]]).sub(self.origin[0]),
            V::load(&corner[self.axes[1]]).sub(self.origin[1]),
            V::load(&corner[self.axes[2]]).sub(self.origin[2]),
        ]
    }
}

/// One ray against eight triangles at a time.
struct RayLeaves<'a, V, A, const ANY: bool> {
    blocks: &'a [Block],
    rows: &'a RayRows<V>,
    margin: f32,
    nearest: &'a mut Nearest,
    accept: A,
}

impl<V: V8, A: Fn(u32) -> bool, const ANY: bool> Leaves for RayLeaves<'_, V, A, ANY> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let block = &self.blocks[leaf_range(word).0];
        let [a, b, c] = &block.corners;
        let rows = self.rows;
        let corners = [rows.corner(a), rows.corner(b), rows.corner(c)];
        let best = V::splat(self.nearest.distance);
        let (mask, distances) = triangle::intersect(corners, rows.shear, rows.min, best);
        let mut bits = mask.bits();
        if bits == 0 {
            return Step::On;
        }
        let distances = distances.store();
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            let (distance, id) = (distances.0[lane], block.id(lane));
            if self.nearest.is_worse_than(distance, id) && (self.accept)(id) {
                *self.nearest = Nearest { distance, id };
                if ANY {
                    return Step::Stop;
                }
            }
        }
        Step::Within(reach(self.nearest.distance, self.margin))
    }
}

/// Returns the bounding box of a triangle, with a margin for the rounding of the triangle test, and
/// its longest side.
fn bounds(corners: [[f32; 3]; 3], number: u32) -> (Bounds, f32) {
    let [a, b, c] = corners;
    let mut low = [0.0_f32; 3];
    let mut high = [0.0_f32; 3];
    let mut extent = 0.0_f32;
    for axis in 0..3 {
        low[axis] = a[axis].min(b[axis]).min(c[axis]);
        high[axis] = a[axis].max(b[axis]).max(c[axis]);
        extent = extent.max(high[axis] - low[axis]);
    }
    for axis in 0..3 {
        let room = 2e-6 * extent + 2.4e-7 * low[axis].abs().max(high[axis].abs());
        low[axis] -= room;
        high[axis] += room;
    }
    (Bounds::new(low, high, number), extent)
}
