//! Queries with single rays.

use periplus_geometry::DVec3;

use super::{Filter, Frame, Instance, InstanceGeometry, RaycastWorld};
use crate::bvh::{MAX_STACK_ENTRIES, leaf_range};
use crate::local_ray::{BoxTest, LocalRay, reach};
use crate::mesh::{GroupStack, Nearest};
use crate::ray::{Hit, InstanceId, Ray};
use crate::simd::{Task, V8, dispatch};
use crate::simd8::DVec3x8;
use crate::traversal::{Leaves, Stack, Step, traverse};

/// Nearest hit so far; without a hit (`instance` is `u32::MAX`) `distance` is the maximum distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct NearestHit {
    pub(super) distance: f64,
    pub(super) instance: u32,
    pub(super) primitive: u32,
}

impl NearestHit {
    #[inline(always)]
    pub(super) fn nothing(max: f64) -> Self {
        Self { distance: max, instance: u32::MAX, primitive: u32::MAX }
    }

    #[inline(always)]
    pub(super) fn is_hit(&self) -> bool {
        self.instance != u32::MAX
    }

    pub(super) fn is_same_face(&self, other: &Self) -> bool {
        (self.instance, self.primitive) == (other.instance, other.primitive)
    }

    /// Keeps the nearer hit; at equal distance the one with the lower numbers.
    #[inline(always)]
    pub(super) fn consider(&mut self, distance: f64, instance: u32, primitive: u32) {
        let numbers = (instance, primitive) < (self.instance, self.primitive);
        if distance < self.distance || distance == self.distance && numbers {
            *self = Self { distance, instance, primitive };
        }
    }
}

/// Stacks for the traversal of both levels.
pub(super) struct Scratch {
    pub(super) top: Stack,
    pub(super) body: Stack,
    pub(super) group: GroupStack,
}

impl Scratch {
    pub(super) fn new() -> Self {
        Self { top: [0; MAX_STACK_ENTRIES], body: [0; MAX_STACK_ENTRIES], group: GroupStack::EMPTY }
    }
}

/// Returns the smallest f32 that is not below a distance.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "rounded up when it was rounded down")]
pub(super) fn single_above(distance: f64) -> f32 {
    let to_f32 = distance as f32;
    // `f32::next_up` without its branches: comparisons with NaN are false, and no value below -0.0
    // rounds to it.
    let bits = to_f32.to_bits();
    let above = if to_f32 < 0.0 { bits.wrapping_sub(1) } else { bits.wrapping_add(1) };
    f32::from_bits(if f64::from(to_f32) < distance { above } else { bits })
}

/// Returns the minimum distance as stored in a ray of a tree's frame.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
pub(super) fn to_f32(min_m: f64) -> f32 {
    min_m.max(0.0) as f32
}

#[inline(always)]
pub(super) fn directions([a, b, c, d, e, f, g, h]: [&Ray; 8]) -> [&DVec3; 8] {
    [
        &a.direction,
        &b.direction,
        &c.direction,
        &d.direction,
        &e.direction,
        &f.direction,
        &g.direction,
        &h.direction,
    ]
}

/// `normal` points outwards.
#[inline(always)]
pub(super) fn hit_of(ray: &Ray, found: &NearestHit, normal: DVec3) -> Hit {
    Hit {
        distance_m: found.distance,
        normal: if normal.dot(ray.direction) > 0.0 { -normal } else { normal },
        instance: InstanceId(found.instance),
        primitive: found.primitive,
    }
}

impl RaycastWorld {
    /// Returns the first hit of a ray.
    #[must_use]
    pub fn cast(&self, ray: &Ray, filter: Filter) -> Option<Hit> {
        let found =
            dispatch(Find::<false> { world: self, ray, filter, scratch: &mut Scratch::new() });
        found.is_hit().then(|| self.hit(ray, &found))
    }

    /// Returns true if anything is on a ray; cheaper than [`Self::cast`].
    #[must_use]
    pub fn occluded(&self, ray: &Ray, filter: Filter) -> bool {
        let scratch = &mut Scratch::new();
        dispatch(Find::<true> { world: self, ray, filter, scratch }).is_hit()
    }

    /// Returns the full hit.
    pub(super) fn hit(&self, ray: &Ray, found: &NearestHit) -> Hit {
        let normal = self.flat_normal(found).unwrap_or_else(|| self.round_normal(ray, found));
        hit_of(ray, found, normal)
    }

    /// Returns the outward normal of a flat face; `None` for a curved one.
    pub(super) fn flat_normal(&self, found: &NearestHit) -> Option<DVec3> {
        let instance = &self.instances[found.instance as usize];
        let normal = match &instance.body {
            InstanceGeometry::Fixed => {
                let part = self.parts.partition_point(|part| part.instance < found.instance);
                return Some(self.fixed.normal(self.parts[part].first + found.primitive));
            }
            InstanceGeometry::Solid(solid) => solid.flat_normal(found.primitive)?,
            InstanceGeometry::Mesh(mesh) => mesh.normal(found.primitive),
            InstanceGeometry::Heights(heights) => heights.normal(found.primitive),
        };
        Some(instance.world_from_body.rotate_into_world(normal))
    }

    /// Returns the outward normal at a hit on a curved face.
    pub(super) fn round_normal(&self, ray: &Ray, found: &NearestHit) -> DVec3 {
        let Instance { body: InstanceGeometry::Solid(solid), world_from_body, .. } =
            &self.instances[found.instance as usize]
        else {
            return -ray.direction;
        };
        let point = world_from_body.point_in_body(ray.at(found.distance));
        world_from_body.rotate_into_world(solid.normal(point, found.primitive))
    }

    /// Returns true if there are bounded instances besides the fixed triangles.
    #[inline(always)]
    pub(super) fn has_instances(&self) -> bool {
        !self.resting.nodes.is_empty() || !self.moving.nodes.is_empty()
    }

    /// Returns true if the filter accepts every fixed triangle.
    pub(super) fn sees_all_fixed(&self, filter: Filter) -> bool {
        (self.parts.is_empty() || self.parts_mask & filter.mask != 0)
            && (filter.except_group == 0
                || self.parts_groups.binary_search(&filter.except_group).is_err())
    }

    /// Returns the instance of a fixed triangle and the triangle's index in it.
    #[inline]
    pub(super) fn part_of(&self, triangle: u32) -> (u32, u32) {
        if let [part] = &*self.parts {
            return (part.instance, triangle - part.first);
        }
        let after = self.parts.partition_point(|part| part.first <= triangle);
        let part = self.parts[after - 1];
        (part.instance, triangle - part.first)
    }

    /// Traces one ray through the whole world.
    #[inline(always)]
    pub(super) fn find<V: V8, const ANY: bool>(
        &self,
        ray: &Ray,
        filter: Filter,
        scratch: &mut Scratch,
    ) -> NearestHit {
        let mut found = NearestHit::nothing(ray.max_m);
        if !ray.is_sound() {
            return found;
        }
        self.find_endless(ray, filter, &mut found);
        if ANY && found.is_hit() {
            return found;
        }
        if !self.fixed.is_empty() {
            let local = self.fixed.localize(ray.origin_m, ray.direction, ray.min_m);
            self.find_fixed::<V, ANY>(&local, filter, &mut found, &mut scratch.body);
            if ANY && found.is_hit() {
                return found;
            }
        }
        self.find_instances::<V, ANY>(ray, filter, &mut found, scratch);
        found
    }

    #[inline(always)]
    pub(super) fn find_endless(&self, ray: &Ray, filter: Filter, found: &mut NearestHit) {
        for &number in &self.endless {
            self.find_solid(number, ray, filter, found);
        }
    }

    #[inline(always)]
    fn find_solid(&self, number: u32, ray: &Ray, filter: Filter, found: &mut NearestHit) {
        let Instance { body: InstanceGeometry::Solid(solid), tags, world_from_body, .. } =
            &self.instances[number as usize]
        else {
            return;
        };
        if !filter.accepts(*tags) {
            return;
        }
        let origin = world_from_body.point_in_body(ray.origin_m);
        let direction = world_from_body.rotate_into_body(ray.direction);
        let min = ray.min_m.max(0.0);
        if let Some((distance, face)) = solid.cast(origin, direction, min, found.distance) {
            found.consider(distance, number, face);
        }
    }

    /// Tests eight rays against one shape and keeps the nearest hits.
    #[inline(always)]
    pub(super) fn find_solid8<V: V8>(
        &self,
        number: u32,
        origins_m: &DVec3x8,
        directions: &DVec3x8,
        min: &[f64; 8],
        filter: Filter,
        found: &mut [NearestHit; 8],
    ) {
        let Instance { body: InstanceGeometry::Solid(solid), tags, world_from_body, .. } =
            &self.instances[number as usize]
        else {
            return;
        };
        if !filter.accepts(*tags) {
            return;
        }
        let Frame { translation, columns } = world_from_body;
        let origins = origins_m.into_frame::<V>(*translation, columns);
        let directions = directions.into_frame::<V>(DVec3::ZERO, columns);
        let mut max = [0.0; 8];
        for (max, found) in max.iter_mut().zip(&*found) {
            *max = found.distance;
        }
        let met = solid.cast8::<V>(&origins, &directions, min, &max);
        for (lane, found) in found.iter_mut().enumerate() {
            // A NaN distance is never nearer.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 5")]
            found.consider(met.distance[lane], number, met.face[lane] as u32);
        }
    }

    #[inline(always)]
    pub(super) fn find_fixed<V: V8, const ANY: bool>(
        &self,
        local: &LocalRay,
        filter: Filter,
        found: &mut NearestHit,
        stack: &mut Stack,
    ) {
        let mut nearest = Nearest { distance: single_above(found.distance), id: u32::MAX };
        if self.sees_all_fixed(filter) {
            self.fixed.trace::<V, ANY>(local, &mut nearest, stack, |_| true);
        } else {
            let accept = |id: u32| filter.accepts(self.instances[self.part_of(id).0 as usize].tags);
            self.fixed.trace::<V, ANY>(local, &mut nearest, stack, accept);
        }
        self.keep_fixed(nearest, found);
    }

    #[inline(always)]
    pub(super) fn keep_fixed(&self, nearest: Nearest, found: &mut NearestHit) {
        if nearest.id != u32::MAX {
            let (instance, primitive) = self.part_of(nearest.id);
            found.consider(nearest.distance.into(), instance, primitive);
        }
    }

    #[inline(always)]
    pub(super) fn find_instances<V: V8, const ANY: bool>(
        &self,
        ray: &Ray,
        filter: Filter,
        found: &mut NearestHit,
        scratch: &mut Scratch,
    ) {
        if !self.has_instances() {
            return;
        }
        let local = LocalRay::new(ray.origin_m - self.middle_m, ray.direction, ray.min_m);
        // The margins of the boxes cover the error of an instance's frame.
        let boxes = BoxTest::<V>::new(&local, 0.0);
        let Scratch { top, body, .. } = scratch;
        for tree in [&self.resting, &self.moving] {
            let limit = reach(single_above(found.distance), 0.0);
            let mut leaves = InstanceLeaves::<V, ANY> {
                world: self,
                order: &tree.order,
                ray,
                filter,
                found,
                stack: body,
                vectors: std::marker::PhantomData,
            };
            traverse(&tree.nodes, &boxes, limit, top, &mut leaves);
            if ANY && found.is_hit() {
                return;
            }
        }
    }

    #[inline(always)]
    pub(super) fn find_instance<V: V8, const ANY: bool>(
        &self,
        number: u32,
        ray: &Ray,
        filter: Filter,
        found: &mut NearestHit,
        stack: &mut Stack,
    ) {
        let instance = &self.instances[number as usize];
        if !filter.accepts(instance.tags) {
            return;
        }
        let frame = &instance.world_from_body;
        let body = |v: DVec3| frame.point_in_body(v);
        match &instance.body {
            InstanceGeometry::Fixed => {}
            InstanceGeometry::Solid(_) => self.find_solid(number, ray, filter, found),
            InstanceGeometry::Mesh(mesh) => {
                let direction = frame.rotate_into_body(ray.direction);
                let local = mesh.localize(body(ray.origin_m), direction, ray.min_m);
                let mut nearest = Nearest { distance: single_above(found.distance), id: u32::MAX };
                mesh.trace::<V, ANY>(&local, &mut nearest, stack, |_| true);
                if nearest.id != u32::MAX {
                    found.consider(nearest.distance.into(), number, nearest.id);
                }
            }
            InstanceGeometry::Heights(heights) => {
                let (origin, direction) =
                    (body(ray.origin_m), frame.rotate_into_body(ray.direction));
                let min = ray.min_m.max(0.0);
                if let Some((distance, primitive)) =
                    heights.cast(origin, direction, min, found.distance)
                {
                    found.consider(distance, number, primitive);
                }
            }
        }
    }
}

/// One ray against instances.
struct InstanceLeaves<'a, V, const ANY: bool> {
    world: &'a RaycastWorld,
    order: &'a [u32],
    ray: &'a Ray,
    filter: Filter,
    found: &'a mut NearestHit,
    stack: &'a mut Stack,
    vectors: std::marker::PhantomData<V>,
}

impl<V: V8, const ANY: bool> Leaves for InstanceLeaves<'_, V, ANY> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (first, count) = leaf_range(word);
        for &number in &self.order[first..first + count] {
            self.world.find_instance::<V, ANY>(
                number,
                self.ray,
                self.filter,
                self.found,
                self.stack,
            );
            if ANY && self.found.is_hit() {
                return Step::Stop;
            }
        }
        Step::Within(reach(single_above(self.found.distance), 0.0))
    }
}

/// The nearest hit of one ray, or any with `ANY`.
pub(super) struct Find<'a, const ANY: bool> {
    pub(super) world: &'a RaycastWorld,
    pub(super) ray: &'a Ray,
    pub(super) filter: Filter,
    pub(super) scratch: &'a mut Scratch,
}

impl<const ANY: bool> Task for Find<'_, ANY> {
    type Output = NearestHit;

    #[inline(always)]
    fn run<V: V8>(self) -> NearestHit {
        self.world.find::<V, ANY>(self.ray, self.filter, self.scratch)
    }
}

/// The nearest hit of one ray among instances, if it is nearer than one that is known.
pub(super) struct FindInstances<'a> {
    pub(super) world: &'a RaycastWorld,
    pub(super) ray: &'a Ray,
    pub(super) filter: Filter,
    pub(super) found: &'a mut NearestHit,
    pub(super) scratch: &'a mut Scratch,
}

impl Task for FindInstances<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let Self { world, ray, filter, found, scratch } = self;
        world.find_instances::<V, false>(ray, filter, found, scratch);
    }
}

/// [`FindInstances`] for one instance.
pub(super) struct FindInstance<'a> {
    pub(super) world: &'a RaycastWorld,
    pub(super) number: u32,
    pub(super) ray: &'a Ray,
    pub(super) filter: Filter,
    pub(super) found: &'a mut NearestHit,
    pub(super) stack: &'a mut Stack,
}

impl Task for FindInstance<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let Self { world, number, ray, filter, found, stack } = self;
        world.find_instance::<V, false>(number, ray, filter, found, stack);
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{DVec3, Pose, Stream};
    use proptest::prelude::*;

    use crate::simd::{without_avx512, without_vectors};
    use crate::{Filter, Ray, RaycastWorld, Tags};

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "that is what is asked")]
    fn no_single_lies_below_what_it_stands_for() {
        let some = [0.0, -0.0, 1e-50, -1e-50, 0.1, -0.1, 1.0, 16_777_217.0, 1e300, -1e300];
        for distance in some.into_iter().chain([f64::INFINITY, f64::NEG_INFINITY]) {
            let nearest = distance as f32;
            let low = f64::from(nearest) < distance;
            let wanted = if low { nearest.next_up() } else { nearest };
            assert_eq!(super::single_above(distance).to_bits(), wanted.to_bits(), "{distance}");
        }
        assert!(super::single_above(f64::NAN).is_nan());
    }
    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// Trees as well are built with and without vector instructions.
        #[test]
        fn vectors_change_no_bit(seed in any::<u64>(), count in 1_u32..300) {
            let mut stream = Stream::keyed(seed, "world", 0);
            let mut point = |size: f64| {
                [0; 3].map(|_| (stream.unit() - 0.5) * size)
            };
            let mut positions = Vec::new();
            for _ in 0..count {
                let middle = point(10.0);
                for _ in 0..3 {
                    let off = point(2.0);
                    positions.push([0, 1, 2].map(|axis: usize| middle[axis] + off[axis]));
                }
            }
            let triangles: Vec<[u32; 3]> =
                (0..count).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
            let eye = DVec3::from_array(point(4.0));
            let rays: Vec<Ray> = (0..200)
                .map(|n| {
                    let ahead = DVec3::new(1.0, f64::from(n) * 0.01 - 1.0, 0.0);
                    if (60..140).contains(&n) {
                        return Ray::new(eye, ahead);
                    }
                    let any = DVec3::from_array(point(2.0));
                    let origin = if n % 3 == 0 { DVec3::from_array(point(9.0)) } else { eye };
                    Ray::new(origin, (ahead + any * 0.05).normalize_or(DVec3::X))
                })
                .collect();
            let answers = || {
                let mut builder = RaycastWorld::builder();
                builder
                    .add_fixed(&positions, &triangles, &Pose::IDENTITY, Tags::default())
                    .unwrap();
                let world = builder.build(1).unwrap();
                let mut hits = vec![None; rays.len()];
                world.hits_grid(&rays, 20, Filter::default(), 1, &mut hits);
                let mut row = vec![None; rays.len()];
                world.hits_grid(&rays, rays.len(), Filter::default(), 1, &mut row);
                assert_eq!(row, hits);
                let to_f32: Vec<_> =
                    rays.iter().map(|ray| world.cast(ray, Filter::default())).collect();
                (hits, to_f32)
            };
            let (vectors, plain) = (answers(), without_vectors(answers));
            prop_assert_eq!(&vectors.0, &vectors.1);
            prop_assert_eq!(&vectors, &without_avx512(answers));
            prop_assert_eq!(vectors, plain);
        }
    }
}
