//! Report of a conversion, for readers and for programs.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_migration::{MigrationEntry, MigrationOutcome};
use serde_json::{Value, json};

use super::compare::{Comparison, ComparisonRun, TopicComparison};
use super::difference::{Deviation, Difference};
use super::project::Project;

const OUTCOMES: [MigrationOutcome; 5] = [
    MigrationOutcome::Converted,
    MigrationOutcome::Approximated,
    MigrationOutcome::BuiltIn,
    MigrationOutcome::NoEffect,
    MigrationOutcome::NoCounterpart,
];

/// Number of elements by outcome, one line each.
pub(super) fn counts(project: &Project) -> Vec<String> {
    counts_of(&project.entries)
}

/// Number of elements by outcome, one line each.
pub(super) fn counts_of(entries: &[MigrationEntry]) -> Vec<String> {
    OUTCOMES
        .into_iter()
        .filter_map(|outcome| {
            let count = entries.iter().filter(|entry| entry.outcome == outcome).count();
            (count > 0).then(|| format!("{count} elements: {}", outcome.words()))
        })
        .collect()
}

/// Report for programs.
pub(super) fn json(project: &Project, files: &[String], comparison: &Comparison) -> Value {
    json!({
        "file": project.file.display().to_string(),
        "is_current": project.is_current(),
        "files": files.iter().map(|file| written(project, file)).collect::<Vec<_>>(),
        "elements": project.entries,
        "bridge": project.bridge,
        "comparison": comparison,
        "ok": !comparison.is_unexplained(),
    })
}

/// A file of the output folder, with the old file that it replaces.
fn written(project: &Project, file: &str) -> Value {
    let converted = project.files.iter().find(|converted| converted.output.as_os_str() == file);
    json!({ "path": file, "replaces": converted.map(|converted| converted.path.display().to_string()) })
}

/// Report for readers.
pub(super) fn markdown(project: &Project, files: &[String], comparison: &Comparison) -> String {
    let mut text = String::new();
    let name = project.file.file_name().unwrap_or_default().to_string_lossy();
    let _ = writeln!(text, "# `{name}` for Gazebo Harmonic\n");
    for line in counts(project) {
        let _ = writeln!(text, "- {line}");
    }
    let _ = writeln!(text, "- {}\n\n## Files\n", comparison.summary());
    for file in files {
        let _ = writeln!(text, "- `{file}`");
    }
    let _ = writeln!(
        text,
        "\nA file keeps its path below the name of its package or model: copy the folder of the package over \
         the package. Everything outside of the elements below is unchanged.\n"
    );
    elements(&project.entries, &mut text);
    if !project.bridge.is_empty() {
        text.push_str(
            "## Bridge\n\n`ros2 run ros_gz_bridge parameter_bridge --ros-args -p config_file:=ros_gz_bridge.yaml`\n\n\
             | ROS | Gazebo | type | direction |\n|---|---|---|---|\n",
        );
        for entry in &project.bridge {
            let arrow = match entry.direction {
                periplus_migration::BridgeFlow::GzToRos => "Gazebo to ROS",
                periplus_migration::BridgeFlow::RosToGz => "ROS to Gazebo",
            };
            let _ = writeln!(
                text,
                "| `{}` | `{}` | {} | {arrow} |",
                entry.ros_topic_name, entry.gz_topic_name, entry.ros_type_name
            );
        }
        text.push('\n');
    }
    text.push_str("## Comparison run\n\n");
    self::comparison(comparison, &mut text);
    text
}

/// Results of a comparison run.
pub(super) fn comparison(comparison: &Comparison, text: &mut String) {
    match comparison {
        Comparison::NotRun { reason } => {
            let _ = writeln!(text, "Not run: {reason}.");
        }
        Comparison::Run(run) => comparison_text(run, text),
    }
}

/// Tables of the old elements.
pub(super) fn elements(entries: &[MigrationEntry], text: &mut String) {
    let is_missing = |entry: &&MigrationEntry| entry.outcome == MigrationOutcome::NoCounterpart;
    let missing: Vec<&MigrationEntry> = entries.iter().filter(is_missing).collect();
    if !missing.is_empty() {
        text.push_str("## Elements without a counterpart\n\n");
        for entry in grouped(&missing) {
            let _ = writeln!(text, "- {}: {}. {}", entry.place, entry.old, entry.remarks);
        }
        text.push('\n');
    }
    let others: Vec<&MigrationEntry> = entries.iter().filter(|entry| !is_missing(entry)).collect();
    if !others.is_empty() {
        text.push_str(
            "## Elements\n\n| file:line | old | new | result | remarks |\n|---|---|---|---|---|\n",
        );
        for entry in grouped(&others) {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} |",
                entry.place,
                cell(&entry.old),
                cell(&entry.new),
                entry.outcome.words(),
                cell(&entry.remarks)
            );
        }
        text.push('\n');
    }
}

fn comparison_text(run: &ComparisonRun, text: &mut String) {
    let _ = write!(
        text,
        "Both descriptions were simulated by Periplus for {} s in lockstep with the same seed; noise is keyed by \
         sensor and number of the measurement, so that equal sensors have equal readings. ",
        run.duration_s
    );
    if run.drive.is_empty() {
        text.push_str("No drive listens to velocities, so nothing was driven. ");
    } else {
        let [old, new] = &run.command_topics;
        let _ = write!(
            text,
            "The drive: {} (on {}; new: {}). ",
            run.drive,
            old.join(", "),
            new.join(", ")
        );
    }
    let _ = writeln!(
        text,
        "The start poses of {} links were compared. Verdict: **{}**.\n",
        run.links,
        run.verdict.words()
    );
    for difference in &run.differences {
        let _ = writeln!(text, "- {}", difference_words(difference));
    }
    if !run.differences.is_empty() {
        text.push('\n');
    }
    if run.topics.is_empty() {
        text.push_str("The old description publishes no topics.\n");
        return;
    }
    text.push_str(
        "| topic | type | rate old, new [Hz] | frame old, new | pairs | largest deviation | verdict |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for topic in &run.topics {
        let _ = writeln!(text, "{}", row(topic));
    }
    let differing: Vec<&TopicComparison> =
        run.topics.iter().filter(|topic| !topic.differences.is_empty()).collect();
    if !differing.is_empty() {
        text.push_str("\nDifferences:\n\n");
        for topic in differing {
            for difference in &topic.differences {
                let _ = writeln!(text, "- `{}`: {}", topic.topic, difference_words(difference));
            }
        }
    }
    if !run.equalized.is_empty() {
        let _ = writeln!(
            text,
            "\nProof by a second run of both, without {}.",
            run.equalized.join("; without ")
        );
    }
}

fn row(topic: &TopicComparison) -> String {
    let both = |[old, new]: &[String; 2]| {
        if old == new { format!("`{old}`") } else { format!("`{old}`, `{new}`") }
    };
    let frames = if topic.frames[0].is_empty() && topic.frames[1].is_empty() {
        String::new()
    } else {
        both(&topic.frames)
    };
    let types = both(&topic.types);
    let deviations: Vec<String> = topic.deviations.iter().map(Deviation::words).collect();
    let [old_hz, new_hz] = topic.rates_hz;
    let name = if topic.gz_topic == topic.topic {
        format!("`{}`", topic.topic)
    } else {
        format!("`{}` (new: `{}`)", topic.topic, topic.gz_topic)
    };
    format!(
        "| {name} | {types} | {old_hz:.1}, {new_hz:.1} | {frames} | {} | {} | {} |",
        topic.pairs,
        deviations.join("; "),
        topic.verdict.words()
    )
}

fn difference_words(difference: &Difference) -> String {
    match &difference.reason {
        Some(reason) => format!("{}. Explained: {reason}", difference.text),
        None => format!("{}. **Not explained.**", difference.text),
    }
}

/// Entries that differ only in their lines.
struct Grouped {
    place: String,
    old: String,
    new: String,
    outcome: MigrationOutcome,
    remarks: String,
}

/// Maximum number of lines that are listed for one group.
const MAX_LINES: usize = 6;

fn grouped(entries: &[&MigrationEntry]) -> Vec<Grouped> {
    let mut order: Vec<(String, String, String, MigrationOutcome, String)> = Vec::new();
    let mut lines: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for entry in entries {
        let file = entry.file.rsplit('/').next().unwrap_or_default().to_owned();
        let remarks = entry.remarks.join("; ");
        let key = (file, entry.old.clone(), entry.new.clone(), entry.outcome, remarks);
        let index = order.iter().position(|known| *known == key).unwrap_or_else(|| {
            order.push(key);
            order.len() - 1
        });
        lines.entry(index).or_default().push(entry.line);
    }
    order
        .into_iter()
        .enumerate()
        .map(|(index, (file, old, new, outcome, remarks))| {
            let lines = lines.get(&index).map(Vec::as_slice).unwrap_or_default();
            let mut shown: Vec<String> =
                lines.iter().take(MAX_LINES).map(usize::to_string).collect();
            if lines.len() > MAX_LINES {
                shown.push(format!("and {} more", lines.len() - MAX_LINES));
            }
            Grouped { place: format!("{file}:{}", shown.join(", ")), old, new, outcome, remarks }
        })
        .collect()
}

/// Text in a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ").replace('<', "&lt;")
}
