//! Batches of rays.

use std::marker::PhantomData;
use std::sync::Arc;
use std::vec::Drain;

use super::level::LevelLimits;
use super::packet_group::{PacketGroup, TraceGroup};
use super::partition::for_each_chunk;
use super::query::{
    Find, FindInstances, NearestHit, Scratch, directions, hit_of, single_above, to_f32,
};
use super::{Filter, RaycastWorld};
use crate::mesh::{Nearest, QueuedRays, RayQueue, TriangleMesh};
use crate::ray::{Hit, Ray};
use crate::simd::{Row, Task, V8, dispatch};

/// Trees with more leaves exceed the nearest caches, and a wide pyramid meets far more triangles
/// than its rays do.
const LARGE_MESH_BLOCKS: usize = 7_000;
/// The same for trees of level rays, in which the beams of a sparse fan have little in common.
const MAX_LEVEL_PACKET_BLOCK_COUNT: usize = 1_500;
/// Number of rays that are looked at before they are traced: few enough to stay in the cache.
const LEVEL_BLOCK_RAYS: usize = 4096;
/// Minimum number of rays for interleaved traversal.
const MIN_INTERLEAVED_RAYS: usize = 8;
/// Number of collected rays that starts interleaved traversal: small enough to stay in the cache.
const MAX_PENDING_RAYS: usize = 2048;

/// Maximum spread of slopes.
#[derive(Clone, Copy)]
struct SlopeSpread {
    /// Within a packet of eight; rays with a larger spread are traced one by one.
    packet: f32,
    /// Within a group of packets.
    group: f32,
}

const MAX_SPREAD: SlopeSpread = SlopeSpread { packet: 0.5, group: 2.1 };
const MAX_SPREAD_IN_LARGE_MESH: SlopeSpread = SlopeSpread { packet: 0.1, group: 0.3 };

/// Tile of neighbours that form a packet.
#[derive(Clone, Copy)]
struct Tile {
    columns: usize,
    rows: usize,
}

/// Number of image rows that can share a group.
pub(super) const BAND_ROWS: usize = 4;

const TILE_8X1: Tile = Tile { columns: 8, rows: 1 };
const TILE_4X2: Tile = Tile { columns: 4, rows: 2 };

impl RaycastWorld {
    /// Computes distances of many rays, infinite without a hit: the results of [`Self::cast`] for
    /// each, with any number of `threads`. Neighbours with a common origin are traced together, so
    /// pass the rays of scans and images in order. Small batches are traced on the calling thread.
    ///
    /// For level rays, as of 2D scans, the world keeps up to eight trees over the fixed triangles at
    /// their heights, built on the first large batch; [`Self::size_bytes`] counts them.
    ///
    /// # Panics
    /// When `distances_m` and `rays` differ in length.
    pub fn cast_batch(
        &self,
        rays: &[Ray],
        filter: Filter,
        threads: usize,
        distances_m: &mut [f32],
    ) {
        self.cast_grid(rays, rays.len(), filter, threads, distances_m);
    }

    /// [`Self::cast_batch`] for rays in rows of `columns`, like the pixels of an image or the beams
    /// of a lidar, where rays of adjacent rows are neighbours as well.
    ///
    /// # Panics
    /// When `distances_m` and `rays` differ in length.
    pub fn cast_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        distances_m: &mut [f32],
    ) {
        for_each_chunk(rays, columns, threads, distances_m, |rays, columns, distances_m| {
            #[expect(clippy::cast_possible_truncation, reason = "single precision is asked for")]
            self.trace_many(rays, columns, filter, |index: usize, found: &NearestHit| {
                distances_m[index] =
                    if found.is_hit() { found.distance as f32 } else { f32::INFINITY };
            });
        });
    }

    /// Computes the results of [`Self::cast`] for each of many rays in rows of `columns`.
    ///
    /// # Panics
    /// When `hits` and `rays` differ in length.
    pub fn hits_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        hits: &mut [Option<Hit>],
    ) {
        for_each_chunk(rays, columns, threads, hits, |rays, columns, hits| {
            // Neighbours mostly hit the same face.
            let mut last = (NearestHit::nothing(0.0), None);
            self.trace_many(rays, columns, filter, |index: usize, found: &NearestHit| {
                let ray = &rays[index];
                hits[index] = found.is_hit().then(|| {
                    if !last.0.is_same_face(found) {
                        last = (*found, self.flat_normal(found));
                    }
                    let normal = last.1.unwrap_or_else(|| self.round_normal(ray, found));
                    hit_of(ray, found, normal)
                });
            });
        });
    }

    /// Traces rays in rows of `columns` and reports the nearest hit of each. Level rays in one row are
    /// traced through the triangles of their slab, where there is a tree for it.
    fn trace_many(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        mut report: impl FnMut(usize, &NearestHit),
    ) {
        let (world, fixed) = (self, &self.fixed);
        let limits = LevelLimits::new(fixed).filter(|_| columns >= rays.len());
        let Some(limits) = limits else {
            dispatch(Many { world, fixed, rays, first: 0, columns, filter, report: &mut report });
            return;
        };
        let (mut first, mut end) = (0, 0);
        let mut current: Option<Arc<TriangleMesh>> = None;
        while end < rays.len() {
            let slab = limits.slab_of(&rays[end]);
            let block = &rays[end..rays.len().min(end + LEVEL_BLOCK_RAYS)];
            let count = limits.run_length(block, slab);
            let next = slab.and_then(|slab| self.level.tree(fixed, slab, count));
            let changed = next.as_ref().map(Arc::as_ptr) != current.as_ref().map(Arc::as_ptr);
            if changed || end - first >= LEVEL_BLOCK_RAYS {
                let (rays, fixed) = (&rays[first..end], current.as_deref().unwrap_or(fixed));
                let columns = rays.len().max(1);
                dispatch(Many { world, fixed, rays, first, columns, filter, report: &mut report });
                (first, current) = (end, next);
            }
            end += count;
        }
        let (rays, fixed) = (&rays[first..end], current.as_deref().unwrap_or(fixed));
        let columns = rays.len().max(1);
        dispatch(Many { world, fixed, rays, first, columns, filter, report: &mut report });
    }
}

struct Many<'a, F> {
    world: &'a RaycastWorld,
    /// The fixed triangles that these rays can meet.
    fixed: &'a TriangleMesh,
    rays: &'a [Ray],
    /// Index of the first of these rays among those that are reported.
    first: usize,
    columns: usize,
    filter: Filter,
    report: &'a mut F,
}

/// Rays traced through the fixed triangles interleaved, then through the instances one after the
/// other.
struct InterleavedRays<'a, 'b, V, F> {
    many: &'a mut Many<'b, F>,
    slots: Drain<'a, usize>,
    scratch: &'a mut Scratch,
    vectors: PhantomData<V>,
}

impl<V: V8, F: FnMut(usize, &NearestHit)> RayQueue for InterleavedRays<'_, '_, V, F> {
    type Ticket = (usize, NearestHit);

    #[inline(always)]
    fn fill(&mut self, queued: &mut QueuedRays<Self::Ticket>) {
        let (world, rays) = (self.many.world, self.many.rays);
        queued.count = 0;
        let Some(mut own) = rays.first().map(|ray| [ray; 8]) else { return };
        let (mut min, mut max) = (Row([0.0; 8]), Row([0.0; 8]));
        while queued.count < 8 {
            let Some(index) = self.slots.next() else { break };
            let ray = &rays[index];
            let mut found = NearestHit::nothing(ray.max_m);
            if !ray.is_sound() {
                (self.many.report)(self.many.first + index, &found);
                continue;
            }
            world.find_endless(ray, self.many.filter, &mut found);
            let lane = queued.count;
            if lane == 0 {
                own = [ray; 8];
            }
            own[lane] = ray;
            min.0[lane] = to_f32(ray.min_m);
            max.0[lane] = single_above(found.distance);
            queued.tickets[lane] = (index, found);
            queued.count += 1;
        }
        if queued.count > 0 {
            let [a, b, c, d, e, f, g, h] = own;
            let origins = [
                &a.origin_m,
                &b.origin_m,
                &c.origin_m,
                &d.origin_m,
                &e.origin_m,
                &f.origin_m,
                &g.origin_m,
                &h.origin_m,
            ];
            let fixed = self.many.fixed;
            let range = (min, max);
            queued.block.prepare::<V>(
                origins,
                directions(own),
                range,
                fixed.middle_m,
                fixed.extent,
            );
        }
    }

    #[inline(always)]
    fn done(&mut self, (index, mut found): Self::Ticket, nearest: Nearest) {
        let (world, rays, filter) = (self.many.world, self.many.rays, self.many.filter);
        world.keep_fixed(nearest, &mut found);
        if world.has_instances() {
            let (ray, scratch) = (&rays[index], &mut *self.scratch);
            V::run(FindInstances { world, ray, filter, found: &mut found, scratch });
        }
        (self.many.report)(self.many.first + index, &found);
    }
}

/// Task of [`Many::trace_interleaved`].
struct TraceInterleaved<'a, 'b, F> {
    many: &'a mut Many<'b, F>,
    slots: Drain<'a, usize>,
    scratch: &'a mut Scratch,
}

impl<F: FnMut(usize, &NearestHit)> Task for TraceInterleaved<'_, '_, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let Self { many, slots, scratch } = self;
        let (fixed, vectors) = (many.fixed, PhantomData);
        let flat = !std::ptr::eq(fixed, &raw const many.world.fixed);
        let mut rays = InterleavedRays::<V, _> { many, slots, scratch, vectors };
        if flat {
            fixed.trace_interleaved::<V, _, true>(&mut rays);
        } else {
            fixed.trace_interleaved::<V, _, false>(&mut rays);
        }
    }
}

impl<F: FnMut(usize, &NearestHit)> Task for Many<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(mut self) {
        let columns = self.columns;
        let rows = self.rays.len().div_ceil(columns);
        let (tile, band) = if rows > 1 { (TILE_4X2, BAND_ROWS) } else { (TILE_8X1, 1) };
        let mut work = Work {
            spread: self.max_spread(),
            together: self.world.sees_all_fixed(self.filter),
            group: PacketGroup::new(),
            loose: Vec::new(),
            scratch: Scratch::new(),
        };
        for first in (0..rows).step_by(band) {
            for left in (0..columns).step_by(tile.columns) {
                for top in (first..(first + band).min(rows)).step_by(tile.rows) {
                    let mut picked = [0_usize; 8];
                    let mut count = 0;
                    for row in top..(top + tile.rows).min(rows) {
                        for column in left..(left + tile.columns).min(columns) {
                            let index = row * columns + column;
                            if index < self.rays.len() {
                                picked[count & 7] = index;
                                count += 1;
                            }
                        }
                    }
                    self.add::<V>(&picked[..count.min(8)], &mut work);
                }
            }
        }
        self.trace_group::<V>(&mut work.group, &mut work.scratch);
        self.trace_interleaved::<V>(&mut work.loose, &mut work.scratch);
    }
}

/// Rays that are collected to be traced together.
struct Work {
    spread: SlopeSpread,
    /// True if every fixed triangle is visible to the rays; otherwise each ray is traced alone.
    together: bool,
    group: PacketGroup,
    loose: Vec<usize>,
    scratch: Scratch,
}

impl<F: FnMut(usize, &NearestHit)> Many<'_, F> {
    fn max_spread(&self) -> SlopeSpread {
        let level = !std::ptr::eq(self.fixed, &raw const self.world.fixed);
        let max_blocks = if level { MAX_LEVEL_PACKET_BLOCK_COUNT } else { LARGE_MESH_BLOCKS };
        if self.fixed.blocks.len() > max_blocks { MAX_SPREAD_IN_LARGE_MESH } else { MAX_SPREAD }
    }

    /// Adds up to eight neighbours, as a packet or two if they fit together.
    #[inline(always)]
    fn add<V: V8>(&mut self, picked: &[usize], work: &mut Work) {
        if !work.together {
            for &index in picked {
                self.trace_single::<V>(index, &mut work.scratch);
            }
            return;
        }
        let Work { spread, group, loose, scratch, .. } = work;
        let mut rest = picked;
        if self.may_fit(picked, spread.packet) {
            // A packet has one dominant axis: neighbours on both sides of a diagonal are two packets.
            let turn = self.same_axis(picked);
            let (one, other) = picked.split_at(turn);
            if self.add_to_group::<V>(one, *spread, group, scratch) {
                rest = other;
                if self.add_to_group::<V>(other, *spread, group, scratch) {
                    return;
                }
            }
        }
        loose.extend_from_slice(rest);
        if loose.len() >= MAX_PENDING_RAYS {
            self.trace_interleaved::<V>(loose, scratch);
        }
    }

    /// Returns false if rays cannot be in a packet with this spread of slopes. Scattered rays and sparse
    /// fans are distinguished by the first and the last: a difference of slopes is not less than the sine
    /// of the angle between two rays.
    #[inline(always)]
    fn may_fit(&self, picked: &[usize], spread: f32) -> bool {
        let (Some(&first), Some(&last)) = (picked.first(), picked.last()) else { return false };
        let (first, last) = (&self.rays[first], &self.rays[last]);
        let (a, b) = (first.direction, last.direction);
        let sine_squared = a.cross(b).length_squared();
        let max = f64::from(spread) * f64::from(spread) * 1.001;
        (first.origin_m == last.origin_m)
            & (sine_squared <= max * (a.length_squared() * b.length_squared()))
    }

    /// Returns the number of rays, from the first on, with the dominant axis and the sign of the first.
    #[inline(always)]
    fn same_axis(&self, picked: &[usize]) -> usize {
        let key = |&index: &usize| {
            let d = self.rays[index].direction;
            let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
            let (wide, long, high) = (x > y, x > z, y > z);
            let x_axis = wide & long;
            let y_axis = !wide & high;
            let back = if x_axis {
                d.x
            } else if y_axis {
                d.y
            } else {
                d.z
            } < 0.0;
            u8::from(x_axis) | u8::from(y_axis) << 1 | u8::from(back) << 2
        };
        let (Some(first), Some(last)) = (picked.first(), picked.last()) else { return 0 };
        let first = key(first);
        if key(last) == first {
            return picked.len();
        }
        picked.iter().position(|index| key(index) != first).unwrap_or(picked.len())
    }

    /// Adds neighbours to the group as a packet; traces the group first if the packet does not fit.
    /// Returns false, without effect, when the rays cannot form a packet.
    #[inline(always)]
    fn add_to_group<V: V8>(
        &mut self,
        picked: &[usize],
        widest: SlopeSpread,
        group: &mut PacketGroup,
        scratch: &mut Scratch,
    ) -> bool {
        if picked.len() < 2 {
            return picked.is_empty();
        }
        let Some((packet, member)) = self.world.packet_of::<V>(self.rays, picked) else {
            return false;
        };
        if packet.pyramid.spread() > widest.packet {
            return false;
        }
        if !group.fits(&packet, widest.group) {
            self.trace_group::<V>(group, scratch);
        }
        group.push(packet, member);
        true
    }

    #[inline(always)]
    fn trace_group<V: V8>(&mut self, group: &mut PacketGroup, scratch: &mut Scratch) {
        let Self { world, fixed, rays, filter, .. } = *self;
        V::run(TraceGroup { group, world, fixed, rays, filter, scratch });
        group.report(self.first, self.report);
    }

    /// Traces and clears rays that could not form a packet.
    #[inline(always)]
    fn trace_interleaved<V: V8>(&mut self, loose: &mut Vec<usize>, scratch: &mut Scratch) {
        if loose.len() < MIN_INTERLEAVED_RAYS {
            for index in loose.drain(..) {
                self.trace_single::<V>(index, scratch);
            }
            return;
        }
        let task = TraceInterleaved { many: self, slots: loose.drain(..), scratch };
        V::run_with_most_registers(task);
    }

    #[inline(always)]
    fn trace_single<V: V8>(&mut self, index: usize, scratch: &mut Scratch) {
        let (world, ray, filter) = (self.world, &self.rays[index], self.filter);
        let found = V::run(Find::<false> { world, ray, filter, scratch });
        (self.report)(self.first + index, &found);
    }
}
