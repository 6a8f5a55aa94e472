//! Conservative proximity queries.

use periplus_geometry::DVec3;

use super::{Filter, InstanceGeometry, RaycastWorld};
use crate::bvh::{LEAF_MASK, Node, leaf_range};
use crate::shape::Solid;

impl RaycastWorld {
    /// Returns false only if no instance is within a distance of a point \[m\]; true means that a
    /// bounding box is that near. Far cheaper than rays in all directions.
    #[must_use]
    pub fn may_be_near(&self, point_m: DVec3, distance_m: f64, filter: Filter) -> bool {
        let from_middle = point_m - self.middle_m;
        // Margin for the rounding of boxes and of this computation.
        let reach_m = distance_m * 1.000_001 + (point_m.abs() + from_middle.abs()).length() * 1e-6;
        let near = |node: &Node, slot: usize, center: DVec3| {
            let row = |row: usize| f64::from(node.0[row].0[slot]);
            let low = DVec3::new(row(0), row(1), row(2));
            let high = DVec3::new(row(3), row(4), row(5));
            center.clamp(low, high).distance_squared(center) <= reach_m * reach_m
        };
        let instance_near = |number: u32| {
            let instance = &self.instances[number as usize];
            if !filter.accepts(instance.tags) {
                return false;
            }
            let point = instance.world_from_body.point_in_body(point_m);
            match (&instance.body, instance.bounds_m) {
                (InstanceGeometry::Solid(Solid::Plane { .. }), None) => point.z.abs() <= reach_m,
                (_, Some((middle, half))) => {
                    let off = (point - middle).abs() - half;
                    off.max(DVec3::ZERO).length_squared() <= reach_m * reach_m
                }
                (_, None) => true,
            }
        };
        let fixed_near =
            any_leaf(&self.fixed.nodes, |node, slot| near(node, slot, from_middle), |_| true);
        fixed_near
            || self.endless.iter().any(|&number| instance_near(number))
            || [&self.resting, &self.moving].into_iter().any(|tree| {
                any_leaf(
                    &tree.nodes,
                    |node, slot| near(node, slot, from_middle),
                    |word| {
                        let (first, count) = leaf_range(word);
                        tree.order[first..first + count].iter().any(|&number| instance_near(number))
                    },
                )
            })
    }
}

/// Returns true if `leaf` accepts any leaf below nodes whose boxes `enter` accepts.
fn any_leaf(
    nodes: &[Node],
    enter: impl Fn(&Node, usize) -> bool,
    leaf: impl Fn(u32) -> bool,
) -> bool {
    let mut waiting = if nodes.is_empty() { Vec::new() } else { vec![0_u32] };
    while let Some(index) = waiting.pop() {
        let node = &nodes[index as usize];
        for slot in (0..8).filter(|&slot| node.is_used(slot)) {
            let word = node.child(slot);
            if enter(node, slot) {
                if word & LEAF_MASK == 0 {
                    waiting.push(word);
                } else if leaf(word) {
                    return true;
                }
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{DVec3, Pose, Stream};

    use crate::{Filter, Ray, RaycastShape, RaycastWorld, Tags};

    fn world(group: u32) -> RaycastWorld {
        let mut builder = RaycastWorld::builder();
        let tags = Tags { group, ..Tags::default() };
        let ball = RaycastShape::Sphere { radius_m: 0.5 };
        builder.add_shape(&ball, &Pose::from_xyz(3.0, 0.0, 1.0), tags).unwrap();
        let plane = RaycastShape::Plane { size_m: None };
        builder.add_shape(&plane, &Pose::IDENTITY, tags).unwrap();
        let wall = [[-2.0, -1.0, 0.0], [-2.0, 1.0, 0.0], [-2.0, 0.0, 2.0]];
        builder.add_fixed(&wall, &[[0, 1, 2]], &Pose::IDENTITY, tags).unwrap();
        builder.build(1).unwrap()
    }

    #[test]
    fn far_from_everything_nothing_is_near() {
        let near = |x, z, distance| {
            world(0).may_be_near(DVec3::new(x, 0.0, z), distance, Filter::default())
        };
        assert!(!near(0.0, 1.0, 0.9) && near(0.0, 1.0, 1.1), "the plane");
        assert!(!near(2.0, 1.0, 0.4) && near(2.2, 1.0, 0.4), "the ball");
        assert!(!near(-1.5, 1.0, 0.4) && near(-1.5, 1.0, 0.6), "the wall");
    }

    #[test]
    fn what_is_not_looked_for_is_not_near() {
        let own = Filter { except_group: 7, ..Filter::default() };
        assert!(!world(7).may_be_near(DVec3::new(3.0, 0.0, 3.0), 2.5, own));
        assert!(world(7).may_be_near(DVec3::new(3.0, 0.0, 3.0), 2.5, Filter::default()));
    }

    /// No hit of a short ray contradicts a negative result.
    #[test]
    fn no_hit_was_denied() {
        let (world, filter) = (world(0), Filter::default());
        let mut stream = Stream::keyed(0, "near", 0);
        let mut hits = 0;
        for _ in 0..20_000 {
            let mut draw =
                |size: f64| DVec3::from_array([0; 3].map(|_| (stream.unit() - 0.5) * size));
            let (point, direction) = (draw(8.0), draw(1.0).normalize_or(DVec3::X));
            if let Some(hit) = world.cast(&Ray { max_m: 1.0, ..Ray::new(point, direction) }, filter)
            {
                hits += 1;
                assert!(world.may_be_near(point, hit.distance_m, filter), "{point} {hit:?}");
            }
        }
        assert!(hits > 1000, "{hits}");
    }
}
