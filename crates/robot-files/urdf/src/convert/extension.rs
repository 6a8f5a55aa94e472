//! `<gazebo>` blocks, sorted by what they speak about.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::Element;

use super::element::is_true;
use crate::lump::Preserved;
use crate::robot::{GazeboBlock, Robot};

/// Whom a setting of Gazebo is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum For {
    /// Each collision or visual of a link.
    Shapes,
    /// A link.
    Link,
    /// A joint.
    Joint,
    /// The robot.
    Robot,
    /// Nobody: it once meant something.
    Nobody,
}

/// The settings that Gazebo knows by names of its own (libsdformat, `ParseSDFExtension`); all
/// other elements are SDF and go where the reference points.
const SETTINGS: [(&str, For); 30] = [
    ("material", For::Shapes),
    ("collision", For::Shapes),
    ("visual", For::Shapes),
    ("mu", For::Shapes),
    ("mu1", For::Shapes),
    ("mu2", For::Shapes),
    ("fdir1", For::Shapes),
    ("kp", For::Shapes),
    ("kd", For::Shapes),
    ("maxVel", For::Shapes),
    ("minDepth", For::Shapes),
    ("laserRetro", For::Shapes),
    ("maxContacts", For::Shapes),
    ("turnGravityOff", For::Link),
    ("dampingFactor", For::Link),
    ("selfCollide", For::Link),
    ("springReference", For::Joint),
    ("springStiffness", For::Joint),
    ("stopCfm", For::Joint),
    ("stopErp", For::Joint),
    ("fudgeFactor", For::Joint),
    ("provideFeedback", For::Joint),
    ("cfmDamping", For::Joint),
    ("implicitSpringDamper", For::Joint),
    ("disableFixedJointLumping", For::Joint),
    ("preserveFixedJoint", For::Joint),
    ("static", For::Robot),
    ("canonicalBody", For::Nobody),
    // Misspellings of the two above that real files hold would go to SDF; these never meant
    // anything there.
    ("stopKp", For::Nobody),
    ("stopKd", For::Nobody),
];

/// Whom a setting is for; none for SDF.
pub(super) fn purpose(name: &str) -> Option<For> {
    SETTINGS.iter().find(|(known, _)| *known == name).map(|(_, purpose)| *purpose)
}

/// The blocks of a robot.
pub(super) struct Extensions<'a> {
    by_reference: BTreeMap<&'a str, Vec<&'a GazeboBlock>>,
}

impl<'a> Extensions<'a> {
    pub(super) fn new(robot: &'a Robot) -> Self {
        let mut by_reference: BTreeMap<&str, Vec<&GazeboBlock>> = BTreeMap::new();
        for block in &robot.gazebo {
            let reference = block.reference.as_deref().unwrap_or_default();
            by_reference.entry(reference).or_default().push(block);
        }
        Self { by_reference }
    }

    /// The blocks about a link or joint, or without a name about the robot.
    pub(super) fn about(&self, name: &str) -> &[&'a GazeboBlock] {
        self.by_reference.get(name).map_or(&[], Vec::as_slice)
    }

    /// The names of all that blocks speak about, with their blocks.
    pub(super) fn all(&self) -> impl Iterator<Item = (&'a str, &[&'a GazeboBlock])> {
        self.by_reference.iter().map(|(name, blocks)| (*name, blocks.as_slice()))
    }

    /// Everything said about a link, joint or robot.
    pub(super) fn settings(&self, name: &str) -> impl Iterator<Item = &'a Element> + '_ {
        self.about(name).iter().flat_map(|block| &block.content)
    }

    /// The fixed joints that the robot wants kept. Who asks for both is an old file that also
    /// knows the new way, which wins.
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

/// Warns about settings that stand where Gazebo reads none of their kind. `here` is what the
/// block speaks about.
pub(super) fn check_place(setting: &Element, here: &[For], diagnostics: &mut Diagnostics) {
    let Some(purpose) = purpose(&setting.name) else { return };
    if here.contains(&purpose) {
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
    let warning = match purpose {
        For::Nobody => Diagnostic::warning(
            "obsolete-setting",
            format!("`{}` no longer means anything to Gazebo", setting.name),
        )
        .help("leave it out"),
        _ => Diagnostic::warning(
            "misplaced-setting",
            format!("`{}` means nothing here", setting.name),
        )
        .help(match purpose {
            For::Joint => "it belongs in <gazebo reference=\"...\"> with the name of a joint",
            For::Robot => "it belongs in <gazebo> without a reference",
            _ => "it belongs in <gazebo reference=\"...\"> with the name of a link",
        }),
    };
    diagnostics.push(warning.at(setting.name_origin()).label("Gazebo ignores it"));
}
