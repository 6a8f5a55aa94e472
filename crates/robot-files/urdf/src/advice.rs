//! Warnings about robots that are valid but do not behave as intended in a simulation.

mod axis;
mod balance;
pub(crate) mod mass;

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::robot::UrdfRobot;

/// Reports common mistakes in a first robot: no collision shapes, a joint without an axis, two wheels
/// without a caster. None of them is an error in URDF.
pub fn advise(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    without_collisions(robot, diagnostics);
    axis::check(robot, diagnostics);
    balance::check(robot, diagnostics);
}

/// Robot with mass and visuals but no collision shape.
fn without_collisions(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let has_mass = robot.links.iter().any(|link| link.inertial.is_some());
    let shown = robot.links.iter().find(|link| !link.visuals.is_empty());
    let (true, Some(shown)) = (has_mass, shown) else { return };
    if robot.links.iter().any(|link| !link.collisions.is_empty()) {
        return;
    }
    diagnostics.push(
        Diagnostic::warning("no-collision", "no link of the robot has a `collision`")
            .at(shown.origin)
            .label("for example this one has only a `visual`")
            .note("in a simulation the robot falls through the floor and drives through walls")
            .help(
                "give each wheel, caster and the body a <collision> with the <origin> and \
                 <geometry> of its <visual>; simple shapes are best",
            ),
    );
}

#[cfg(test)]
mod tests;
