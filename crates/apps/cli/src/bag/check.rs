//! `periplus bag check`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use periplus_bags::files::check;
use periplus_diagnostics::{Severity, SourceMap, to_json};
use serde_json::json;

use super::options::CheckOptions;
use super::progress::ProgressLine;
use crate::error::CliError;
use crate::terminal;

pub(super) fn run(options: &CheckOptions) -> Result<ExitCode, CliError> {
    let mut failed = false;
    let mut reports = Vec::new();
    for path in &options.bags {
        let Some(bag) = super::try_open(path)? else {
            failed = true;
            continue;
        };
        let line = ProgressLine::new(bag.message_count());
        let checked = check(&bag, &mut |count| line.show(count));
        line.clear();
        let (messages, findings) = match checked {
            Ok(checked) => checked,
            Err(error) => {
                terminal::complain(&error.to_string());
                failed = true;
                continue;
            }
        };
        let wrong = [bag.findings(), &findings]
            .iter()
            .map(|found| found.count(Severity::Error) + found.count(Severity::Warning))
            .sum::<usize>();
        failed |= wrong > 0;
        if options.json {
            let sources = SourceMap::new();
            let all: Vec<_> = bag
                .findings()
                .iter()
                .chain(findings.iter())
                .map(|one| to_json(one, &sources))
                .collect();
            let name = path.display().to_string();
            reports.push(
                json!({ "bag": name, "messages": messages, "findings": all, "ok": wrong == 0 }),
            );
        } else {
            super::tell(&findings)?;
            let word = if wrong == 0 { "in order".into() } else { format!("{wrong} findings") };
            writeln!(io::stdout(), "{}: {messages} messages, {word}", path.display())?;
        }
    }
    if options.json {
        writeln!(io::stdout(), "{:#}", json!({ "bags": reports, "ok": !failed }))?;
    }
    Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
