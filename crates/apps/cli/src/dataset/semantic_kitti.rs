//! Clouds with a label for each point, in the layout of SemanticKITTI.
//!
//! Format: Behley et al., "SemanticKITTI: A Dataset for Semantic Scene Understanding of LiDAR Sequences" (ICCV 2019), and
//! the odometry benchmark of KITTI. A label has the class in its lower 16 bits and the instance in its upper ones.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use periplus_geometry::Pose;
use periplus_sim::{LabelledPoint, LidarFrame};

use super::matrix::{forward_from_optical, line, rows};
use crate::error::CliError;
use crate::paths;

pub(super) struct SemanticKittiWriter {
    folder: PathBuf,
    classes: BTreeMap<u8, String>,
    world_from_lidars: Vec<Pose>,
    times_s: Vec<f64>,
}

impl SemanticKittiWriter {
    pub(super) fn new(folder: PathBuf, classes: BTreeMap<u8, String>) -> Result<Self, CliError> {
        for name in ["sequences/00/velodyne", "sequences/00/labels", "poses"] {
            paths::make_folder(&folder.join(name))?;
        }
        Ok(Self { folder, classes, world_from_lidars: Vec::new(), times_s: Vec::new() })
    }

    pub(super) fn add(
        &mut self,
        number: usize,
        time_s: f64,
        frame: &LidarFrame,
    ) -> Result<(), CliError> {
        let sequence = self.folder.join("sequences/00");
        let cloud = sequence.join(format!("velodyne/{number:06}.bin"));
        paths::write(&cloud, &cloud_bytes(&frame.points))?;
        let labels: Vec<u8> =
            frame.points.iter().flat_map(|point| label_of(point).to_le_bytes()).collect();
        paths::write(&sequence.join(format!("labels/{number:06}.label")), &labels)?;
        self.world_from_lidars.push(frame.world_from_lidar);
        self.times_s.push(time_s);
        Ok(())
    }

    /// Writes poses, times, calibration and names. Poses are those of a camera at the lidar, relative to the first, as in
    /// KITTI; `Tr` leads from the lidar to it.
    pub(super) fn finish(&self) -> Result<(), CliError> {
        let optical_from_lidar = forward_from_optical().inverse();
        let first = self.world_from_lidars.first().copied().unwrap_or(Pose::IDENTITY);
        let (mut poses, mut times) = (String::new(), String::new());
        for (world_from_lidar, time_s) in self.world_from_lidars.iter().zip(&self.times_s) {
            let first_from_lidar = first.inverse() * *world_from_lidar;
            let pose = optical_from_lidar * first_from_lidar * optical_from_lidar.inverse();
            let _ = writeln!(poses, "{}", line(&rows(pose)));
            let _ = writeln!(times, "{time_s:.6e}");
        }
        let identity = line(&rows(Pose::IDENTITY));
        let mut calibration: String =
            (0..4).map(|camera| format!("P{camera}: {identity}\n")).collect();
        let _ = writeln!(calibration, "Tr: {}", line(&rows(optical_from_lidar)));
        let mut names = String::from("labels:\n  0: \"unlabeled\"\n");
        for (class, name) in &self.classes {
            let _ = writeln!(names, "  {class}: {}", serde_json::json!(name));
        }
        let sequence = self.folder.join("sequences/00");
        paths::write(&sequence.join("poses.txt"), poses.as_bytes())?;
        paths::write(&self.folder.join("poses/00.txt"), poses.as_bytes())?;
        paths::write(&sequence.join("times.txt"), times.as_bytes())?;
        paths::write(&sequence.join("calib.txt"), calibration.as_bytes())?;
        paths::write(&self.folder.join("labels.yaml"), names.as_bytes())?;
        Ok(())
    }
}

/// Returns x, y, z and intensity of all points as little-endian floats, the layout of KITTI's clouds.
pub(super) fn cloud_bytes(points: &[LabelledPoint]) -> Vec<u8> {
    let numbers = points.iter().flat_map(|point| {
        let [x, y, z] = point.position_m;
        [x, y, z, point.intensity]
    });
    numbers.flat_map(f32::to_le_bytes).collect()
}

fn label_of(point: &LabelledPoint) -> u32 {
    point.label.map_or(0, |label| u32::from(label.class) | u32::from(label.instance) << 16)
}

#[cfg(test)]
mod tests {
    use periplus_sim::ObjectLabel;

    use super::*;

    #[test]
    fn points_and_labels_have_their_layout() {
        let label = Some(ObjectLabel { class: 7, instance: 2 });
        let point = LabelledPoint { position_m: [1.0, -2.0, 0.5], intensity: 0.25, label };
        let bytes = cloud_bytes(&[point]);
        let floats: Vec<f32> = bytes
            .chunks(4)
            .map(|it| f32::from_le_bytes(it.try_into().expect("four bytes")))
            .collect();
        assert_eq!(floats, [1.0, -2.0, 0.5, 0.25]);
        assert_eq!(label_of(&point), 0x0002_0007);
        assert_eq!(label_of(&LabelledPoint { label: None, ..point }), 0);
    }
}
