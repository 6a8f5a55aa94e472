//! Throttled logging.

use periplus_diagnostics::{Diagnostic, Severity};
use periplus_graph::Node;

/// Minimum interval between two log messages of the same kind \[ns\].
const QUIET_NS: i64 = 5_000_000_000;

/// Logger that throttles repeated messages and tracks the current error.
#[derive(Debug, Default)]
pub struct Told {
    said: Vec<(&'static str, i64)>,
    /// The error that currently keeps the node from working.
    pub trouble: Option<String>,
}

impl Told {
    /// Logs a finding, unless one of the same kind was logged recently. An error is the current
    /// trouble until [`Told::fine`].
    pub fn tell(&mut self, finding: &Diagnostic, node: &Node) {
        if finding.severity == Severity::Error {
            let helps: String = finding.help.iter().map(|help| format!("; {help}")).collect();
            self.trouble = Some(format!("{}{helps}", finding.message));
        }
        let now_ns = node.now_ns();
        if !self.has_said(finding.code, now_ns) {
            self.said.push((finding.code, now_ns));
            node.log_finding(finding);
        }
    }

    /// True if a message of this kind was logged recently.
    pub fn has_said(&mut self, code: &str, now_ns: i64) -> bool {
        self.said.retain(|(_, said_ns)| (0..QUIET_NS).contains(&(now_ns - said_ns)));
        self.said.iter().any(|(said, _)| *said == code)
    }

    /// Clears the current error.
    pub fn fine(&mut self) {
        self.trouble = None;
    }
}
