//! Models and the frames in them.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::{Joint, Light, Link, Plugin};

/// Links connected by joints: a robot, a wall, a cup. Its frame is named `__model__`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Model {
    /// Its name, unique among its siblings.
    pub name: String,
    /// Model frame in the frame of the world or of the model around it.
    pub parent_from_model: Pose,
    /// True if it never moves.
    pub is_static: bool,
    /// True if its links collide with each other.
    pub self_collide: bool,
    /// True if the physics engine may put it to sleep at rest.
    pub allow_auto_disable: bool,
    /// True if wind acts on it.
    pub enable_wind: bool,
    /// Link that carries the model's frame, scoped (`nested::link`). `None` in a static model without
    /// links.
    pub canonical_link: Option<String>,
    /// Links; poses are `model_from_link`.
    pub links: Vec<Link>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Named frames; poses are `model_from_frame`.
    pub frames: Vec<NamedFrame>,
    /// Nested models.
    pub models: Vec<Self>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// URI of the `<include>` that added it.
    pub included_from: Option<String>,
    /// Uninterpreted elements: grippers, transmissions.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Purpose of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameRole {
    /// Declared in the file.
    #[default]
    Declared,
    /// Link of a URDF that was merged into its parent over a fixed joint.
    MergedLink,
    /// Fixed joint over which a link was merged.
    MergedJoint,
}

/// Named frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedFrame {
    /// Its name, unique among the links, joints, frames and models of its parent.
    pub name: String,
    /// Pose at time zero in the frame of the model (or world) that declares it.
    pub parent_from_frame: Pose,
    /// Frame that it moves with: a link, joint, frame or model of the same parent, `__model__`, or `world`.
    pub attached_to: String,
    /// Purpose of the frame.
    pub role: FrameRole,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

impl Model {
    /// Returns a dynamic model without content.
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

    /// Link of this model, without nested models.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&Link> {
        self.links.iter().find(|link| link.name == name)
    }

    /// Joint of this model, without nested models.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<&Joint> {
        self.joints.iter().find(|joint| joint.name == name)
    }

    /// Lights on its links, each with its link.
    pub fn lights(&self) -> impl Iterator<Item = (&Link, &Light)> {
        self.links.iter().flat_map(|link| link.lights.iter().map(move |light| (link, light)))
    }
}
