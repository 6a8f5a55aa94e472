//! What was said a moment ago is not said again.

use periplus_diagnostics::{Diagnostic, Severity};
use periplus_graph::Node;

/// The same kind of thing is not said again for so long \[ns\].
const QUIET_NS: i64 = 5_000_000_000;

/// What was said, and when; and what is wrong now.
#[derive(Debug, Default)]
pub struct Told {
    said: Vec<(&'static str, i64)>,
    /// What keeps the node from its work.
    pub trouble: Option<String>,
}

impl Told {
    /// Says something, unless it has been said a moment ago. What is an error is the trouble until
    /// [`Told::fine`].
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

    /// Whether something was said a moment ago.
    pub fn has_said(&mut self, code: &str, now_ns: i64) -> bool {
        self.said.retain(|(_, said_ns)| (0..QUIET_NS).contains(&(now_ns - said_ns)));
        self.said.iter().any(|(said, _)| *said == code)
    }

    /// All is well again.
    pub fn fine(&mut self) {
        self.trouble = None;
    }
}
