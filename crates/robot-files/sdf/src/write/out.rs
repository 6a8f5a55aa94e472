//! Element under construction.

use periplus_geometry::{DVec3, Pose, Rpy, format_number, parse_number, quaternion_from_rpy};
use periplus_scene::Colour;
use periplus_xml::{Element, SmolStr, XmlNode};

/// Element under construction; default values are left out.
pub(super) struct Out {
    element: Element,
}

impl Out {
    pub(super) fn new(name: &str) -> Self {
        Self { element: Element::new(name) }
    }

    pub(super) fn named(element: &str, name: &str) -> Self {
        let mut out = Self::new(element);
        out.attribute("name", name);
        out
    }

    pub(super) fn attribute(&mut self, name: &str, value: impl AsRef<str>) {
        let element = std::mem::replace(&mut self.element, Element::new(""));
        self.element = element.with_attribute(name, SmolStr::new(value.as_ref()));
    }

    pub(super) fn push(&mut self, child: Element) {
        self.element.push(child);
    }

    /// Adds a child, unless it is empty.
    pub(super) fn push_filled(&mut self, child: Element) {
        if !child.children.is_empty() || !child.attributes.is_empty() {
            self.push(child);
        }
    }

    pub(super) fn text(&mut self, name: &str, text: impl AsRef<str>) {
        self.push(Element::new(name).with_text(SmolStr::new(text.as_ref())));
    }

    pub(super) fn optional(&mut self, name: &str, text: &Option<String>) {
        if let Some(text) = text {
            self.text(name, text);
        }
    }

    pub(super) fn always(&mut self, name: &str, value: f64) {
        self.text(name, format_number(value));
    }

    pub(super) fn number(&mut self, name: &str, value: f64, default: f64) {
        if value != default {
            self.always(name, value);
        }
    }

    pub(super) fn count(&mut self, name: &str, value: u32, default: u32) {
        if value != default {
            self.text(name, value.to_string());
        }
    }

    pub(super) fn flag(&mut self, name: &str, value: bool, default: bool) {
        if value != default {
            self.text(name, value.to_string());
        }
    }

    pub(super) fn vector(&mut self, name: &str, value: DVec3) {
        self.text(name, numbers(&value.to_array()));
    }

    /// Direction, and the frame in which it is expressed.
    pub(super) fn vector_in(&mut self, name: &str, value: DVec3, frame: Option<&str>) {
        let mut element = Element::new(name).with_text(numbers(&value.to_array()));
        if let Some(frame) = frame {
            element = element.with_attribute("gz:expressed_in", frame);
        }
        self.push(element);
    }

    pub(super) fn colour(&mut self, name: &str, colour: Colour) {
        self.text(name, numbers(&colour.0));
    }

    /// `<pose>` in the frame of the fixed parent.
    pub(super) fn pose(&mut self, pose: Pose) {
        if pose != Pose::IDENTITY {
            self.push(write_pose(pose));
        }
    }

    /// Returns the element, with the content that its reader kept put back.
    pub(super) fn finish(mut self, extra: &[Element]) -> Element {
        put_back(&mut self.element, extra);
        self.element
    }
}

/// Puts back the content kept by the reader. If a child of the same name was written, the kept content is
/// added to that child.
fn put_back(element: &mut Element, extra: &[Element]) {
    let written = element.children.len();
    for rest in extra {
        let same = element.children[..written].iter_mut().find_map(|node| match node {
            XmlNode::Element(child) if child.name == rest.name => Some(child),
            _ => None,
        });
        match same {
            Some(child) => {
                let inner: Vec<Element> = rest.elements().cloned().collect();
                put_back(child, &inner);
            }
            None => element.push(rest.clone()),
        }
    }
}

pub(super) fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| format_number(*value)).collect::<Vec<_>>().join(" ")
}

/// `<pose>`: angles if they give the same rotation to the last bit, else the quaternion.
pub(super) fn write_pose(pose: Pose) -> Element {
    let translation = numbers(&pose.translation.to_array());
    let element = Element::new("pose");
    if let Some([roll, pitch, yaw]) = angles(pose) {
        return element.with_text(format!("{translation} {roll} {pitch} {yaw}"));
    }
    element
        .with_attribute("rotation_format", "quat_xyzw")
        .with_text(format!("{translation} {}", numbers(&pose.rotation.to_array())))
}

/// Roll, pitch and yaw that give exactly this rotation, with as few digits as possible.
fn angles(pose: Pose) -> Option<[String; 3]> {
    let Rpy { roll, pitch, yaw } = pose.rpy();
    let exact = |texts: &[String; 3]| {
        let [roll, pitch, yaw] = texts.each_ref().map(|text| parse_number(text));
        let rpy = Rpy { roll: roll?, pitch: pitch?, yaw: yaw? };
        let again = quaternion_from_rpy(rpy).to_array();
        (again.map(f64::to_bits) == pose.rotation.to_array().map(f64::to_bits)).then_some(())
    };
    let rounded = [4, 6, 9, 12, 15].map(|digits| {
        [roll, pitch, yaw].map(|angle| {
            let text = format!("{angle:.digits$}");
            format_number(parse_number(&text).unwrap_or(angle) + 0.0)
        })
    });
    let full = [roll, pitch, yaw].map(format_number);
    rounded.into_iter().chain([full]).find(|texts| exact(texts).is_some())
}

/// Degrees that give exactly these radians when they are read, if they exist; else the nearest.
pub(super) fn degrees(radians: f64) -> String {
    let nearest = radians.to_degrees();
    let rounded = [4, 6, 9, 12].map(|digits| format!("{nearest:.digits$}"));
    let rounded = rounded.iter().filter_map(|text| parse_number(text));
    let up = std::iter::successors(Some(nearest), |value| Some(value.next_up()));
    let down = std::iter::successors(Some(nearest), |value| Some(value.next_down()));
    let found = rounded.chain(up.take(8)).chain(down.take(8)).find(|it| it.to_radians() == radians);
    format_number(found.unwrap_or(nearest))
}
