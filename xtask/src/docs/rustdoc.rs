//! The documentation of the code, with every warning an error, except one: units are written in
//! brackets, `[m]`, which rustdoc takes for links.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use serde_json::Value;

use crate::step::{Failed, cargo};

/// Units in brackets that look like links; `[m/s]` does not.
const UNITS: [&str; 20] = [
    "m", "mm", "rad", "deg", "s", "ms", "ns", "Hz", "kg", "N", "Pa", "T", "K", "J", "W", "V", "A",
    "px", "bytes", "MiB",
];

pub(crate) fn run() -> Result<(), Failed> {
    let mut command = cargo();
    command.args(["doc", "--workspace", "--no-deps", "--message-format=json"]);
    let failed = |why: String| Failed(format!("cargo doc failed: {why}"));
    let mut child =
        command.stdout(Stdio::piped()).spawn().map_err(|error| failed(error.to_string()))?;
    let mut findings = 0;
    for line in child.stdout.take().map(BufReader::new).into_iter().flat_map(BufRead::lines) {
        let line = line.map_err(|error| failed(error.to_string()))?;
        let Ok(message) = serde_json::from_str::<Value>(&line) else { continue };
        if let Some(rendered) = finding(&message) {
            eprintln!("{rendered}");
            findings += 1;
        }
    }
    let status = child.wait().map_err(|error| failed(error.to_string()))?;
    match (status.success(), findings) {
        (true, 0) => Ok(()),
        (true, _) => Err(failed(format!("{findings} findings, see above"))),
        (false, _) => Err(failed("see above".into())),
    }
}

/// The rendered warning or error of one line of cargo's JSON; none for any other line.
fn finding(message: &Value) -> Option<&str> {
    let message = &message["message"];
    let level = message["level"].as_str()?;
    let rendered = message["rendered"].as_str().filter(|_| matches!(level, "warning" | "error"))?;
    // Summaries such as "3 warnings emitted" have no position in the source.
    if level == "warning" && message["spans"].as_array().is_none_or(Vec::is_empty) {
        return None;
    }
    let is_link = message["code"]["code"] == "rustdoc::broken_intra_doc_links";
    let target = message["message"].as_str().unwrap_or_default().split('`').nth(1);
    let is_unit = target.is_some_and(|target| UNITS.contains(&target));
    (!(is_link && is_unit)).then_some(rendered)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn is_finding(level: &str, code: &str, words: &str) -> bool {
        let message = json!({"message": {
            "level": level, "code": {"code": code}, "message": words, "rendered": words,
            "spans": [{}],
        }});
        finding(&message).is_some()
    }

    #[test]
    fn units_are_not_links() {
        let link = "rustdoc::broken_intra_doc_links";
        assert!(!is_finding("warning", link, "unresolved link to `rad`"));
        assert!(is_finding("warning", link, "unresolved link to `Robot`"));
        assert!(is_finding("warning", "rustdoc::bare_urls", "this URL is not a hyperlink"));
        assert!(is_finding("error", "E0425", "cannot find value `m`"));
        assert!(!is_finding("note", "", "something"));
        assert!(finding(&json!({"reason": "build-finished", "success": true})).is_none());
    }
}
