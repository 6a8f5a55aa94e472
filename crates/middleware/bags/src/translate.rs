//! Conversion of messages between ROS 1 and ROS 2.

use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_msgs::{Adaptation, Format, Layout, RecodeError, Recoding, TypeRegistry};
use periplus_rosidl::{InterfaceDialect, InterfaceKind, TypeName};

use crate::{BagTopic, QosProfile, Style, qos};

/// Target encoding of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// ROS 2: CDR, with the type definitions of this program if known.
    Ros2,
    /// ROS 1 Noetic.
    Ros1,
}

impl Target {
    fn encoding(self) -> &'static str {
        match self {
            Self::Ros2 => "cdr",
            Self::Ros1 => "ros1",
        }
    }

    fn format(self) -> Format {
        match self {
            Self::Ros2 => Format::CDR,
            Self::Ros1 => Format::Ros1,
        }
    }

    /// Known types of the target.
    fn known(self) -> &'static TypeRegistry {
        match self {
            Self::Ros2 => TypeRegistry::builtin(),
            Self::Ros1 => TypeRegistry::ros1(),
        }
    }
}

/// Converts the messages of a topic.
#[derive(Debug)]
pub struct Translation {
    topic: BagTopic,
    way: Way,
    out: Vec<u8>,
}

#[derive(Debug)]
enum Way {
    /// No conversion.
    Same,
    /// Another encoding, and perhaps another revision of the type.
    Convert(Recoding),
}

/// Types with another name in ROS 1.
const RENAMED: [(&str, &str); 1] = [("tf/tfMessage", "tf2_msgs/msg/TFMessage")];

impl Translation {
    /// Creates the conversion of a topic for a target. None, with a finding, if the type is
    /// unknown.
    #[must_use]
    pub fn new(topic: &BagTopic, target: Target, diagnostics: &mut Diagnostics) -> Option<Self> {
        let renamed = RENAMED.iter().find(|(old, _)| *old == topic.type_name);
        let type_name = renamed.map_or(topic.type_name.as_str(), |(_, new)| new);
        if topic.encoding == target.encoding() && renamed.is_none() {
            let mut topic = topic.clone();
            complete(&mut topic, target);
            return Some(Self { topic, way: Way::Same, out: Vec::new() });
        }
        let from = match topic.encoding.as_str() {
            "cdr" => Format::CDR,
            "ros1" => Format::Ros1,
            other => {
                let wrong = format!("messages of `{}` are encoded as `{other}`", topic.name);
                diagnostics.push(left_out(wrong, "only CDR and ROS 1 are translated"));
                return None;
            }
        };
        let Some(name) = TypeName::read(type_name) else {
            let wrong = format!("`{type_name}`, the type of `{}`, is not a type name", topic.name);
            diagnostics.push(left_out(wrong, "types are named `package/Name`"));
            return None;
        };
        let own = own_types(topic, type_name);
        let full_name = name.to_string();
        let source = own.layout(&full_name).or_else(|| match from {
            Format::Ros1 => TypeRegistry::ros1().layout(&full_name),
            Format::Cdr(_) => TypeRegistry::builtin().layout(&full_name),
        });
        let Some(source) = source.cloned() else {
            let wrong = format!("the type `{full_name}` of `{}` is unknown", topic.name);
            diagnostics.push(left_out(wrong, "the bag contains no definition of it"));
            return None;
        };
        let own = match target {
            Target::Ros2 => TypeRegistry::new(own.registry().for_ros2(), &mut Diagnostics::new()),
            Target::Ros1 => own,
        };
        let types = if target.known().layout(&full_name).is_some() { target.known() } else { &own };
        let Some(described) = describe(topic, &name, types, target) else {
            let wrong = format!(
                "`{full_name}`, the type of `{}`, does not exist in the target",
                topic.name
            );
            diagnostics.push(left_out(
                wrong,
                "ROS 1 has neither wide strings nor service requests as messages",
            ));
            return None;
        };
        let goal = types.layout(&full_name)?;
        let recoding = Recoding::new(&source, from, goal, target.format());
        if let Some(adaptation) = recoding.adaptation() {
            diagnostics.push(adapted(topic, &full_name, adaptation));
        }
        Some(Self { topic: described, way: Way::Convert(recoding), out: Vec::new() })
    }

    /// Creates a conversion that copies messages unchanged, in any encoding.
    #[must_use]
    pub fn untouched(topic: &BagTopic) -> Self {
        Self { topic: topic.clone(), way: Way::Same, out: Vec::new() }
    }

    /// The topic in the target.
    #[must_use]
    pub fn topic(&self) -> &BagTopic {
        &self.topic
    }

    /// True if messages are copied unchanged.
    #[must_use]
    pub fn is_same(&self) -> bool {
        matches!(self.way, Way::Same)
    }

    /// Converts a message.
    ///
    /// # Errors
    /// When the message cannot be decoded or encoded.
    pub fn translate<'a>(&'a mut self, data: &'a [u8]) -> Result<&'a [u8], RecodeError> {
        self.out.clear();
        match &self.way {
            Way::Same => return Ok(data),
            Way::Convert(recoding) => recoding.convert(data, &mut self.out)?,
        }
        Ok(&self.out)
    }
}

impl BagTopic {
    /// Type of its messages, from its schema or else as this program knows it; none if unknown.
    #[must_use]
    pub fn layout(&self) -> Option<Arc<Layout>> {
        let name = TypeName::read(&self.type_name)?.to_string();
        let own = own_types(self, &self.type_name);
        let known = match self.encoding.as_str() {
            "ros1" => TypeRegistry::ros1(),
            _ => TypeRegistry::builtin(),
        };
        own.layout(&name).or_else(|| known.layout(&name)).cloned()
    }
}

fn left_out(wrong: String, help: &str) -> Diagnostic {
    Diagnostic::warning("untranslatable-topic", wrong).help(format!("the topic is skipped: {help}"))
}

fn adapted(topic: &BagTopic, type_name: &str, adaptation: &Adaptation) -> Diagnostic {
    let wrong = format!("`{}` has another revision of `{type_name}`", topic.name);
    let mut finding = Diagnostic::warning("other-revision", wrong);
    if !adaptation.lost().is_empty() {
        finding = finding.note(format!("fields dropped: {}", adaptation.lost().join(", ")));
    }
    if !adaptation.blank().is_empty() {
        finding =
            finding.note(format!("fields without a value: {}", adaptation.blank().join(", ")));
    }
    finding
}

/// Types defined by the topic's own schema.
fn own_types(topic: &BagTopic, type_name: &str) -> TypeRegistry {
    let dialect = match topic.schema_encoding.as_str() {
        "ros2msg" => InterfaceDialect::Ros2,
        "ros1msg" => InterfaceDialect::Ros1,
        _ => return TypeRegistry::default(),
    };
    TypeRegistry::of_schema(type_name, &String::from_utf8_lossy(&topic.schema), dialect)
}

/// The topic with its type as known in the target; none if there is none.
fn describe(
    topic: &BagTopic,
    name: &TypeName,
    types: &TypeRegistry,
    target: Target,
) -> Option<BagTopic> {
    let about = |key: &str| topic.metadata.get(key).map_or("", String::as_str);
    let full_name = name.to_string();
    let mut described = BagTopic {
        name: topic.name.clone(),
        type_name: full_name.clone(),
        encoding: target.encoding().into(),
        schema_encoding: String::new(),
        schema: Vec::new(),
        metadata: Default::default(),
    };
    match target {
        Target::Ros2 => {
            described.schema_encoding = "ros2msg".into();
            described.schema = types.schema_text(&full_name)?.into();
            let latched = about("latching") == "1";
            let profile = if latched { QosProfile::latched(1) } else { QosProfile::reliable(10) };
            let profiles = qos::to_yaml(&[profile], Style::default(), 0);
            described.metadata.insert("offered_qos_profiles".into(), profiles);
            described
                .metadata
                .extend(types.hash(&full_name).map(|hash| ("topic_type_hash".to_owned(), hash)));
        }
        Target::Ros1 => {
            // ROS 1 has no names for parts of services.
            if name.kind != InterfaceKind::Message {
                return None;
            }
            described.type_name = name.short();
            described.schema_encoding = "ros1msg".into();
            let text = types.registry().ros1_text(name)?;
            described.schema = text.text.into();
            described.metadata.insert("md5sum".into(), text.md5);
            let is_latched = qos::from_text(about("offered_qos_profiles"))
                .iter()
                .any(|profile| profile.durability == crate::Durability::TransientLocal);
            let latching = if is_latched { "1" } else { "0" };
            described.metadata.insert("latching".into(), latching.into());
        }
    }
    Some(described)
}

/// Adds the schema of a known type if the bag only names it.
fn complete(topic: &mut BagTopic, target: Target) {
    let Some(name) = TypeName::read(&topic.type_name) else { return };
    if target == Target::Ros1 && !topic.metadata.contains_key("md5sum") {
        let own = own_types(topic, &topic.type_name);
        let text = own.registry().ros1_text(&name);
        topic.metadata.extend(text.map(|text| ("md5sum".to_owned(), text.md5)));
    }
    if !topic.schema.is_empty() {
        return;
    }
    if let Some(known) = describe(topic, &name, target.known(), target) {
        topic.schema = known.schema;
        topic.schema_encoding = known.schema_encoding;
        for (key, value) in known.metadata {
            if key != "offered_qos_profiles" && key != "latching" {
                topic.metadata.entry(key).or_insert(value);
            }
        }
    }
}
