//! The run of a dataset: frames at a rate, written in one of the formats.

use std::collections::BTreeMap;
use std::sync::atomic::Ordering;

use periplus_session::stop;
use periplus_sim::{Driver, LabellingCamera, LabellingError, LabellingLidar, Simulation};
use serde_json::Value;

use super::coco::CocoWriter;
use super::kitti::KittiWriter;
use super::semantic_kitti::SemanticKittiWriter;
use super::{DatasetFormat, DatasetOptions, classes};
use crate::error::CliError;

/// Sensors of a dataset and its writer.
pub(super) struct Capture<'a> {
    options: &'a DatasetOptions,
    camera: Option<LabellingCamera>,
    lidar: Option<LabellingLidar>,
    classes: BTreeMap<u8, String>,
    writer: Writer,
    frame_count: usize,
    object_count: usize,
    point_count: usize,
}

enum Writer {
    Coco(CocoWriter),
    Kitti(KittiWriter),
    Lidar(SemanticKittiWriter),
}

impl<'a> Capture<'a> {
    pub(super) fn new(
        options: &'a DatasetOptions,
        simulation: &mut Simulation,
    ) -> Result<Self, CliError> {
        let classes = classes::names(&simulation.labelled_objects(), &options.classes);
        let needs_camera = options.format != DatasetFormat::Lidar;
        let needs_lidar = options.format != DatasetFormat::Coco;
        let wrong = |error: LabellingError| CliError::usage(error);
        let camera = needs_camera.then(|| simulation.labelling_camera(options.camera.as_deref()));
        let camera = camera.transpose().map_err(wrong)?;
        let lidar = needs_lidar.then(|| simulation.labelling_lidar(options.lidar.as_deref()));
        let lidar = lidar.transpose().map_err(wrong)?;
        let out = options.out.clone();
        let writer = match (options.format, &camera) {
            (DatasetFormat::Kitti, Some(camera)) => {
                Writer::Kitti(KittiWriter::new(out, classes.clone(), camera)?)
            }
            (DatasetFormat::Lidar, _) => {
                Writer::Lidar(SemanticKittiWriter::new(out, classes.clone())?)
            }
            (DatasetFormat::Coco | DatasetFormat::Kitti, _) => {
                Writer::Coco(CocoWriter::new(out, classes.clone())?)
            }
        };
        Ok(Self {
            options,
            camera,
            lidar,
            classes,
            writer,
            frame_count: 0,
            object_count: 0,
            point_count: 0,
        })
    }

    /// Runs the simulation for a duration \[s\], and writes frames at a rate \[Hz\]. Returns false if a signal ended it.
    pub(super) fn run(
        &mut self,
        simulation: &mut Simulation,
        driver: &mut Driver,
        duration_s: f64,
        rate_hz: f64,
    ) -> Result<bool, CliError> {
        let stop = stop::on_signal();
        let end_ns = (duration_s * 1e9).round() as i64;
        let time_ns = |frame: usize| (frame as f64 * 1e9 / rate_hz).round() as i64;
        while simulation.time_ns() < end_ns {
            if stop.load(Ordering::Relaxed) {
                return Ok(false);
            }
            if simulation.time_ns() >= time_ns(self.frame_count) {
                self.frame(simulation)?;
            }
            driver.play(simulation);
            let next_ns = driver.next_ns().unwrap_or(i64::MAX);
            let next_ns = next_ns.min(time_ns(self.frame_count)).min(end_ns);
            simulation.step_until(next_ns).map_err(CliError::failed)?;
            if let Some(diverged) = simulation.diverged().first() {
                return Err(CliError::failed(format!("{diverged}; its model was removed")));
            }
        }
        Ok(true)
    }

    fn frame(&mut self, simulation: &mut Simulation) -> Result<(), CliError> {
        let gone = || CliError::failed("the model of the camera or lidar was removed");
        let image = match &mut self.camera {
            Some(camera) => Some(simulation.camera_frame(camera).ok_or_else(gone)?),
            None => None,
        };
        let cloud = match &mut self.lidar {
            Some(lidar) => Some(simulation.lidar_frame(lidar).ok_or_else(gone)?),
            None => None,
        };
        let number = self.frame_count;
        #[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
        let time_s = simulation.time_ns() as f64 * 1e-9;
        match (&mut self.writer, &image, &cloud) {
            (Writer::Coco(writer), Some(image), _) => writer.add(number, image)?,
            (Writer::Kitti(writer), Some(image), Some(cloud)) => {
                writer.add(number, image, cloud)?;
            }
            (Writer::Lidar(writer), _, Some(cloud)) => writer.add(number, time_s, cloud)?,
            // The sensors of each format were built with its writer.
            _ => {}
        }
        self.frame_count += 1;
        self.object_count += match (&image, &cloud) {
            (Some(image), _) => image.objects.len(),
            (None, Some(cloud)) => {
                let labels: std::collections::BTreeSet<_> =
                    cloud.points.iter().filter_map(|point| point.label).collect();
                labels.len()
            }
            (None, None) => 0,
        };
        self.point_count += cloud.map_or(0, |cloud| cloud.points.len());
        Ok(())
    }

    /// Writes the files about all frames, and returns the report.
    pub(super) fn finish(self) -> Result<Value, CliError> {
        match &self.writer {
            Writer::Coco(writer) => writer.finish()?,
            Writer::Kitti(_) => {}
            Writer::Lidar(writer) => writer.finish()?,
        }
        Ok(self.options.report(&self))
    }

    pub(super) fn classes(&self) -> &BTreeMap<u8, String> {
        &self.classes
    }

    pub(super) fn frame_count(&self) -> usize {
        self.frame_count
    }

    /// Number of objects in all frames.
    pub(super) fn object_count(&self) -> usize {
        self.object_count
    }

    /// Number of points in all frames.
    pub(super) fn point_count(&self) -> usize {
        self.point_count
    }

    pub(super) fn camera_name(&self) -> Option<&str> {
        self.camera.as_ref().map(LabellingCamera::name)
    }

    pub(super) fn lidar_name(&self) -> Option<&str> {
        self.lidar.as_ref().map(LabellingLidar::name)
    }
}
