//! Where a sensor stands, and what its messages are called.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_physics::LinkId;
use periplus_plugin_specs::Site;
use periplus_scene::{FrameRole, Link, Model, Sensor};
use periplus_sensors::{Schedule, Streams};

use crate::{Setting, gz_topic};

/// Frames nearer than this are the same place \[m, rad\].
const SAME_PLACE: f64 = 1e-6;

/// Where a sensor stands.
#[derive(Clone, Copy)]
pub(crate) struct Post<'a> {
    pub(crate) setting: &'a Setting<'a>,
    /// The innermost model.
    pub(crate) model: &'a Model,
    /// The link's name, scoped in the outermost model.
    pub(crate) scoped: &'a str,
    pub(crate) link: &'a Link,
    pub(crate) id: LinkId,
    pub(crate) sensor: &'a Sensor,
    pub(crate) sites: &'a [Site<'a>],
}

impl Post<'_> {
    /// `robot::link::sensor`: unique in the world.
    pub(crate) fn full_name(&self) -> String {
        format!("{}::{}::{}", self.setting.model_name, self.scoped, self.sensor.name)
    }

    /// Its random streams.
    pub(crate) fn streams(&self) -> Streams {
        Streams::new(self.setting.seed, self.full_name())
    }

    /// When it measures. `rate_hz` is a plugin's, where that counts instead of the sensor's.
    pub(crate) fn schedule(&self, rate_hz: Option<f64>) -> Schedule {
        let rate_hz = rate_hz.unwrap_or(self.sensor.update_rate_hz);
        Schedule::new(rate_hz, self.setting.start_ns, self.setting.quirks)
    }

    /// Its frame in that of its link.
    pub(crate) fn link_from_sensor(&self) -> Pose {
        self.sensor.parent_from_sensor
    }

    /// The topic that Gazebo gives it: its own, or the long one with a word for what it is.
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

    /// The frame of its messages: the one that is `told` by a plugin, that of the sensor element,
    /// the link or frame that is where the sensor is, or its link's. In the last case a reader
    /// will take its data for measured somewhere else, and that is told.
    pub(crate) fn frame_id(&self, told: Option<String>, diagnostics: &mut Diagnostics) -> String {
        // ROS 1 names begin with a slash now and then; tf2 refuses those.
        if let Some(told) = told.or_else(|| self.sensor.frame_id.clone()) {
            return told.trim_start_matches('/').to_owned();
        }
        let same = |a: Pose, b: Pose| {
            let (metres, radians) = a.distance_to(b);
            metres < SAME_PLACE && radians < SAME_PLACE
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
        // Of several in one place the last is the sensor's own: the links before it lead there.
        if let Some(frame) = frames.rfind(|frame| frame.role != FrameRole::MergedJoint) {
            return frame.name.clone();
        }
        let away = self.link_from_sensor().translation.length();
        diagnostics.push(
            Diagnostic::warning(
                "sensor-frame",
                format!(
                    "the messages of sensor `{}` carry the frame `{}`, but it stands {away:.3} m \
                     from that frame's origin or is turned against it",
                    self.sensor.name, self.link.name
                ),
            )
            .at(self.sensor.origin)
            .help(
                "give the sensor a link or frame of its own and name it in `<frame_name>` of the \
                 plugin or `<gz_frame_id>` of the sensor",
            ),
        );
        self.link.name.clone()
    }
}
