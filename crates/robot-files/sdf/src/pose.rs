//! `<pose>` and the frame that it is relative to.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{DQuat, DVec3, Pose, Rpy};
use periplus_xml::{Element, SmolStr};

use crate::fields::Fields;
use crate::value::{all_numbers, boolean_word, leaf, wrong_number_of_values};

/// Name of a frame as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The name, scoped: `arm::hand`.
    pub name: SmolStr,
    /// Source location.
    pub origin: Origin,
}

/// Element with a pose that may be relative to a named frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PosedElement<T> {
    /// The element; its pose is as written.
    pub value: T,
    /// Frame that the pose is relative to; `None` for the default.
    pub relative_to: Option<Reference>,
}

impl Fields<'_, '_> {
    /// Child `<pose>`, and the frame that it is relative to.
    pub(crate) fn pose(&mut self) -> (Pose, Option<Reference>) {
        match self.child("pose") {
            Some(element) => read_pose(element, self.diagnostics),
            None => (Pose::IDENTITY, None),
        }
    }

    /// Child `<pose>` of an element that SDF fixes to its parent.
    pub(crate) fn fixed_pose(&mut self, parent: &str) -> Pose {
        let (pose, relative_to) = self.pose();
        if let Some(frame) = relative_to {
            let message = format!(
                "the pose of `<{}>` is always relative to its {parent}, never to `{}`",
                self.element.name, frame.name
            );
            self.diagnostics.push(
                Diagnostic::warning("fixed-frame", message)
                    .at(frame.origin)
                    .note("the attribute is left out"),
            );
        }
        pose
    }
}

/// Reads `<pose relative_to="frame" degrees="true" rotation_format="quat_xyzw">`. Lengths in
/// metres, angles in radians unless `degrees` is set; a pose that cannot be read is the identity.
pub fn read_pose(element: &Element, diagnostics: &mut Diagnostics) -> (Pose, Option<Reference>) {
    leaf(element, &["relative_to", "degrees", "rotation_format", "frame"], diagnostics);
    let relative_to = element
        .attribute("relative_to")
        .filter(|attribute| !attribute.value.trim().is_empty())
        .map(|attribute| Reference {
            name: attribute.value.trim().into(),
            origin: attribute.value_origin,
        });
    (numbers(element, diagnostics).unwrap_or_default(), relative_to)
}

fn numbers(element: &Element, diagnostics: &mut Diagnostics) -> Option<Pose> {
    let degrees = element.attribute("degrees").is_some_and(|attribute| {
        boolean_word(&attribute.value, attribute.value_origin, diagnostics).unwrap_or(false)
    });
    let quaternion = match element.value("rotation_format") {
        None | Some("euler_rpy") => false,
        Some("quat_xyzw") => true,
        Some(other) => {
            let origin = element.attribute("rotation_format").map(|it| it.value_origin);
            diagnostics.push(
                Diagnostic::error(
                    "unknown-rotation-format",
                    format!("`{other}` is not a rotation format"),
                )
                .at(origin.unwrap_or_default())
                .help("write `euler_rpy` or `quat_xyzw`"),
            );
            return None;
        }
    };
    let found = all_numbers(element, diagnostics)?;
    match (quaternion, found.as_slice()) {
        (_, []) => Some(Pose::IDENTITY),
        (false, [x, y, z, roll, pitch, yaw]) => {
            let angle = |value: &f64| if degrees { value.to_radians() } else { *value };
            let rpy = Rpy { roll: angle(roll), pitch: angle(pitch), yaw: angle(yaw) };
            Some(Pose::from_xyz_rpy([*x, *y, *z], rpy))
        }
        (true, [x, y, z, qx, qy, qz, qw]) => {
            let rotation = DQuat::from_xyzw(*qx, *qy, *qz, *qw);
            let length = rotation.length();
            if !(1e-6..1e6).contains(&length) {
                diagnostics.push(
                    Diagnostic::error("bad-quaternion", "this quaternion has length zero")
                        .at(element.text_origin())
                        .note("a rotation is a quaternion x y z w of length 1"),
                );
                return Some(Pose { translation: DVec3::new(*x, *y, *z), ..Pose::IDENTITY });
            }
            if (length - 1.0).abs() > 1e-3 {
                diagnostics.push(
                    Diagnostic::warning(
                        "bad-quaternion",
                        "this quaternion is not of length 1; it is scaled",
                    )
                    .at(element.text_origin()),
                );
            }
            Some(Pose::from_xyz_quaternion([*x, *y, *z], rotation))
        }
        (false, other) => {
            wrong_number_of_values(element, "6 (x y z roll pitch yaw)", other.len(), diagnostics);
            None
        }
        (true, other) => {
            wrong_number_of_values(element, "7 (x y z qx qy qz qw)", other.len(), diagnostics);
            None
        }
    }
}
