//! Animated figures.

use periplus_diagnostics::Origin;
use periplus_geometry::Pose;
use periplus_xml::Element;
use serde::Serialize;

use crate::{Joint, Link, Plugin};

/// Animated figure: a skin, animations, and a script of waypoints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Actor {
    /// Its name.
    pub name: String,
    /// Initial pose.
    pub world_from_actor: Pose,
    /// Links for sensors and collisions.
    pub links: Vec<Link>,
    /// Joints between its links.
    pub joints: Vec<Joint>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// Skin, animations and script.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}
