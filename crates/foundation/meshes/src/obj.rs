//! Wavefront OBJ.
//!
//! Follows Wavefront's "Advanced Visualizer" manual, appendix B1. Faces are read; free-form curves, points
//! and lines are left out with a note. A part is one `o`/`g` name with one `usemtl`.

mod lines;
mod mtl;

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DMat4, DVec3};

use self::lines::{Line, lines};
use crate::SideFiles;
use crate::build::{Corner, Part};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::mesh::{Mesh, MeshMaterial};
use crate::notes::Notes;
use crate::triangulate::triangulate;

/// Lists that faces refer to.
#[derive(Default)]
struct Pool {
    positions: Vec<DVec3>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
}

/// Length of each list at a face: negative indices count back from there.
#[derive(Default)]
struct Seen {
    positions: usize,
    uvs: usize,
    normals: usize,
}

pub(crate) fn read(
    bytes: &[u8],
    budget: &mut Budget,
    side_files: &mut SideFiles<'_>,
) -> Result<Mesh, MeshError> {
    // Vertices first: some writers put a face before its vertices.
    let pool = read_pool(bytes)?;
    let mut notes = Notes::default();
    let mut materials: HashMap<String, Arc<MeshMaterial>> = HashMap::new();
    let mut parts: Vec<(String, String, Part)> = Vec::new();
    let mut part_of_names: HashMap<(String, String), usize> = HashMap::new();
    let (mut name, mut material) = (String::new(), String::new());
    let mut current = None;
    let mut material_file_is_missing = false;
    let mut seen = Seen::default();

    for line in lines(bytes) {
        match line.keyword() {
            "v" => seen.positions += 1,
            "vt" => seen.uvs += 1,
            "vn" => seen.normals += 1,
            "f" | "fo" => {
                let index = match current {
                    Some(index) => index,
                    None => {
                        budget.bytes(2 * (name.len() + material.len()))?;
                        let names = (name.clone(), material.clone());
                        *part_of_names.entry(names).or_insert_with(|| {
                            parts.push((name.clone(), material.clone(), Part::default()));
                            parts.len() - 1
                        })
                    }
                };
                current = Some(index);
                face(&line, &pool, &seen, &mut parts[index].2, budget, &mut notes)
                    .map_err(|error| error.at(line.place()))?;
            }
            "o" | "g" => (name, current) = (line.rest().to_owned(), None),
            "usemtl" => (material, current) = (line.rest().to_owned(), None),
            "mtllib" => {
                let files = material_files(line.rest(), side_files, &mut notes);
                material_file_is_missing |= files.is_empty();
                for (file, text) in files {
                    mtl::read(&text, &file, &mut materials, &mut notes);
                }
            }
            "" | "s" | "vp" => {}
            "l" | "p" => notes.add("lines and points left out: only faces make a mesh"),
            "curv" | "curv2" | "surf" | "cstype" | "deg" | "bmat" | "step" | "parm" | "trim"
            | "hole" | "scrv" | "sp" | "end" | "con" => {
                notes.add("free-form curves and surfaces left out: export the object as polygons");
            }
            other => {
                let other: String = other.chars().take(20).collect();
                notes.add(format!("statement `{other}` left out"));
            }
        }
    }

    let mut submeshes = Vec::new();
    for (name, material, part) in parts.iter().filter(|(_, _, part)| !part.is_empty()) {
        let found = materials.get(material).cloned();
        if found.is_none() && !material.is_empty() && !material_file_is_missing {
            notes.add(format!("material `{material}` is defined in no material file"));
        }
        submeshes.push(part.placed(name.clone(), found, DMat4::IDENTITY, &mut notes)?);
    }
    Ok(Mesh { submeshes, declared_up: None, notes: notes.finish() })
}

fn read_pool(bytes: &[u8]) -> Result<Pool, MeshError> {
    let mut pool = Pool::default();
    for line in lines(bytes) {
        match line.keyword() {
            // A fourth number is a weight or the first of a colour: neither moves the vertex.
            "v" => pool.positions.push(DVec3::from_array(line.numbers(3)?)),
            "vt" => pool.uvs.push(line.numbers::<2>(1)?.map(|x| x as f32)),
            "vn" => pool.normals.push(line.numbers::<3>(3)?.map(|x| x as f32)),
            _ => {}
        }
    }
    Ok(pool)
}

/// Material files of a `mtllib` line. Names with spaces are common, although the format has none, so the
/// whole line is tried as one name first.
fn material_files(
    names: &str,
    side_files: &mut SideFiles<'_>,
    notes: &mut Notes,
) -> Vec<(String, Vec<u8>)> {
    if let Some(text) = side_files(names) {
        return vec![(names.to_owned(), text)];
    }
    let mut found = Vec::new();
    for name in names.split_whitespace() {
        match side_files(name).filter(|_| name != names) {
            Some(text) => found.push((name.to_owned(), text)),
            None => notes.add(format!("material file `{name}` not found: parts have no colour")),
        }
    }
    found
}

fn face(
    line: &Line<'_>,
    pool: &Pool,
    seen: &Seen,
    part: &mut Part,
    budget: &mut Budget,
    notes: &mut Notes,
) -> Result<(), MeshError> {
    let mut corners = Vec::new();
    for word in line.rest().split_whitespace() {
        budget.corners(corners.len() + 1)?;
        let mut fields = word.split('/');
        let mut index = |what, seen: usize, len: usize| match fields.next() {
            None | Some("") => Ok(None),
            Some(text) => resolve(text, what, seen, len).map(Some),
        };
        let position = index("v", seen.positions, pool.positions.len())?;
        let uv = index("vt", seen.uvs, pool.uvs.len())?;
        let normal = index("vn", seen.normals, pool.normals.len())?;
        let Some(position) = position else {
            return Err(bad_index(word, "v", pool.positions.len()));
        };
        let key = |index: Option<usize>| index.map_or(0, |i| u32::try_from(i + 1).unwrap_or(0));
        corners.push(Corner {
            key: [key(Some(position)), key(uv), key(normal)],
            position: pool.positions[position],
            normal: normal.map(|i| pool.normals[i]),
            uv: uv.map(|i| pool.uvs[i]),
        });
    }
    if corners.len() < 3 {
        notes.add("faces with fewer than three corners left out");
        return Ok(());
    }
    let positions: Vec<DVec3> = corners.iter().map(|corner| corner.position).collect();
    let mut result = Ok(());
    let mut steps = Vec::new();
    triangulate(&positions, budget, notes, &mut |triangle| steps.push(triangle));
    for triangle in steps {
        result = result.and(part.triangle(triangle.map(|i| &corners[i]), budget));
    }
    result
}

fn resolve(text: &str, what: &str, seen: usize, len: usize) -> Result<usize, MeshError> {
    let index = match text.parse::<i64>() {
        Ok(i) if i > 0 => usize::try_from(i - 1).ok(),
        Ok(i) if i < 0 => usize::try_from(i.unsigned_abs()).ok().and_then(|i| seen.checked_sub(i)),
        _ => None,
    };
    index.filter(|&i| i < len).ok_or_else(|| bad_index(text, what, len))
}

fn bad_index(text: &str, what: &str, len: usize) -> MeshError {
    let text: String = text.chars().take(40).collect();
    MeshError::new(
        format!("face refers to `{what}` number `{text}`, but the file has {len} of them"),
        "indices count from 1, or back from the face when negative; export the file again",
    )
}
