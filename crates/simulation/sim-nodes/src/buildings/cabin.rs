//! Space in the cabin of a lift.

use periplus_geometry::{DVec3, Pose};
use periplus_scene::{Model, Shape};

/// Box around the collisions of a cabin, in the frame of its model, with its joint at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CabinBox {
    /// \[m\]
    pub(super) low: DVec3,
    /// \[m\]
    pub(super) high: DVec3,
}

impl CabinBox {
    /// Box around the boxes among the collisions of a model's own links; none without them.
    pub(super) fn of(model: &Model) -> Option<Self> {
        let mut found: Option<Self> = None;
        for link in &model.links {
            for collision in &link.collisions {
                let Shape::Box { size_m } = collision.shape else { continue };
                let pose = link.model_from_link * collision.link_from_collision;
                for corner in corners(size_m) {
                    let at = pose.transform_point(corner);
                    found = Some(found.map_or(Self { low: at, high: at }, |it| Self {
                        low: it.low.min(at),
                        high: it.high.max(at),
                    }));
                }
            }
        }
        found
    }

    /// True if a point of the world is in the cabin of a model at a pose.
    pub(super) fn contains(&self, world_from_model: Pose, point: DVec3) -> bool {
        let at = world_from_model.inverse().transform_point(point);
        at.cmpge(self.low).all() && at.cmple(self.high).all()
    }
}

fn corners(size_m: DVec3) -> impl Iterator<Item = DVec3> {
    let half = 0.5 * size_m;
    (0..8).map(move |bits| {
        let sign = |bit: u8| if bits & (1 << bit) == 0 { -1.0 } else { 1.0 };
        half * DVec3::new(sign(0), sign(1), sign(2))
    })
}
