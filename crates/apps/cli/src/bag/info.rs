//! `periplus bag info`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use periplus_bags::files::Info;
use serde_json::{Value, json};

use super::options::InfoOptions;

use crate::error::CliError;

pub(super) fn run(options: &InfoOptions) -> Result<ExitCode, CliError> {
    let mut out = io::stdout().lock();
    let mut reports = Vec::new();
    let mut failed = false;
    for path in &options.bags {
        let Some(bag) = super::try_open(path)? else {
            failed = true;
            continue;
        };
        let info = Info::of(&bag);
        if options.json {
            reports.push(report(&info));
        } else if options.topic_name {
            for topic in &info.topics {
                writeln!(out, "{}", topic.name)?;
            }
        } else {
            write!(out, "{}", info.to_text())?;
        }
    }
    if options.json {
        let report = match reports.as_slice() {
            [one] => one.clone(),
            _ => Value::Array(reports),
        };
        writeln!(out, "{report:#}")?;
    }
    out.flush()?;
    Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn report(info: &Info) -> Value {
    let topics: Vec<Value> = info
        .topics
        .iter()
        .map(|topic| {
            json!({
                "name": topic.name,
                "type": topic.type_name,
                "messages": topic.messages,
                "serialization_format": topic.encoding,
            })
        })
        .collect();
    json!({
        "files": info.files,
        "bytes": info.bytes,
        "storage": info.storage.identifier(),
        "ros_distro": info.ros_distro,
        "custom_data": info.custom_data,
        "compression_format": info.packing.0,
        "compression_mode": info.packing.1,
        "start_ns": info.span_ns.map(|(start_ns, _)| start_ns),
        "end_ns": info.span_ns.map(|(_, end_ns)| end_ns),
        "messages": info.messages,
        "topics": topics,
        "closed_properly": info.is_whole,
    })
}
