//! Sources of messages: bags on disk, and logs in memory.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus::bags::files::{Bag, BagError, Storage};
use periplus::bags::{BagTopic, Selection, is_carmen};
use periplus::diagnostics::{Diagnostics, SourceMap, closest};
use periplus::msgs::{Format, TypeRegistry};
use periplus_rosidl::{InterfaceDialect, Registry, TypeName};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::carmen::{self, Memory};
use crate::messages::{Plan, plan_in};
use crate::robot_files::{PyFinding, findings_of};

/// Opened recording.
pub(super) struct Source {
    kind: SourceKind,
    topics: Vec<TopicData>,
}

pub(super) enum SourceKind {
    Bag(Box<Bag>),
    Memory(Memory),
}

/// Topic with its type.
#[derive(Clone)]
pub(super) struct TopicData {
    pub(super) topic: BagTopic,
    pub(super) count: u64,
    /// Type and format of the messages, or the reason why they cannot be decoded.
    pub(super) plan: Result<(Arc<Plan>, Format), String>,
}

/// Selected messages.
#[derive(Clone)]
pub(super) struct Wanted {
    pub(super) topics: Option<BTreeSet<String>>,
    pub(super) start_ns: i64,
    pub(super) end_ns: i64,
}

impl Source {
    pub(super) fn open(path: &Path) -> Result<Self, BagError> {
        if path.is_file() && Storage::of_path(path).is_none() {
            let head =
                carmen::head(path).map_err(|error| BagError::File(path.to_owned(), error))?;
            if is_carmen(&head) {
                let memory =
                    carmen::read(path).map_err(|error| BagError::File(path.to_owned(), error))?;
                let topics = memory.topics.iter().zip(&memory.counts);
                let topics = topics.map(|(topic, count)| topic_data(topic, *count)).collect();
                return Ok(Self { kind: SourceKind::Memory(memory), topics });
            }
        }
        let bag = Bag::open(path)?;
        let topics = bag.topics().iter().zip(bag.counts());
        let topics = topics.map(|(topic, count)| topic_data(topic, *count)).collect();
        Ok(Self { kind: SourceKind::Bag(Box::new(bag)), topics })
    }

    pub(super) fn kind(&self) -> &SourceKind {
        &self.kind
    }

    pub(super) fn topics(&self) -> &[TopicData] {
        &self.topics
    }

    pub(super) fn bag(&self) -> Option<&Bag> {
        match &self.kind {
            SourceKind::Bag(bag) => Some(bag),
            SourceKind::Memory(_) => None,
        }
    }

    pub(super) fn into_bag(self) -> Option<Bag> {
        match self.kind {
            SourceKind::Bag(bag) => Some(*bag),
            SourceKind::Memory(_) => None,
        }
    }

    pub(super) fn path(&self) -> &Path {
        match &self.kind {
            SourceKind::Bag(bag) => bag.path(),
            SourceKind::Memory(memory) => &memory.path,
        }
    }

    pub(super) fn files(&self) -> Vec<PathBuf> {
        match &self.kind {
            SourceKind::Bag(bag) => bag.files().map(Path::to_owned).collect(),
            SourceKind::Memory(memory) => vec![memory.path.clone()],
        }
    }

    pub(super) fn span_ns(&self) -> Option<(i64, i64)> {
        match &self.kind {
            SourceKind::Bag(bag) => bag.span_ns(),
            SourceKind::Memory(memory) => memory.span_ns(),
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        match &self.kind {
            SourceKind::Bag(bag) => bag.bytes(),
            SourceKind::Memory(memory) => memory.bytes,
        }
    }

    pub(super) fn storage(&self) -> &'static str {
        match &self.kind {
            SourceKind::Bag(bag) => bag.storage().identifier(),
            SourceKind::Memory(_) => "carmen",
        }
    }

    pub(super) fn is_whole(&self) -> bool {
        self.bag().is_none_or(Bag::is_whole)
    }

    pub(super) fn findings(&self) -> Vec<PyFinding> {
        match &self.kind {
            SourceKind::Bag(bag) => {
                let mut findings = findings_of(bag.findings(), &SourceMap::new());
                findings.extend((!bag.is_whole()).then(|| {
                    PyFinding::warning(
                        "incomplete-bag",
                        "a file was not closed properly; the messages up to its end are read",
                    )
                }));
                findings
            }
            SourceKind::Memory(memory) => memory
                .faults
                .iter()
                .map(|(line, what)| {
                    PyFinding::of_line("bad-line", what, &memory.path.display().to_string(), *line)
                })
                .collect(),
        }
    }
}

impl Wanted {
    pub(super) fn new(
        source: &Source,
        topics: Option<&Bound<'_, PyAny>>,
        start: Option<i64>,
        end: Option<i64>,
    ) -> PyResult<Self> {
        let names: Option<Vec<String>> = match topics {
            None => None,
            Some(one) if one.is_instance_of::<PyString>() => Some(vec![one.extract()?]),
            Some(many) => Some(
                many.try_iter()
                    .and_then(|names| names.map(|name| name?.extract()).collect())
                    .map_err(|_| PyTypeError::new_err("`topics` must be a str or a list of str"))?,
            ),
        };
        let known = || source.topics.iter().map(|topic| topic.topic.name.as_str());
        for name in names.iter().flatten() {
            if !known().any(|known| known == name) {
                let mut text = format!("the bag has no topic `{name}`");
                match closest(name, known()) {
                    Some(near) => text.push_str(&format!(", did you mean `{near}`?")),
                    None => {
                        let names: Vec<&str> = known().collect();
                        text.push_str(&format!("; its topics are: {}", names.join(", ")));
                    }
                }
                return Err(PyValueError::new_err(text));
            }
        }
        Ok(Self {
            topics: names.map(|names| names.into_iter().collect()),
            start_ns: start.unwrap_or(i64::MIN),
            end_ns: end.unwrap_or(i64::MAX),
        })
    }

    pub(super) fn selection(&self) -> Selection {
        Selection { topics: self.topics.clone(), span_ns: self.start_ns..=self.end_ns }
    }

    pub(super) fn takes(&self, name: &str) -> bool {
        self.topics.as_ref().is_none_or(|topics| topics.contains(name))
    }
}

fn topic_data(topic: &BagTopic, count: u64) -> TopicData {
    TopicData { topic: topic.clone(), count, plan: plan_of_topic(topic) }
}

/// Type with another name in ROS 1.
const RENAMED: (&str, &str) = ("tf/tfMessage", "tf2_msgs/msg/TFMessage");

fn plan_of_topic(topic: &BagTopic) -> Result<(Arc<Plan>, Format), String> {
    let format = match topic.encoding.as_str() {
        "cdr" => Format::CDR,
        "ros1" => Format::Ros1,
        other => return Err(format!("its messages are encoded as `{other}`")),
    };
    let type_name = if topic.type_name == RENAMED.0 { RENAMED.1 } else { &topic.type_name };
    let Some(name) = TypeName::read(type_name) else {
        return Err(format!("`{type_name}` is not the name of a message type"));
    };
    let dialect = match topic.schema_encoding.as_str() {
        "ros2msg" => Some(InterfaceDialect::Ros2),
        "ros1msg" => Some(InterfaceDialect::Ros1),
        _ => None,
    };
    let full_name = name.to_string();
    if let Some(dialect) = dialect {
        let mut registry = Registry::new();
        // Errors in the definition show as an unknown type.
        let mut findings = Diagnostics::new();
        let mut sources = SourceMap::new();
        let text = String::from_utf8_lossy(&topic.schema).into_owned();
        let file = sources.add(format!("schema of {}", topic.name), text);
        registry.add_schema(&name, file, &sources, dialect, &mut findings);
        let types = TypeRegistry::new(registry, &mut findings);
        if let Some(plan) = plan_in(&types, &full_name) {
            return Ok((plan, format));
        }
    }
    let known = match format {
        Format::Ros1 => plan_in(TypeRegistry::ros1(), &full_name),
        Format::Cdr(_) => crate::messages::plan(&full_name),
    };
    let missing = || format!("the bag has no definition of its type `{}`", topic.type_name);
    known.map(|plan| (plan, format)).ok_or_else(missing)
}
