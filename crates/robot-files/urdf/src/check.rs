//! Validity of a robot: unique names, one tree, possible inertias, references that resolve.

mod inertia;
mod references;
mod structure;

use periplus_diagnostics::Diagnostics;
use periplus_xml::Element;

use crate::robot::UrdfRobot;

/// Checks a robot. `root` is the element that it was read from.
pub(crate) fn check(robot: &UrdfRobot, root: &Element, diagnostics: &mut Diagnostics) {
    structure::unique_names(robot, diagnostics);
    structure::one_tree(robot, root, diagnostics);
    inertia::check(robot, diagnostics);
    references::mimics(robot, diagnostics);
    references::materials(robot, diagnostics);
    references::gazebo(robot, diagnostics);
}
