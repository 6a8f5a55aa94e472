//! Mesh primitives.

use ::gltf::json::Root;
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::DVec3;

use super::accessor::Accessor;
use super::buffers::{Buffers, missing};
use crate::build::{Corner, Part};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::notes::Notes;

/// Maximum number of corners of a part whose accessor has no data and is therefore all zeros. Exporters
/// omit data for a few vertices at most; a count without bytes must stay cheap.
const MAX_IMPLIED_CORNERS: usize = 100_000;

/// Reads one primitive; points and lines give an empty part and a note.
pub(super) fn read(
    root: &Root,
    primitive: &Primitive,
    buffers: &mut Buffers<'_>,
    budget: &mut Budget,
    notes: &mut Notes,
) -> Result<Part, MeshError> {
    let mut part = Part::default();
    let Checked::Valid(mode) = primitive.mode else {
        return Err(MeshError::new("a primitive has an unknown mode", "export the file again"));
    };
    let corner_places: fn(usize) -> [usize; 3] = match mode {
        Mode::Triangles => |i| [3 * i, 3 * i + 1, 3 * i + 2],
        Mode::TriangleStrip => |i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] },
        Mode::TriangleFan => |i| [0, i + 1, i + 2],
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
            notes.add("points and lines left out: only triangles make a mesh");
            return Ok(part);
        }
    };
    let mut attribute = |semantic| {
        let index = primitive.attributes.get(&Checked::Valid(semantic));
        index.map(|&index| Accessor::new(root, buffers, budget, index)).transpose()
    };
    let Some(positions) = attribute(Semantic::Positions)? else {
        notes.add("primitive without positions left out");
        return Ok(part);
    };
    let normals = attribute(Semantic::Normals)?;
    let uv_set = super::material::uv_set(root, primitive);
    let uvs = attribute(Semantic::TexCoords(uv_set))?;
    let indices = primitive.indices.map(|i| Accessor::new(root, buffers, budget, i)).transpose()?;

    let places = indices.as_ref().map_or(positions.count, |indices| indices.count);
    let is_implied = indices.as_ref().unwrap_or(&positions).is_implied();
    if is_implied && places > MAX_IMPLIED_CORNERS {
        return Err(MeshError::new(
            format!("a part counts {places} corners and has no data for them"),
            "the file is damaged: export it again",
        ));
    }
    let triangles = match mode {
        Mode::Triangles => places / 3,
        _ => places.saturating_sub(2),
    };
    if mode == Mode::Triangles && places % 3 != 0 {
        notes.add("corners left over after the last triangle of a part left out");
    }
    let corner = |place: usize| {
        let index = match &indices {
            Some(indices) => indices.index(place).unwrap_or(usize::MAX),
            None => place,
        };
        let Some(position) = positions.vector(index) else {
            return Err(missing("vertex", index));
        };
        let key = u32::try_from(index).map_err(|_| missing("vertex", index))?;
        Ok(Corner {
            key: [key, 0, 0],
            position: DVec3::from_array(position),
            normal: normals.as_ref().and_then(|a| a.vector(index)).map(|n| n.map(|x| x as f32)),
            // In glTF v points down from the upper left corner.
            uv: uvs
                .as_ref()
                .and_then(|a| a.vector(index))
                .map(|[u, v]: [f64; 2]| [u as f32, (1.0 - v) as f32]),
        })
    };
    for triangle in 0..triangles {
        let [a, b, c] = corner_places(triangle);
        part.triangle([&corner(a)?, &corner(b)?, &corner(c)?], budget)?;
    }
    Ok(part)
}
