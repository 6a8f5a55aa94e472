//! Names of joints. In SDF they share one namespace with links.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::robot::{UrdfJoint, UrdfRobot};

/// SDF names of joints: the URDF name, unless a link has the same one.
pub(super) struct JointNames<'a> {
    joints: BTreeSet<&'a str>,
    changed: BTreeMap<&'a str, String>,
}

impl<'a> JointNames<'a> {
    pub(super) fn new(robot: &'a UrdfRobot) -> Self {
        let links: BTreeSet<&str> = robot.links.iter().map(|link| &*link.name).collect();
        let joints: BTreeSet<&'a str> = robot.joints.iter().map(|joint| &*joint.name).collect();
        let mut changed = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for name in joints.iter().copied().filter(|name| links.contains(name)) {
            let mut new = format!("{name}_joint");
            while links.contains(&*new) || joints.contains(&*new) || taken.contains(&new) {
                new.push('_');
            }
            taken.insert(new.clone());
            changed.insert(name, new);
        }
        Self { joints, changed }
    }

    pub(super) fn is_joint(&self, name: &str) -> bool {
        self.joints.contains(name)
    }

    pub(super) fn of<'b>(&'b self, joint: &'b str) -> &'b str {
        self.changed.get(joint).map_or(joint, String::as_str)
    }

    /// Warns about each joint that is renamed.
    pub(super) fn check(&self, robot: &UrdfRobot, diagnostics: &mut Diagnostics) {
        for joint in &robot.joints {
            let Some(new) = self.changed.get(&*joint.name) else { continue };
            diagnostics.push(shared(joint, new).related(
                robot.link(&joint.name).map_or_else(Default::default, |link| link.origin),
                "the link",
            ));
        }
    }
}

fn shared(joint: &UrdfJoint, new: &str) -> Diagnostic {
    Diagnostic::warning(
        "shared-name",
        format!("a link and a joint are both named `{}`", joint.name),
    )
    .at(joint.origin)
    .label(format!("here this joint becomes `{new}`"))
    .note("ROS allows it; Gazebo refuses the robot, for in SDF they share one namespace")
    .help("rename the joint")
}
