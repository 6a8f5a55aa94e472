//! Sensors.

use periplus_xml::Element;

use super::{Walker, words};
use crate::entry::MigrationOutcome;
use crate::old_plugin::Surroundings;
use crate::replacement::{SensorChange, leaf};
use crate::{sensor, template};

impl<'a> Walker<'a> {
    pub(super) fn sensor(&mut self, element: &'a Element, around: Surroundings<'a>) {
        let written_type = element.value("type").unwrap_or_default();
        let old_type = &*self.resolved(element, written_type);
        if old_type == "multicamera" && self.split(element, around) {
            return;
        }
        self.sensor_changes.clear();
        self.has_topic = false;
        self.children(element, Surroundings { sensor: Some(element), ..around });
        let changes = std::mem::take(&mut self.sensor_changes);
        self.sensor_type(element, old_type, &changes);
        self.sensor_topic(element);
        self.settings(element, &changes);
        for change in &changes {
            if let SensorChange::MaxRate(rate_hz) = change {
                self.max_rate(element, rate_hz);
            }
        }
        if matches!(old_type, "ray" | "gpu_ray" | "lidar" | "gpu_lidar")
            && let Some(ray) = element.child("ray")
        {
            self.edits.rename(ray, "lidar");
        }
    }

    fn sensor_type(&mut self, element: &'a Element, old_type: &str, changes: &[SensorChange]) {
        let name = element.value("name").unwrap_or_default();
        let old = format!("sensor {name} ({old_type})");
        if template::is_template(old_type) {
            let remark = "the type is an expression: see that it gives a type of current Gazebo (gpu_lidar, \
                          camera, rgbd_camera, imu, navsat)";
            let outcome = MigrationOutcome::NoCounterpart;
            return self.entry(element, old, "", outcome, vec![remark.to_owned()]);
        }
        if let Some(reason) = sensor::missing_type(old_type) {
            let outcome = MigrationOutcome::NoCounterpart;
            return self.entry(element, old, "", outcome, vec![reason.to_owned()]);
        }
        let by_plugin = changes.iter().find_map(|change| match change {
            SensorChange::Type(kind) => Some(*kind),
            _ => None,
        });
        let usual = sensor::new_type(old_type);
        let Some(new_type) = by_plugin.or(usual.map(|(kind, _)| kind)) else { return };
        if new_type == old_type {
            return;
        }
        self.edits.set_attribute(element, "type", new_type);
        let remark = usual.map_or("", |(_, remark)| remark);
        let (outcome, remarks) = match remark {
            "" => (MigrationOutcome::Converted, Vec::new()),
            remark => (MigrationOutcome::Approximated, vec![remark.to_owned()]),
        };
        self.entry(element, old, format!("sensor {name} ({new_type})"), outcome, remarks);
    }

    /// Topics of Gazebo Classic are relative to the model; a topic of a ROS plugin replaces them.
    fn sensor_topic(&mut self, element: &'a Element) {
        for topic in element.named("topic") {
            let text = topic.text();
            if self.has_topic || text == "__default_topic__" || text.is_empty() {
                self.edits.remove(topic);
            } else if let Some(rest) = text.strip_prefix("~/") {
                self.edits.set_text(topic, rest);
            }
        }
        if self.has_topic {
            for name in ["gz_frame_id", "ignition_frame_id", "frame_id"] {
                for frame in element.named(name) {
                    self.edits.remove(frame);
                }
            }
        }
    }

    /// Settings go into their group, which is created if it is missing.
    fn settings(&mut self, element: &'a Element, changes: &[SensorChange]) {
        let mut created: Vec<Element> = Vec::new();
        for change in changes {
            let SensorChange::Setting { group, element: setting } = change else { continue };
            match element.child(group) {
                Some(group) => match group.child(&setting.name) {
                    Some(present) if setting.name == "topic" => {
                        self.edits.set_text(present, &setting.text());
                    }
                    Some(_) => {}
                    None => self.edits.append(group, std::slice::from_ref(setting)),
                },
                None => match created.iter_mut().find(|element| element.name == *group) {
                    Some(created) => created.push(setting.clone()),
                    None => created.push(Element::new(*group).with_child(setting.clone())),
                },
            }
        }
        if !created.is_empty() {
            self.edits.append(element, &created);
        }
    }

    /// A plugin's rate limits that of the sensor.
    fn max_rate(&mut self, element: &'a Element, rate_hz: &str) {
        let Some(present) = element.child("update_rate") else {
            return self.edits.append(element, &[leaf("update_rate", rate_hz)]);
        };
        let text = present.text();
        if text == rate_hz {
            return;
        }
        match (template::number(&text), template::number(rate_hz)) {
            (Some(own), Some(rate)) if own > 0.0 && own <= rate => {}
            (Some(_), Some(_)) => self.edits.set_text(present, rate_hz),
            _ => {
                let remark = format!(
                    "the plugin limited the rate of the sensor to `{rate_hz}`: the lower of both is \
                     the rate now"
                );
                let outcome = MigrationOutcome::Approximated;
                self.entry(present, format!("update_rate {text}"), "", outcome, vec![remark]);
            }
        }
    }

    /// A sensor of several cameras becomes one sensor for each. False if it has no cameras.
    fn split(&mut self, element: &'a Element, around: Surroundings<'a>) -> bool {
        let cameras: Vec<&Element> = element.named("camera").collect();
        if cameras.is_empty() {
            return false;
        }
        let name = element.value("name").unwrap_or_default();
        let plugin = element.named("plugin").next();
        let old = plugin.map(|plugin| {
            let around = Surroundings { sensor: Some(element), ..around };
            crate::old_plugin::OldPlugin::read(plugin, around, self.ros)
        });
        let mut sensors = Vec::new();
        for camera in cameras {
            let own = camera.value("name").unwrap_or("camera");
            let mut single = Element::new("sensor")
                .with_attribute("name", format!("{name}_{own}"))
                .with_attribute("type", "camera");
            if let Some(pose) = camera.child("pose") {
                single.push(pose.clone());
            }
            for child in element.elements() {
                if !matches!(child.name.as_str(), "camera" | "plugin" | "pose" | "topic") {
                    single.push(child.clone());
                }
            }
            let mut kept = camera.clone();
            kept.children.retain(|node| node.as_element().is_none_or(|child| child.name != "pose"));
            single.push(kept);
            if let Some(old) = &old {
                let (image, info, frame) = sensor::topics_of_one(old, own);
                single.push(leaf("topic", &image));
                if let Some(frame) = frame {
                    single.push(leaf("gz_frame_id", frame));
                }
                self.bridge.push(crate::BridgeEntry::to_ros(&image, &image, crate::bridge::IMAGE));
                self.bridge.push(crate::BridgeEntry::to_ros(
                    &info,
                    &info,
                    crate::bridge::CAMERA_INFO,
                ));
                self.expected.push(sensor::other_camera_info(&info));
                if camera.child("noise").is_some() {
                    self.expected.push(sensor::other_noise(&image));
                }
            }
            sensors.push(single);
        }
        let mut remarks = vec![
            "gz-sim has no multicamera: each camera is a sensor, measured in the same steps"
                .to_owned(),
        ];
        if element.child("pose").is_some() {
            remarks.push(
                "the pose of the sensor is not added to those of its cameras: add it".to_owned(),
            );
        }
        let new = sensors.iter().map(words).collect::<Vec<_>>().join(", ");
        self.edits.replace(element, &sensors);
        let old = format!("sensor {name} (multicamera)");
        self.entry(element, old, new, MigrationOutcome::Approximated, remarks);
        true
    }
}
