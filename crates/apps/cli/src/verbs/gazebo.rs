//! Topics and services of Gazebo Transport.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write as _};
use std::process::ExitCode;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_gz_transport::{Advertisement, Settings, Transport};
use periplus_os::{Machine, Stopwatch, sleep};
use serde_json::json;

use super::Common;
use crate::error::CliError;
use crate::terminal;

/// Longest wait for Gazebo programs, which send heartbeats every second.
const DISCOVERY: Duration = Duration::from_millis(2500);

/// Time without a new topic after which discovery is complete.
const SETTLE_TIME: Duration = Duration::from_millis(500);

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(20);

/// Lists the topics of Gazebo programs, as `gz topic -l` does.
pub(super) fn topics(common: &Common, show_types: bool, count: bool) -> Result<ExitCode, CliError> {
    list("topic", Transport::topics, common, show_types, count)
}

/// Lists the services of Gazebo programs, as `gz service -l` does.
pub(super) fn services(
    common: &Common,
    show_types: bool,
    count: bool,
) -> Result<ExitCode, CliError> {
    list("service", Transport::services, common, show_types, count)
}

fn list(
    what: &str,
    offered: impl Fn(&Transport) -> Vec<Advertisement>,
    common: &Common,
    show_types: bool,
    count: bool,
) -> Result<ExitCode, CliError> {
    let (settings, findings) = Settings::from_environment(&Machine);
    terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    let transport = Transport::open(&settings).map_err(CliError::failed)?;
    let longest = common.spin_time.map_or(DISCOVERY, Duration::from_secs_f64);
    let (clock, mut changed, mut known) = (Stopwatch::start(), Stopwatch::start(), 0);
    while clock.elapsed() < longest && (known == 0 || changed.elapsed() < SETTLE_TIME) {
        let now = offered(&transport).len();
        if now != known {
            (known, changed) = (now, Stopwatch::start());
        }
        sleep(POLL_PERIOD);
    }
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for one in offered(&transport) {
        found.entry(one.name).or_default().extend(one.types);
    }
    let mut out = io::stdout().lock();
    if common.json {
        let all = found.iter().map(|(name, types)| json!({ "name": name, "types": types }));
        writeln!(out, "{}", json!({ format!("{what}s"): all.collect::<Vec<_>>() }))?;
    } else if count {
        writeln!(out, "{}", found.len())?;
    } else {
        for (name, types) in &found {
            let types: Vec<&str> = types.iter().map(String::as_str).collect();
            match show_types {
                true => writeln!(out, "{name} [{}]", types.join(", "))?,
                false => writeln!(out, "{name}")?,
            }
        }
        if found.is_empty() {
            terminal::say(&format!(
                "no Gazebo {what} found in partition `{}`: start a world with `periplus gz sim \
                 WORLD` or `periplus sim WORLD --gz`",
                settings.partition
            ));
        }
    }
    Ok(ExitCode::SUCCESS)
}
