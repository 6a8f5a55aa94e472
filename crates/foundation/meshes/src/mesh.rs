//! A mesh in memory: submeshes of triangles, in metres, with their materials.

use std::sync::Arc;

use crate::notes::Note;

/// A mesh file, read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The parts, in file order; never empty and never without triangles.
    pub submeshes: Vec<Submesh>,
    /// The up axis a COLLADA file declares. Positions are *not* turned by it:
    /// see the crate documentation, "Which way is up".
    pub declared_up: Option<UpAxis>,
    /// What was left out or assumed on the way.
    pub notes: Vec<Note>,
}

/// One part of a mesh: one material, one name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Submesh {
    /// The name an SDF `<submesh><name>` selects by; several parts may share it.
    pub name: String,
    /// Vertex positions in the mesh's frame \[m\]; all finite.
    pub positions_m: Vec<[f64; 3]>,
    /// Unit normals, one per position, where the file has them for every vertex.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates, one per position, origin at the lower left
    /// (v upwards) whatever the file's own convention.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// Corners of each triangle as indices into `positions_m`, counter-clockwise
    /// seen from outside. Triangles without area are kept as the file has them.
    pub triangles: Vec<[u32; 3]>,
    /// The material, when the file gives one that could be found.
    pub material: Option<Arc<Material>>,
}

/// The part of a material that every format has.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name or id in the file; may be empty.
    pub name: String,
    /// Diffuse (glTF: base) colour, red, green, blue, alpha, each 0 to 1.
    pub diffuse_rgba: [f32; 4],
    /// The diffuse (glTF: base colour) texture.
    pub texture: Option<Texture>,
}

impl Material {
    /// What names and texture take in memory \[bytes\]: several materials of a
    /// file may refer to one long name or one large image.
    pub(crate) fn size_bytes(&self) -> usize {
        let texture = match &self.texture {
            None => 0,
            Some(Texture::File(file)) => file.len(),
            Some(Texture::Embedded { bytes, .. }) => bytes.len(),
        };
        self.name.len().saturating_add(texture)
    }
}

/// An image a material refers to.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// A file, as the mesh file writes it: usually relative to the mesh file.
    File(String),
    /// An image stored inside the mesh file, still encoded.
    Embedded {
        /// Media type such as `image/png`; empty when the file does not say.
        media_type: String,
        /// The image file's bytes.
        bytes: Arc<[u8]>,
    },
}

/// An axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// `X_UP`
    X,
    /// `Y_UP`, what COLLADA and glTF mean where nothing is said.
    Y,
    /// `Z_UP`, what Gazebo and ROS use.
    Z,
}

/// An axis-aligned box in the mesh's frame \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates \[m\].
    pub min_m: [f64; 3],
    /// Greatest coordinates \[m\].
    pub max_m: [f64; 3],
}

impl Bounds {
    fn of(positions_m: impl Iterator<Item = [f64; 3]>) -> Option<Bounds> {
        positions_m.fold(None, |bounds, p| {
            let Bounds { min_m: a, max_m: b } = bounds.unwrap_or(Bounds { min_m: p, max_m: p });
            Some(Bounds {
                min_m: [a[0].min(p[0]), a[1].min(p[1]), a[2].min(p[2])],
                max_m: [b[0].max(p[0]), b[1].max(p[1]), b[2].max(p[2])],
            })
        })
    }

    /// Edge lengths \[m\].
    pub fn size_m(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.max_m[i] - self.min_m[i])
    }
}

impl Mesh {
    /// The box around all vertices \[m\]; `None` only for a mesh without any.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(self.submeshes.iter().flat_map(|part| part.positions_m.iter().copied()))
    }

    /// Number of triangles in all parts.
    pub fn triangle_count(&self) -> usize {
        self.submeshes.iter().map(|part| part.triangles.len()).sum()
    }

    /// Number of vertices in all parts.
    pub fn vertex_count(&self) -> usize {
        self.submeshes.iter().map(|part| part.positions_m.len()).sum()
    }
}

impl Submesh {
    /// The box around this part's vertices \[m\].
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(self.positions_m.iter().copied())
    }

    /// How many triangles have exactly no area: a ray can never hit them.
    pub fn degenerate_triangle_count(&self) -> usize {
        let at = |i: u32| glam::DVec3::from_array(self.positions_m[i as usize]);
        let area_is_zero =
            |&&[a, b, c]: &&[u32; 3]| (at(b) - at(a)).cross(at(c) - at(a)).length_squared() == 0.0;
        self.triangles.iter().filter(area_is_zero).count()
    }
}
