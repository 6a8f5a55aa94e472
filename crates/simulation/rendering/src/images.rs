//! Pictures: colour, depth and labels in one pass.

mod bands;
mod shade;

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::{Filter, Hit, Ray};

use crate::lens::Lens;
use crate::surroundings::{ModelGroup, Surroundings, filter};
use bands::Band;
use shade::Shader;

/// Which images are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Red, green, blue.
    pub colour: bool,
    /// Distance along the optical axis.
    pub depth: bool,
    /// Classes and instances.
    pub labels: bool,
}

/// How a picture is taken.
#[derive(Clone, Copy, Debug)]
pub struct Shot<'a> {
    /// The lens.
    pub lens: &'a Lens,
    /// Where it is: looking along x, z up.
    pub world_from_camera: Pose,
    /// Nothing nearer is seen, along the optical axis \[m\].
    pub near_m: f64,
    /// Nothing farther is seen \[m\].
    pub far_m: f64,
    /// Only visuals that share a bit are seen.
    pub visibility_mask: u32,
    /// What is looked past: the camera's own model.
    pub own: Option<ModelGroup>,
    /// Which images.
    pub wanted: Wanted,
    /// How many threads; the picture is the same for any number.
    pub threads: usize,
}

/// Images of one size, row by row from the top. Those that were not wanted are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue of every pixel.
    pub rgb: Vec<u8>,
    /// Distance along the optical axis, infinite where nothing is \[m\].
    pub depth_m: Vec<f32>,
    /// The label of what is seen; 0 where there is none.
    pub classes: Vec<u8>,
    /// Counts the labelled things of one class from 1 on; 0 where there is none.
    pub instances: Vec<u16>,
}

impl Surroundings {
    /// Takes a picture, into memory that is used again.
    pub fn take(&self, shot: &Shot<'_>, picture: &mut Picture) {
        let bands = picture.bands(shot.lens, shot.wanted);
        let shader = shot.wanted.colour.then(|| Shader::new(self));
        bands::share(bands, shot.threads, |band, scratch| {
            self.band(shot, shader.as_ref(), band, scratch);
        });
    }

    fn band<'a>(
        &'a self,
        shot: &Shot<'_>,
        shader: Option<&Shader<'a>>,
        band: &mut Band<'_>,
        scratch: &mut Scratch<'a>,
    ) {
        let columns = shot.lens.width() as usize;
        let seen = filter(shot.visibility_mask, shot.own);
        scratch.aim(shot, band);
        if let (None, false) = (shader, shot.wanted.labels) {
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

/// Memory of one thread.
#[derive(Default)]
struct Scratch<'a> {
    rays: Vec<Ray>,
    /// Of every ray: depth along the optical axis of one length of its direction.
    along_axis: Vec<f32>,
    /// Through a pinhole, the part of directions that the column gives.
    columns: Vec<DVec3>,
    hits: Vec<Option<Hit>>,
    /// For [`Shader::paint`]: what is met, its colours, rays from a light, what they meet, what is
    /// in shadow.
    patches: Vec<shade::Patch<'a>>,
    colours: Vec<[f32; 3]>,
    light_rays: Vec<Ray>,
    light_m: Vec<f32>,
    dark: Vec<bool>,
}

impl Scratch<'_> {
    /// Rays through every pixel of a band.
    fn aim(&mut self, shot: &Shot<'_>, band: &Band<'_>) {
        let Pose { translation: origin_m, rotation: world_from_camera } = shot.world_from_camera;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world_from_camera * axis);
        self.rays.clear();
        self.along_axis.clear();
        if let Some(pinhole) = shot.lens.slopes() {
            // Of length 1 along the axis: rows and columns have a share each, and nothing is divided.
            if self.columns.is_empty() {
                let columns = 0..shot.lens.width();
                let part = |column| axes[0] + axes[1] * pinhole.left(column);
                self.columns.extend(columns.map(part));
            }
            let (min_m, max_m) = (shot.near_m, shot.far_m);
            for row in band.rows.clone() {
                let part = axes[2] * pinhole.up(row);
                let ray = |&column| Ray { origin_m, direction: column + part, min_m, max_m };
                self.rays.extend(self.columns.iter().map(ray));
            }
            self.along_axis.resize(self.rays.len(), 1.0);
            return;
        }
        for row in band.rows.clone() {
            for column in 0..shot.lens.width() {
                let towards = shot.lens.direction(column, row);
                // A ray without direction meets nothing.
                let d = towards.unwrap_or(DVec3::ZERO);
                let direction = axes[0] * d.x + axes[1] * d.y + axes[2] * d.z;
                let (min_m, max_m) = (shot.near_m / d.x.max(1e-9), shot.far_m / d.x.max(1e-9));
                self.rays.push(Ray { origin_m, direction, min_m, max_m });
                #[expect(clippy::cast_possible_truncation, reason = "1 but for wide lenses")]
                self.along_axis.push(d.x as f32);
            }
        }
    }
}

/// What lets light pass and what does not.
const SHADOWS: Filter = Filter { mask: crate::surroundings::SHADOW_MASK, except_group: 0 };
