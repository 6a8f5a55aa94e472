//! Many rays at a time.

use super::lanes::Lanes;
use super::order::Loose;
use super::query::{Found, Scratch, hit_of, single_above};
use super::shares::in_shares;
use super::{Body, Filter, World};
use crate::bvh::leaf_range;
use crate::mesh::{Nearest, TriangleMesh};
use crate::packet::{Frustum, Packet};
use crate::ray::{Hit, Ray};
use crate::simd::{Row, Task, V8, dispatch};
use crate::walk::{Leaves, Stack, Step, walk};

/// Rays farther apart than this (in slope) have little in common, and go one by one.
const WIDEST: f32 = 0.5;
/// The same where triangles are many and a wide pyramid meets far more than its rays do.
const WIDEST_AMONG_MANY: f32 = 0.1;
const MANY_TRIANGLES: usize = 50_000;
/// From here on a tree is so large that rays without order wait for memory most of their time.
const FAR_TOO_MANY: usize = 500_000;

/// How rays are gathered by eights: so many columns, so many rows.
#[derive(Clone, Copy)]
struct Tile {
    columns: usize,
    rows: usize,
}

const LINE: Tile = Tile { columns: 8, rows: 1 };
const PATCH: Tile = Tile { columns: 4, rows: 2 };

impl World {
    /// Distances of many rays, infinite where nothing is: the same that [`Self::cast`] finds for
    /// each, with any number of `threads`. Neighbours of one origin are traced together, so keep
    /// scans and images in order. Few rays stay on this thread.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn cast_many(&self, rays: &[Ray], filter: Filter, threads: usize, distances_m: &mut [f32]) {
        self.cast_grid(rays, rays.len(), filter, threads, distances_m);
    }

    /// [`Self::cast_many`] for rays that lie in rows of `columns`, like the pixels of an image or
    /// the beams of a lidar, where the one below is a neighbour as well.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn cast_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        distances_m: &mut [f32],
    ) {
        in_shares(rays, columns, threads, distances_m, |rays, columns, distances_m| {
            #[expect(clippy::cast_possible_truncation, reason = "single precision is asked for")]
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                give: |index: usize, found: &Found| {
                    distances_m[index] =
                        if found.is_hit() { found.distance as f32 } else { f32::INFINITY };
                },
            });
        });
    }

    /// What [`Self::cast`] finds for each of many rays in rows of `columns`.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn hits_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        hits: &mut [Option<Hit>],
    ) {
        in_shares(rays, columns, threads, hits, |rays, columns, hits| {
            // Neighbours mostly meet the same face.
            let mut last = (Found::nothing(0.0), None);
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                give: |index: usize, found: &Found| {
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
    world: &'a World,
    rays: &'a [Ray],
    columns: usize,
    filter: Filter,
    give: F,
}

impl<F: FnMut(usize, &Found)> Task for Many<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(mut self) {
        let mut scratch = Scratch::new();
        let fixed = &self.world.fixed;
        let mut loose = Loose::new(fixed.low_m, fixed.high_m);
        let sorts = fixed.len() > FAR_TOO_MANY;
        let columns = self.columns;
        let rows = self.rays.len().div_ceil(columns);
        let tile = if rows > 1 { PATCH } else { LINE };
        for top in (0..rows).step_by(tile.rows) {
            for left in (0..columns).step_by(tile.columns) {
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
                if self.packet::<V>(picked, &mut scratch) {
                    continue;
                }
                for &index in picked {
                    match u32::try_from(index) {
                        Ok(place) if sorts => loose.push(place, &self.rays[index]),
                        _ => self.single::<V>(index, &mut scratch),
                    }
                }
                if loose.is_full() {
                    self.singles::<V>(&mut loose, &mut scratch);
                }
            }
        }
        self.singles::<V>(&mut loose, &mut scratch);
    }
}

impl<F: FnMut(usize, &Found)> Many<'_, F> {
    /// False when the rays do not go together; then nothing was done.
    #[inline(always)]
    fn packet<V: V8>(&mut self, picked: &[usize], scratch: &mut Scratch) -> bool {
        let (Some(&start), true) = (picked.first(), picked.len() > 1) else { return false };
        let first = &self.rays[start];
        let mut together = [first; 8];
        let mut common = first.is_sound();
        for (lane, &index) in picked.iter().enumerate() {
            let ray = &self.rays[index];
            together[lane] = ray;
            common &= ray.origin_m == first.origin_m && ray.is_sound();
        }
        if !common {
            return false;
        }
        let rays = &together[..picked.len()];
        let Some(found) = self.world.find_packet::<V>(rays, self.filter, scratch) else {
            return false;
        };
        for (lane, &index) in picked.iter().enumerate() {
            (self.give)(index, &found[lane]);
        }
        true
    }

    #[inline(always)]
    fn singles<V: V8>(&mut self, loose: &mut Loose, scratch: &mut Scratch) {
        for index in loose.sorted() {
            self.single::<V>(index, scratch);
        }
    }

    #[inline(always)]
    fn single<V: V8>(&mut self, index: usize, scratch: &mut Scratch) {
        let found = self.world.find::<V, false>(&self.rays[index], self.filter, scratch);
        (self.give)(index, &found);
    }
}

impl World {
    /// Follows up to eight sound rays of one origin through everything, if they go together.
    #[inline(always)]
    fn find_packet<V: V8>(
        &self,
        rays: &[&Ray],
        filter: Filter,
        scratch: &mut Scratch,
    ) -> Option<[Found; 8]> {
        if !self.sees_all_fixed(filter) {
            return None;
        }
        let first = self.fixed.localize(rays[0].origin_m, rays[0].direction, rays[0].min_m);
        let mut locals = [first; 8];
        for (local, ray) in locals.iter_mut().zip(rays).skip(1) {
            *local = self.fixed.localize(ray.origin_m, ray.direction, ray.min_m);
        }
        let packet = Packet::new(&locals)?;
        let many = self.fixed.len() > MANY_TRIANGLES;
        if packet.spread() > if many { WIDEST_AMONG_MANY } else { WIDEST } {
            return None;
        }
        let lanes = Lanes::new(rays);
        let mut found = lanes.nothing();
        for &number in &self.endless {
            let Lanes { origins_m, directions, min, .. } = &lanes;
            self.find_solid_eight::<V>(number, origins_m, directions, min, filter, &mut found);
        }
        if !self.fixed.is_empty() {
            let mut nearest = start(&found);
            self.fixed.trace_packet::<V>(&packet, &mut nearest, &mut scratch.body);
            for (nearest, found) in nearest.iter().zip(&mut found) {
                self.take_fixed(*nearest, found);
            }
        }
        if !self.resting.nodes.is_empty() || !self.moving.nodes.is_empty() {
            self.find_instances_packet::<V>(rays, &lanes, &packet, filter, &mut found, scratch);
        }
        Some(found)
    }

    /// `packet` is in the frame of the fixed triangles, which is that of the trees over instances.
    #[inline(always)]
    fn find_instances_packet<V: V8>(
        &self,
        rays: &[&Ray],
        lanes: &Lanes,
        packet: &Packet,
        filter: Filter,
        found: &mut [Found; 8],
        scratch: &mut Scratch,
    ) {
        let frustum = Frustum::<V>::new(packet, 0.0);
        let Scratch { top, body } = scratch;
        for tree in [&self.resting, &self.moving] {
            let limit = limit(packet, found, rays.len());
            let mut leaves = InstancesPacket::<V> {
                world: self,
                order: &tree.order,
                rays,
                lanes,
                packet,
                filter,
                found,
                stack: body,
                vectors: std::marker::PhantomData,
            };
            walk(&tree.nodes, &frustum, limit, top, &mut leaves);
        }
    }

    /// False when the rays do not go together in the mesh's frame.
    #[inline(always)]
    fn find_mesh_packet<V: V8>(
        &self,
        mesh: &TriangleMesh,
        number: u32,
        rays: &[&Ray],
        found: &mut [Found; 8],
        stack: &mut Stack,
    ) -> bool {
        let frame = &self.instances[number as usize].world_from_body;
        let origin = frame.point_in_body(rays[0].origin_m);
        let first = mesh.localize(origin, frame.unturn(rays[0].direction), rays[0].min_m);
        let mut locals = [first; 8];
        for (local, ray) in locals.iter_mut().zip(rays).skip(1) {
            *local = mesh.localize(origin, frame.unturn(ray.direction), ray.min_m);
        }
        let Some(packet) = Packet::new(&locals) else { return false };
        let mut nearest = start(found);
        mesh.trace_packet::<V>(&packet, &mut nearest, stack);
        for (nearest, found) in nearest.iter().zip(found) {
            if nearest.id != u32::MAX {
                found.consider(nearest.distance.into(), number, nearest.id);
            }
        }
        true
    }
}

/// The depth within which any of the first `count` rays may still find something.
#[inline(always)]
fn limit(packet: &Packet, found: &[Found; 8], count: usize) -> f32 {
    let mut row = [0.0; 8];
    for (lane, found) in found[..count].iter().enumerate() {
        row[lane] = single_above(found.distance);
    }
    packet.reach(&Row(row), 0.0)
}

/// Eight rays against instances.
struct InstancesPacket<'a, V> {
    world: &'a World,
    order: &'a [u32],
    rays: &'a [&'a Ray],
    lanes: &'a Lanes,
    packet: &'a Packet,
    filter: Filter,
    found: &'a mut [Found; 8],
    stack: &'a mut Stack,
    vectors: std::marker::PhantomData<V>,
}

impl<V: V8> Leaves for InstancesPacket<'_, V> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (first, count) = leaf_range(word);
        for &number in &self.order[first..first + count] {
            let instance = &self.world.instances[number as usize];
            if !self.filter.lets_pass(instance.tags) {
                continue;
            }
            if let Body::Solid(_) = &instance.body {
                let Lanes { origins_m, directions, min, .. } = self.lanes;
                let (filter, found) = (self.filter, &mut *self.found);
                self.world.find_solid_eight::<V>(number, origins_m, directions, min, filter, found);
                continue;
            }
            if let Body::Mesh(mesh) = &instance.body
                && self.world.find_mesh_packet::<V>(mesh, number, self.rays, self.found, self.stack)
            {
                continue;
            }
            for (ray, found) in self.rays.iter().zip(&mut *self.found) {
                self.world.find_instance::<V, false>(number, ray, self.filter, found, self.stack);
            }
        }
        Step::Within(limit(self.packet, self.found, self.rays.len()))
    }
}

/// What is nearest before any triangle is tested.
#[inline(always)]
fn start(found: &[Found; 8]) -> [Nearest; 8] {
    found.map(|found| Nearest { distance: single_above(found.distance), id: u32::MAX })
}
