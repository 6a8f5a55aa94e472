//! Depths by rays alone.

use periplus_base::{DVec3, Pose};
use periplus_raycast::Ray;

use super::Pinhole;
use crate::View;

/// Casts a ray through every pixel, for cameras of which nobody wants the colours.
#[derive(Clone, Debug)]
pub struct Depth {
    columns: usize,
    near_m: f64,
    far_m: f64,
    directions: Vec<DVec3>,
    rays: Vec<Ray>,
}

impl Depth {
    /// Of a camera that sees from `near_m` to `far_m` along its axis; what lies nearer is cut
    /// away, as a renderer does, and so a camera looks out of its housing.
    #[must_use]
    pub fn new(pinhole: &Pinhole, near_m: f64, far_m: f64) -> Self {
        Self {
            columns: pinhole.width as usize,
            near_m,
            far_m,
            directions: pinhole.directions().collect(),
            rays: Vec::new(),
        }
    }

    /// Depths [m] along the optical axis, row after row from the upper left; infinite where nothing
    /// is met.
    pub fn measure(&mut self, view: &View<'_>, world_from_camera: Pose, depths_m: &mut Vec<f32>) {
        let Pose { translation: origin_m, rotation } = world_from_camera;
        let (min_m, max_m) = (self.near_m, self.far_m);
        let aimed = self.directions.iter();
        self.rays.clear();
        self.rays.extend(aimed.map(|&direction| Ray {
            origin_m,
            direction: rotation * direction,
            min_m,
            max_m,
        }));
        depths_m.resize(self.rays.len(), f32::INFINITY);
        view.rays.cast_grid(&self.rays, self.columns, view.filter, view.threads, depths_m);
    }
}

/// Out of range as REP 117 says: at or below the least depth `-inf`, from the greatest on `inf`.
pub fn clip_depths(depths_m: &mut [f32], min_m: f64, max_m: f64) {
    #[expect(clippy::cast_possible_truncation, reason = "images have single precision")]
    let (min_m, max_m) = (min_m as f32, max_m as f32);
    for depth_m in depths_m {
        *depth_m = if *depth_m <= min_m {
            f32::NEG_INFINITY
        } else if *depth_m < max_m {
            *depth_m
        } else {
            f32::INFINITY
        };
    }
}

#[cfg(test)]
mod tests {
    use periplus_raycast::{Shape, Tags, World};

    use super::super::pinhole::tests::camera;
    use super::*;

    fn depths(shape: &Shape, pose: Pose) -> (Pinhole, Vec<f32>) {
        let mut builder = World::builder();
        builder.add_shape(shape, &pose, Tags::default()).unwrap();
        let world = builder.build(1).unwrap();
        let pinhole = Pinhole::new(&camera(64, 48, 1.2)).unwrap();
        let mut depths_m = Vec::new();
        let mut depth = Depth::new(&pinhole, 0.1, 10.0);
        depth.measure(&View::of(&world), Pose::IDENTITY, &mut depths_m);
        (pinhole, depths_m)
    }

    /// A wall across the view has one depth everywhere.
    #[test]
    fn a_wall_has_one_depth() {
        let wall = Shape::Box { size_m: DVec3::new(2.0, 100.0, 100.0) };
        let (_, depths_m) = depths(&wall, Pose::from_xyz(4.0, 0.0, 0.0));
        assert!(depths_m.iter().all(|depth_m| (depth_m - 3.0).abs() < 1e-6));
    }

    /// The floor 1 m below: row by row, depth = f / (row from the middle).
    #[test]
    fn the_floor_follows_the_pinhole_formula() {
        let (pinhole, depths_m) =
            depths(&Shape::Plane { size_m: None }, Pose::from_xyz(0.0, 0.0, -1.0));
        for (pixel, depth_m) in depths_m.iter().enumerate() {
            let below = (pixel / 64) as f64 - 23.5;
            let expected = pinhole.focal_px / below;
            if below > 0.0 && expected < 10.0 {
                assert!((f64::from(*depth_m) - expected).abs() < 1e-5, "{pixel}: {depth_m}");
            } else {
                assert_eq!(*depth_m, f32::INFINITY);
            }
        }
    }

    #[test]
    fn depths_are_clipped_by_rep_117() {
        let mut depths_m = [0.4, 0.41, 9.99, 10.0, f32::INFINITY];
        clip_depths(&mut depths_m, 0.4, 10.0);
        let (far, near) = (f32::INFINITY, f32::NEG_INFINITY);
        assert_eq!(depths_m, [near, 0.41, 9.99, far, far]);
    }
}
