//! Static stability: the centre of mass must be above the support area of the wheels and other contacts.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose, format_number};

use crate::lump::WORLD;
use crate::robot::{JointType, UrdfCollision, UrdfGeometry, UrdfRobot};
use crate::tree::Tree;

/// Height above the lowest point up to which a point counts as a contact [m].
const CONTACT_BAND_M: f64 = 0.02;

/// Minimum distance of the centre of mass from the edge of the support area [m].
const MARGIN_M: f64 = 0.001;

/// Points on the rim of an upright cylinder.
const RIM_POINTS: u8 = 8;

/// Point that may touch the floor, with its link.
struct Contact {
    link: usize,
    model_from_point_m: DVec3,
}

pub(super) fn check(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let tree = Tree::new(robot);
    let [root] = *tree.roots else { return };
    if robot.links[root].name == WORLD {
        return;
    }
    let order = tree.below(root);
    let poses = poses(robot, &tree, &order);
    let Some(contacts) = contacts(robot, &order, &poses) else { return };
    let carriers: BTreeSet<usize> = contacts.iter().map(|contact| contact.link).collect();
    let is_wheel = |link: &usize| {
        tree.joint_above[*link].is_some_and(|j| robot.joints[j].kind == JointType::Continuous)
    };
    if carriers.is_empty() || !carriers.iter().all(is_wheel) {
        return;
    }
    let Some(centre) = centre_of_mass(robot, &order, &poses) else { return };
    let points: Vec<[f64; 2]> =
        contacts.iter().map(|at| [at.model_from_point_m.x, at.model_from_point_m.y]).collect();
    if distance_inside(&points, [centre.x, centre.y]) >= MARGIN_M {
        return;
    }
    let names: Vec<String> =
        carriers.iter().map(|&link| format!("`{}`", robot.links[link].name)).collect();
    let floor = contacts.iter().map(|at| at.model_from_point_m.z).fold(f64::INFINITY, f64::min);
    let first = carriers.first().map_or(robot.origin, |&link| robot.links[link].origin);
    diagnostics.push(
        Diagnostic::warning(
            "unstable",
            format!("the robot stands on {} alone, so it tips over", names.join(" and ")),
        )
        .at(first)
        .note(format!(
            "its centre of mass is at x {}, y {}, outside the area between these contacts",
            rounded(centre.x),
            rounded(centre.y)
        ))
        .help(format!(
            "add a caster: a link on a fixed joint with a <sphere> as <collision> whose lowest \
             point is at z {} of `{}`, and <mu1>0</mu1> and <mu2>0</mu2> in its <gazebo> block",
            rounded(floor),
            robot.links[root].name
        )),
    );
}

/// Rounds to millimetres, enough for a message.
fn rounded(length_m: f64) -> String {
    format_number((length_m * 1000.0).round() / 1000.0 + 0.0)
}

/// The pose of each link in the root's frame, all joints at zero.
fn poses(robot: &UrdfRobot, tree: &Tree<'_>, order: &[usize]) -> Vec<Pose> {
    let mut poses = vec![Pose::IDENTITY; robot.links.len()];
    for &link in order {
        if let (Some(parent), Some(joint)) = (tree.parent[link], tree.joint_above[link]) {
            poses[link] = poses[parent] * robot.joints[joint].parent_from_joint.pose();
        }
    }
    poses
}

/// Lowest points of the robot; `None` if the extent of a shape is not known, such as that of a mesh.
fn contacts(robot: &UrdfRobot, order: &[usize], poses: &[Pose]) -> Option<Vec<Contact>> {
    let mut points = Vec::new();
    for &link in order {
        for collision in &robot.links[link].collisions {
            for model_from_point_m in low_points(collision, poses[link])? {
                points.push(Contact { link, model_from_point_m });
            }
        }
    }
    let lowest =
        points.iter().map(|point| point.model_from_point_m.z).fold(f64::INFINITY, f64::min);
    points.retain(|point| point.model_from_point_m.z <= lowest + CONTACT_BAND_M);
    Some(points)
}

/// Points of a shape that include its lowest ones.
fn low_points(collision: &UrdfCollision, model_from_link: Pose) -> Option<Vec<DVec3>> {
    let pose = model_from_link * collision.link_from_collision.pose();
    let axis = pose.rotation * DVec3::Z;
    match collision.geometry {
        UrdfGeometry::Box { size_m } => {
            let half = DVec3::from_array(size_m) * 0.5;
            let corner = |index: u8| {
                let sign = |bit: u8| if index & bit == 0 { -1.0 } else { 1.0 };
                pose.translation + pose.rotation * (half * DVec3::new(sign(1), sign(2), sign(4)))
            };
            Some((0..8).map(corner).collect())
        }
        UrdfGeometry::Sphere { radius_m } => Some(vec![pose.translation - radius_m * DVec3::Z]),
        UrdfGeometry::Capsule { radius_m, length_m } => {
            let end = |sign: f64| pose.translation + sign * 0.5 * length_m * axis;
            Some([1.0, -1.0].map(|sign| end(sign) - radius_m * DVec3::Z).to_vec())
        }
        UrdfGeometry::Cylinder { radius_m, length_m } => {
            let ends = [1.0, -1.0].map(|sign| pose.translation + sign * 0.5 * length_m * axis);
            let down = DVec3::Z - axis.z * axis;
            Some(match down.try_normalize() {
                // On its side: one line touches.
                Some(down) if down.z > CONTACT_BAND_M => {
                    ends.map(|end| end - radius_m * down).to_vec()
                }
                _ => {
                    let rim = |index: u8| {
                        let angle =
                            std::f64::consts::TAU * f64::from(index) / f64::from(RIM_POINTS);
                        let (sine, cosine) = libm::sincos(angle);
                        pose.rotation * DVec3::new(radius_m * cosine, radius_m * sine, 0.0)
                    };
                    ends.into_iter()
                        .flat_map(|end| (0..RIM_POINTS).map(move |index| end + rim(index)))
                        .collect()
                }
            })
        }
        UrdfGeometry::Mesh { .. } | UrdfGeometry::Unknown(_) => None,
    }
}

fn centre_of_mass(robot: &UrdfRobot, order: &[usize], poses: &[Pose]) -> Option<DVec3> {
    let mut mass_kg = 0.0;
    let mut moment = DVec3::ZERO;
    for &link in order {
        let Some(inertial) = &robot.links[link].inertial else { continue };
        let centre = (poses[link] * inertial.link_from_inertial.pose()).translation;
        mass_kg += inertial.mass_kg;
        moment += inertial.mass_kg * centre;
    }
    (mass_kg > 0.0).then(|| moment / mass_kg)
}

/// Distance of a point from the edge of the convex hull of others; negative outside, and if the hull has no
/// area.
fn distance_inside(points: &[[f64; 2]], point: [f64; 2]) -> f64 {
    let hull = convex_hull(points);
    if hull.len() < 3 {
        return f64::NEG_INFINITY;
    }
    let edges = hull.iter().zip(hull.iter().cycle().skip(1));
    edges
        .map(|(a, b)| {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            (dx * (point[1] - a[1]) - dy * (point[0] - a[0])) / libm::hypot(dx, dy)
        })
        .fold(f64::INFINITY, f64::min)
}

/// The convex hull, counter-clockwise (A. M. Andrew's monotone chain, 1979).
fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) <= 1e-12
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}
