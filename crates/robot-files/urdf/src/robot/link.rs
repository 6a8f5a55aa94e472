//! Links and their shapes.

use periplus_diagnostics::Origin;
use periplus_xml::Element;

use super::{Extra, Material, Placement};

/// A link. Its frame is that of the joint above it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Link {
    /// Its name, unique among the links.
    pub name: String,
    /// Mass and inertia, if given.
    pub inertial: Option<Inertial>,
    /// Visual shapes.
    pub visuals: Vec<Visual>,
    /// Collision shapes.
    pub collisions: Vec<Collision>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Mass and inertia.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inertial {
    /// Centre of mass and axes of the inertia in the link.
    pub link_from_inertial: Placement,
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
pub struct Visual {
    /// Name, if given.
    pub name: Option<String>,
    /// Its frame in the link's.
    pub link_from_visual: Placement,
    /// Its shape.
    pub geometry: Geometry,
    /// Material.
    pub material: Option<Material>,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// Shape for contacts.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// Name, if given.
    pub name: Option<String>,
    /// Its frame in the link's.
    pub link_from_collision: Placement,
    /// Its shape.
    pub geometry: Geometry,
    /// Uninterpreted attributes and elements, kept verbatim.
    pub extra: Extra,
    /// Source location.
    pub origin: Origin,
}

/// A shape, centred on its frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
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
