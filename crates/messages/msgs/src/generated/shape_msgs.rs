//! `shape_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/shape_msgs`
//! instead.

crate::message! {
    /// Triangles.
    "shape_msgs/msg/Mesh" "RIHS01_f2150b82d8ee7e8bc3f396a2b158aefb4b9a5510a474be271ba1268aebb55289"
    Mesh {
        /// triangles
        triangles: Vec<MeshTriangle>,
        /// vertices
        vertices: Vec<crate::geometry_msgs::Point>,
    }
}

crate::message! {
    /// The corners of a triangle.
    "shape_msgs/msg/MeshTriangle" "RIHS01_618e5c073eeb729e433ef6226e72c01d995c459fb7d76348c9700409a5020bd0"
    MeshTriangle {
        /// vertex_indices
        vertex_indices: [u32; 3],
    }
}

crate::message! {
    /// Points with a x + b y + c z + d = 0.
    "shape_msgs/msg/Plane" "RIHS01_dfbfe8314689c850615d4a727af017e9aa86c10e369a606c8c851ef8f16c58c8"
    Plane {
        /// coef
        coef: [f64; 4],
    }
}

crate::message! {
    /// A simple body.
    "shape_msgs/msg/SolidPrimitive" "RIHS01_2802a15190aadc3f496584df4b0b4c5824d8a0b31aaef839faa75bc34dda38ac"
    SolidPrimitive {
        /// type
        r#type: u8,
        /// m.
        dimensions: Vec<f64> | 3,
        /// polygon
        polygon: crate::geometry_msgs::Polygon,
    }
    /// BOX
    BOX: u8 = 1;
    /// SPHERE
    SPHERE: u8 = 2;
    /// CYLINDER
    CYLINDER: u8 = 3;
    /// CONE
    CONE: u8 = 4;
    /// PRISM
    PRISM: u8 = 5;
    /// BOX_X
    BOX_X: u8 = 0;
    /// BOX_Y
    BOX_Y: u8 = 1;
    /// BOX_Z
    BOX_Z: u8 = 2;
    /// SPHERE_RADIUS
    SPHERE_RADIUS: u8 = 0;
    /// CYLINDER_HEIGHT
    CYLINDER_HEIGHT: u8 = 0;
    /// CYLINDER_RADIUS
    CYLINDER_RADIUS: u8 = 1;
    /// CONE_HEIGHT
    CONE_HEIGHT: u8 = 0;
    /// CONE_RADIUS
    CONE_RADIUS: u8 = 1;
    /// PRISM_HEIGHT
    PRISM_HEIGHT: u8 = 0;
}
