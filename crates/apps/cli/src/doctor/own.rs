//! `periplus doctor --self`: this program, and the machine as far as it needs it. Nothing is changed.

mod folders;
mod machine;
mod network;
mod program;

use std::io::{self, Write as _};
use std::process::ExitCode;

use serde_json::{Value, json};

use crate::error::CliError;

/// Outcome of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum CheckStatus {
    Ok,
    /// A part of the program does not work, or works slowly.
    Warning,
    /// The program does not work.
    Error,
}

impl CheckStatus {
    fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// A check of the program or the machine.
#[derive(Clone, Debug, PartialEq, Eq)]
struct SelfCheck {
    name: &'static str,
    status: CheckStatus,
    /// Text of what was found.
    found: String,
    /// Advice; empty if nothing is to do.
    advice: String,
}

impl SelfCheck {
    fn ok(name: &'static str, found: impl Into<String>) -> Self {
        Self { name, status: CheckStatus::Ok, found: found.into(), advice: String::new() }
    }

    fn warning(name: &'static str, found: impl Into<String>, advice: impl Into<String>) -> Self {
        let (found, advice) = (found.into(), advice.into());
        Self { name, status: CheckStatus::Warning, found, advice }
    }

    fn error(name: &'static str, found: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { status: CheckStatus::Error, ..Self::warning(name, found, advice) }
    }

    fn json(&self) -> Value {
        let mut value =
            json!({ "name": self.name, "status": self.status.name(), "found": self.found });
        if !self.advice.is_empty() {
            value["advice"] = self.advice.as_str().into();
        }
        value
    }
}

/// Prints all checks. Exit code 1: an error.
pub(super) fn run(is_json: bool) -> Result<ExitCode, CliError> {
    let mut checks = vec![program::build(), program::page(), program::python()];
    checks.extend(machine::all());
    checks.extend(network::all());
    checks.extend(folders::all());
    let worst = checks.iter().map(|check| check.status).max().unwrap_or(CheckStatus::Ok);
    if is_json {
        let report = json!({
            "program": program::identity(),
            "status": worst.name(),
            "checks": checks.iter().map(SelfCheck::json).collect::<Vec<_>>(),
        });
        writeln!(io::stdout().lock(), "{report:#}")?;
    } else {
        anstream::stdout().lock().write_all(text(&checks).as_bytes())?;
    }
    Ok(if worst == CheckStatus::Error { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// One line per check, and a line of advice below those that are not ok.
fn text(checks: &[SelfCheck]) -> String {
    let width = checks.iter().map(|check| check.name.len()).max().unwrap_or_default();
    let mut out = String::new();
    for check in checks {
        let (name, status) = (check.name, check.status.name());
        out += &format!("{status:7}  {name:width$}  {}\n", check.found);
        if !check.advice.is_empty() {
            out += &format!("{:7}  {:width$}  help: {}\n", "", "", check.advice);
        }
    }
    let count = |status| checks.iter().filter(|check| check.status == status).count();
    let (errors, warnings) = (count(CheckStatus::Error), count(CheckStatus::Warning));
    out += &match (errors, warnings) {
        (0, 0) => "no problems found\n".to_owned(),
        _ => format!("{errors} errors, {warnings} warnings\n"),
    };
    out
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::*;

    #[test]
    fn advice_is_below_its_check() {
        let checks = [
            SelfCheck::ok("page", "built in"),
            SelfCheck::warning("port 8765", "in use", "use `--page=8766`"),
        ];
        expect![[r"
            ok       page       built in
            warning  port 8765  in use
                                help: use `--page=8766`
            0 errors, 1 warnings
        "]]
        .assert_eq(&text(&checks));
        assert_eq!(text(&checks[..1]).lines().last(), Some("no problems found"));
    }

    #[test]
    fn an_error_is_worse_than_a_warning() {
        assert!(
            CheckStatus::Error > CheckStatus::Warning && CheckStatus::Warning > CheckStatus::Ok
        );
    }
}
