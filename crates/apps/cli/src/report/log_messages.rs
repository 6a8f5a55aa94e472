//! Warnings and errors of the log.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_msgs::rcl_interfaces::Log;
use periplus_session::recorded::{each_at, has_type};

use super::OpenRun;
use super::html::{Section, escape, paragraph, table};
use crate::error::CliError;

/// Levels of `rcl_interfaces/msg/Log`.
const WARN: u8 = 30;
const ERROR: u8 = 40;
const FATAL: u8 = 50;

/// Maximum number of rows.
const MAX_ROW_COUNT: usize = 100;

/// Equal messages of a node.
struct Repeated {
    first_ns: i64,
    count: u64,
}

pub(super) fn section(run: &OpenRun) -> Result<Section, CliError> {
    let title = run.heading("Log");
    let topics: Vec<&str> = run
        .bag
        .topics()
        .iter()
        .filter(|topic| topic.name.ends_with("rosout") && has_type(topic, "Log"))
        .map(|topic| topic.name.as_str())
        .collect();
    if topics.is_empty() {
        let body = paragraph("The recording has no log (/rosout).");
        return Ok(Section { title, body });
    }
    let mut total = 0_u64;
    let mut found: BTreeMap<(u8, String, String), Repeated> = BTreeMap::new();
    each_at::<Log>(&run.bag, &topics, |_, time_ns, log| {
        total += 1;
        if log.level >= WARN {
            let key = (u8::MAX - log.level, log.name, log.msg);
            let entry = found.entry(key).or_insert(Repeated { first_ns: time_ns, count: 0 });
            entry.count += 1;
            entry.first_ns = entry.first_ns.min(time_ns);
        }
    })?;
    if found.is_empty() {
        let body = paragraph(&format!("No warnings and no errors in {total} log messages."));
        return Ok(Section { title, body });
    }
    let start_ns = run.bag.span_ns().unwrap_or_default().0;
    let mut rows = String::new();
    for ((level, node, text), repeated) in found.iter().take(MAX_ROW_COUNT) {
        let (class, name) = match u8::MAX - level {
            FATAL.. => ("error", "fatal"),
            ERROR.. => ("error", "error"),
            _ => ("warning", "warning"),
        };
        let _ = writeln!(
            rows,
            "<tr><td class=\"number\">{:.1}</td><td class=\"{class}\">{name}</td><td>{}</td><td>{}</td>\
             <td class=\"number\">{}</td></tr>",
            (repeated.first_ns - start_ns) as f64 * 1e-9,
            escape(node),
            escape(text),
            repeated.count
        );
    }
    let of = |from: u8, below: u8| -> u64 {
        let level = |key: &(u8, String, String)| u8::MAX - key.0;
        let rows = found.iter().filter(|(key, _)| (from..below).contains(&level(key)));
        rows.map(|(_, repeated)| repeated.count).sum()
    };
    let caption = format!(
        "{} errors, {} warnings in {total} log messages; equal ones are one row",
        of(ERROR, u8::MAX),
        of(WARN, ERROR)
    );
    let mut body = table(&caption, &["first [s]", "level", "node", "message", "count"], &rows);
    if found.len() > MAX_ROW_COUNT {
        body.push_str(&paragraph(&format!("And {} other messages.", found.len() - MAX_ROW_COUNT)));
    }
    Ok(Section { title, body })
}
