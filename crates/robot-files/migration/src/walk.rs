//! Walk through the elements of a file.

mod bodies;
mod materials;
mod sensors;
mod worlds;

use periplus_diagnostics::SourceFile;
use periplus_plugin_specs::Family;
use periplus_xml::{Document, Element};

use crate::bridge::BridgeEntry;
use crate::edits::Edits;
use crate::entry::{ExpectedDifference, MigrationEntry, MigrationOutcome};
use crate::old_plugin::{OldPlugin, Surroundings};
use crate::replacement::{AttachmentParent, Replacement, SensorChange};
use crate::{Migrated, MigrationContext, plugin, template, transmission};

/// Walk with its results.
struct Walker<'a> {
    file: &'a SourceFile,
    context: &'a MigrationContext<'a>,
    edits: Edits<'a>,
    entries: Vec<MigrationEntry>,
    bridge: Vec<BridgeEntry>,
    expected: Vec<ExpectedDifference>,
    ros: Option<Family>,
    /// True for a version of SDF from before the first release of current Gazebo.
    is_old_version: bool,
    /// Changes of the sensor that is being converted.
    sensor_changes: Vec<SensorChange>,
    /// True if a plugin gave that sensor a topic.
    has_topic: bool,
}

pub(crate) fn walk(
    document: &Document,
    file: &SourceFile,
    context: &MigrationContext<'_>,
) -> Option<Migrated> {
    if is_for_current_gazebo(&document.root) {
        let text = file.text.to_string();
        return Some(Migrated {
            text,
            entries: Vec::new(),
            bridge: Vec::new(),
            expected: Vec::new(),
        });
    }
    let mut walker = Walker {
        file,
        context,
        edits: Edits::new(&file.text),
        entries: Vec::new(),
        bridge: Vec::new(),
        expected: Vec::new(),
        ros: context.ros,
        is_old_version: document.root.value("version").is_some_and(is_old_version),
        sensor_changes: Vec::new(),
        has_topic: false,
    };
    let is_urdf = !matches!(document.root.local_name(), "sdf" | "gazebo");
    let model = is_urdf.then_some(&document.root);
    walker.element(&document.root, Surroundings { model, is_urdf, ..Surroundings::default() });
    let text = walker.edits.apply()?;
    let Walker { mut entries, mut bridge, mut expected, .. } = walker;
    entries.sort_by_key(|entry| (entry.line, entry.column));
    let mut seen = Vec::new();
    bridge.retain(|entry| {
        let is_new = !seen.contains(entry);
        if is_new {
            seen.push(entry.clone());
        }
        is_new
    });
    expected.dedup();
    Some(Migrated { text, entries, bridge, expected })
}

/// True for SDF up to 1.6, the version of Gazebo Classic 9.
fn is_old_version(version: &str) -> bool {
    let minor = version.trim().strip_prefix("1.").and_then(|minor| minor.parse::<u32>().ok());
    minor.is_some_and(|minor| minor <= 6)
}

/// True for a file with plugins of current Gazebo and none of Gazebo Classic: old spellings that it may have are known to
/// libsdformat.
fn is_for_current_gazebo(root: &Element) -> bool {
    let (mut current, mut classic) = (0, 0);
    count_plugins(root, &mut current, &mut classic);
    current > 0 && classic == 0
}

fn count_plugins(element: &Element, current: &mut usize, classic: &mut usize) {
    for child in element.elements() {
        if child.name == "plugin" && child.attribute("filename").is_some() {
            let old = OldPlugin::read(child, Surroundings::default(), None);
            match old.spec {
                _ if !plugin::is_classic(&old) => *current += 1,
                Some(_) => *classic += 1,
                None => {}
            }
        } else {
            count_plugins(child, current, classic);
        }
    }
}

impl<'a> Walker<'a> {
    fn children(&mut self, element: &'a Element, around: Surroundings<'a>) {
        for child in element.elements() {
            self.element(child, around);
        }
    }

    fn element(&mut self, element: &'a Element, around: Surroundings<'a>) {
        match element.name.as_str() {
            "plugin" if element.attribute("filename").is_some() => self.plugin(element, around),
            "plugin" => self.hardware(element),
            "sensor" if element.attribute("type").is_some() => self.sensor(element, around),
            "material" => self.material(element, around),
            "world" => self.world(element, around),
            "include" => self.include(element, around),
            "model" => self.children(element, Surroundings { model: Some(element), ..around }),
            "link" => {
                let reference = element.value("name").or(around.reference);
                if !around.is_urdf {
                    self.inertia(element, around);
                }
                self.children(element, Surroundings { reference, ..around });
            }
            "gazebo" if around.is_urdf => {
                let reference = element.value("reference").or(around.reference);
                self.children(element, Surroundings { reference, gazebo: Some(element), ..around });
            }
            "transmission" if around.is_urdf && self.context.has_ros_control => {
                self.transmission(element);
            }
            "xacro:if" | "xacro:unless" => {
                self.children(element, Surroundings { is_conditional: true, ..around });
            }
            name => {
                let called = name.strip_prefix("xacro:").filter(|name| !BLOCKS.contains(name));
                let macro_name = called.or(around.macro_name);
                self.children(element, Surroundings { macro_name, ..around });
            }
        }
    }

    /// Value of an attribute that is an expression, if it is the same wherever the element is used.
    fn resolved(&self, element: &Element, written: &str) -> String {
        let start = element.origin.0.map(|span| span.start);
        let values = start.and_then(|start| self.context.expanded?.get(&start));
        match values.map(Vec::as_slice) {
            Some([only]) if template::is_template(written) => only.clone(),
            _ => written.to_owned(),
        }
    }

    /// Adds an entry of the report.
    fn entry(
        &mut self,
        element: &Element,
        old: impl Into<String>,
        new: impl Into<String>,
        outcome: MigrationOutcome,
        remarks: Vec<String>,
    ) {
        let position = element.origin.0.map(|span| self.file.position(span.start));
        self.entries.push(MigrationEntry {
            file: self.file.name.clone(),
            line: position.map_or(0, |position| position.line),
            column: position.map_or(0, |position| position.column),
            old: old.into(),
            new: new.into(),
            outcome,
            remarks,
        });
    }

    fn plugin(&mut self, element: &'a Element, around: Surroundings<'a>) {
        let written = element.value("filename").unwrap_or_default();
        let filename = self.resolved(element, written);
        let old = OldPlugin::read_as(element, &filename, around, self.ros);
        let name = format!("plugin {}", old.plugin.filename.trim());
        let Some(mut replacement) = plugin::replacement(&old, self.context) else { return };
        if let Some(called) = around.macro_name {
            let remark = format!(
                "the plugin is an argument of the macro `{called}`, so it stays here: {}",
                replacement.remarks.first().map_or("convert it by hand", String::as_str)
            );
            return self.entry(element, name, "", MigrationOutcome::NoCounterpart, vec![remark]);
        }
        let has_topic = replacement.elements.iter().any(|element| element.name == "topic");
        if around.sensor.is_some() && has_topic {
            if self.has_topic && !around.is_conditional {
                replacement = Replacement::without(
                    MigrationOutcome::NoCounterpart,
                    "a sensor of gz has one topic, which an earlier plugin of it has taken: bridge \
                     that topic a second time under the name of this one",
                );
            }
            self.has_topic = true;
        }
        let new = self.replace_plugin(element, around, &mut replacement);
        self.entry(element, name, new, replacement.outcome, replacement.remarks);
        self.bridge.extend(replacement.bridge);
        self.expected.extend(replacement.expected);
    }

    /// Edits the file; returns the new elements in words.
    fn replace_plugin(
        &mut self,
        element: &'a Element,
        around: Surroundings<'a>,
        replacement: &mut Replacement,
    ) -> String {
        let mut new: Vec<String> = replacement.elements.iter().map(words).collect();
        new.extend(replacement.attached.iter().map(|attached| words(&attached.sensor)));
        let changes_sensor = !replacement.sensor.is_empty();
        self.sensor_changes.append(&mut replacement.sensor);
        if !replacement.attached.is_empty() {
            self.attach(element, around, replacement);
        } else if !replacement.elements.is_empty() {
            self.edits.replace(element, &replacement.elements);
        } else if changes_sensor {
            self.edits.remove(element);
        } else {
            let reason = replacement.remarks.first().map_or("", String::as_str);
            let library = element.value("filename").unwrap_or_default();
            self.edits.comment_out(element, &format!("Removed: plugin {library}; {reason}."));
        }
        new.join(", ")
    }

    /// Replaces a plugin of a model by sensors of links and joints. In a URDF they get a `<gazebo>` with a reference.
    fn attach(
        &mut self,
        plugin: &'a Element,
        around: Surroundings<'a>,
        replacement: &mut Replacement,
    ) {
        if let Some(block) = around.gazebo {
            let blocks: Vec<Element> = replacement
                .attached
                .iter()
                .map(|attached| {
                    let (AttachmentParent::Link(name) | AttachmentParent::Joint(name)) =
                        &attached.parent;
                    Element::new("gazebo")
                        .with_attribute("reference", name.as_str())
                        .with_child(attached.sensor.clone())
                })
                .collect();
            if block.elements().count() == 1
                && std::ptr::eq(block.elements().next().unwrap_or(block), plugin)
            {
                self.edits.replace(block, &blocks);
            } else {
                self.edits.remove(plugin);
                self.edits.insert_after(block, &blocks);
            }
            return;
        }
        self.edits.remove(plugin);
        for attached in &replacement.attached {
            let (kind, name) = match &attached.parent {
                AttachmentParent::Link(name) => ("link", name),
                AttachmentParent::Joint(name) => ("joint", name),
            };
            let named = |model: &'a Element| {
                model.named(kind).find(|element| element.value("name") == Some(name))
            };
            match around.model.and_then(named) {
                Some(parent) => {
                    self.edits.append(parent, std::slice::from_ref(&attached.sensor));
                }
                None => {
                    let sensor = attached.sensor.value("name").unwrap_or_default();
                    replacement.outcome = MigrationOutcome::NoCounterpart;
                    replacement.remarks.push(format!(
                        "the model has no {kind} `{name}` in this file, so that the sensor `{sensor}` \
                         was not written"
                    ));
                }
            }
        }
    }

    /// Hardware of `ros2_control`.
    fn hardware(&mut self, element: &Element) {
        if element.text() == "gazebo_ros2_control/GazeboSystem" {
            self.edits.set_text(element, transmission::HARDWARE);
            self.entry(
                element,
                "hardware gazebo_ros2_control/GazeboSystem",
                format!("hardware {}", transmission::HARDWARE),
                MigrationOutcome::Converted,
                Vec::new(),
            );
        }
    }

    fn transmission(&mut self, element: &Element) {
        let name = format!("transmission {}", element.value("name").unwrap_or_default());
        match transmission::ros2_control(element) {
            Some(control) => {
                let new = words(&control);
                self.edits.replace(element, &[control]);
                let remark =
                    "reductions and actuators of a transmission are not simulated".to_owned();
                self.entry(element, name, new, MigrationOutcome::Converted, vec![remark]);
            }
            None => self.entry(
                element,
                name,
                "",
                MigrationOutcome::NoCounterpart,
                vec![
                    "the hardware interface is none of position, velocity and effort, or an \
                      expression: write a <ros2_control> for its joints"
                        .to_owned(),
                ],
            ),
        }
    }
}

/// Elements of xacro that are not calls of macros.
const BLOCKS: [&str; 5] = ["macro", "if", "unless", "insert_block", "property"];

/// New element in words: `plugin gz::sim::systems::DiffDrive`, `topic /scan`.
fn words(element: &Element) -> String {
    let name = &element.name;
    match (name.as_str(), element.value("name"), element.value("type")) {
        ("plugin", Some(class), _) => format!("plugin {class}"),
        ("sensor", Some(sensor), Some(kind)) => format!("sensor {sensor} ({kind})"),
        ("ros2_control", Some(control), _) => format!("ros2_control {control}"),
        _ if element.elements().next().is_some() => format!("<{name}>"),
        _ => format!("<{name}>{}", shortened(&element.text())),
    }
}

/// Text of at most 60 characters.
fn shortened(text: &str) -> String {
    const MAX_CHARACTERS: usize = 60;
    if text.chars().count() <= MAX_CHARACTERS || template::is_template(text) {
        return text.to_owned();
    }
    text.chars().take(MAX_CHARACTERS).chain(['.', '.', '.']).collect()
}
