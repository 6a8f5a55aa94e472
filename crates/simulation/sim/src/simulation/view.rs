//! Pictures of a simulation from any pose.

use periplus_geometry::Pose;
use periplus_rendering::{ImageOutputs, Lens, RenderRequest, RenderedImages, SensedGeometry};

use super::Simulation;

/// Nearest and farthest surfaces in a picture \[m\].
const PICTURE_RANGE_M: [f64; 2] = [0.05, 500.0];

impl Simulation {
    /// Renders the visuals from a camera that looks along its x axis, z up: an image of the size of the lens.
    pub fn picture(&mut self, lens: &Lens, world_from_camera: Pose) -> RenderedImages {
        let [near_m, far_m] = PICTURE_RANGE_M;
        let request = RenderRequest {
            lens,
            world_from_camera,
            near_m,
            far_m,
            visibility_mask: u32::MAX,
            own: None,
            outputs: ImageOutputs { colour: true, ..ImageOutputs::default() },
            threads: self.options.threads,
        };
        let mut images = RenderedImages::default();
        let scene = self.views.at(SensedGeometry::Visual, self.time_ns, &self.motion);
        scene.render(&request, &mut images);
        images
    }
}
