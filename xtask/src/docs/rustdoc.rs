//! The documentation of the code, with every warning an error, except one: units are written in
//! brackets, `[m]`, which rustdoc takes for links.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::step::{Failed, cargo, metadata};

/// Units in brackets that look like links; `[m/s]` does not.
const UNITS: [&str; 20] = [
    "m", "mm", "rad", "deg", "s", "ms", "ns", "Hz", "kg", "N", "Pa", "T", "K", "J", "W", "V", "A",
    "px", "bytes", "MiB",
];

/// Folder of the command's pages, beside `doc`.
const COMMAND_FOLDER: &str = "command";

/// Checks the documentation of all libraries and of the command.
pub(crate) fn run() -> Result<(), Failed> {
    let mut libraries = cargo();
    libraries.args(["doc", "--workspace", "--no-deps", "--message-format=json"]);
    let findings = findings(libraries)? + findings(command_docs()?)?;
    match findings {
        0 => Ok(()),
        count => Err(Failed(format!("cargo doc failed: {count} findings, see above"))),
    }
}

/// The documentation of the command `periplus`, which `cargo doc` leaves out: the library `periplus`
/// has the same name. Its pages go to a separate folder; the build of its dependencies is shared.
fn command_docs() -> Result<Command, Failed> {
    let metadata = metadata()?;
    let folder = metadata["target_directory"].as_str().unwrap_or("target");
    let mut command = cargo();
    command.args(["rustdoc", "--package", "periplus-cli", "--bin", "periplus"]);
    command
        .args(["--message-format=json", "--target-dir"])
        .arg(Path::new(folder).join(COMMAND_FOLDER));
    command.env("CARGO_BUILD_BUILD_DIR", metadata["build_directory"].as_str().unwrap_or(folder));
    Ok(command)
}

/// Runs cargo and returns the number of findings, which are printed.
fn findings(mut command: Command) -> Result<usize, Failed> {
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
    if status.success() { Ok(findings) } else { Err(failed("see above".into())) }
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
