//! `<gazebo>` blocks by their reference.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::Element;

use super::element::is_true;
use crate::lump::Preserved;
use crate::robot::{GazeboBlock, UrdfRobot};

/// Target of one of Gazebo's settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SettingTarget {
    /// Each collision or visual of a link.
    Shapes,
    /// A link.
    Link,
    /// A joint.
    Joint,
    /// The robot.
    Robot,
    /// No target: an obsolete setting.
    Obsolete,
}

/// Settings that Gazebo knows by their own names (libsdformat, `ParseSDFExtension`). All other elements are
/// SDF and are copied to the referenced element.
const SETTINGS: [(&str, SettingTarget); 30] = [
    ("material", SettingTarget::Shapes),
    ("collision", SettingTarget::Shapes),
    ("visual", SettingTarget::Shapes),
    ("mu", SettingTarget::Shapes),
    ("mu1", SettingTarget::Shapes),
    ("mu2", SettingTarget::Shapes),
    ("fdir1", SettingTarget::Shapes),
    ("kp", SettingTarget::Shapes),
    ("kd", SettingTarget::Shapes),
    ("maxVel", SettingTarget::Shapes),
    ("minDepth", SettingTarget::Shapes),
    ("laserRetro", SettingTarget::Shapes),
    ("maxContacts", SettingTarget::Shapes),
    ("turnGravityOff", SettingTarget::Link),
    ("dampingFactor", SettingTarget::Link),
    ("selfCollide", SettingTarget::Link),
    ("springReference", SettingTarget::Joint),
    ("springStiffness", SettingTarget::Joint),
    ("stopCfm", SettingTarget::Joint),
    ("stopErp", SettingTarget::Joint),
    ("fudgeFactor", SettingTarget::Joint),
    ("provideFeedback", SettingTarget::Joint),
    ("cfmDamping", SettingTarget::Joint),
    ("implicitSpringDamper", SettingTarget::Joint),
    ("disableFixedJointLumping", SettingTarget::Joint),
    ("preserveFixedJoint", SettingTarget::Joint),
    ("static", SettingTarget::Robot),
    ("canonicalBody", SettingTarget::Obsolete),
    // Misspellings of the two above that occur in real files would be copied as SDF; these never had an
    // effect there.
    ("stopKp", SettingTarget::Obsolete),
    ("stopKd", SettingTarget::Obsolete),
];

/// Target of a setting; `None` for SDF.
pub(super) fn setting_target(name: &str) -> Option<SettingTarget> {
    SETTINGS.iter().find(|(known, _)| *known == name).map(|(_, setting_target)| *setting_target)
}

/// `<gazebo>` blocks of a robot.
pub(super) struct Extensions<'a> {
    by_reference: BTreeMap<&'a str, Vec<&'a GazeboBlock>>,
}

impl<'a> Extensions<'a> {
    pub(super) fn new(robot: &'a UrdfRobot) -> Self {
        let mut by_reference: BTreeMap<&str, Vec<&GazeboBlock>> = BTreeMap::new();
        for block in &robot.gazebo {
            let reference = block.reference.as_deref().unwrap_or_default();
            by_reference.entry(reference).or_default().push(block);
        }
        Self { by_reference }
    }

    /// Blocks of a link or joint, or with an empty name of the robot.
    pub(super) fn about(&self, name: &str) -> &[&'a GazeboBlock] {
        self.by_reference.get(name).map_or(&[], Vec::as_slice)
    }

    /// All references with their blocks.
    pub(super) fn all(&self) -> impl Iterator<Item = (&'a str, &[&'a GazeboBlock])> {
        self.by_reference.iter().map(|(name, blocks)| (*name, blocks.as_slice()))
    }

    /// All settings of a link, joint or robot.
    pub(super) fn settings(&self, name: &str) -> impl Iterator<Item = &'a Element> + '_ {
        self.about(name).iter().flat_map(|block| &block.content)
    }

    /// Fixed joints that the robot wants to keep. If a file asks for both kinds, the newer one wins: the
    /// other is there for older versions of Gazebo.
    pub(super) fn preserved(&self) -> Preserved<'a> {
        let mut preserved = Preserved::default();
        for (name, blocks) in &self.by_reference {
            for setting in blocks.iter().flat_map(|block| &block.content) {
                if setting.name == "preserveFixedJoint" && is_true(setting) {
                    preserved.fixed.insert(*name);
                }
                if setting.name == "disableFixedJointLumping" && is_true(setting) {
                    preserved.hinge.insert(*name);
                }
            }
        }
        for name in &preserved.fixed {
            preserved.hinge.remove(name);
        }
        preserved
    }
}

/// Warns about settings in a block where Gazebo reads none of their kind. `here` is the kind of the block's
/// reference.
pub(super) fn check_place(
    setting: &Element,
    here: &[SettingTarget],
    diagnostics: &mut Diagnostics,
) {
    let Some(setting_target) = setting_target(&setting.name) else { return };
    if here.contains(&setting_target) {
        if setting.name == "mu" {
            diagnostics.push(
                Diagnostic::warning("misplaced-setting", "here Gazebo reads `mu1`, not `mu`")
                    .at(setting.name_origin())
                    .label("taken as `mu1`; Gazebo would ignore it")
                    .replace(setting.name_origin(), "mu1", "write `mu1`"),
            );
        }
        return;
    }
    let warning = match setting_target {
        SettingTarget::Obsolete => Diagnostic::warning(
            "obsolete-setting",
            format!("Gazebo no longer reads `{}`", setting.name),
        )
        .help("leave it out"),
        _ => Diagnostic::warning(
            "misplaced-setting",
            format!("`{}` has no effect here", setting.name),
        )
        .help(match setting_target {
            SettingTarget::Joint => {
                "it belongs in <gazebo reference=\"...\"> with the name of a joint"
            }
            SettingTarget::Robot => "it belongs in <gazebo> without a reference",
            _ => "it belongs in <gazebo reference=\"...\"> with the name of a link",
        }),
    };
    diagnostics.push(warning.at(setting.name_origin()).label("Gazebo ignores it"));
}
