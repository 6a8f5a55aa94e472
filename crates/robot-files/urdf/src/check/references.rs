//! References between elements of the file.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};

use super::structure::MAX_COMPARED_NAMES;
use crate::robot::{UrdfMaterial, UrdfRobot};

/// A mimic must name another joint.
pub(super) fn mimics(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let names: BTreeSet<&str> = robot.joints.iter().map(|joint| &*joint.name).collect();
    let mut suggestions = MAX_COMPARED_NAMES;
    for joint in &robot.joints {
        let Some(mimic) = &joint.mimic else { continue };
        if mimic.joint == joint.name {
            diagnostics.push(
                Diagnostic::error("unknown-joint", format!("`{}` mimics itself", joint.name))
                    .at(mimic.origin)
                    .help("write the name of another joint"),
            );
        } else if !names.contains(&*mimic.joint) {
            diagnostics.push(
                Diagnostic::warning(
                    "unknown-joint",
                    format!("`{}` mimics `{}`, which is not a joint", joint.name, mimic.joint),
                )
                .at(mimic.origin)
                .note("ROS and Gazebo accept the robot; the joint moves independently")
                .did_you_mean(
                    mimic.origin,
                    &mimic.joint,
                    names.iter().copied().take(suggestions),
                ),
            );
            suggestions = suggestions.saturating_sub(names.len());
        }
    }
}

/// A visual's material must be defined somewhere, and not in two ways.
pub(super) fn materials(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let mut defined: BTreeMap<&str, &UrdfMaterial> = BTreeMap::new();
    let in_place = || {
        let visuals = robot.links.iter().flat_map(|link| &link.visuals);
        visuals.filter_map(|visual| visual.material.as_ref())
    };
    for material in robot.materials.iter().filter(|material| material.is_definition()) {
        defined.entry(&material.name).or_insert(material);
    }
    for material in in_place().filter(|material| material.is_definition()) {
        // An empty name cannot be referred to, so such materials never clash.
        if material.name.is_empty() {
            continue;
        }
        let first = *defined.entry(&material.name).or_insert(material);
        let colour = |material: &UrdfMaterial| material.colour.as_ref().map(|colour| colour.rgba);
        let texture = |material: &UrdfMaterial| {
            material.texture.as_ref().map(|texture| texture.filename.clone())
        };
        if colour(first) != colour(material) || texture(first) != texture(material) {
            diagnostics.push(
                Diagnostic::warning(
                    "material-redefined",
                    format!("the material `{}` is defined in two ways", material.name),
                )
                .at(material.origin)
                .label("not used: the first definition of a name wins")
                .related(first.origin, "the first definition")
                .help("give the second one a different name"),
            );
        }
    }
    let mut suggestions = MAX_COMPARED_NAMES;
    for material in in_place().filter(|material| !material.is_definition()) {
        if material.name.is_empty() || defined.contains_key(&*material.name) {
            continue;
        }
        let warning = Diagnostic::warning(
            "unknown-material",
            format!("no material is named `{}`", material.name),
        )
        .at(material.origin);
        let known = defined.keys().copied().take(suggestions);
        suggestions = suggestions.saturating_sub(defined.len());
        diagnostics.push(match periplus_diagnostics::closest(&material.name, known) {
            Some(near) => warning.help(format!("did you mean `{near}`?")),
            None => warning.help(format!(
                "write <material name=\"{}\"><color rgba=\"1 0 0 1\"/></material> in the robot",
                material.name
            )),
        });
    }
}

/// A `<gazebo reference>` must name a link or joint.
pub(super) fn gazebo(robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
    let links = robot.links.iter().map(|link| &*link.name);
    let names: BTreeSet<&str> =
        links.chain(robot.joints.iter().map(|joint| &*joint.name)).collect();
    let mut suggestions = MAX_COMPARED_NAMES;
    for block in &robot.gazebo {
        let Some(reference) = &block.reference else { continue };
        // Gazebo takes an empty reference for none.
        if reference.is_empty() || names.contains(&**reference) {
            continue;
        }
        diagnostics.push(
            Diagnostic::warning(
                "unknown-reference",
                format!("no link or joint is named `{reference}`"),
            )
            .at(block.origin)
            .label("Gazebo ignores the whole block")
            .did_you_mean(
                block.origin,
                reference,
                names.iter().copied().take(suggestions),
            ),
        );
        suggestions = suggestions.saturating_sub(names.len());
    }
}
