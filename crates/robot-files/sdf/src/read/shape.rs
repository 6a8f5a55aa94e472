//! `<geometry>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_scene::{Heightmap, ImageShape, MeshShape, Polyline, Shape};
use periplus_xml::Element;

use crate::fields::Fields;
use crate::value;
use crate::verbatim::keep;

const SHAPES: [&str; 12] = [
    "empty",
    "box",
    "capsule",
    "cone",
    "cylinder",
    "ellipsoid",
    "heightmap",
    "image",
    "mesh",
    "plane",
    "polyline",
    "sphere",
];

/// Reads the `<geometry>` of a collision or visual; lengths in metres, SDF's defaults.
pub fn read_geometry(element: &Element, diagnostics: &mut Diagnostics) -> Shape {
    let Some(first) = element.elements().find(|child| SHAPES.contains(&&*child.name)) else {
        return unknown(element, diagnostics);
    };
    // Several `<polyline>`s are one shape with holes; otherwise the first shape is used.
    let polylines = first.name == "polyline";
    for other in element.elements().filter(|other| !std::ptr::eq(*other, first)) {
        if !(polylines && other.name == "polyline") {
            diagnostics.push(
                Diagnostic::warning(
                    "more-than-one-shape",
                    format!("`<geometry>` holds one shape; `<{}>` is left out", other.name),
                )
                .at(other.origin)
                .related(first.origin, "this one is used"),
            );
        }
    }
    if polylines {
        return Shape::Polylines(
            element.named("polyline").map(|it| polyline(it, diagnostics)).collect(),
        );
    }
    read_shape(first, diagnostics)
}

fn unknown(element: &Element, diagnostics: &mut Diagnostics) -> Shape {
    let Some(child) = element.elements().next() else {
        diagnostics.push(
            Diagnostic::warning("missing-element", "`<geometry>` holds no shape")
                .at(element.origin)
                .help("write `<empty/>` if it has no shape"),
        );
        return Shape::Empty;
    };
    let mut finding = Diagnostic::warning(
        "unknown-element",
        format!("`<{}>` is not a shape that is known here", child.name),
    )
    .at(child.name_origin())
    .note("it is kept, but has no effect");
    finding = finding.did_you_mean(child.name_origin(), &child.name, SHAPES);
    if child.prefix().is_none() {
        diagnostics.push(finding);
    }
    Shape::Unknown(keep(child))
}

fn read_shape(element: &Element, diagnostics: &mut Diagnostics) -> Shape {
    let mut fields = Fields::new(element, diagnostics);
    let shape = match &*element.name {
        "box" => {
            fields.require("size", "1 1 1");
            let size_m = fields.vector("size", DVec3::ONE);
            Shape::Box { size_m: extent(size_m, "size", &mut fields) }
        }
        "cylinder" => Shape::Cylinder {
            radius_m: fields.length("radius", 1.0),
            length_m: fields.length("length", 1.0),
        },
        "capsule" => Shape::Capsule {
            radius_m: fields.length("radius", 0.5),
            length_m: fields.length("length", 1.0),
        },
        "cone" => Shape::Cone {
            radius_m: fields.length("radius", 0.5),
            length_m: fields.length("length", 1.0),
        },
        "sphere" => Shape::Sphere { radius_m: fields.length("radius", 1.0) },
        "ellipsoid" => {
            fields.require("radii", "1 1 1");
            let radii_m = fields.vector("radii", DVec3::ONE);
            Shape::Ellipsoid { radii_m: extent(radii_m, "radii", &mut fields) }
        }
        "plane" => plane(&mut fields),
        "mesh" => return mesh(fields),
        "heightmap" => return heightmap(fields),
        "image" => return image(fields),
        _ => Shape::Empty,
    };
    // A shape has no field for unread content, which has been reported.
    fields.finish();
    shape
}

/// Extent of a shape. A side of zero is flat and accepted; a negative one is an error.
fn extent(size: DVec3, name: &'static str, fields: &mut Fields<'_, '_>) -> DVec3 {
    if size.min_element() < 0.0
        && let Some(child) = fields.element.child(name)
    {
        value::out_of_range(
            size.min_element(),
            "at least 0 in each number",
            child,
            fields.diagnostics,
        );
        return DVec3::ONE;
    }
    size
}

fn plane(fields: &mut Fields<'_, '_>) -> Shape {
    let written = fields.vector("normal", DVec3::Z);
    let normal = unit(written).unwrap_or_else(|| {
        let finding = Diagnostic::error("bad-direction", "the normal of a plane must not be zero");
        fields.diagnostics.push(finding.at(
            fields.element.child("normal").map_or_else(|| fields.origin(), Element::text_origin),
        ));
        DVec3::Z
    });
    let size_m = fields.pair("size", [1.0, 1.0]);
    if size_m.iter().any(|side| *side < 0.0)
        && let Some(child) = fields.element.child("size")
    {
        value::out_of_range(
            size_m[0].min(size_m[1]),
            "at least 0 in each number",
            child,
            fields.diagnostics,
        );
        return Shape::Plane { normal, size_m: [1.0, 1.0] };
    }
    Shape::Plane { normal, size_m }
}

/// Direction of a vector. A vector that is of unit length within rounding is returned unchanged, so that
/// writing and reading back changes nothing.
pub(crate) fn unit(vector: DVec3) -> Option<DVec3> {
    let length = vector.length();
    if (length - 1.0).abs() < 1e-14 {
        return Some(vector);
    }
    (length > 1e-12 && length.is_finite()).then(|| vector / length)
}

fn required_uri(fields: &mut Fields<'_, '_>) -> String {
    let written = fields.text("uri");
    if written.is_none()
        && let Some(old) = fields.element.child("filename")
        && let Some(name) = fields.text("filename")
    {
        fields.diagnostics.push(
            Diagnostic::warning("old-spelling", "`<filename>` is called `<uri>` since SDF 1.3")
                .at(old.name_origin())
                .note("Gazebo does not find this file")
                .replace(old.name_origin(), "uri", "write `<uri>`"),
        );
        return name;
    }
    written.unwrap_or_else(|| {
        let finding = Diagnostic::error(
            "missing-uri",
            format!("`<{}>` lacks the `<uri>` of its file", fields.element.name),
        );
        fields.diagnostics.push(finding.at(fields.origin()));
        String::new()
    })
}

fn mesh(mut fields: Fields<'_, '_>) -> Shape {
    let uri = required_uri(&mut fields);
    let mut submesh = None;
    let mut center_submesh = false;
    if let Some(mut part) = fields.open("submesh") {
        submesh = part.text("name");
        center_submesh = part.boolean("center", false);
        let rest = part.finish();
        fields.close("submesh", rest);
    }
    let scale = fields.vector("scale", DVec3::ONE);
    if scale.to_array().contains(&0.0) {
        let finding = Diagnostic::warning("flat-mesh", "a scale of 0 makes the mesh flat");
        fields.diagnostics.push(finding.at(fields.origin()));
    }
    fields.verbatim(&["convex_decomposition", "simplification"]);
    let origin = fields.origin();
    let optimization = fields.attribute("optimization");
    let mut extra = Vec::new();
    if let Some(attribute) = optimization {
        // The only attribute of a shape; it is kept as an element with a private name.
        extra.push(Element::new(OPTIMIZATION).with_text(attribute.value.clone()));
    }
    extra.extend(fields.finish());
    Shape::Mesh(MeshShape { uri, path: None, submesh, center_submesh, scale, extra, origin })
}

/// Name under which `<mesh optimization="...">` is kept in [`Mesh::extra`].
pub(crate) const OPTIMIZATION: &str = "periplus:optimization";

fn heightmap(mut fields: Fields<'_, '_>) -> Shape {
    let heightmap = Heightmap {
        uri: required_uri(&mut fields),
        path: None,
        size_m: fields.vector("size", DVec3::ONE),
        position_m: fields.vector("pos", DVec3::ZERO),
        sampling: fields.count("sampling", 1),
        origin: fields.origin(),
        extra: {
            fields.verbatim(&["texture", "blend", "use_terrain_paging"]);
            fields.finish()
        },
    };
    Shape::Heightmap(Box::new(heightmap))
}

fn image(mut fields: Fields<'_, '_>) -> Shape {
    Shape::Image(ImageShape {
        uri: required_uri(&mut fields),
        path: None,
        scale: fields.length("scale", 1.0),
        threshold: fields.integer("threshold", 200),
        height_m: fields.length("height", 1.0),
        granularity: fields.integer("granularity", 1),
        origin: fields.origin(),
        extra: fields.finish(),
    })
}

fn polyline(element: &Element, diagnostics: &mut Diagnostics) -> Polyline {
    let mut fields = Fields::new(element, diagnostics);
    let mut points_m = Vec::new();
    for point in fields.children("point") {
        points_m.extend(value::numbers::<2>(point, fields.diagnostics));
    }
    if points_m.len() < 3 {
        let finding = Diagnostic::warning(
            "too-few-points",
            format!("an outline needs 3 points, here are {}", points_m.len()),
        );
        fields.diagnostics.push(finding.at(fields.origin()));
    }
    let height_m = fields.length("height", 1.0);
    fields.finish();
    Polyline { points_m, height_m }
}
