//! Links and their shapes.

use periplus_diagnostics::Origin;
use periplus_xml::Element;

use super::{Extra, UrdfMaterial, UrdfOrigin};

/// A link. Its frame is that of the joint above it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfLink {
    /// Its name, unique among the links.
    pub name: String,
    /// Mass and inertia, if given.
    pub inertial: Option<UrdfInertial>,
    /// Visual shapes.
    pub visuals: Vec<UrdfVisual>,
    /// Collision shapes.
    pub collisions: Vec<UrdfCollision>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Mass and inertia.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UrdfInertial {
    /// Centre of mass and axes of the inertia in the link.
    pub link_from_inertial: UrdfOrigin,
    /// Mass [kg].
    pub mass_kg: f64,
    /// `xx, xy, xz, yy, yz, zz` about the centre of mass [kg m²].
    pub inertia_kg_m2: [f64; 6],
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Shape for rendering.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfVisual {
    /// Name, if given.
    pub name: Option<String>,
    /// Its frame in the link's.
    pub link_from_visual: UrdfOrigin,
    /// Its shape.
    pub geometry: UrdfGeometry,
    /// Material.
    pub material: Option<UrdfMaterial>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Shape for contacts.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfCollision {
    /// Name, if given.
    pub name: Option<String>,
    /// Its frame in the link's.
    pub link_from_collision: UrdfOrigin,
    /// Its shape.
    pub geometry: UrdfGeometry,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// A shape, centred on its frame.
#[derive(Clone, Debug, PartialEq)]
pub enum UrdfGeometry {
    /// A box with full edge lengths [m].
    Box {
        /// Edge lengths [m].
        size_m: [f64; 3],
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Length [m].
        length_m: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius [m].
        radius_m: f64,
    },
    /// A cylinder along z with half spheres at its ends (URDF 1.2).
    Capsule {
        /// Radius [m].
        radius_m: f64,
        /// Length without the ends [m].
        length_m: f64,
    },
    /// Triangles from a file.
    Mesh {
        /// The URI as written.
        filename: String,
        /// Factors along x, y, z.
        scale: [f64; 3],
        /// Source location of the URI.
        origin: Origin,
    },
    /// Unknown shape.
    Unknown(Element),
}
