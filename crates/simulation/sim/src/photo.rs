//! Pictures of the world from outside, which no sensor of a robot takes.

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::RaycastShape;
use periplus_rendering::{
    ImageOutputs, Lens, LensError, RenderRequest, RenderedImages, SensedGeometry, TracedGeometry,
    TracedShape,
};

use crate::Simulation;

/// Rays along each side of a pixel, for smooth edges.
const RAYS_PER_SIDE: u32 = 3;

/// Distance of the nearest surface that is shown \[m\].
const NEAR_M: f64 = 0.02;

/// Distance of the farthest surface that is shown \[m\].
const FAR_M: f64 = 1e4;

/// Bounding box, its sides along the axes of the world \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Least coordinates.
    pub low_m: DVec3,
    /// Greatest coordinates.
    pub high_m: DVec3,
}

impl BoundingBox {
    /// Centre \[m\].
    #[must_use]
    pub fn centre_m(&self) -> DVec3 {
        (self.low_m + self.high_m) / 2.0
    }

    /// Radius of the sphere about the centre that contains the box \[m\].
    #[must_use]
    pub fn radius_m(&self) -> f64 {
        (self.high_m - self.low_m).length() / 2.0
    }
}

/// Camera of a photo, and its picture.
#[derive(Clone, Copy, Debug)]
pub struct PhotoRequest {
    /// Pose of the camera: it looks along x, z is up.
    pub world_from_camera: Pose,
    /// Horizontal field of view \[rad\].
    pub horizontal_fov_rad: f64,
    /// Width of the picture \[px\].
    pub width_px: u32,
    /// Height of the picture \[px\].
    pub height_px: u32,
    /// Shapes that are shown.
    pub geometry: SensedGeometry,
}

/// Red, green and blue of every pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Photo {
    /// Width \[px\].
    pub width_px: u32,
    /// Height \[px\].
    pub height_px: u32,
    /// `3 * width * height` bytes.
    pub rgb: Vec<u8>,
}

impl Simulation {
    /// Takes a photo of the world as it is now. Each pixel is the mean of nine rays.
    ///
    /// # Errors
    /// A picture without pixels or with too many, or an impossible field of view.
    pub fn photo(&mut self, request: &PhotoRequest) -> Result<Photo, LensError> {
        let PhotoRequest { width_px, height_px, .. } = *request;
        let too_large = LensError::ImageSize { width: width_px, height: height_px };
        let (Some(width), Some(height)) =
            (width_px.checked_mul(RAYS_PER_SIDE), height_px.checked_mul(RAYS_PER_SIDE))
        else {
            return Err(too_large);
        };
        let lens = Lens::pinhole(width, height, request.horizontal_fov_rad).map_err(|error| {
            // The size that was asked for, not that of the rays.
            if matches!(error, LensError::ImageSize { .. }) { too_large } else { error }
        })?;
        let shot = RenderRequest {
            lens: &lens,
            world_from_camera: request.world_from_camera,
            near_m: NEAR_M,
            far_m: FAR_M,
            visibility_mask: u32::MAX,
            own: None,
            outputs: ImageOutputs { colour: true, ..ImageOutputs::default() },
            threads: self.threads(),
        };
        let mut images = RenderedImages::default();
        self.views.at(request.geometry, self.time_ns, &self.motion).render(&shot, &mut images);
        Ok(Photo { width_px, height_px, rgb: mean_of_rays(&images.rgb, width_px, height_px) })
    }

    /// Returns the bounding box of the shapes of one model, or of all, without planes. `None` without a shape.
    pub fn bounding_box(
        &mut self,
        geometry: SensedGeometry,
        model: Option<&str>,
    ) -> Option<BoundingBox> {
        let scene = self.views.at(geometry, self.time_ns, &self.motion);
        let shapes = scene.shapes().filter(|shape| model.is_none_or(|model| shape.model == model));
        shapes.filter_map(|shape| box_of(&shape)).reduce(|one, other| BoundingBox {
            low_m: one.low_m.min(other.low_m),
            high_m: one.high_m.max(other.high_m),
        })
    }
}

/// Returns the box around the points of a shape; `None` for planes.
fn box_of(shape: &TracedShape<'_>) -> Option<BoundingBox> {
    let around = |points: &mut dyn Iterator<Item = DVec3>| {
        let points = points.map(|point| shape.world_from_body.transform_point(point));
        points.map(|point| BoundingBox { low_m: point, high_m: point }).reduce(|one, other| {
            BoundingBox { low_m: one.low_m.min(other.low_m), high_m: one.high_m.max(other.high_m) }
        })
    };
    let about_origin = |half_m: DVec3| around(&mut corners(-half_m, half_m));
    match shape.geometry {
        TracedGeometry::Triangles { positions_m, .. } => {
            around(&mut positions_m.iter().copied().map(DVec3::from_array))
        }
        TracedGeometry::Heightfield(heights) => {
            let (low_m, high_m) = heights.bounds_m();
            around(&mut corners(low_m, high_m))
        }
        TracedGeometry::Shape(form) => match *form {
            RaycastShape::Plane { .. } => None,
            RaycastShape::Box { size_m } => about_origin(size_m / 2.0),
            RaycastShape::Sphere { radius_m } => about_origin(DVec3::splat(radius_m)),
            RaycastShape::Cylinder { radius_m, length_m }
            | RaycastShape::Cone { radius_m, length_m } => {
                about_origin(DVec3::new(radius_m, radius_m, length_m / 2.0))
            }
            RaycastShape::Capsule { radius_m, length_m } => {
                about_origin(DVec3::new(radius_m, radius_m, radius_m + length_m / 2.0))
            }
            RaycastShape::Ellipsoid { radii_m } => about_origin(radii_m),
        },
    }
}

fn corners(low_m: DVec3, high_m: DVec3) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |corner| {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { low_m[axis] } else { high_m[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

/// Reduces a picture with `RAYS_PER_SIDE` times the width and height.
fn mean_of_rays(rgb: &[u8], width_px: u32, height_px: u32) -> Vec<u8> {
    let side = RAYS_PER_SIDE as usize;
    let (width, height) = (width_px as usize, height_px as usize);
    let mean = |row: usize, column: usize, colour: usize| {
        let rays =
            (0..side).flat_map(|y| (0..side).map(move |x| (row * side + y, column * side + x)));
        let sum: usize =
            rays.map(|(y, x)| usize::from(rgb[(y * width * side + x) * 3 + colour])).sum();
        (sum / (side * side)) as u8
    };
    let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
    pixels.flat_map(|(row, column)| [0, 1, 2].map(|colour| mean(row, column, colour))).collect()
}
