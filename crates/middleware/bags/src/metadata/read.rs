//! Parser for `metadata.yaml` of any version.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap};
use periplus_yaml::YamlNode;

use super::{BagInfo, FileInfo, TopicInformation};
use crate::qos;

/// Content of `metadata.yaml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Metadata {
    /// Version.
    pub version: i64,
    /// Storage of the files: `mcap` or `sqlite3`.
    pub storage: String,
    /// Compression format on top of the storage, such as `zstd`; usually empty.
    pub compression: String,
    /// Compression mode: `FILE`, `MESSAGE`; usually empty.
    pub compression_mode: String,
    /// Content of the bag.
    pub info: BagInfo,
}

/// Parses `metadata.yaml`. None, with findings, if it lists no files.
pub fn read_metadata(
    file: FileId,
    sources: &SourceMap,
    diagnostics: &mut Diagnostics,
) -> Option<Metadata> {
    let node = match periplus_yaml::parse(file, sources) {
        Ok(node) => node,
        Err(wrong) => {
            diagnostics.push(*wrong);
            return None;
        }
    };
    let bag = node.as_ref().and_then(|node| node.get("rosbag2_bagfile_information"));
    let paths = bag.and_then(|bag| bag.get("relative_file_paths")).and_then(YamlNode::list);
    let (Some(bag), Some(paths)) = (bag, paths) else {
        let wrong = "this is not the metadata of a bag: it lists no files";
        let at = bag.map_or_else(|| sources.whole(file), |bag| bag.span);
        let help = "`ros2 bag reindex` recreates it; or open the .mcap file itself";
        diagnostics.push(Diagnostic::error("bad-metadata", wrong).at(at).help(help));
        return None;
    };
    let texts = |list: &[YamlNode]| -> Vec<String> {
        list.iter().filter_map(YamlNode::text).map(str::to_owned).collect()
    };
    let about = bag.get("files").and_then(YamlNode::list).unwrap_or_default();
    let files = texts(paths).into_iter().map(|path| file_info(path, about)).collect();
    let topics = bag.get("topics_with_message_count").and_then(YamlNode::list).unwrap_or_default();
    let info = BagInfo {
        topics: topics.iter().map(topic_info).collect(),
        files,
        ros_distro: text(bag, "ros_distro"),
        custom_data: custom_data(bag),
    };
    Some(Metadata {
        version: bag.get("version").and_then(YamlNode::integer).unwrap_or(0),
        storage: text(bag, "storage_identifier"),
        compression: text(bag, "compression_format"),
        compression_mode: text(bag, "compression_mode"),
        info,
    })
}

fn text(node: &YamlNode, name: &str) -> String {
    node.get(name).and_then(YamlNode::text).unwrap_or_default().to_owned()
}

/// Texts of `custom_data`; it is null if there are none.
fn custom_data(bag: &YamlNode) -> BTreeMap<String, String> {
    let entries = bag.get("custom_data").and_then(YamlNode::entries).unwrap_or_default();
    let text = |node: &YamlNode| node.text().map(str::to_owned);
    entries.iter().filter_map(|(name, value)| Some((text(name)?, text(value)?))).collect()
}

/// Parses the metadata that a file contains: `metadata.yaml` without its first line in MCAP, all of it in databases.
/// None if it is damaged.
pub(crate) fn embedded_custom_data(text: &str) -> Option<BTreeMap<String, String>> {
    let mut sources = SourceMap::new();
    let file = sources.add("metadata".to_owned(), text.to_owned());
    let node = periplus_yaml::parse(file, &sources).ok()??;
    let bag = node.get("rosbag2_bagfile_information").unwrap_or(&node);
    Some(custom_data(bag))
}

fn count(node: &YamlNode) -> u64 {
    let count = node.get("message_count").and_then(YamlNode::integer).unwrap_or(0);
    u64::try_from(count).unwrap_or(0)
}

fn file_info(path: String, about: &[YamlNode]) -> FileInfo {
    let node = about.iter().find(|node| text(node, "path") == path);
    let span_ns = node.filter(|node| count(node) > 0).and_then(|node| {
        let start_ns = node.get("starting_time")?.get("nanoseconds_since_epoch")?.integer()?;
        let duration_ns = node.get("duration")?.get("nanoseconds")?.integer()?;
        Some((start_ns, start_ns.saturating_add(duration_ns)))
    });
    FileInfo { path, span_ns, messages: node.map_or(0, count) }
}

fn topic_info(node: &YamlNode) -> TopicInformation {
    let about = node.get("topic_metadata").unwrap_or(node);
    // A list since version 9, a string with YAML inside before.
    let profiles = about.get("offered_qos_profiles");
    let qos = match profiles.and_then(YamlNode::text) {
        Some(text) => qos::from_text(text),
        None => profiles.map(qos::from_yaml).unwrap_or_default(),
    };
    TopicInformation {
        name: text(about, "name"),
        type_name: text(about, "type"),
        type_hash: text(about, "type_description_hash"),
        encoding: text(about, "serialization_format"),
        qos,
        messages: count(node),
    }
}
