//! Images with the labels of their pixels and the boxes of their objects.

use periplus_geometry::Pose;
use periplus_rendering::{
    DetectedObject, ImageOutputs, Lens, RenderRequest, RenderedImages, SensedGeometry,
};
use periplus_scene::{Camera, CameraKind, Sensor, SensorKind};
use periplus_sensors::{ImageNoise, Streams};

use super::{LabellingError, MountedSensor};
use crate::Simulation;

/// Camera of the world whose images are labelled.
#[derive(Clone, Debug)]
pub struct LabellingCamera {
    mounted: MountedSensor,
    camera: Camera,
    lens: Lens,
    noise: Option<ImageNoise>,
    streams: Streams,
    frame_count: u64,
}

/// Image with the truth about its contents.
#[derive(Clone, Debug)]
pub struct CameraFrame {
    /// Colours with the camera's noise, and labels without.
    pub images: RenderedImages,
    /// Visible objects with their boxes, by their labels.
    pub objects: Vec<DetectedObject>,
    /// Pose of the camera: it looks along x, z is up.
    pub world_from_camera: Pose,
}

impl LabellingCamera {
    /// Full name of the sensor, `model::link::sensor`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.mounted.full_name
    }

    /// The camera as its file has it.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Projection of the camera.
    #[must_use]
    pub fn lens(&self) -> &Lens {
        &self.lens
    }

    /// Rate of the sensor \[Hz\]; 0 is one image in each step.
    #[must_use]
    pub fn update_rate_hz(&self) -> f64 {
        self.mounted.sensor.update_rate_hz
    }
}

impl Simulation {
    /// Returns a camera with this name of its sensor, or the first camera of the robot.
    ///
    /// # Errors
    /// When there is no such camera, or its lens is impossible.
    pub fn labelling_camera(&self, name: Option<&str>) -> Result<LabellingCamera, LabellingError> {
        let mounted = self.mounted_sensor("camera", name, is_camera)?;
        let SensorKind::Camera(camera) = &mounted.sensor.kind else {
            return Err(LabellingError::NoSensor {
                kind: "camera",
                name: name.map(str::to_owned),
                known: Vec::new(),
            });
        };
        let camera = (**camera).clone();
        let lens = Lens::of(&camera).map_err(|error| LabellingError::Impossible {
            name: mounted.full_name.clone(),
            reason: error.to_string(),
        })?;
        Ok(LabellingCamera {
            lens,
            noise: ImageNoise::new(&camera.noise),
            streams: Streams::new(self.seed(), format!("{}/dataset", mounted.full_name)),
            frame_count: 0,
            camera,
            mounted,
        })
    }

    /// Takes an image with its labels now; `None` after the model of the camera was removed.
    pub fn camera_frame(&mut self, camera: &mut LabellingCamera) -> Option<CameraFrame> {
        let world_from_sensor = self.world_from_mounted(&camera.mounted)?;
        let world_from_camera = world_from_sensor * camera.camera.sensor_from_camera;
        let request = RenderRequest {
            lens: &camera.lens,
            world_from_camera,
            near_m: camera.camera.near_m,
            far_m: camera.camera.far_m,
            visibility_mask: camera.camera.visibility_mask,
            own: None,
            outputs: ImageOutputs { colour: true, depth: false, labels: true },
            threads: self.threads(),
        };
        let scene = self.views.at(SensedGeometry::Visual, self.time_ns, &self.motion);
        let mut images = RenderedImages::default();
        scene.render(&request, &mut images);
        let objects = scene.detected_objects(&request, &images, true);
        if let Some(noise) = &camera.noise
            && camera.camera.kind != CameraKind::Depth
        {
            noise.colours(&mut images.rgb, &mut camera.streams.tick(camera.frame_count));
        }
        camera.frame_count += 1;
        Some(CameraFrame { images, objects, world_from_camera })
    }
}

fn is_camera(sensor: &Sensor) -> bool {
    matches!(sensor.kind, SensorKind::Camera(_))
}
