//! Animated figures.

use periplus_base::Pose;
use periplus_diagnostics::Origin;
use periplus_xml::Element;

use crate::{Link, Plugin};

/// An animated figure: a skin, animations, and a script of waypoints.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// Its name.
    pub name: String,
    /// Where it starts.
    pub world_from_actor: Pose,
    /// Links for sensors and collisions.
    pub links: Vec<Link>,
    /// Plugins.
    pub plugins: Vec<Plugin>,
    /// Skin, animations and script.
    pub extra: Vec<Element>,
    /// Where it was read.
    pub origin: Origin,
}
