//! Joints without `<axis>`, which turn about the default axis x.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;

use crate::robot::{JointType, UrdfGeometry, UrdfLink, UrdfRobot};
use crate::tree::Tree;

pub(super) fn check(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let tree = Tree::new(robot);
    for joint in &robot.joints {
        let moved = match joint.kind {
            JointType::Revolute | JointType::Continuous => "turns about",
            JointType::Prismatic => "slides along",
            JointType::Fixed | JointType::Planar | JointType::Floating => continue,
        };
        if joint.axis.is_some() {
            continue;
        }
        let name = &joint.name;
        let child = tree.index.get(&*joint.child).map(|&child| &robot.links[child]);
        let cylinder = child.filter(|_| joint.kind != JointType::Prismatic).and_then(cylinder_axis);
        // A wheel whose cylinder lies along x needs no axis.
        if cylinder == Some("1 0 0") {
            continue;
        }
        let warning = Diagnostic::warning(
            "missing-axis",
            format!(
                "the joint `{name}` has no `axis`, so it {moved} the x axis of the joint frame"
            ),
        )
        .at(joint.origin);
        diagnostics.push(match cylinder {
            Some(axis) => warning.help(format!(
                "write <axis xyz=\"{axis}\"/>: the cylinder of `{}` turns about it",
                joint.child
            )),
            None => warning.help(
                "write <axis xyz=\"0 1 0\"/> for a wheel of a robot that drives along x, \
                 <axis xyz=\"1 0 0\"/> if x is meant",
            ),
        });
    }
}

/// The axis of a link's only cylinder in the link's frame, when it lies along x, y or z.
fn cylinder_axis(link: &UrdfLink) -> Option<&'static str> {
    let collisions = link.collisions.iter().map(|one| (&one.geometry, &one.link_from_collision));
    let visuals = link.visuals.iter().map(|one| (&one.geometry, &one.link_from_visual));
    let mut cylinders = collisions
        .chain(visuals)
        .filter(|(geometry, _)| matches!(geometry, UrdfGeometry::Cylinder { .. }))
        .map(|(_, placement)| nearest(placement.pose().rotation * DVec3::Z));
    let first = cylinders.next()??;
    cylinders.all(|other| other == Some(first)).then_some(first)
}

fn nearest(direction: DVec3) -> Option<&'static str> {
    // Angles are often written as 1.57.
    const ALONG: f64 = 0.999;
    let axes = [(DVec3::X, "1 0 0"), (DVec3::Y, "0 1 0"), (DVec3::Z, "0 0 1")];
    axes.into_iter().find(|(axis, _)| axis.dot(direction).abs() > ALONG).map(|(_, text)| text)
}
