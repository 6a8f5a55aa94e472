//! `<geometry>`.

use periplus_geometry::DVec3;
use periplus_scene::{Heightmap, ImageShape, MeshShape, Polyline, Shape};
use periplus_xml::Element;

use super::Writer;
use super::out::{Out, numbers};
use crate::read::shape::OPTIMIZATION;
use crate::version::Version;

pub(super) fn write_geometry(shape: &Shape, writer: &mut Writer<'_>) -> Element {
    let mut geometry = Element::new("geometry");
    match shape {
        Shape::Polylines(outlines) => {
            outlines.iter().for_each(|outline| geometry.push(polyline(outline)));
        }
        other => geometry.push(single(other, writer)),
    }
    geometry
}

fn single(shape: &Shape, writer: &mut Writer<'_>) -> Element {
    let round = |name, radius_m: f64, length_m: f64| {
        let mut out = Out::new(name);
        out.always("radius", radius_m);
        out.always("length", length_m);
        out.finish(&[])
    };
    match shape {
        Shape::Empty | Shape::Polylines(_) => Element::new("empty"),
        Shape::Box { size_m } => {
            let mut out = Out::new("box");
            out.vector("size", *size_m);
            out.finish(&[])
        }
        Shape::Cylinder { radius_m, length_m } => round("cylinder", *radius_m, *length_m),
        Shape::Capsule { radius_m, length_m } => round("capsule", *radius_m, *length_m),
        Shape::Cone { radius_m, length_m } => {
            writer.needs(Version::new(12));
            round("cone", *radius_m, *length_m)
        }
        Shape::Sphere { radius_m } => {
            let mut out = Out::new("sphere");
            out.always("radius", *radius_m);
            out.finish(&[])
        }
        Shape::Ellipsoid { radii_m } => {
            let mut out = Out::new("ellipsoid");
            out.vector("radii", *radii_m);
            out.finish(&[])
        }
        Shape::Plane { normal, size_m } => {
            let mut out = Out::new("plane");
            out.vector("normal", *normal);
            out.text("size", numbers(size_m));
            out.finish(&[])
        }
        Shape::Mesh(mesh) => write_mesh(mesh, writer),
        Shape::Heightmap(map) => heightmap(map),
        Shape::Image(picture) => image(picture),
        Shape::Unknown(element) => element.clone(),
    }
}

fn write_mesh(mesh: &MeshShape, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::new("mesh");
    let (private, extra): (Vec<_>, Vec<_>) =
        mesh.extra.iter().cloned().partition(|element| element.name == OPTIMIZATION);
    for element in private {
        writer.needs(Version::new(11));
        out.attribute("optimization", element.text());
    }
    out.text("uri", &mesh.uri);
    if mesh.submesh.is_some() || mesh.center_submesh {
        let mut submesh = Out::new("submesh");
        submesh.optional("name", &mesh.submesh);
        submesh.flag("center", mesh.center_submesh, false);
        out.push(submesh.finish(&[]));
    }
    if mesh.scale != DVec3::ONE {
        out.vector("scale", mesh.scale);
    }
    out.finish(&extra)
}

fn heightmap(map: &Heightmap) -> Element {
    let mut out = Out::new("heightmap");
    out.text("uri", &map.uri);
    out.vector("size", map.size_m);
    out.vector("pos", map.position_m);
    out.count("sampling", map.sampling, 1);
    out.finish(&map.extra)
}

fn image(picture: &ImageShape) -> Element {
    let mut out = Out::new("image");
    out.text("uri", &picture.uri);
    out.always("scale", picture.scale);
    out.text("threshold", picture.threshold.to_string());
    out.always("height", picture.height_m);
    out.text("granularity", picture.granularity.to_string());
    out.finish(&picture.extra)
}

fn polyline(outline: &Polyline) -> Element {
    let mut out = Out::new("polyline");
    for point in &outline.points_m {
        out.text("point", numbers(point));
    }
    out.always("height", outline.height_m);
    out.finish(&[])
}
