//! Visuals as markers.

use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_msgs::geometry_msgs::{Point, Vector3};
use periplus_msgs::std_msgs::{ColorRGBA, Header};
use periplus_msgs::visualization_msgs::{Marker, MarkerArray};
use periplus_rendering::sample_heightmap;
use periplus_scene::{
    Colour, Material, MeshShape, Model, Polyline, Shape, Trapezoid, Visual, edges, trapezoids,
};

use super::super::convert::{colour_message, pose_message, vector_message};
use crate::Simulation;

/// Gazebo's default grey.
const PLAIN: Colour = Colour([0.7, 0.7, 0.7, 1.0]);

/// Thickness of a plane \[m\].
const PLANE_M: f64 = 0.001;

/// Sides of a cone.
const CONE_SIDE_COUNT: u32 = 32;

/// Maximum number of corners of a polyline.
const MAX_CORNERS: usize = 1024;

/// Maximum number of points along a side of a heightmap.
const MAX_POINTS: usize = 129;

/// Returns the markers of all visuals, after a marker that deletes all.
pub(super) fn of(simulation: &Simulation) -> MarkerArray {
    let all = Marker { action: Marker::DELETEALL, ..Marker::default() };
    let mut artist = MarkerBuilder { simulation, model: "", markers: vec![all] };
    for running in &simulation.running {
        artist.model = &running.member.name;
        artist.model(&running.member.model);
    }
    MarkerArray { markers: artist.markers }
}

struct MarkerBuilder<'a> {
    simulation: &'a Simulation,
    model: &'a str,
    markers: Vec<Marker>,
}

impl MarkerBuilder<'_> {
    fn model(&mut self, model: &Model) {
        // Iterative: models can be nested deeper than the call stack allows.
        let mut open = vec![(String::new(), model)];
        while let Some((scope, model)) = open.pop() {
            for link in &model.links {
                let frame = format!("{}/{scope}{}", self.model, link.name);
                for visual in &link.visuals {
                    self.visual(&frame, visual);
                }
            }
            let inner = model.models.iter();
            open.extend(inner.map(|inner| (format!("{scope}{}::", inner.name), inner)));
        }
    }

    fn visual(&mut self, frame: &str, visual: &Visual) {
        let material = visual.material.as_ref();
        let mut colour = material.map_or(PLAIN, colour_of);
        colour.0[3] *= 1.0 - visual.transparency.clamp(0.0, 1.0);
        let albedo = material.and_then(|material| material.pbr.as_ref()?.albedo_map.as_deref());
        let texture_resource = albedo.map(file_uri).unwrap_or_default();
        let blank = Marker {
            header: Header::at(0, frame),
            ns: self.model.to_owned(),
            action: Marker::ADD,
            frame_locked: true,
            color: colour_message(colour),
            scale: vector_message(DVec3::ONE),
            texture_resource,
            text: visual.name.clone(),
            ..Marker::default()
        };
        let at = visual.link_from_visual;
        match &visual.shape {
            Shape::Box { size_m } => self.put(&blank, Marker::CUBE, at, *size_m),
            Shape::Sphere { radius_m } => {
                self.put(&blank, Marker::SPHERE, at, DVec3::splat(2.0 * radius_m));
            }
            Shape::Ellipsoid { radii_m } => self.put(&blank, Marker::SPHERE, at, 2.0 * *radii_m),
            Shape::Cylinder { radius_m, length_m } => {
                self.put(&blank, Marker::CYLINDER, at, round(*radius_m, *length_m));
            }
            Shape::Capsule { radius_m, length_m } => {
                self.put(&blank, Marker::CYLINDER, at, round(*radius_m, *length_m));
                for z in [-0.5 * length_m, 0.5 * length_m] {
                    let end = at * Pose::from_xyz(0.0, 0.0, z);
                    self.put(&blank, Marker::SPHERE, end, DVec3::splat(2.0 * radius_m));
                }
            }
            Shape::Plane { normal, size_m: [x, y] } => {
                let turned = DQuat::from_rotation_arc(DVec3::Z, normal.normalize_or(DVec3::Z));
                let at = at * Pose::from_xyz_quaternion([0.0; 3], turned);
                self.put(&blank, Marker::CUBE, at, DVec3::new(*x, *y, PLANE_M));
            }
            Shape::Mesh(mesh) => self.mesh(&blank, at, mesh, material.is_none()),
            Shape::Cone { radius_m, length_m } => {
                self.triangles(blank, at, cone(*radius_m, *length_m));
            }
            Shape::Polylines(outlines) => self.triangles(blank, at, prism(outlines)),
            Shape::Heightmap(map) => {
                // Problems are reported by rendering.
                if let Ok(samples) = sample_heightmap(map, self.simulation.files()) {
                    let at = at * samples.shape_from_heightmap;
                    self.triangles(blank, at, terrain_triangles(&samples));
                }
            }
            Shape::Empty | Shape::Image(_) | Shape::Unknown(_) => {}
        }
    }

    fn put(&mut self, blank: &Marker, r#type: i32, at: Pose, scale: DVec3) {
        let (pose, scale) = (pose_message(at), vector_message(scale));
        self.push(Marker { r#type, pose, scale, ..blank.clone() });
    }

    fn mesh(&mut self, blank: &Marker, at: Pose, mesh: &MeshShape, own_look: bool) {
        let path = mesh.path.as_ref();
        let mut uri =
            path.map_or_else(|| mesh.uri.clone(), |path| file_uri(&path.to_string_lossy()));
        if let Some(part) = &mesh.submesh {
            uri.push_str(&format!("#submesh={part}"));
            if mesh.center_submesh {
                uri.push_str("&center=1");
            }
        }
        let mut marker = blank.clone();
        if own_look {
            // No tint for a file with its own colours.
            marker.color = ColorRGBA { a: marker.color.a, ..ColorRGBA::default() };
            if marker.color.a >= 1.0 {
                marker.color.a = 0.0;
            }
        }
        marker.mesh_use_embedded_materials = own_look;
        marker.mesh_resource = uri;
        self.put(&marker, Marker::MESH_RESOURCE, at, mesh.scale);
    }

    fn triangles(&mut self, blank: Marker, at: Pose, points: Vec<DVec3>) {
        let points = points.into_iter().map(|DVec3 { x, y, z }| Point { x, y, z }).collect();
        let (r#type, pose, scale) =
            (Marker::TRIANGLE_LIST, pose_message(at), Vector3 { x: 1.0, y: 1.0, z: 1.0 });
        self.push(Marker { r#type, pose, scale, points, ..blank });
    }

    fn push(&mut self, mut marker: Marker) {
        marker.id = i32::try_from(self.markers.len()).unwrap_or(i32::MAX);
        self.markers.push(marker);
    }
}

fn colour_of(material: &Material) -> Colour {
    material.diffuse.or(material.ambient).or(material.emissive).unwrap_or(PLAIN)
}

/// Converts a path to a URI; URIs are kept.
fn file_uri(path: &str) -> String {
    if path.contains("://") || !path.starts_with('/') {
        return path.to_owned();
    }
    format!("file://{path}")
}

fn round(radius_m: f64, length_m: f64) -> DVec3 {
    DVec3::new(2.0 * radius_m, 2.0 * radius_m, length_m)
}

fn cone(radius_m: f64, length_m: f64) -> Vec<DVec3> {
    let (tip, foot) = (DVec3::new(0.0, 0.0, 0.5 * length_m), DVec3::new(0.0, 0.0, -0.5 * length_m));
    let corner = |side: u32| {
        let angle =
            std::f64::consts::TAU * f64::from(side % CONE_SIDE_COUNT) / f64::from(CONE_SIDE_COUNT);
        foot + radius_m * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    let pieces = (0..CONE_SIDE_COUNT).flat_map(|side| {
        let (one, next) = (corner(side), corner(side + 1));
        [one, next, tip, next, one, foot]
    });
    pieces.collect()
}

fn prism(outlines: &[Polyline]) -> Vec<DVec3> {
    let Ok(edges) = edges(outlines, MAX_CORNERS) else { return Vec::new() };
    let height = outlines.first().map_or(0.0, |first| first.height_m);
    let mut points = Vec::new();
    let mut quad = |corners: [[f64; 3]; 4]| {
        let [a, b, c, d] = corners.map(DVec3::from_array);
        points.extend([a, b, c, a, c, d]);
    };
    for [[ax, ay], [bx, by]] in &edges {
        quad([[*ax, *ay, 0.0], [*bx, *by, 0.0], [*bx, *by, height], [*ax, *ay, height]]);
    }
    for Trapezoid { y_m: [low, high], low_m: [a, b], high_m: [c, d] } in trapezoids(&edges) {
        for z in [0.0, height] {
            quad([[a, low, z], [b, low, z], [d, high, z], [c, high, z]]);
        }
    }
    points
}

/// Returns the triangles of a heightmap, downsampled if it is fine.
fn terrain_triangles(samples: &periplus_rendering::HeightmapSamples) -> Vec<DVec3> {
    let step = samples.columns.max(samples.rows).div_ceil(MAX_POINTS).max(1);
    let places = |count: usize| -> Vec<usize> {
        let mut places: Vec<usize> = (0..count).step_by(step).collect();
        if places.last() != Some(&(count - 1)) {
            places.push(count - 1);
        }
        places
    };
    let along = |place: usize, count: usize, length: f64| {
        length * (place as f64 / (count - 1) as f64 - 0.5)
    };
    let [x_m, y_m] = samples.size_m;
    let point = |column: usize, row: usize| {
        let z = samples.heights_m[row * samples.columns + column];
        DVec3::new(along(column, samples.columns, x_m), along(row, samples.rows, y_m), z)
    };
    let (columns, rows) = (places(samples.columns), places(samples.rows));
    let mut points = Vec::new();
    for row in rows.windows(2) {
        for column in columns.windows(2) {
            let [a, b] = [point(column[0], row[0]), point(column[1], row[0])];
            let [c, d] = [point(column[0], row[1]), point(column[1], row[1])];
            points.extend([a, b, d, a, d, c]);
        }
    }
    points
}
