//! Shapes of collisions and visuals, centred on their own frame.

use periplus_diagnostics::Origin;
use periplus_geometry::DVec3;
use periplus_xml::Element;
use serde::Serialize;

/// A shape [m].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// No shape.
    Empty,
    /// A box with full edge lengths.
    Box {
        /// Edge lengths [m].
        size_m: DVec3,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Length along z [m].
        length_m: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius [m].
        radius_m: f64,
    },
    /// A cylinder along z with half spheres at both ends.
    Capsule {
        /// Radius [m].
        radius_m: f64,
        /// Length of the cylinder without the ends [m].
        length_m: f64,
    },
    /// A cone along z, its base at `-length/2`, its tip at `length/2`.
    Cone {
        /// Radius of the base [m].
        radius_m: f64,
        /// Height [m].
        length_m: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Half axes [m].
        radii_m: DVec3,
    },
    /// Plane: infinite for contacts, a rectangle for rendering.
    Plane {
        /// Unit normal.
        normal: DVec3,
        /// Lengths of the visible rectangle [m].
        size_m: [f64; 2],
    },
    /// Triangles from a file.
    Mesh(MeshShape),
    /// Prisms over outlines; several outlines make holes.
    Polylines(Vec<Polyline>),
    /// Terrain from an image.
    Heightmap(Box<Heightmap>),
    /// Boxes extruded from an image (Classic).
    Image(ImageShape),
    /// Uninterpreted shape.
    #[serde(serialize_with = "crate::json::element")]
    Unknown(Element),
}

/// Triangles from a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshShape {
    /// URI as written; a relative one is relative to the file of [`Self::origin`].
    pub uri: String,
    /// Resolved file of the URI.
    pub path: Option<std::path::PathBuf>,
    /// Name of the only part of the file to use.
    pub submesh: Option<String>,
    /// True if the part is moved so that its centre is at the origin.
    pub center_submesh: bool,
    /// Factors along x, y, z.
    pub scale: DVec3,
    /// Uninterpreted elements: simplification, convex decomposition.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// A prism along z from 0 to its height.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Polyline {
    /// Corners [m].
    pub points_m: Vec<[f64; 2]>,
    /// Height [m].
    pub height_m: f64,
}

/// Terrain whose height is the brightness of an image.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Heightmap {
    /// URI of the image as written.
    pub uri: String,
    /// Resolved file of the URI.
    pub path: Option<std::path::PathBuf>,
    /// Extent [m].
    pub size_m: DVec3,
    /// Offset of the centre [m].
    pub position_m: DVec3,
    /// Samples per pixel.
    pub sampling: u32,
    /// Textures and blends.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}

/// Boxes extruded from the dark (or bright) pixels of an image.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImageShape {
    /// URI of the image as written.
    pub uri: String,
    /// Resolved file of the URI.
    pub path: Option<std::path::PathBuf>,
    /// Metres per pixel [m].
    pub scale: f64,
    /// Threshold of brightness between wall and floor.
    pub threshold: i64,
    /// Height of the boxes [m].
    pub height_m: f64,
    /// Pixels per box.
    pub granularity: i64,
    /// Uninterpreted attributes and elements, kept verbatim.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Source location.
    #[serde(skip)]
    pub origin: Origin,
}
