//! Mesh in memory: submeshes of triangles, in metres, with their materials.

use std::sync::Arc;

use crate::notes::Note;

/// Mesh read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Parts, in file order; never empty and never without triangles.
    pub submeshes: Vec<Submesh>,
    /// Up axis declared by a COLLADA file. Positions are *not* rotated by it: see the crate documentation,
    /// "Up axis and unit".
    pub declared_up: Option<UpAxis>,
    /// Content that was left out or assumed.
    pub notes: Vec<Note>,
}

/// Part of a mesh with one material and one name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Submesh {
    /// Name that an SDF `<submesh><name>` refers to; several parts may share it.
    pub name: String,
    /// Vertex positions in the mesh frame \[m\]; all finite.
    pub positions_m: Vec<[f64; 3]>,
    /// Unit normals, one per position, if the file has them for every vertex.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates, one per position, with the origin at the lower left (v upwards), whatever the
    /// convention of the file.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// Corners of each triangle as indices into `positions_m`, counter-clockwise seen from outside.
    /// Triangles without area are kept.
    pub triangles: Vec<[u32; 3]>,
    /// Material, if the file gives one that exists.
    pub material: Option<Arc<MeshMaterial>>,
}

/// Material properties that all formats have.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshMaterial {
    /// Name or id in the file; may be empty.
    pub name: String,
    /// Diffuse (glTF: base) colour, red, green, blue, alpha, each 0 to 1.
    pub diffuse_rgba: [f32; 4],
    /// Colour that the surface emits, red, green, blue, each 0 to 1.
    pub emissive_rgb: [f32; 3],
    /// Diffuse (glTF: base colour) texture.
    pub texture: Option<MeshTexture>,
    /// Effect of the alpha of the texture.
    pub texture_alpha: TextureAlpha,
    /// True if the back of each triangle is visible too.
    pub is_double_sided: bool,
}

/// Effect of the alpha of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TextureAlpha {
    /// None: the surface is opaque, or as transparent as its colour.
    #[default]
    Ignored,
    /// Points with a smaller alpha than this are not drawn; 0 to 1.
    Cutout(f32),
    /// The surface is as transparent as the texture.
    Blended,
}

impl Default for MeshMaterial {
    /// White, opaque, without a texture.
    fn default() -> Self {
        MeshMaterial {
            name: String::new(),
            diffuse_rgba: [1.0; 4],
            emissive_rgb: [0.0; 3],
            texture: None,
            texture_alpha: TextureAlpha::Ignored,
            is_double_sided: false,
        }
    }
}

impl MeshMaterial {
    /// Memory of names and texture \[bytes\]: several materials of a file may refer to one long name or one
    /// large image.
    pub(crate) fn size_bytes(&self) -> usize {
        let texture = match &self.texture {
            None => 0,
            Some(MeshTexture::File(file)) => file.len(),
            Some(MeshTexture::Embedded { bytes, .. }) => bytes.len(),
        };
        self.name.len().saturating_add(texture)
    }
}

/// Image of a material.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshTexture {
    /// File as written in the mesh file: usually relative to it.
    File(String),
    /// Image inside the mesh file, still encoded.
    Embedded {
        /// Media type such as `image/png`; empty if the file does not give one.
        media_type: String,
        /// Bytes of the image file.
        bytes: Arc<[u8]>,
    },
}

/// Up axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// `X_UP`
    X,
    /// `Y_UP`, the default of COLLADA and glTF.
    Y,
    /// `Z_UP`, as in Gazebo and ROS.
    Z,
}

/// Axis-aligned bounding box in the mesh frame \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshBounds {
    /// Minimum coordinates \[m\].
    pub min_m: [f64; 3],
    /// Maximum coordinates \[m\].
    pub max_m: [f64; 3],
}

impl MeshBounds {
    fn of(positions_m: impl Iterator<Item = [f64; 3]>) -> Option<MeshBounds> {
        positions_m.fold(None, |bounds, p| {
            let MeshBounds { min_m: a, max_m: b } =
                bounds.unwrap_or(MeshBounds { min_m: p, max_m: p });
            Some(MeshBounds {
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
    /// Bounding box of all vertices \[m\]; `None` only for a mesh without any.
    pub fn bounds(&self) -> Option<MeshBounds> {
        MeshBounds::of(self.submeshes.iter().flat_map(|part| part.positions_m.iter().copied()))
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
    /// Bounding box of this part's vertices \[m\].
    pub fn bounds(&self) -> Option<MeshBounds> {
        MeshBounds::of(self.positions_m.iter().copied())
    }

    /// Number of triangles with exactly zero area, which a ray can never hit.
    pub fn degenerate_triangle_count(&self) -> usize {
        let at = |i: u32| glam::DVec3::from_array(self.positions_m[i as usize]);
        let area_is_zero =
            |&&[a, b, c]: &&[u32; 3]| (at(b) - at(a)).cross(at(c) - at(a)).length_squared() == 0.0;
        self.triangles.iter().filter(area_is_zero).count()
    }
}
