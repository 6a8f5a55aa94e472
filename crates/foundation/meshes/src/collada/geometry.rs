//! Primitives of a `<geometry>`.

use glam::DVec3;

use super::source::{Arrays, Source};
use super::tree::{Node, short};
use crate::build::{Corner, Part};
use crate::error::MeshError;
use crate::limits::Budget;
use crate::notes::Notes;
use crate::triangulate::triangulate;

/// Primitive element: the material symbol that it refers to, and its triangles.
pub(super) struct Primitive {
    pub(super) material_symbol: Option<String>,
    pub(super) part: Part,
}

/// State needed to read a geometry.
pub(super) struct Context<'c> {
    pub(super) arrays: &'c mut Arrays,
    pub(super) budget: &'c mut Budget,
    pub(super) notes: &'c mut Notes,
}

/// Reads all primitives of a `<geometry>` with triangles.
pub(super) fn read(
    geometry: Node<'_>,
    context: &mut Context<'_>,
) -> Result<Vec<Primitive>, MeshError> {
    let Some(mesh) = geometry.child("mesh") else {
        context.notes.add("geometry that is not a `<mesh>` (spline, convex_mesh) left out");
        return Ok(Vec::new());
    };
    let mut primitives = Vec::new();
    for element in mesh.children() {
        let shape: fn(&[u32], usize, &mut Polygons) = match element.tag() {
            "triangles" => each_triangle,
            "polygons" | "trifans" | "polylist" => whole,
            "tristrips" => strip,
            "lines" | "linestrips" => {
                context.notes.add("lines left out: only faces make a mesh");
                continue;
            }
            _ => continue,
        };
        let part = primitive(element, shape, context)?;
        if !part.is_empty() {
            let material_symbol = element.attribute("material").map(str::to_owned);
            primitives.push(Primitive { material_symbol, part });
        }
    }
    Ok(primitives)
}

/// Polygons as ranges of index tuples (first tuple, number of tuples), or single triangles as tuples in any
/// order.
enum Face {
    Polygon(usize, usize),
    Triangle([usize; 3]),
}
type Polygons = Vec<Face>;

fn each_triangle(indices: &[u32], stride: usize, faces: &mut Polygons) {
    faces.extend((0..indices.len() / stride / 3).map(|i| Face::Polygon(3 * i, 3)));
}

fn whole(indices: &[u32], stride: usize, faces: &mut Polygons) {
    faces.push(Face::Polygon(0, indices.len() / stride));
}

fn strip(indices: &[u32], stride: usize, faces: &mut Polygons) {
    let triangles = (indices.len() / stride).saturating_sub(2);
    // Every second triangle of a strip has the opposite winding.
    faces.extend(
        (0..triangles).map(|i| {
            Face::Triangle(if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] })
        }),
    );
}

/// Sources that index tuples refer to, with the offset of each in a tuple.
struct Inputs {
    stride: usize,
    position: (usize, Source<3>),
    normal: Option<(usize, Source<3>)>,
    uv: Option<(usize, Source<2>)>,
}

fn inputs(element: Node<'_>, arrays: &mut Arrays) -> Result<Option<Inputs>, MeshError> {
    let mut stride = 1;
    let (mut position, mut normal, mut uv) = (None, None, None);
    let mut uv_set = usize::MAX;
    for input in element.children_named("input") {
        let offset = input.count("offset", 0)?;
        if offset >= 256 {
            return Err(input.error(format!("offset {offset} is beyond any real file")));
        }
        stride = stride.max(offset + 1);
        let vertex_inputs = match input.attribute("semantic") {
            Some("VERTEX") => {
                let url = input.attribute("source").unwrap_or("");
                let Some(vertices) = input.tree().find("vertices", url) else {
                    return Err(input.error(format!("no `<vertices>` is called `{}`", short(url))));
                };
                vertices.children_named("input").collect()
            }
            _ => vec![input],
        };
        for source in vertex_inputs {
            match source.attribute("semantic") {
                Some("POSITION") => position = Some((offset, Source::of(source, arrays)?)),
                Some("NORMAL") => normal = Some((offset, Source::of(source, arrays)?)),
                Some("TEXCOORD") => {
                    let set = source.count("set", 0)?;
                    if set < uv_set {
                        uv_set = set;
                        uv = Some((offset, Source::of(source, arrays)?));
                    }
                }
                _ => {}
            }
        }
    }
    Ok(position.map(|position| Inputs { stride, position, normal, uv }))
}

fn primitive(
    element: Node<'_>,
    shape: fn(&[u32], usize, &mut Polygons),
    context: &mut Context<'_>,
) -> Result<Part, MeshError> {
    let mut part = Part::default();
    // A primitive without indices may lack other elements too.
    let has_indices = |p: &Node<'_>| match p.tag() {
        "p" => !p.text().is_empty(),
        "ph" => true,
        _ => false,
    };
    if !element.children().any(|child| has_indices(&child)) {
        return Ok(part);
    }
    let Some(inputs) = inputs(element, context.arrays)? else {
        return Err(element.error("has no POSITION input"));
    };
    let vcount = element.child("vcount").filter(|_| element.tag() == "polylist");
    for child in element.children() {
        let p = match child.tag() {
            "p" => child,
            "ph" => {
                context.notes.add("hole in a polygon filled: triangulate the mesh to keep holes");
                let Some(outline) = child.child("p") else { continue };
                outline
            }
            _ => continue,
        };
        let indices = p.indices()?;
        if indices.len() % inputs.stride != 0 {
            let message = format!("{} indices do not divide into {}", indices.len(), inputs.stride);
            return Err(p.error(message));
        }
        let mut faces = Polygons::new();
        match vcount {
            Some(vcount) => runs(vcount, indices.len() / inputs.stride, &mut faces)?,
            None => shape(&indices, inputs.stride, &mut faces),
        }
        if element.tag() == "triangles" && indices.len() % (3 * inputs.stride) != 0 {
            context.notes.add("corners left over after the last triangle of a part left out");
        }
        let tuples = Tuples { p, indices: &indices, inputs: &inputs };
        let is_fan = element.tag() == "trifans";
        for face in faces {
            tuples.add(face, is_fan, &mut part, context)?;
        }
    }
    Ok(part)
}

/// Polygons of a `<polylist>`, whose `<vcount>` gives the number of corners of each.
fn runs(vcount: Node<'_>, tuples: usize, faces: &mut Polygons) -> Result<(), MeshError> {
    let mut start = 0usize;
    for corners in vcount.indices()? {
        let corners = corners as usize;
        if start.saturating_add(corners) > tuples {
            let message = format!("polygons have more corners than the {tuples} that `<p>` lists");
            return Err(vcount.error(message));
        }
        faces.push(Face::Polygon(start, corners));
        start += corners;
    }
    Ok(())
}

/// Index tuples of one `<p>`.
struct Tuples<'a> {
    p: Node<'a>,
    indices: &'a [u32],
    inputs: &'a Inputs,
}

impl Tuples<'_> {
    fn add(
        &self,
        face: Face,
        is_fan: bool,
        part: &mut Part,
        context: &mut Context<'_>,
    ) -> Result<(), MeshError> {
        let (start, len) = match face {
            Face::Triangle(tuples) => {
                let [a, b, c] = tuples;
                let corners = [self.corner(a)?, self.corner(b)?, self.corner(c)?];
                return self.triangle(corners.each_ref(), part, context);
            }
            Face::Polygon(start, len) => (start, len),
        };
        if len < 3 {
            context.notes.add("polygons with fewer than three corners left out");
            return Ok(());
        }
        context.budget.corners(len).map_err(|error| self.locate(error))?;
        let corners: Vec<Corner> =
            (start..start + len).map(|tuple| self.corner(tuple)).collect::<Result<_, _>>()?;
        let mut triangles = Vec::with_capacity(len - 2);
        if is_fan {
            triangles.extend((1..len - 1).map(|i| [0, i, i + 1]));
        } else {
            let positions: Vec<DVec3> = corners.iter().map(|corner| corner.position).collect();
            triangulate(&positions, context.budget, context.notes, &mut |t| triangles.push(t));
        }
        triangles.into_iter().try_for_each(|t| self.triangle(t.map(|i| &corners[i]), part, context))
    }

    fn triangle(
        &self,
        corners: [&Corner; 3],
        part: &mut Part,
        context: &mut Context<'_>,
    ) -> Result<(), MeshError> {
        part.triangle(corners, context.budget).map_err(|error| self.locate(error))
    }

    fn corner(&self, tuple: usize) -> Result<Corner, MeshError> {
        let Inputs { stride, position, normal, uv } = self.inputs;
        let tuple = &self.indices[tuple * stride..(tuple + 1) * stride];
        let index = tuple[position.0];
        let Some(at) = position.1.get(index) else {
            return Err(self.p.error(format!(
                "vertex number {index} does not exist: the source has {}",
                position.1.len()
            )));
        };
        // A wrong normal or texture index only loses the attribute.
        let normal = normal.as_ref().map(|(offset, source)| (tuple[*offset], source));
        let uv = uv.as_ref().map(|(offset, source)| (tuple[*offset], source));
        let key = |index: Option<u32>| index.map_or(0, |i| i.wrapping_add(1));
        Ok(Corner {
            key: [index, key(normal.map(|(i, _)| i)), key(uv.map(|(i, _)| i))],
            position: DVec3::from_array(at),
            normal: normal.and_then(|(i, source)| source.get(i)).map(|n| n.map(|x| x as f32)),
            uv: uv.and_then(|(i, source)| source.get(i)).map(|t| t.map(|x| x as f32)),
        })
    }

    fn locate(&self, error: MeshError) -> MeshError {
        let place = self.p.error("").place;
        MeshError { place: error.place.or(place), ..error }
    }
}
