//! The layout of the KITTI object benchmark: images, clouds, calibration and labels.
//!
//! Format: Geiger, Lenz and Urtasun, "Are we ready for Autonomous Driving? The KITTI Vision Benchmark Suite" (CVPR 2012),
//! and the readme of its development kit. Pixels are counted from their centres.

mod label;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use periplus_geometry::Pose;
use periplus_images::{Layout, write_png};
use periplus_sim::{CameraFrame, LabellingCamera, LidarFrame};

use self::label::{CameraGeometry, label_line};
use super::matrix::{forward_from_optical, line, rows};
use super::semantic_kitti::cloud_bytes;
use crate::error::CliError;
use crate::paths;

/// Distance of the centre of the first pixel from the corner of the image \[px\].
const PIXEL_CENTRE_PX: f64 = 0.5;

pub(super) struct KittiWriter {
    folder: PathBuf,
    classes: BTreeMap<u8, String>,
    geometry: CameraGeometry,
}

impl KittiWriter {
    pub(super) fn new(
        folder: PathBuf,
        classes: BTreeMap<u8, String>,
        camera: &LabellingCamera,
    ) -> Result<Self, CliError> {
        let lens = camera.lens();
        let Some((focal_px, centre_px)) = lens.pinhole_px() else {
            return Err(CliError::usage(format!(
                "the images of KITTI are rectified, but {} has a distortion or a wide lens: remove its `<distortion>`, \
                 or name another `--camera`",
                camera.name()
            )));
        };
        let folder = folder.join("training");
        for name in ["image_2", "velodyne", "calib", "label_2"] {
            paths::make_folder(&folder.join(name))?;
        }
        let geometry = CameraGeometry {
            focal_px,
            centre_px,
            size_px: [f64::from(lens.width()), f64::from(lens.height())],
            near_m: camera.camera().near_m,
        };
        Ok(Self { folder, classes, geometry })
    }

    pub(super) fn add(
        &self,
        number: usize,
        image: &CameraFrame,
        cloud: &LidarFrame,
    ) -> Result<(), CliError> {
        let file = |folder: &str, ending: &str| {
            self.folder.join(folder).join(format!("{number:06}.{ending}"))
        };
        let images = &image.images;
        let png = write_png(images.width, images.height, Layout::Rgb, &images.rgb);
        paths::write(&file("image_2", "png"), &png)?;
        paths::write(&file("velodyne", "bin"), &cloud_bytes(&cloud.points))?;
        let calibration = self.calibration(image.world_from_camera, cloud.world_from_lidar);
        paths::write(&file("calib", "txt"), calibration.as_bytes())?;
        let mut labels = String::new();
        for detected in &image.objects {
            let name = self.classes.get(&detected.object.label.class);
            let name = name.map_or("DontCare", String::as_str);
            let _ = writeln!(
                labels,
                "{}",
                label_line(name, detected, &self.geometry, image.world_from_camera)
            );
        }
        paths::write(&file("label_2", "txt"), labels.as_bytes())?;
        Ok(())
    }

    /// Returns the calibration of a frame. There is one camera, which all four are; the IMU is at the lidar.
    fn calibration(&self, world_from_camera: Pose, world_from_lidar: Pose) -> String {
        let CameraGeometry { focal_px: f, centre_px: [cx, cy], .. } = self.geometry;
        let (cx, cy) = (cx - PIXEL_CENTRE_PX, cy - PIXEL_CENTRE_PX);
        let projection = line(&[f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let mut text: String = (0..4).map(|it| format!("P{it}: {projection}\n")).collect();
        let rectification = line(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        let world_from_optical = world_from_camera * forward_from_optical();
        let optical_from_lidar = world_from_optical.inverse() * world_from_lidar;
        let _ = writeln!(text, "R0_rect: {rectification}");
        let _ = writeln!(text, "Tr_velo_to_cam: {}", line(&rows(optical_from_lidar)));
        let _ = writeln!(text, "Tr_imu_to_velo: {}", line(&rows(Pose::IDENTITY)));
        text
    }
}
