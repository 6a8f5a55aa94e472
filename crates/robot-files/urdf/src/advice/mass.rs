//! Estimate of a link's mass and inertia from its size.

use periplus_geometry::format_number;

use crate::robot::{UrdfGeometry, UrdfLink};

/// Mean density of a robot's body, hollow parts included [kg/m³]: small mobile robots (TurtleBot3,
/// Husky, Jackal) weigh 200 to 500 kg for each cubic metre of their bounding box.
const DENSITY_KG_PER_M3: f64 = 300.0;

/// Minimum mass that is suggested [kg].
const MIN_MASS_KG: f64 = 0.01;

/// Suggested `<inertial>` of a link, from its largest simple shape.
pub(crate) fn advised(link: &UrdfLink) -> String {
    let collisions = link.collisions.iter().map(|one| (&one.geometry, &one.link_from_collision));
    let visuals = link.visuals.iter().map(|one| (&one.geometry, &one.link_from_visual));
    let largest = collisions
        .chain(visuals)
        .filter_map(|(geometry, placement)| Some((extent_m(geometry)?, geometry, placement)))
        .max_by(|(a, ..), (b, ..)| volume_m3(*a).total_cmp(&volume_m3(*b)));
    let Some((extent, geometry, placement)) = largest else {
        return match link.collisions.is_empty() && link.visuals.is_empty() {
            true => "give it an <inertial> with a mass; 0.001 kg and 1e-6 kg m² about each axis \
                     are customary for a link that only marks a pose"
                .to_owned(),
            false => "give it an <inertial> with the mass of the real part, and m/12 (y² + z²), \
                      m/12 (x² + z²), m/12 (x² + y²) as ixx, iyy, izz, where x, y, z are the \
                      sizes of its mesh in metres"
                .to_owned(),
        };
    };
    let [x, y, z] = extent;
    let mass_kg = two_digits((DENSITY_KG_PER_M3 * volume_m3(extent)).max(MIN_MASS_KG));
    let moments = match geometry {
        UrdfGeometry::Cylinder { radius_m, length_m }
        | UrdfGeometry::Capsule { radius_m, length_m } => {
            let across = (3.0 * radius_m * radius_m + length_m * length_m) / 12.0;
            [across, across, radius_m * radius_m / 2.0]
        }
        UrdfGeometry::Sphere { radius_m } => [0.4 * radius_m * radius_m; 3],
        _ => [y * y + z * z, x * x + z * z, x * x + y * y].map(|squares| squares / 12.0),
    };
    let [ixx, iyy, izz] = moments.map(|moment| format_number(two_digits(mass_kg * moment)));
    let origin = origin_text(placement);
    format!(
        "give it an <inertial>; for a part of this size, for example <inertial>{origin}<mass \
         value=\"{}\"/><inertia ixx=\"{ixx}\" ixy=\"0\" ixz=\"0\" iyy=\"{iyy}\" iyz=\"0\" \
         izz=\"{izz}\"/></inertial>",
        format_number(mass_kg)
    )
}

/// `<origin>` of the shape, as the centre of mass is its middle.
fn origin_text(placement: &crate::robot::UrdfOrigin) -> String {
    let pose = placement.pose();
    if pose == periplus_geometry::Pose::IDENTITY {
        return String::new();
    }
    let text = |numbers: [f64; 3]| numbers.map(format_number).join(" ");
    let xyz = text(placement.xyz_m);
    let rpy = pose.rpy();
    let rpy = [rpy.roll, rpy.pitch, rpy.yaw].map(|angle| (angle * 1e6).round() / 1e6 + 0.0);
    format!("<origin xyz=\"{xyz}\" rpy=\"{}\"/>", text(rpy))
}

/// Extent along the shape's own axes; `None` for meshes and empty shapes.
fn extent_m(geometry: &UrdfGeometry) -> Option<[f64; 3]> {
    let extent = match *geometry {
        UrdfGeometry::Box { size_m } => size_m,
        UrdfGeometry::Cylinder { radius_m, length_m } => [2.0 * radius_m, 2.0 * radius_m, length_m],
        UrdfGeometry::Capsule { radius_m, length_m } => {
            [2.0 * radius_m, 2.0 * radius_m, length_m + 2.0 * radius_m]
        }
        UrdfGeometry::Sphere { radius_m } => [2.0 * radius_m; 3],
        UrdfGeometry::Mesh { .. } | UrdfGeometry::Unknown(_) => return None,
    };
    extent.iter().all(|size| *size > 0.0).then_some(extent)
}

fn volume_m3([x, y, z]: [f64; 3]) -> f64 {
    x * y * z
}

/// Rounds to two significant digits: an estimate should not look exact.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
