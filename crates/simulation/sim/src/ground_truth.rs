//! True contents of camera images and point clouds: the labels of pixels, points and objects.

mod camera;
mod lidar;

use periplus_geometry::Pose;
use periplus_physics::LinkId;
use periplus_rendering::{LabelledObject, SensedGeometry};
use periplus_scene::{Model, Sensor};

use crate::Simulation;

pub use camera::{CameraFrame, LabellingCamera};
pub use lidar::{LabelledPoint, LabellingLidar, LidarFrame};

/// Sensor of a model in a running world.
#[derive(Clone, Debug)]
struct MountedSensor {
    /// `model::link::sensor`, unique in the world.
    full_name: String,
    sensor: Sensor,
    link: LinkId,
}

impl MountedSensor {
    /// Returns true if a user means this sensor: by its name, its full name, or any name if none is given.
    fn is_named(&self, name: Option<&str>) -> bool {
        name.is_none_or(|name| self.sensor.name == name || self.full_name == name)
    }
}

/// Error of a labelled sensor.
#[derive(Clone, Debug, PartialEq)]
pub enum LabellingError {
    /// No sensor of this kind, or none with the name; with the names of all.
    NoSensor {
        /// Kind of the sensor.
        kind: &'static str,
        /// Requested name.
        name: Option<String>,
        /// Full names of the sensors of this kind.
        known: Vec<String>,
    },
    /// The sensor cannot measure: its name, and the reason.
    Impossible {
        /// Full name.
        name: String,
        /// Reason.
        reason: String,
    },
}

impl std::fmt::Display for LabellingError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoSensor { kind, name, known } => {
                let what =
                    name.as_ref().map_or(format!("no {kind}"), |it| format!("no {kind} `{it}`"));
                if known.is_empty() {
                    write!(f, "{what}: no model here has a {kind}")
                } else {
                    write!(f, "{what}; there are {}", known.join(", "))
                }
            }
            Self::Impossible { name, reason } => write!(f, "{name}: {reason}"),
        }
    }
}

impl std::error::Error for LabellingError {}

impl Simulation {
    /// Returns all objects with a label, also those that no camera sees.
    pub fn labelled_objects(&mut self) -> Vec<LabelledObject> {
        self.views.at(SensedGeometry::Visual, self.time_ns, &self.motion).labelled_objects()
    }

    /// Returns the first sensor that `is_kind` accepts with a name, or the first of all; the robot is searched before the
    /// models of the world.
    fn mounted_sensor(
        &self,
        kind: &'static str,
        name: Option<&str>,
        is_kind: fn(&Sensor) -> bool,
    ) -> Result<MountedSensor, LabellingError> {
        let robot = self.robot().map(|robot| robot.model);
        let mut sensors = Vec::new();
        let own = self.running.iter().filter(|running| Some(running.model) == robot);
        let others = self.running.iter().filter(|running| Some(running.model) != robot);
        for running in own.chain(others) {
            let member = &running.member;
            self.collect_sensors(running.model, &member.name, &member.model, "", &mut sensors);
        }
        sensors.retain(|mounted| is_kind(&mounted.sensor));
        let known = sensors.iter().map(|mounted| mounted.full_name.clone()).collect();
        let found = sensors.into_iter().find(|mounted| mounted.is_named(name));
        found.ok_or(LabellingError::NoSensor { kind, name: name.map(str::to_owned), known })
    }

    fn collect_sensors(
        &self,
        id: periplus_physics::ModelId,
        model_name: &str,
        model: &Model,
        scope: &str,
        sensors: &mut Vec<MountedSensor>,
    ) {
        for link in &model.links {
            let scoped = format!("{scope}{}", link.name);
            let Some(link_id) = self.motion.find_link(id, &scoped) else { continue };
            sensors.extend(link.sensors.iter().map(|sensor| MountedSensor {
                full_name: format!("{model_name}::{scoped}::{}", sensor.name),
                sensor: sensor.clone(),
                link: link_id,
            }));
        }
        for inner in &model.models {
            let scope = format!("{scope}{}::", inner.name);
            self.collect_sensors(id, model_name, inner, &scope, sensors);
        }
    }

    /// Returns the pose of a sensor in the world; `None` after its model was removed.
    fn world_from_mounted(&self, mounted: &MountedSensor) -> Option<Pose> {
        let state = self.motion.link_state(mounted.link)?;
        Some(state.world_from_link * mounted.sensor.parent_from_sensor)
    }
}
