//! Occlusion queries for many rays, as for shadows.

use std::marker::PhantomData;

use periplus_geometry::DVec3;

use super::lanes::Lanes;
use super::partition::for_each_chunk;
use super::query::{NearestHit, Scratch, single_above};
use super::{Filter, InstanceGeometry, RaycastWorld};
use crate::bvh::leaf_range;
use crate::local_ray::{BoxTest, LocalRay, reach};
use crate::ray::Ray;
use crate::simd::{Task, V8, dispatch};
use crate::traversal::{Leaves, Stack, Step, traverse};

/// Tile of neighbours that form a packet.
const COLUMNS: usize = 4;
const ROWS: usize = 2;

impl RaycastWorld {
    /// Occlusion of each of many rays in rows of `columns`, like the pixels of an image: the result
    /// of [`Self::occluded`] for each, with any number of `threads`. Neighbours with a common
    /// direction, such as shadow rays to the sun, are traced together. A ray with an empty range
    /// costs nothing.
    ///
    /// # Panics
    /// When `occluded` and `rays` differ in length.
    pub fn occluded_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        occluded: &mut [bool],
    ) {
        for_each_chunk(rays, columns, threads, occluded, |rays, columns, occluded| {
            dispatch(Many { world: self, rays, columns, filter, occluded });
        });
    }
}

struct Many<'a> {
    world: &'a RaycastWorld,
    rays: &'a [Ray],
    columns: usize,
    filter: Filter,
    occluded: &'a mut [bool],
}

impl Task for Many<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let Self { world, rays, columns, filter, occluded } = self;
        let mut scratch = Scratch::new();
        let rows = rays.len().div_ceil(columns);
        for top in (0..rows).step_by(ROWS) {
            for left in (0..columns).step_by(COLUMNS) {
                let mut picked = [0_usize; COLUMNS * ROWS];
                let mut count = 0;
                for row in top..(top + ROWS).min(rows) {
                    for column in left..(left + COLUMNS).min(columns) {
                        let index = row * columns + column;
                        if index < rays.len() {
                            occluded[index] = false;
                            if rays[index].is_sound() {
                                picked[count] = index;
                                count += 1;
                            }
                        }
                    }
                }
                let picked = &picked[..count];
                let Some(&first) = picked.first() else { continue };
                let direction = rays[first].direction;
                if picked.iter().all(|&index| rays[index].direction == direction) {
                    world.mark_occluded::<V>(rays, picked, filter, occluded, &mut scratch);
                } else {
                    for &index in picked {
                        let found = world.find::<V, true>(&rays[index], filter, &mut scratch);
                        occluded[index] = found.is_hit();
                    }
                }
            }
        }
    }
}

impl RaycastWorld {
    /// Traces sound rays with a common direction through the whole world.
    #[inline(always)]
    fn mark_occluded<V: V8>(
        &self,
        rays: &[Ray],
        picked: &[usize],
        filter: Filter,
        occluded: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let mut together = [&rays[picked[0]]; COLUMNS * ROWS];
        for (ray, &index) in together.iter_mut().zip(picked) {
            *ray = &rays[index];
        }
        let lanes = Lanes::new(&together[..picked.len()]);
        let mut found = lanes.nothing();
        for &number in &self.endless {
            let Lanes { origins_m, directions, min, .. } = &lanes;
            self.find_solid8::<V>(number, origins_m, directions, min, filter, &mut found);
        }
        if !self.fixed.is_empty() {
            for (ray, found) in together.iter().zip(&mut found).take(picked.len()) {
                if !found.is_hit() {
                    let local = self.fixed.localize(ray.origin_m, ray.direction, ray.min_m);
                    self.find_fixed::<V, true>(&local, filter, found, &mut scratch.body);
                }
            }
        }
        let rays = &together[..picked.len()];
        self.mark_occluded_by_instances::<V>(rays, &lanes, filter, &mut found, scratch);
        for (found, &index) in found.iter().zip(picked) {
            occluded[index] = found.is_hit();
        }
    }

    #[inline(always)]
    fn mark_occluded_by_instances<V: V8>(
        &self,
        rays: &[&Ray],
        lanes: &Lanes,
        filter: Filter,
        found: &mut [NearestHit; 8],
        scratch: &mut Scratch,
    ) {
        if self.resting.nodes.is_empty() && self.moving.nodes.is_empty() {
            return;
        }
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut min, mut max) = (f64::INFINITY, 0.0_f64);
        for (ray, found) in rays.iter().zip(&*found) {
            if !found.is_hit() {
                (low, high) = (low.min(ray.origin_m), high.max(ray.origin_m));
                (min, max) = (min.min(ray.min_m), max.max(ray.max_m));
            }
        }
        if low.x > high.x {
            return;
        }
        let middle = (low + high) / 2.0;
        let off = (high - middle).max(middle - low);
        let local = LocalRay::new(middle - self.middle_m, rays[0].direction, min);
        let boxes = BoxTest::<V>::new(&local, 0.0).around(off);
        let Scratch { top, body, .. } = scratch;
        let mut leaves = OcclusionLeaves::<V> {
            world: self,
            order: &[],
            rays,
            lanes,
            filter,
            found,
            stack: body,
            vectors: PhantomData,
        };
        for tree in [&self.resting, &self.moving] {
            leaves.order = &tree.order;
            traverse(&tree.nodes, &boxes, reach(single_above(max), 0.0), top, &mut leaves);
        }
    }
}

/// Rays of one direction against instances, until all are occluded.
struct OcclusionLeaves<'a, V> {
    world: &'a RaycastWorld,
    order: &'a [u32],
    rays: &'a [&'a Ray],
    lanes: &'a Lanes,
    filter: Filter,
    found: &'a mut [NearestHit; 8],
    stack: &'a mut Stack,
    vectors: PhantomData<V>,
}

impl<V: V8> Leaves for OcclusionLeaves<'_, V> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (first, count) = leaf_range(word);
        let (world, filter) = (self.world, self.filter);
        for &number in &self.order[first..first + count] {
            if let InstanceGeometry::Solid(_) = &world.instances[number as usize].body {
                let Lanes { origins_m, directions, min, .. } = self.lanes;
                world.find_solid8::<V>(number, origins_m, directions, min, filter, self.found);
                continue;
            }
            for (ray, found) in self.rays.iter().zip(&mut *self.found) {
                if !found.is_hit() {
                    world.find_instance::<V, true>(number, ray, filter, found, self.stack);
                }
            }
        }
        let mut lit = false;
        for found in &self.found[..self.rays.len()] {
            lit |= !found.is_hit();
        }
        if lit { Step::On } else { Step::Stop }
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{DVec3, Pose};
    use proptest::prelude::*;

    use crate::{Filter, Ray, RaycastShape, RaycastWorld, Tags};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Batched and single rays give the same occlusion.
        #[test]
        fn rays_of_one_direction_are_as_dark_as_each(
            boxes in prop::collection::vec((prop::array::uniform3(-4.0..4.0), 0.1..2.0), 1..30),
            moved in 0_usize..30,
            towards in prop::array::uniform3(-1.0..1.0),
            step in 0.01..0.5,
            flat in any::<bool>(),
        ) {
            let mut builder = RaycastWorld::builder();
            let mut ids = Vec::new();
            for &(at, size) in &boxes {
                let shape = RaycastShape::Box { size_m: DVec3::new(size, 1.0, 0.5) };
                let [x, y, z] = at;
                ids.push(builder.add_shape(&shape, &Pose::from_xyz(x, y, z), Tags::default()).unwrap());
            }
            let mut world = builder.build(1).unwrap();
            if let Some(&id) = ids.get(moved) {
                world.move_to(&[(id, Pose::from_xyz(0.5, 0.5, 0.5))]).unwrap();
            }
            let direction = if flat { DVec3::Z } else { DVec3::from_array(towards) };
            prop_assume!(direction.length() > 0.01);
            let rays: Vec<Ray> = (0..200)
                .map(|n| {
                    let (column, row) = (f64::from(n % 20), f64::from(n / 20));
                    let origin = DVec3::new((column - 10.0) * step, (row - 5.0) * step, -1.0);
                    let max_m = if n % 7 == 0 { -1.0 } else { 2.0 + row };
                    Ray { max_m, ..Ray::new(origin, direction) }
                })
                .collect();
            let mut occluded = vec![true; rays.len()];
            world.occluded_grid(&rays, 20, Filter::default(), 1, &mut occluded);
            let alone: Vec<bool> =
                rays.iter().map(|ray| world.occluded(ray, Filter::default())).collect();
            prop_assert_eq!(occluded, alone);
        }
    }
}
