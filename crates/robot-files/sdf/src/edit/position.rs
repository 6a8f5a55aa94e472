//! Edits of `<pose>`.

use periplus_diagnostics::{Diagnostics, TextEdit};
use periplus_geometry::Pose;
use periplus_xml::Element;

use super::{Editor, WorldEditError};
use crate::read_pose;

/// Decimal places of written lengths and angles: micrometres and microradians.
const DECIMAL_PLACE_COUNT: usize = 6;
const DECIMAL_PLACE: f64 = 1e-6;

/// Decimal places of written quaternions.
const QUATERNION_DECIMAL_PLACE_COUNT: usize = 9;

/// Returns the edit that moves an element in the world from one pose to another. Numbers that stay are not touched.
pub(super) fn pose_edit(
    element: &Element,
    (from, to): (Pose, Pose),
    editor: &Editor<'_>,
) -> Result<TextEdit, WorldEditError> {
    let is_include = element.name == "include";
    let Some(child) = element.child("pose") else {
        let placement = placement_frame(element, is_include);
        if let Some(frame) = placement {
            return Err(WorldEditError::RelativePose { frame });
        }
        // An include without a pose has that of its file, and its own replaces it.
        let text = format!("<pose>{}</pose>", numbers(to, Format::default()).join(" "));
        return editor.first_child(element, &text);
    };
    let (written, relative_to) = read_pose(child, &mut Diagnostics::new());
    let relative_to = relative_to.map(|it| it.name.to_string()).filter(|it| it != "world");
    let old_frame = child.value("frame").filter(|it| !it.trim().is_empty() && *it != "world");
    if let Some(frame) = old_frame {
        return Err(WorldEditError::RelativePose { frame: frame.to_owned() });
    }
    let placement = placement_frame(element, is_include);
    let target = match (relative_to, placement) {
        // world_from_model * model_from_placement
        (None, _) => to * (from.inverse() * written),
        (Some(frame), None) => {
            let top = frame.split("::").next().unwrap_or_default();
            if editor.changing.iter().any(|it| it == top) {
                return Err(WorldEditError::RelativePose { frame });
            }
            // frame_from_world * world_from_model
            (written * from.inverse()) * to
        }
        (Some(frame), Some(_)) => return Err(WorldEditError::RelativePose { frame }),
    };
    let format = Format {
        is_quaternion: child.value("rotation_format") == Some("quat_xyzw"),
        is_degrees: child.value("degrees").is_some_and(|it| ["true", "1"].contains(&it.trim())),
    };
    let target = numbers(target, format);
    let Some(span) = child.text_origin().0.filter(|_| !child.text().is_empty()) else {
        return empty_pose(child, &target.join(" "), editor.text);
    };
    let range = span.start as usize..span.end as usize;
    let text = editor.text.get(range.clone()).ok_or(WorldEditError::Unexpected)?;
    if text.split_whitespace().count() != target.len() {
        return Err(WorldEditError::Unexpected);
    }
    let tolerance = 0.5 * DECIMAL_PLACE;
    let mut changed = String::new();
    let mut target = target.iter();
    for part in text.split_inclusive(char::is_whitespace) {
        let word = part.trim_end();
        if word.is_empty() {
            changed.push_str(part);
            continue;
        }
        let value: f64 = word.parse().map_err(|_| WorldEditError::Unexpected)?;
        let new = target.next().ok_or(WorldEditError::Unexpected)?;
        let is_same = new.parse().is_ok_and(|it: f64| (it - value).abs() <= tolerance);
        changed.push_str(if is_same { word } else { new });
        changed.push_str(&part[word.len()..]);
    }
    Ok(TextEdit { range, text: changed })
}

/// Returns the placement frame of a model or include.
fn placement_frame(element: &Element, is_include: bool) -> Option<String> {
    let attribute = element.value("placement_frame").map(str::to_owned);
    let child = element.child("placement_frame").filter(|_| is_include);
    let frame = child.map(|it| it.text().into_owned()).or(attribute);
    frame.filter(|it| !it.trim().is_empty())
}

/// Returns the edit of `<pose/>` or `<pose></pose>`.
fn empty_pose(child: &Element, numbers: &str, text: &str) -> Result<TextEdit, WorldEditError> {
    let end = child.origin.0.ok_or(WorldEditError::Unexpected)?.end as usize;
    if text.get(..end).is_some_and(|it| it.ends_with("/>")) {
        return Ok(TextEdit { range: end - 2..end, text: format!(">{numbers}</pose>") });
    }
    Ok(TextEdit { range: end..end, text: numbers.to_owned() })
}

/// Spelling of a pose.
#[derive(Clone, Copy, Default)]
struct Format {
    is_quaternion: bool,
    is_degrees: bool,
}

fn numbers(pose: Pose, format: Format) -> Vec<String> {
    let lengths = pose.translation.to_array().map(|it| number(it, DECIMAL_PLACE_COUNT));
    let mut numbers = lengths.to_vec();
    if format.is_quaternion {
        let rotation = pose.rotation.to_array();
        numbers.extend(rotation.map(|it| number(it, QUATERNION_DECIMAL_PLACE_COUNT)));
        return numbers;
    }
    let rpy = pose.rpy();
    for angle in [rpy.roll, rpy.pitch, rpy.yaw] {
        let angle = if format.is_degrees { angle.to_degrees() } else { angle };
        numbers.push(number(angle, DECIMAL_PLACE_COUNT));
    }
    numbers
}

/// Returns a decimal number without zeros at its end.
fn number(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
