//! YAML file of `ros2 bag convert --output-options`: output recordings and their settings.
//!
//! Names are those of rosbag2's `StorageOptions` and `RecordOptions` (`rosbag2_storage/yaml.hpp`,
//! `rosbag2_transport/record_options.hpp`).

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap, closest};
use periplus_session::files::{FileError, text};
use periplus_yaml::YamlNode;

use super::options::{Chunks, Format, Mode, SelectOptions, StorageId, WriteOptions};

/// Settings of one output recording.
#[derive(Debug)]
pub(super) struct OutputSettings {
    pub(super) output: PathBuf,
    pub(super) select: SelectOptions,
    pub(super) write: WriteOptions,
}

/// Keys that are accepted and have no effect on the output.
const WITHOUT_EFFECT: [&str; 18] = [
    "compression_queue_size",
    "compression_threads",
    "compression_threads_priority",
    "custom_data",
    "ignore_leaf_topics",
    "include_hidden_topics",
    "include_unpublished_topics",
    "input_serialization_format",
    "is_discovery_disabled",
    "max_cache_size",
    "node_prefix",
    "rmw_serialization_format",
    "output_serialization_format",
    "snapshot_mode",
    "start_paused",
    "storage_config_uri",
    "topic_polling_interval",
    "use_sim_time",
];

const WITH_EFFECT: [&str; 16] = [
    "uri",
    "storage_id",
    "all",
    "all_topics",
    "topics",
    "regex",
    "exclude",
    "exclude_regex",
    "exclude_topics",
    "compression_mode",
    "compression_format",
    "max_bagfile_size",
    "max_bagfile_duration",
    "storage_preset_profile",
    "start_time_ns",
    "end_time_ns",
];

/// Returns true if a path names a YAML file instead of a recording.
pub(super) fn is_one(path: &Path) -> bool {
    let is_yaml = path.extension().is_some_and(|ending| ending == "yaml" || ending == "yml");
    is_yaml && path.is_file()
}

/// Reads a YAML file of outputs; the findings carry their source lines.
pub(super) fn read(
    path: &Path,
) -> Result<(Vec<OutputSettings>, Diagnostics, SourceMap), FileError> {
    let text = text(path)?;
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add(path.display().to_string(), text);
    let wanted = match periplus_yaml::parse(file, &sources) {
        Ok(node) => node.map_or_else(Vec::new, |node| outputs(&node, &mut findings)),
        Err(wrong) => {
            findings.push(*wrong);
            Vec::new()
        }
    };
    if wanted.is_empty() && !findings.has_errors() {
        findings.push(
            Diagnostic::error("no-output", "the file has no `output_bags`")
                .at(sources.whole(file))
                .help("write `output_bags:` with an entry `- uri: NAME` for each recording"),
        );
    }
    Ok((wanted, findings, sources))
}

fn outputs(node: &YamlNode, findings: &mut Diagnostics) -> Vec<OutputSettings> {
    let list = node.get("output_bags").and_then(YamlNode::list).unwrap_or_default();
    list.iter().filter_map(|one| output(one, findings)).collect()
}

fn output(node: &YamlNode, findings: &mut Diagnostics) -> Option<OutputSettings> {
    let Some(uri) = node.get("uri").and_then(YamlNode::text) else {
        findings.push(
            Diagnostic::error(
                "no-uri",
                "an entry of `output_bags` has no `uri`, the path of the output",
            )
            .at(node.span),
        );
        return None;
    };
    let mut wanted = OutputSettings {
        output: PathBuf::from(uri),
        select: SelectOptions::default(),
        write: WriteOptions::default(),
    };
    for (name, value) in node.entries().unwrap_or_default() {
        let Some(key) = name.text() else { continue };
        // A null value counts as absent.
        let is_empty = value.is_null() || value.text() == Some("");
        if is_empty || WITHOUT_EFFECT.contains(&key) {
            continue;
        }
        if !WITH_EFFECT.contains(&key) {
            let mut unknown =
                Diagnostic::warning("unknown-option", format!("`{key}` is unknown and ignored"))
                    .at(name.span);
            if let Some(near) = closest(key, WITH_EFFECT) {
                unknown = unknown.help(format!("did you mean `{near}`?"));
            }
            findings.push(unknown);
        } else if let Err(why) = set(&mut wanted, key, value) {
            let wrong = format!("`{key}` is {}: {why}", value.text().unwrap_or(value.kind()));
            findings.push(Diagnostic::error("bad-option", wrong).at(value.span));
        }
    }
    Some(wanted)
}

fn set(wanted: &mut OutputSettings, key: &str, value: &YamlNode) -> Result<(), String> {
    let (select, write) = (&mut wanted.select, &mut wanted.write);
    let text = || value.text().ok_or_else(|| "expected a string".to_owned());
    let number = || value.integer().ok_or_else(|| "expected an integer".to_owned());
    let regex = || text().and_then(|text| text.parse().map_err(|error| format!("{error}")));
    match key {
        "storage_id" => write.storage = Some(one_of::<StorageId>(text()?)?),
        // An empty selection means all topics.
        "all" | "all_topics" => drop(value.truth().ok_or("expected true or false")?),
        "topics" => select.names.topics = texts(value)?,
        "exclude_topics" => select.names.exclude_topics = texts(value)?,
        "regex" => select.names.regex = Some(regex()?),
        "exclude" | "exclude_regex" => select.names.exclude_regex = Some(regex()?),
        "compression_mode" => write.compression_mode = one_of::<Mode>(text()?)?,
        "compression_format" => write.compression_format = one_of::<Format>(text()?)?,
        "max_bagfile_size" => write.max_bag_size = u64::try_from(number()?).ok(),
        "max_bagfile_duration" => {
            write.max_bag_duration = number()?.checked_mul(1_000_000_000).filter(|ns| *ns >= 0);
        }
        "storage_preset_profile" => write.chunks = Some(preset(text()?)?),
        "start_time_ns" => select.start = Some(number()?).filter(|ns| *ns >= 0),
        "end_time_ns" => select.end = Some(number()?).filter(|ns| *ns >= 0),
        _ => {}
    }
    Ok(())
}

/// Storage presets of rosbag2's MCAP plugin.
fn preset(name: &str) -> Result<Chunks, String> {
    match name {
        "none" | "fastwrite" => Ok(Chunks::None),
        "zstd_fast" | "zstd_small" => Ok(Chunks::Zstd),
        _ => Err("expected none, fastwrite, zstd_fast or zstd_small".to_owned()),
    }
}

fn one_of<T: ValueEnum>(word: &str) -> Result<T, String> {
    T::from_str(word, true).map_err(|_| {
        let names = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let names: Vec<String> = names.map(|name| name.get_name().to_owned()).collect();
        format!("expected one of {}", names.join(", "))
    })
}

fn texts(value: &YamlNode) -> Result<Vec<String>, String> {
    let all = value.list().map(|list| list.iter().map(|one| one.text().map(str::to_owned)));
    all.and_then(Iterator::collect).ok_or_else(|| "expected a list of names".to_owned())
}
