//! Overview of a recording: names, times, topics.

use std::collections::BTreeSet;

use periplus_bags::files::stamp_name;
use periplus_msgs::std_msgs;
use periplus_session::recorded::{each, has_type};

use super::html::{Section, escape, paragraph, table};
use super::{OpenRun, name_of, row};
use crate::error::CliError;

/// Times of recording after this are dates, earlier ones simulated time \[ns\]: the year 2001.
const FIRST_DATE_NS: i64 = 1_000_000_000_000_000_000;

/// Maximum number of findings that are listed.
const MAX_FINDING_COUNT: usize = 10;

pub(super) fn section(run: &OpenRun) -> Result<Section, CliError> {
    let bag = &run.bag;
    let mut rows = row("Recording", &name_of(&run.path));
    let (from_ns, to_ns) = bag.span_ns().unwrap_or_default();
    if from_ns >= FIRST_DATE_NS {
        rows.push_str(&row("Start", &stamp_name(from_ns)));
    }
    rows.push_str(&row("Duration", &duration(to_ns.saturating_sub(from_ns))));
    rows.push_str(&row(
        "Messages",
        &format!("{} on {} topics", bag.message_count(), bag.topics().len()),
    ));
    rows.push_str(&row("Size", &size(bag.bytes())));
    let worlds = worlds(run);
    if !worlds.is_empty() {
        rows.push_str(&row("World", &worlds.join(", ")));
    }
    let robots = robots(run)?;
    if !robots.is_empty() {
        rows.push_str(&row("Robot", &robots.join(", ")));
    }
    if let Some(base) = run.base() {
        rows.push_str(&row("Frame of the robot", &base));
    }
    if !bag.ros_distro().is_empty() {
        rows.push_str(&row("ROS distribution", bag.ros_distro()));
    }
    for (name, value) in bag.custom_data() {
        rows.push_str(&row(&label_of(name), value));
    }
    let mut body = format!(
        "<div class=\"facts\">{}</div>",
        table(&run.heading("What was recorded"), &[], &rows)
    );
    if !bag.is_whole() {
        body.push_str(&paragraph("The recording was not closed properly; its end may be missing."));
    }
    let findings: Vec<String> =
        bag.findings().iter().take(MAX_FINDING_COUNT).map(|it| it.message.clone()).collect();
    if !findings.is_empty() {
        let items = findings.iter().map(|it| format!("<li>{}</li>\n", escape(it)));
        body.push_str(&format!("<ul class=\"warning\">\n{}</ul>\n", items.collect::<String>()));
    }
    Ok(Section { title: run.heading("Overview"), body })
}

/// Returns the label of a fact of the recorder.
fn label_of(name: &str) -> String {
    match name {
        "command" => "Command".to_owned(),
        "periplus" => "Version of Periplus".to_owned(),
        "robots" => "Robot files".to_owned(),
        "seed" => "Seed".to_owned(),
        "world" => "World file".to_owned(),
        other => other.to_owned(),
    }
}

/// Returns the names of the worlds, from the topics `/world/<name>/...`.
fn worlds(run: &OpenRun) -> Vec<String> {
    let names = run.bag.topics().iter().filter_map(|topic| {
        let (name, _) = topic.name.strip_prefix("/world/")?.split_once('/')?;
        Some(name.to_owned())
    });
    names.collect::<BTreeSet<_>>().into_iter().collect()
}

/// Returns the names of the robots in the descriptions.
fn robots(run: &OpenRun) -> Result<Vec<String>, CliError> {
    let is_description = |name: &str| name.ends_with("robot_description");
    let topics: Vec<&str> = run
        .bag
        .topics()
        .iter()
        .filter(|topic| is_description(&topic.name) && has_type(topic, "String"))
        .map(|topic| topic.name.as_str())
        .collect();
    let mut names = BTreeSet::new();
    each::<std_msgs::String>(&run.bag, &topics, |_, message| {
        names.extend(robot_name(&message.data));
    })?;
    Ok(names.into_iter().collect())
}

/// Returns the name in `<robot name="...">` or `<model name="...">`.
fn robot_name(description: &str) -> Option<String> {
    let start = description.find("<robot").or_else(|| description.find("<model"))?;
    let tag = &description[start..start + description[start..].find('>')?];
    let after = &tag[tag.find("name")? + 4..];
    let quote = after.find(['"', '\''])?;
    let mark = after.as_bytes()[quote] as char;
    let value = &after[quote + 1..];
    Some(value[..value.find(mark)?].to_owned())
}

/// Returns a duration such as `1 min 5.0 s`.
pub(super) fn duration(span_ns: i64) -> String {
    let seconds = span_ns as f64 * 1e-9;
    let minutes = (seconds / 60.0).floor();
    match minutes {
        0.0 => format!("{seconds:.1} s"),
        ..60.0 => format!("{minutes} min {:.1} s", seconds - 60.0 * minutes),
        _ => {
            let hours = (minutes / 60.0).floor();
            format!("{hours} h {} min", minutes - 60.0 * hours)
        }
    }
}

fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} B"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 * 1e-3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 * 1e-6),
        _ => format!("{:.2} GB", bytes as f64 * 1e-9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_robots_are_found() {
        assert_eq!(robot_name("<?xml?><robot name=\"bot\">").as_deref(), Some("bot"));
        assert_eq!(robot_name("<robot version='1' name = 'b c' >").as_deref(), Some("b c"));
        assert_eq!(robot_name("<sdf><model name='m'/></sdf>").as_deref(), Some("m"));
        assert_eq!(robot_name("no robot"), None);
        assert_eq!(robot_name("<robot name="), None);
    }

    #[test]
    fn durations_have_two_units() {
        assert_eq!(duration(500_000_000), "0.5 s");
        assert_eq!(duration(65_000_000_000), "1 min 5.0 s");
        assert_eq!(duration(3_720_000_000_000), "1 h 2 min");
        assert_eq!(size(1_500_000), "1.5 MB");
    }
}
