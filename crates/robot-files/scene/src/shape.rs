//! Shapes of collisions and visuals, centred on their own frame.

use periplus_diagnostics::Origin;
use periplus_geometry::DVec3;
use periplus_xml::Element;
use serde::Serialize;

/// A shape [m].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Nothing.
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
    /// A plane: endless to touch, of a size to see.
    Plane {
        /// Unit normal.
        normal: DVec3,
        /// Lengths of the visible rectangle [m].
        size_m: [f64; 2],
    },
    /// Triangles from a file.
    Mesh(Mesh),
    /// Prisms over outlines; several outlines make holes.
    Polylines(Vec<Polyline>),
    /// Ground from an image.
    Heightmap(Box<Heightmap>),
    /// Boxes extruded from an image (Classic).
    Image(Image),
    /// A shape that nobody here interprets.
    #[serde(serialize_with = "crate::json::element")]
    Unknown(Element),
}

/// Triangles from a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mesh {
    /// The URI as written; a relative one counts from the file in which [`Self::origin`] lies.
    pub uri: String,
    /// The file the URI was found to name.
    pub path: Option<std::path::PathBuf>,
    /// Only this part of the file.
    pub submesh: Option<String>,
    /// Whether the part is moved so that its centre lies at the origin.
    pub center_submesh: bool,
    /// Factors along x, y, z.
    pub scale: DVec3,
    /// What nobody here interprets: simplification, convex decomposition.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
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

/// Ground whose height is the brightness of an image.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Heightmap {
    /// The image as written.
    pub uri: String,
    /// The file the URI was found to name.
    pub path: Option<std::path::PathBuf>,
    /// Extent [m].
    pub size_m: DVec3,
    /// Shift of the centre [m].
    pub position_m: DVec3,
    /// Samples per pixel.
    pub sampling: u32,
    /// Textures and blends.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}

/// Boxes extruded from the dark (or bright) pixels of an image.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Image {
    /// The image as written.
    pub uri: String,
    /// The file the URI was found to name.
    pub path: Option<std::path::PathBuf>,
    /// Metres per pixel [m].
    pub scale: f64,
    /// Brightness that parts wall from floor.
    pub threshold: i64,
    /// Height of the boxes [m].
    pub height_m: f64,
    /// Pixels per box.
    pub granularity: i64,
    /// What nobody here interprets.
    #[serde(serialize_with = "crate::json::elements", skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<Element>,
    /// Where it was read.
    #[serde(skip)]
    pub origin: Origin,
}
