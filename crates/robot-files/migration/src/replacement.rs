//! Replacement of a plugin.

use periplus_xml::Element;

use crate::bridge::{BridgeEntry, BridgeTypes};
use crate::entry::{ExpectedDifference, MigrationOutcome, TopicAspect};

/// Elements and topics that replace a plugin of Gazebo Classic.
#[derive(Debug)]
pub(crate) struct Replacement {
    pub(crate) outcome: MigrationOutcome,
    /// Elements at the position of the plugin.
    pub(crate) elements: Vec<Element>,
    /// Elements of the sensor that the plugin belongs to.
    pub(crate) sensor: Vec<SensorChange>,
    /// Sensors for links and joints.
    pub(crate) attached: Vec<Attached>,
    pub(crate) bridge: Vec<BridgeEntry>,
    pub(crate) expected: Vec<ExpectedDifference>,
    pub(crate) remarks: Vec<String>,
}

/// Sensor that was part of a plugin of the model.
#[derive(Debug)]
pub(crate) struct Attached {
    pub(crate) parent: AttachmentParent,
    pub(crate) sensor: Element,
}

/// Element that gets a sensor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum AttachmentParent {
    Link(String),
    Joint(String),
}

/// Change of the sensor around a plugin.
#[derive(Debug)]
pub(crate) enum SensorChange {
    /// Sets the type.
    Type(&'static str),
    /// Adds an element to the group of settings (`<camera>`, `<imu>`, `<contact>`), which is created if it is missing; an
    /// element of that name stays.
    Setting { group: &'static str, element: Element },
    /// Replaces the update rate if it is above this one \[Hz\].
    MaxRate(String),
}

impl Replacement {
    pub(crate) fn new(outcome: MigrationOutcome) -> Self {
        Self {
            outcome,
            elements: Vec::new(),
            sensor: Vec::new(),
            attached: Vec::new(),
            bridge: Vec::new(),
            expected: Vec::new(),
            remarks: Vec::new(),
        }
    }

    /// No element replaces the plugin.
    pub(crate) fn without(outcome: MigrationOutcome, remark: impl Into<String>) -> Self {
        let mut replacement = Self::new(outcome);
        replacement.remarks.push(remark.into());
        replacement
    }

    /// Adds a remark about a difference.
    pub(crate) fn differs(&mut self, remark: impl Into<String>) {
        if self.outcome == MigrationOutcome::Converted {
            self.outcome = MigrationOutcome::Approximated;
        }
        self.remarks.push(remark.into());
    }

    pub(crate) fn remark(&mut self, remark: impl Into<String>) {
        self.remarks.push(remark.into());
    }

    /// Adds a difference that the comparison will find.
    pub(crate) fn expects(&mut self, topic: &str, aspect: TopicAspect, reason: impl Into<String>) {
        let topic = format!("/{}", topic.trim_start_matches('/'));
        self.expected.push(ExpectedDifference { topic, aspect, reason: reason.into() });
    }

    pub(crate) fn bridge_to_ros(&mut self, ros: &str, gz: &str, types: BridgeTypes) {
        self.bridge.push(BridgeEntry::to_ros(ros, gz, types));
    }

    pub(crate) fn bridge_to_gz(&mut self, ros: &str, gz: &str, types: BridgeTypes) {
        self.bridge.push(BridgeEntry::to_gz(ros, gz, types));
    }
}

/// Element with text.
pub(crate) fn leaf(name: &str, text: impl AsRef<str>) -> Element {
    Element::new(name).with_text(text.as_ref())
}

/// System of current Gazebo.
pub(crate) fn system(library: &str, class: &str) -> Element {
    Element::new("plugin")
        .with_attribute("filename", format!("gz-sim-{library}-system"))
        .with_attribute("name", format!("gz::sim::systems::{class}"))
}
