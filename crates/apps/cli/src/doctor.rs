//! `periplus doctor`.

mod files;
mod network_test;
mod own;

use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Subcommand};
use periplus_diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap, to_json};
use periplus_ros2cli::doctor::{examine, listen};
use serde_json::json;

use crate::costmap::doctor::DoctorCostmapOptions;
use crate::error::CliError;
use crate::options::SearchOptions;
use crate::sim::Robots;
use crate::terminal;
use crate::verbs::{Common, seconds, with_session};

/// Diagnose a running system or a file, and name the parameter to change
///
/// Without a file it examines the running system: QoS mismatches, missing transforms, missing
/// /clock, silent sensors, programs in other domains. A world or robot (SDF, URDF, xacro) is
/// simulated for two seconds and examined likewise; of a parameter file costmaps and clocks are
/// examined; a launch file is planned, and nothing is started. Exit code 1: findings.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct DoctorOptions {
    #[command(subcommand)]
    command: Option<DoctorCommand>,
    /// Check this program and this machine instead: version, target, page, memory, network, Python;
    /// exit code 1: an error
    #[arg(long = "self", conflicts_with_all = ["words", "time", "robot"])]
    own: bool,
    /// World, robot, launch file or parameter file to examine, in place of the running system
    #[arg(value_name = "FILE|NAME:=VALUE")]
    words: Vec<String>,
    #[command(flatten)]
    robots: Robots,
    /// Duration of the measurement [s]
    #[arg(long, short = 't', value_name = "SECONDS", default_value_t = 3.0, value_parser = seconds)]
    time: f64,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    search: SearchOptions,
}

#[derive(Debug, Subcommand)]
enum DoctorCommand {
    Costmap(DoctorCostmapOptions),
}

pub(crate) fn run(options: &DoctorOptions) -> Result<ExitCode, CliError> {
    if let Some(DoctorCommand::Costmap(options)) = &options.command {
        return crate::costmap::doctor::run(options);
    }
    if options.own {
        return own::run(options.common.json);
    }
    if !options.words.is_empty() || !options.robots.others.is_empty() {
        return files::run(options);
    }
    let mut found = None;
    let code = with_session(&options.common, |session| {
        let mut observation = listen(session, Duration::from_secs_f64(options.time))?;
        observation.network_settings = Some(network_test::look());
        let counts = (observation.seen.nodes.len(), observation.seen.topics.len());
        found = Some((examine(&observation), counts));
        Ok(())
    })?;
    let Some((found, (nodes, topics))) = found else { return Ok(code) };
    let what = format!("{nodes} nodes, {topics} topics");
    tell(&[(found, SourceMap::new())], &what, options.common.json)
}

/// Returns a count such as `2 errors, 1 warning`, or `no problems found`.
fn counted(severities: &[Severity]) -> String {
    let kinds = [Severity::Error, Severity::Warning, Severity::Hint];
    let parts: Vec<String> = kinds
        .into_iter()
        .map(|kind| (severities.iter().filter(|one| **one == kind).count(), kind.name()))
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" }))
        .collect();
    if parts.is_empty() { "no problems found".to_owned() } else { parts.join(", ") }
}

#[test]
fn every_finding_is_counted_by_its_kind() {
    let of = counted;
    assert_eq!(of(&[]), "no problems found");
    assert_eq!(of(&[Severity::Hint]), "1 hint");
    let mixed = [Severity::Warning, Severity::Error, Severity::Hint, Severity::Warning];
    assert_eq!(of(&mixed), "1 error, 2 warnings, 1 hint");
}

/// Prints findings; the exit code is 1 when there are warnings or errors.
fn tell(
    found: &[(Diagnostics, SourceMap)],
    what: &str,
    is_json: bool,
) -> Result<ExitCode, CliError> {
    let all =
        || found.iter().flat_map(|(found, sources)| found.iter().map(move |it| (it, sources)));
    let is_serious = |(finding, _): (&Diagnostic, &SourceMap)| finding.severity != Severity::Hint;
    let has_serious = all().any(is_serious);
    if is_json {
        let findings: Vec<_> = all().map(|(finding, sources)| to_json(finding, sources)).collect();
        let report = json!({ "examined": what, "findings": findings });
        writeln!(io::stdout().lock(), "{report:#}")?;
    } else {
        let mut out = anstream::stdout().lock();
        for (findings, sources) in found {
            terminal::diagnostics(&mut out, findings, sources)?;
        }
        let severities: Vec<Severity> = all().map(|(finding, _)| finding.severity).collect();
        writeln!(out, "{what}: {}", counted(&severities))?;
    }
    Ok(if has_serious { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
