//! Batches of rays.

use std::marker::PhantomData;
use std::vec::Drain;

use super::packet_group::{PacketGroup, TraceGroup};
use super::partition::for_each_chunk;
use super::query::{Find, FindInstances, NearestHit, Scratch, hit_of, single_above};
use super::{Filter, RaycastWorld};
use crate::local_ray::LocalRay;
use crate::mesh::{Nearest, RayQueue};
use crate::ray::{Hit, Ray};
use crate::simd::{Task, V8, dispatch};

/// Trees with more triangles exceed the nearest caches, and a wide pyramid meets far more triangles
/// than its rays do.
const LARGE_MESH_TRIANGLES: usize = 50_000;
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

const MAX_SPREAD: SlopeSpread = SlopeSpread { packet: 0.5, group: 0.2 };
const MAX_SPREAD_IN_LARGE_MESH: SlopeSpread = SlopeSpread { packet: 0.1, group: 0.03 };

/// Tile of neighbours that form a packet.
#[derive(Clone, Copy)]
struct Tile {
    columns: usize,
    rows: usize,
}

/// Number of image rows that can share a group.
pub(super) const BAND_ROWS: usize = 4;

const CACHE_LINE_BYTES: Tile = Tile { columns: 8, rows: 1 };
const TILE_4X2: Tile = Tile { columns: 4, rows: 2 };

impl RaycastWorld {
    /// Computes distances of many rays, infinite without a hit: the results of [`Self::cast`] for
    /// each, with any number of `threads`. Neighbours with a common origin are traced together, so
    /// pass the rays of scans and images in order. Small batches are traced on the calling thread.
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
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                report: |index: usize, found: &NearestHit| {
                    distances_m[index] =
                        if found.is_hit() { found.distance as f32 } else { f32::INFINITY };
                },
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
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                report: |index: usize, found: &NearestHit| {
                    let ray = &rays[index];
                    hits[index] = found.is_hit().then(|| {
                        if !last.0.is_same_face(found) {
                            last = (*found, self.flat_normal(found));
                        }
                        let normal = last.1.unwrap_or_else(|| self.round_normal(ray, found));
                        hit_of(ray, found, normal)
                    });
                },
            });
        });
    }
}

struct Many<'a, F> {
    world: &'a RaycastWorld,
    rays: &'a [Ray],
    columns: usize,
    filter: Filter,
    report: F,
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
    fn next(&mut self) -> Option<(Self::Ticket, LocalRay, f32)> {
        let world = self.many.world;
        for index in self.slots.by_ref() {
            let ray = &self.many.rays[index];
            let mut found = NearestHit::nothing(ray.max_m);
            if !ray.is_sound() {
                (self.many.report)(index, &found);
                continue;
            }
            world.find_endless(ray, self.many.filter, &mut found);
            let local = world.fixed.localize(ray.origin_m, ray.direction, ray.min_m);
            return Some(((index, found), local, single_above(found.distance)));
        }
        None
    }

    #[inline(always)]
    fn done(&mut self, (index, mut found): Self::Ticket, nearest: Nearest) {
        let (world, rays, filter) = (self.many.world, self.many.rays, self.many.filter);
        world.keep_fixed(nearest, &mut found);
        if world.has_instances() {
            let (ray, scratch) = (&rays[index], &mut *self.scratch);
            V::run(FindInstances { world, ray, filter, found: &mut found, scratch });
        }
        (self.many.report)(index, &found);
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
        let (world, vectors) = (many.world, PhantomData);
        let mut rays = InterleavedRays::<V, _> { many, slots, scratch, vectors };
        world.fixed.trace_interleaved::<V, _>(&mut rays);
    }
}

impl<F: FnMut(usize, &NearestHit)> Task for Many<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(mut self) {
        let mut scratch = Scratch::new();
        let mut group = PacketGroup::new();
        let mut loose = Vec::new();
        let many = self.world.fixed.len() > LARGE_MESH_TRIANGLES;
        let widest = if many { MAX_SPREAD_IN_LARGE_MESH } else { MAX_SPREAD };
        let together = self.world.sees_all_fixed(self.filter);
        let columns = self.columns;
        let rows = self.rays.len().div_ceil(columns);
        let (tile, band) = if rows > 1 { (TILE_4X2, BAND_ROWS) } else { (CACHE_LINE_BYTES, 1) };
        let corners = (0..rows).step_by(band).flat_map(|first| {
            (0..columns).step_by(tile.columns).flat_map(move |left| {
                (first..(first + band).min(rows)).step_by(tile.rows).map(move |top| (top, left))
            })
        });
        for (top, left) in corners {
            let mut picked = [0_usize; 8];
            let mut count = 0;
            for row in top..(top + tile.rows).min(rows) {
                for column in left..(left + tile.columns).min(columns) {
                    let index = row * columns + column;
                    if index < self.rays.len() {
                        picked[count] = index;
                        count += 1;
                    }
                }
            }
            let picked = &picked[..count];
            if together && self.add_to_group::<V>(picked, widest, &mut group, &mut scratch) {
                continue;
            }
            if together {
                loose.extend_from_slice(picked);
            } else {
                for &index in picked {
                    self.trace_single::<V>(index, &mut scratch);
                }
            }
            if loose.len() >= MAX_PENDING_RAYS {
                self.trace_interleaved::<V>(&mut loose, &mut scratch);
            }
        }
        self.trace_group::<V>(&mut group, &mut scratch);
        self.trace_interleaved::<V>(&mut loose, &mut scratch);
    }
}

impl<F: FnMut(usize, &NearestHit)> Many<'_, F> {
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
            return false;
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
        let (world, rays, filter) = (self.world, self.rays, self.filter);
        V::run(TraceGroup { group, world, rays, filter, scratch });
        group.report(&mut self.report);
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
        V::run(TraceInterleaved { many: self, slots: loose.drain(..), scratch });
    }

    #[inline(always)]
    fn trace_single<V: V8>(&mut self, index: usize, scratch: &mut Scratch) {
        let (world, ray, filter) = (self.world, &self.rays[index], self.filter);
        let found = V::run(Find::<false> { world, ray, filter, scratch });
        (self.report)(index, &found);
    }
}
