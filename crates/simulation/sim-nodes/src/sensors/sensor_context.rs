//! A sensor in its model, with its topics and frames.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_physics::LinkId;
use periplus_plugin_specs::PluginSite;
use periplus_scene::{FrameRole, Link, Model, Sensor};
use periplus_sensors::{Schedule, Streams};

use crate::{DeviceContext, gz_topic};

/// Tolerance for frames at the same pose \[m, rad\].
const SAME_FRAME_TOLERANCE_M: f64 = 1e-6;

/// A sensor in its model.
#[derive(Clone, Copy)]
pub(crate) struct SensorContext<'a> {
    pub(crate) setting: &'a DeviceContext<'a>,
    /// Innermost model.
    pub(crate) model: &'a Model,
    /// Name of the link, scoped in the outermost model.
    pub(crate) scoped: &'a str,
    pub(crate) link: &'a Link,
    pub(crate) id: LinkId,
    pub(crate) sensor: &'a Sensor,
    pub(crate) sites: &'a [PluginSite<'a>],
}

impl SensorContext<'_> {
    /// Returns `robot::link::sensor`, which is unique in the world.
    pub(crate) fn full_name(&self) -> String {
        format!("{}::{}::{}", self.setting.model_name, self.scoped, self.sensor.name)
    }

    /// Returns the random streams of the sensor.
    pub(crate) fn streams(&self) -> Streams {
        Streams::new(self.setting.seed, self.full_name())
    }

    /// Returns the schedule of measurements. `rate_hz` is a plugin's rate that replaces the
    /// sensor's.
    pub(crate) fn schedule(&self, rate_hz: Option<f64>) -> Schedule {
        let rate_hz = rate_hz.unwrap_or(self.sensor.update_rate_hz);
        Schedule::new(rate_hz, self.setting.start_ns, self.setting.quirks)
    }

    /// Returns the pose of the sensor in its link.
    pub(crate) fn link_from_sensor(&self) -> Pose {
        self.sensor.parent_from_sensor
    }

    /// Returns Gazebo's topic: the sensor's own, or the long default with a suffix.
    pub(crate) fn gz_topic(&self, suffix: &str) -> String {
        match &self.sensor.topic {
            Some(topic) => gz_topic(topic),
            None => {
                let world = &self.setting.scene.name;
                let model = self.setting.model_name;
                let link = self.scoped.replace("::", "/link/");
                let sensor = &self.sensor.name;
                gz_topic(&format!(
                    "/world/{world}/model/{model}/link/{link}/sensor/{sensor}{suffix}"
                ))
            }
        }
    }

    /// Returns the frame of the messages: `requested` by a plugin, else that of the sensor element,
    /// else the link or frame at the sensor's pose, else its link. The last case misplaces the data
    /// for receivers, and is reported.
    pub(crate) fn frame_id(
        &self,
        requested: Option<String>,
        diagnostics: &mut Diagnostics,
    ) -> String {
        // ROS 1 names can begin with a slash, which tf2 rejects.
        if let Some(requested) = requested.or_else(|| self.sensor.frame_id.clone()) {
            return requested.trim_start_matches('/').to_owned();
        }
        let same = |a: Pose, b: Pose| {
            let (metres, radians) = a.distance_to(b);
            metres < SAME_FRAME_TOLERANCE_M && radians < SAME_FRAME_TOLERANCE_M
        };
        let sensor = self.link.model_from_link * self.link_from_sensor();
        if same(self.link_from_sensor(), Pose::IDENTITY) {
            return self.link.name.clone();
        }
        let mut frames = self.model.frames.iter().filter(|frame| {
            same(frame.parent_from_frame, sensor)
                && periplus_scene::carrying_link(self.model, &frame.name).as_ref()
                    == Some(&self.link.name)
        });
        // Of several frames at the same pose the last is the sensor's own: the links before it lead
        // there.
        if let Some(frame) = frames.rfind(|frame| frame.role != FrameRole::MergedJoint) {
            return frame.name.clone();
        }
        let away = self.link_from_sensor().translation.length();
        diagnostics.push(
            Diagnostic::warning(
                "sensor-frame",
                format!(
                    "the messages of sensor `{}` carry the frame `{}`, but the sensor is {away:.3} m \
                     from that frame's origin or is rotated against it",
                    self.sensor.name, self.link.name
                ),
            )
            .at(self.sensor.origin)
            .help(
                "give the sensor a separate link or frame and name it in `<frame_name>` of the \
                 plugin or `<gz_frame_id>` of the sensor",
            ),
        );
        self.link.name.clone()
    }
}
