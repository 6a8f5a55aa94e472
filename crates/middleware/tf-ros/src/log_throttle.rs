//! Throttled logging.

use periplus_diagnostics::{Diagnostic, Severity};
use periplus_graph::Node;

/// Minimum interval between two log messages of the same kind \[ns\].
const QUIET_NS: i64 = 5_000_000_000;

/// Log of a node that throttles repeated messages and keeps the current error.
#[derive(Debug, Default)]
pub struct LogThrottle {
    /// Code and time \[ns\] of the messages logged recently.
    logged: Vec<(&'static str, i64)>,
    /// The error that currently keeps the node from working.
    pub error: Option<String>,
}

impl LogThrottle {
    /// Logs a finding, unless one of the same kind was logged recently. An error is the current
    /// error until [`LogThrottle::clear_error`].
    pub fn report(&mut self, finding: &Diagnostic, node: &Node) {
        if finding.severity == Severity::Error {
            let helps: String = finding.help.iter().map(|help| format!("; {help}")).collect();
            self.error = Some(format!("{}{helps}", finding.message));
        }
        let now_ns = node.now_ns();
        if !self.was_reported(finding.code, now_ns) {
            self.logged.push((finding.code, now_ns));
            node.log_finding(finding);
        }
    }

    /// True if a message of this kind was logged recently.
    pub fn was_reported(&mut self, code: &str, now_ns: i64) -> bool {
        self.logged.retain(|(_, logged_ns)| (0..QUIET_NS).contains(&(now_ns - logged_ns)));
        self.logged.iter().any(|(logged, _)| *logged == code)
    }

    /// Clears the current error.
    pub fn clear_error(&mut self) {
        self.error = None;
    }
}
