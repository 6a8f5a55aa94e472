//! Point clouds with the labels of their points.

use periplus_geometry::Pose;
use periplus_raycast::Ray;
use periplus_rendering::{ObjectLabel, SensedGeometry, filter};
use periplus_scene::{LidarSpec, Sensor, SensorKind};
use periplus_sensors::{LidarSensor, RayView, Streams, Sweep};

use super::{LabellingError, MountedSensor};
use crate::Simulation;

/// Lidar of the world whose points are labelled.
#[derive(Clone, Debug)]
pub struct LabellingLidar {
    mounted: MountedSensor,
    spec: LidarSpec,
    lidar: LidarSensor,
    streams: Streams,
    frame_count: u64,
}

/// Point of a lidar with the label of the surface that reflected it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelledPoint {
    /// Position in the frame of the lidar \[m\].
    pub position_m: [f32; 3],
    /// Intensity (`laser_retro`).
    pub intensity: f32,
    /// Label of the surface; `None` for the background.
    pub label: Option<ObjectLabel>,
}

/// Point cloud with the truth about its points.
#[derive(Clone, Debug, PartialEq)]
pub struct LidarFrame {
    /// All points with a range, in the order of the beams.
    pub points: Vec<LabelledPoint>,
    /// Pose of the lidar.
    pub world_from_lidar: Pose,
}

impl LabellingLidar {
    /// Full name of the sensor, `model::link::sensor`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.mounted.full_name
    }

    /// Rate of the sensor \[Hz\]; 0 is one cloud in each step.
    #[must_use]
    pub fn update_rate_hz(&self) -> f64 {
        self.mounted.sensor.update_rate_hz
    }

    /// Shapes that the lidar senses: GPU lidars visuals, others collisions, as in Gazebo.
    fn geometry(&self) -> SensedGeometry {
        if self.mounted.sensor.type_name.starts_with("gpu") {
            SensedGeometry::Visual
        } else {
            SensedGeometry::Collision
        }
    }
}

impl Simulation {
    /// Returns a lidar with this name of its sensor, or the first lidar of the robot.
    ///
    /// # Errors
    /// When there is no such lidar, or it cannot measure.
    pub fn labelling_lidar(&self, name: Option<&str>) -> Result<LabellingLidar, LabellingError> {
        let mounted = self.mounted_sensor("lidar", name, is_lidar)?;
        let SensorKind::Lidar(spec) = &mounted.sensor.kind else {
            return Err(LabellingError::NoSensor {
                kind: "lidar",
                name: name.map(str::to_owned),
                known: Vec::new(),
            });
        };
        let spec = (**spec).clone();
        let streams = Streams::new(self.seed(), format!("{}/dataset", mounted.full_name));
        let lidar =
            LidarSensor::new(&spec, &streams).map_err(|error| LabellingError::Impossible {
                name: mounted.full_name.clone(),
                reason: error.message.clone(),
            })?;
        Ok(LabellingLidar { spec, lidar, streams, frame_count: 0, mounted })
    }

    /// Measures a cloud with its labels now; `None` after the model of the lidar was removed. Ranges have the lidar's
    /// noise; labels are those of the surfaces that the beams truly hit.
    pub fn lidar_frame(&mut self, lidar: &mut LabellingLidar) -> Option<LidarFrame> {
        let world_from_lidar = self.world_from_mounted(&lidar.mounted)?;
        let geometry = lidar.geometry();
        let own = self.views.part(geometry, lidar.mounted.link, &self.motion);
        let threads = self.threads();
        let scene = self.views.at(geometry, self.time_ns, &self.motion);
        let retro = |instance| scene.laser_retro(instance);
        let seen = filter(lidar.spec.visibility_mask, None);
        let view = RayView {
            rays: scene.rays(),
            filter: seen,
            own_group: own.and_then(|part| scene.model_of(part)).map_or(0, |it| it.group().0),
            retro: if scene.has_laser_retro() { Some(&retro) } else { None },
            threads,
        };
        let mut stream = lidar.streams.tick(lidar.frame_count);
        lidar.frame_count += 1;
        lidar.lidar.scan(&view, Sweep::AtOnce(world_from_lidar), &mut stream);
        let beams = *lidar.lidar.beams();
        let aim = |direction| Ray {
            origin_m: world_from_lidar.translation,
            direction: world_from_lidar.rotation * direction,
            min_m: lidar.spec.range_min_m,
            max_m: lidar.spec.range_max_m,
        };
        let rays: Vec<Ray> = beams.range_directions().map(aim).collect();
        let mut hits = vec![None; rays.len()];
        scene.rays().hits_grid(&rays, beams.ranges[0], seen, threads, &mut hits);
        let labels = hits.iter().map(|hit| {
            let surface = scene.surface(hit.as_ref()?);
            let class = surface.label.filter(|class| *class != 0)?;
            Some(ObjectLabel { class, instance: surface.instance })
        });
        let intensities = &lidar.lidar.last().intensities;
        let points = lidar.lidar.points().zip(intensities).zip(labels);
        let points =
            points.filter(|((position_m, _), _)| position_m.iter().all(|it| it.is_finite()));
        let points = points.map(|((position_m, &intensity), label)| LabelledPoint {
            position_m,
            intensity,
            label,
        });
        Some(LidarFrame { points: points.collect(), world_from_lidar })
    }
}

fn is_lidar(sensor: &Sensor) -> bool {
    matches!(sensor.kind, SensorKind::Lidar(_))
}
