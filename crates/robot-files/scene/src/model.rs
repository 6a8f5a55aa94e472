//! Models and the frames in them.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::{Joint, Light, Link, Plugin};

/// Links held together by joints: a robot, a wall, a cup. Its frame is named `__model__`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Model {
    /// Its name, unique among its siblings.
    pub name: String,
    /// Its frame in the world or in the model around it.
    pub parent_from_model: Pose,
    /// Whether it never moves.
    pub is_static: bool,
    /// Whether its links collide with each other.
    pub self_collide: bool,
    /// Whether it may fall asleep when at rest.
    pub allow_auto_disable: bool,
    /// Whether wind moves it.
    pub enable_wind: bool,
    /// The link that carries the model's frame, scoped (`nested::link`). None in a static model
    /// without links.
    pub canonical_link: Option<String>,
    /// Links; poses are `model_from_link`.
    pub links: Vec<Link>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Named frames; poses are `model_from_frame`.
    pub frames: Vec<Frame>,
    /// Models inside.
    pub models: Vec<Self>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// The URI it was included from.
    pub included_from: Option<String>,
    /// What nobody here interprets: grippers, transmissions.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

/// Why a frame is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameRole {
    /// The file declares it.
    #[default]
    Declared,
    /// A link of a URDF that was merged into its parent over a fixed joint.
    MergedLink,
    /// The fixed joint over which a link was merged.
    MergedJoint,
}

/// A named place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Frame {
    /// Its name, unique among the links, joints, frames and models of its parent.
    pub name: String,
    /// The frame at time zero, as seen from the model (or world) that declares it.
    pub parent_from_frame: Pose,
    /// What it moves with: a link, joint, frame or model of the same parent, `__model__`, or
    /// `world`.
    pub attached_to: String,
    /// Why it is there.
    pub role: FrameRole,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

impl Model {
    /// A dynamic model without content.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            parent_from_model: Pose::IDENTITY,
            is_static: false,
            self_collide: false,
            allow_auto_disable: true,
            enable_wind: false,
            canonical_link: None,
            links: Vec::new(),
            joints: Vec::new(),
            frames: Vec::new(),
            models: Vec::new(),
            plugins: Vec::new(),
            included_from: None,
            extra: Vec::new(),
            origin: Origin::default(),
        }
    }

    /// A link of this model itself.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&Link> {
        self.links.iter().find(|link| link.name == name)
    }

    /// A joint of this model itself.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<&Joint> {
        self.joints.iter().find(|joint| joint.name == name)
    }

    /// The lights on its links, each with its link.
    pub fn lights(&self) -> impl Iterator<Item = (&Link, &Light)> {
        self.links.iter().flat_map(|link| link.lights.iter().map(move |light| (link, light)))
    }
}
