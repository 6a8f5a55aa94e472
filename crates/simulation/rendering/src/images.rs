//! Camera images: colour, depth and labels in one pass.

mod bands;
mod shade;

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::{Filter, Hit, Ray};

use crate::lens::Lens;
use crate::render_scene::{ModelGroup, RenderScene, filter};
use bands::Band;
use shade::Shader;

/// Selection of the images to render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ImageOutputs {
    /// Red, green, blue.
    pub colour: bool,
    /// Distance along the optical axis.
    pub depth: bool,
    /// Classes and instances.
    pub labels: bool,
}

/// Camera and settings of a rendering.
#[derive(Clone, Copy, Debug)]
pub struct RenderRequest<'a> {
    /// The lens.
    pub lens: &'a Lens,
    /// Camera pose: looking along x, z up.
    pub world_from_camera: Pose,
    /// Near clip distance along the optical axis \[m\].
    pub near_m: f64,
    /// Far clip distance along the optical axis \[m\].
    pub far_m: f64,
    /// Visibility mask: a visual is rendered if it shares a bit.
    pub visibility_mask: u32,
    /// Model to exclude: the camera's own.
    pub own: Option<ModelGroup>,
    /// Images to render.
    pub outputs: ImageOutputs,
    /// Number of threads; the images are the same for any number.
    pub threads: usize,
}

/// Images of one size, row by row from the top. Images that were not requested are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderedImages {
    /// Width \[px\].
    pub width: u32,
    /// Height \[px\].
    pub height: u32,
    /// Red, green, blue of every pixel.
    pub rgb: Vec<u8>,
    /// Distance along the optical axis, infinite without a hit \[m\].
    pub depth_m: Vec<f32>,
    /// Class label of each pixel; 0 without a label.
    pub classes: Vec<u8>,
    /// Instance number within the class, from 1; 0 without a label.
    pub instances: Vec<u16>,
}

impl RenderScene {
    /// Renders images, reusing the memory of `picture`.
    pub fn render(&self, request: &RenderRequest<'_>, picture: &mut RenderedImages) {
        let bands = picture.bands(request.lens, request.outputs);
        let shader = request.outputs.colour.then(|| Shader::new(self));
        bands::render_bands(bands, request.threads, |band, scratch| {
            self.band(request, shader.as_ref(), band, scratch);
        });
    }

    fn band<'a>(
        &'a self,
        request: &RenderRequest<'_>,
        shader: Option<&Shader<'a>>,
        band: &mut Band<'_>,
        scratch: &mut Scratch<'a>,
    ) {
        let columns = request.lens.width() as usize;
        let seen = filter(request.visibility_mask, request.own);
        scratch.aim(request, band);
        if let (None, false) = (shader, request.outputs.labels) {
            self.rays().cast_grid(&scratch.rays, columns, seen, 1, band.depth_m);
            for (depth, &along) in band.depth_m.iter_mut().zip(&scratch.along_axis) {
                *depth *= along;
            }
            return;
        }
        scratch.hits.clear();
        scratch.hits.resize(scratch.rays.len(), None);
        self.rays().hits_grid(&scratch.rays, columns, seen, 1, &mut scratch.hits);
        #[expect(clippy::cast_possible_truncation, reason = "the image is of single precision")]
        for (pixel, depth) in band.depth_m.iter_mut().enumerate() {
            *depth = scratch.hits[pixel].map_or(f32::INFINITY, |hit| hit.distance_m as f32)
                * scratch.along_axis[pixel];
        }
        for (pixel, class) in band.classes.iter_mut().enumerate() {
            let label = scratch.hits[pixel].and_then(|hit| self.label_of(hit.instance));
            (*class, band.instances[pixel]) = label.unwrap_or((0, 0));
        }
        if let Some(shader) = shader {
            shader.paint(scratch, columns, seen, band.rgb);
        }
    }
}

/// Working memory of one thread.
#[derive(Default)]
struct Scratch<'a> {
    rays: Vec<Ray>,
    /// Depth along the optical axis per length of each ray's direction.
    along_axis: Vec<f32>,
    /// Column component of the pinhole's directions.
    columns: Vec<DVec3>,
    hits: Vec<Option<Hit>>,
    /// Buffers of [`Shader::paint`]: surface patches, their colours, rays from a light, their
    /// lengths and occlusion.
    patches: Vec<shade::Patch<'a>>,
    colours: Vec<[f32; 3]>,
    light_rays: Vec<Ray>,
    light_m: Vec<f32>,
    dark: Vec<bool>,
}

impl Scratch<'_> {
    /// Generates rays through every pixel of a band.
    fn aim(&mut self, request: &RenderRequest<'_>, band: &Band<'_>) {
        let Pose { translation: origin_m, rotation: world_from_camera } = request.world_from_camera;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world_from_camera * axis);
        self.rays.clear();
        self.along_axis.clear();
        if let Some(pinhole) = request.lens.slopes() {
            // Length 1 along the axis: rows and columns contribute independently, without a
            // division.
            if self.columns.is_empty() {
                let columns = 0..request.lens.width();
                let part = |column| axes[0] + axes[1] * pinhole.left(column);
                self.columns.extend(columns.map(part));
            }
            let (min_m, max_m) = (request.near_m, request.far_m);
            for row in band.rows.clone() {
                let part = axes[2] * pinhole.up(row);
                let ray = |&column| Ray { origin_m, direction: column + part, min_m, max_m };
                self.rays.extend(self.columns.iter().map(ray));
            }
            self.along_axis.resize(self.rays.len(), 1.0);
            return;
        }
        for row in band.rows.clone() {
            for column in 0..request.lens.width() {
                let towards = request.lens.direction(column, row);
                // A ray with a zero direction hits nothing.
                let d = towards.unwrap_or(DVec3::ZERO);
                let direction = axes[0] * d.x + axes[1] * d.y + axes[2] * d.z;
                let (min_m, max_m) =
                    (request.near_m / d.x.max(1e-9), request.far_m / d.x.max(1e-9));
                self.rays.push(Ray { origin_m, direction, min_m, max_m });
                #[expect(clippy::cast_possible_truncation, reason = "1 but for wide lenses")]
                self.along_axis.push(d.x as f32);
            }
        }
    }
}

/// Filter of shadow rays.
const SHADOWS: Filter = Filter { mask: crate::render_scene::SHADOW_MASK, except_group: 0 };
