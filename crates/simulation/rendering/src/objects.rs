//! Bounding boxes of labelled objects: in the image, and in space.

mod extent;

use std::collections::BTreeMap;

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::{Ray, RaycastWorld};

use crate::images::{RenderRequest, RenderedImages};
use crate::render_scene::RenderScene;
use extent::Extent;

/// Label of an object: its class, and its number within the class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ObjectLabel {
    /// Class, from 1; 0 is the background.
    pub class: u8,
    /// Number within the class, from 1.
    pub instance: u16,
}

/// Rectangle of whole pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelBox {
    /// First column.
    pub left_px: u32,
    /// First row.
    pub top_px: u32,
    /// Number of columns.
    pub width_px: u32,
    /// Number of rows.
    pub height_px: u32,
}

/// Pixels of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRegion {
    /// Smallest rectangle with all of them.
    pub bounds: PixelBox,
    /// Their number.
    pub pixel_count: u32,
}

/// Object with a label, and the box around its shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledObject {
    /// Its label.
    pub label: ObjectLabel,
    /// Name of its model.
    pub model: String,
    /// Centre and axes of the box: those of the first link of the object.
    pub world_from_box: Pose,
    /// Edges of the box \[m\].
    pub size_m: DVec3,
}

/// Object in an image.
#[derive(Clone, Debug, PartialEq)]
pub struct DetectedObject {
    /// The object.
    pub object: LabelledObject,
    /// Pixels in which it is seen.
    pub visible: PixelRegion,
    /// Pixels in which it would be seen if nothing else were there; the visible ones unless they were requested.
    pub full: PixelRegion,
}

/// Rows and columns as they are found.
#[derive(Clone, Copy)]
struct Bounds {
    low: [u32; 2],
    high: [u32; 2],
    pixel_count: u32,
}

impl Bounds {
    fn add(bounds: Option<Self>, [column, row]: [u32; 2]) -> Self {
        let all =
            bounds.unwrap_or(Self { low: [column, row], high: [column, row], pixel_count: 0 });
        Self {
            low: [all.low[0].min(column), all.low[1].min(row)],
            high: [all.high[0].max(column), all.high[1].max(row)],
            pixel_count: all.pixel_count + 1,
        }
    }

    fn region(self) -> PixelRegion {
        let bounds = PixelBox {
            left_px: self.low[0],
            top_px: self.low[1],
            width_px: self.high[0] - self.low[0] + 1,
            height_px: self.high[1] - self.low[1] + 1,
        };
        PixelRegion { bounds, pixel_count: self.pixel_count }
    }
}

impl RenderedImages {
    /// Returns the objects with visible pixels, by their labels. The labels must have been rendered.
    #[must_use]
    pub fn visible_objects(&self) -> BTreeMap<ObjectLabel, PixelRegion> {
        let mut found: BTreeMap<ObjectLabel, Bounds> = BTreeMap::new();
        let pixels = (0..self.height).flat_map(|row| (0..self.width).map(move |it| [it, row]));
        for ((pixel, &class), &instance) in pixels.zip(&self.classes).zip(&self.instances) {
            if class != 0 {
                let label = ObjectLabel { class, instance };
                let bounds = Bounds::add(found.get(&label).copied(), pixel);
                found.insert(label, bounds);
            }
        }
        found.into_iter().map(|(label, bounds)| (label, bounds.region())).collect()
    }
}

impl RenderScene {
    /// Returns all labelled objects of limited size at their current poses, by their labels. Labels of class 0 are the
    /// background.
    #[must_use]
    pub fn labelled_objects(&self) -> Vec<LabelledObject> {
        let mut found: BTreeMap<ObjectLabel, (String, Extent)> = BTreeMap::new();
        for shape in self.labelled_shapes() {
            let (_, extent) = found
                .entry(shape.label)
                .or_insert_with(|| (shape.model.to_owned(), Extent::new(shape.world_from_link)));
            extent.add(shape.body, &shape.world_from_body);
        }
        let boxes = found.into_iter().filter_map(|(label, (model, extent))| {
            let (world_from_box, size_m) = extent.bounding_box()?;
            Some(LabelledObject { label, model, world_from_box, size_m })
        });
        boxes.collect()
    }

    /// Returns the objects that are visible in an image of this request, whose labels were rendered. With `full` the
    /// pixels without occlusion are found, too.
    #[must_use]
    pub fn detected_objects(
        &self,
        request: &RenderRequest<'_>,
        picture: &RenderedImages,
        full: bool,
    ) -> Vec<DetectedObject> {
        let visible = picture.visible_objects();
        let objects = self.labelled_objects().into_iter();
        let detected = objects.filter_map(|object| {
            let visible = *visible.get(&object.label)?;
            let alone = full.then(|| self.pixels_alone(request, &object)).flatten();
            Some(DetectedObject { object, visible, full: alone.unwrap_or(visible) })
        });
        detected.collect()
    }

    /// Returns the pixels of an object without all others.
    fn pixels_alone(
        &self,
        request: &RenderRequest<'_>,
        object: &LabelledObject,
    ) -> Option<PixelRegion> {
        let rays = self.rays_of(object.label)?;
        let [columns, rows] = window(request, object);
        let mut bounds = None;
        for row in rows {
            for column in columns.clone() {
                if is_hit(&rays, request, column, row) {
                    bounds = Some(Bounds::add(bounds, [column, row]));
                }
            }
        }
        bounds.map(Bounds::region)
    }
}

/// Returns true if a pixel shows a shape.
fn is_hit(rays: &RaycastWorld, request: &RenderRequest<'_>, column: u32, row: u32) -> bool {
    let Some(direction) = request.lens.direction(column, row) else { return false };
    let Pose { translation: origin_m, rotation } = request.world_from_camera;
    // Depths along the optical axis, as in the rendering.
    let along = direction.x.max(1e-9);
    let ray = Ray {
        origin_m,
        direction: rotation * direction,
        min_m: request.near_m / along,
        max_m: request.far_m / along,
    };
    let filter = crate::render_scene::filter(request.visibility_mask, request.own);
    rays.cast(&ray, filter).is_some()
}

/// Returns the columns and rows in which an object can be seen: those of its box for a pinhole, if all of the box is in
/// front of the camera, else all.
fn window(request: &RenderRequest<'_>, object: &LabelledObject) -> [std::ops::Range<u32>; 2] {
    let size_px = [request.lens.width(), request.lens.height()];
    let camera_from_box = request.world_from_camera.inverse() * object.world_from_box;
    let mut low_px = [f64::INFINITY; 2];
    let mut high_px = [f64::NEG_INFINITY; 2];
    for corner in box_corners(object.size_m) {
        let corner = camera_from_box.transform_point(corner);
        let pixel = (corner.x > request.near_m).then(|| request.lens.project(corner)).flatten();
        let Some(pixel) = pixel else { return size_px.map(|size| 0..size) };
        for axis in 0..2 {
            low_px[axis] = low_px[axis].min(pixel[axis]);
            high_px[axis] = high_px[axis].max(pixel[axis]);
        }
    }
    [0, 1].map(|axis| {
        let limit = f64::from(size_px[axis]);
        // One pixel more, against rounding.
        let first = (low_px[axis] - 1.0).floor().clamp(0.0, limit);
        let last = (high_px[axis] + 1.0).ceil().clamp(0.0, limit);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let columns = first as u32..last as u32;
        columns
    })
}

/// Returns the corners of a box about the origin with these edges \[m\].
pub fn box_corners(size_m: DVec3) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |corner| {
        let side = |axis: usize| if corner >> axis & 1 == 0 { -0.5 } else { 0.5 };
        size_m * DVec3::new(side(0), side(1), side(2))
    })
}
