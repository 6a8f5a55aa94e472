//! `periplus scenario`.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use clap::Args;
use periplus_diagnostics::plain_words;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_scenarios::{
    Scenario, ScenarioError, ScenarioReport, ScenarioRunOptions, github_summary, json_schema,
    junit_xml, run as run_scenario,
};
use periplus_session::{files, stop};
use serde_json::json;

use crate::error::CliError;

use crate::options::SearchOptions;
use crate::terminal;

/// Run scenarios: a world, a robot, events, faults and assertions
///
/// Each file is a YAML of a world, a robot, nodes (SLAM, localization, costmaps, navigation), events by time, position or
/// message, faults and assertions. Everything runs in one process in simulated time: the same file and seed give the
/// same bytes. Of a scenario that fails, recording, map, picture, log and the command that runs it again are kept.
/// Exit code 1: an assertion does not hold.
#[derive(Debug, Args)]
pub(crate) struct ScenarioOptions {
    /// Scenario files
    #[arg(value_name = "FILE.yaml", required_unless_present = "schema")]
    files: Vec<PathBuf>,
    /// Seed of all noise and faults [default: that of the file]
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Value of a variable of the file; repeatable
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = variable)]
    variables: Vec<(String, String)>,
    /// Value of a parameter of a node, besides those of the file; repeatable
    #[arg(long = "parameter", value_name = "NODE:NAME=VALUE", value_parser = parameter)]
    parameters: Vec<[String; 3]>,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE.xml")]
    junit: Option<PathBuf>,
    /// Folder for the artifacts, in a folder for each scenario that fails
    #[arg(long, value_name = "DIR", default_value = "scenario-artifacts")]
    artifacts: PathBuf,
    /// Keep the artifacts of scenarios that pass, too
    #[arg(long)]
    keep: bool,
    /// Run each scenario this many times, and fail if any message differs
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Print the digest of all messages, to compare runs
    #[arg(long)]
    digest: bool,
    /// Number of threads for rays; results do not depend on it
    #[arg(long, value_name = "NUMBER")]
    threads: Option<usize>,
    /// Print the JSON schema of scenario files, for editors
    #[arg(long, conflicts_with_all = ["files", "junit", "json"])]
    schema: bool,
    /// Print the reports as JSON
    #[arg(long)]
    json: bool,
    /// Print only errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    search: SearchOptions,
}

/// Variable of the environment with the file of GitHub's summary.
const SUMMARY_VARIABLE: &str = "GITHUB_STEP_SUMMARY";

pub(crate) fn run(options: &ScenarioOptions) -> Result<ExitCode, CliError> {
    if options.schema {
        writeln!(io::stdout().lock(), "{:#}", json_schema())?;
        return Ok(ExitCode::SUCCESS);
    }
    // All files are read first: a mistake in the last one is found before the first one has run.
    let read = options.files.iter().map(|path| options.read(path));
    let scenarios = read.collect::<Vec<_>>().into_iter().collect::<Result<Vec<_>, _>>()?;
    let stop = stop::on_signal();
    let (mut reports, mut has_differed) = (Vec::new(), false);
    for scenario in &scenarios {
        let run_options = options.run_options(scenario, stop.clone());
        let report = run_scenario(scenario, &run_options).map_err(failed)?;
        if !options.json && !options.quiet {
            report.write_text(&mut anstream::stderr().lock())?;
        }
        has_differed |= !options.is_repeatable(scenario, &run_options, &report)?;
        reports.push(report);
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    if options.json {
        let all: Vec<_> = reports.iter().map(ScenarioReport::to_json).collect();
        writeln!(io::stdout().lock(), "{:#}", json!(all))?;
    }
    if let Some(path) = &options.junit {
        files::write(path, junit_xml(&reports).as_bytes())?;
    }
    if let Some(path) = Machine.variable(SUMMARY_VARIABLE).filter(|path| !path.is_empty()) {
        append(Path::new(&path), &github_summary(&reports))?;
    }
    if reports.iter().all(ScenarioReport::has_passed) && !has_differed {
        return Ok(ExitCode::SUCCESS);
    }
    if options.quiet {
        for failure in reports.iter().flat_map(ScenarioReport::failures) {
            terminal::complain(&failure);
        }
    }
    Ok(ExitCode::FAILURE)
}

impl ScenarioOptions {
    /// Reads a scenario, and prints its mistakes.
    fn read(&self, path: &Path) -> Result<Scenario, CliError> {
        let text = files::text(path)?;
        match Scenario::read(path, text, &self.variables) {
            Ok(scenario) => Ok(scenario),
            Err(error) => {
                let mut err = anstream::stderr().lock();
                terminal::diagnostics(&mut err, &error.diagnostics, &error.sources)?;
                Err(CliError::Reported(1))
            }
        }
    }

    fn run_options(
        &self,
        scenario: &Scenario,
        stop: Arc<std::sync::atomic::AtomicBool>,
    ) -> ScenarioRunOptions {
        let options = ScenarioRunOptions {
            seed: self.seed,
            keeps_artifacts: self.keep,
            has_digest: self.digest || self.repeat > 1,
            threads: self.threads.unwrap_or_else(terminal::processors),
            search: terminal::search(&self.search.resource_path),
            set: self.variables.clone(),
            parameters: self.parameters.clone(),
            is_verbose: !self.quiet && !self.json,
            stop,
            ..ScenarioRunOptions::default()
        };
        let name: String = scenario.name.chars().map(folder_letter).collect();
        let folder = format!("{name}-seed{}", options.seed_of(scenario));
        ScenarioRunOptions { artifacts: Some(self.artifacts.join(folder)), ..options }
    }

    /// Runs a scenario again and compares the reports; prints the first difference.
    fn is_repeatable(
        &self,
        scenario: &Scenario,
        options: &ScenarioRunOptions,
        first: &ScenarioReport,
    ) -> Result<bool, CliError> {
        // What is kept does not depend on the run.
        let options = ScenarioRunOptions { artifacts: None, is_verbose: false, ..options.clone() };
        let comparable = |report: &ScenarioReport| {
            ScenarioReport { artifacts: None, ..report.clone() }.to_json().to_string()
        };
        let wanted = comparable(first);
        let bar = terminal::bar(u64::from(self.repeat), "runs", self.quiet || self.json);
        for number in 2..=self.repeat {
            if options.stop.load(Ordering::Relaxed) {
                break;
            }
            let report = run_scenario(scenario, &options).map_err(failed)?;
            bar.inc(1);
            if comparable(&report) != wanted {
                bar.finish_and_clear();
                let digest = |report: &ScenarioReport| report.digest.clone().unwrap_or_default();
                terminal::complain(&format!(
                    "{}: run {number} differs from the first: digest {} instead of {}",
                    scenario.name,
                    digest(&report),
                    digest(first)
                ));
                return Ok(false);
            }
        }
        bar.finish_and_clear();
        if self.repeat > 1 && !self.quiet && !self.json {
            let (name, count) = (&scenario.name, self.repeat);
            terminal::say(&format!("{name}: {count} runs without a different byte"));
        }
        Ok(true)
    }
}

pub(crate) fn failed(error: ScenarioError) -> CliError {
    match error {
        ScenarioError::Run(error) => error.into(),
        ScenarioError::File(error) => error.into(),
        ScenarioError::Failed(message) => CliError::Failed(message),
    }
}

/// Letter of a folder's name.
fn folder_letter(letter: char) -> char {
    if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '_' }
}

fn append(path: &Path, text: &str) -> Result<(), CliError> {
    let file = OpenOptions::new().create(true).append(true).open(path);
    file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        CliError::failed(format!("cannot write to {}: {}", path.display(), plain_words(&error)))
    })
}

pub(crate) fn variable(word: &str) -> Result<(String, String), String> {
    match word.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err(format!("`{word}` is not `name=value`")),
    }
}

fn parameter(word: &str) -> Result<[String; 3], String> {
    let parts = word.split_once('=').and_then(|(full, value)| {
        let (node, name) = full.split_once(':')?;
        Some([node, name, value].map(str::to_owned))
    });
    match parts {
        Some(parts) if parts.iter().all(|part| !part.is_empty()) => Ok(parts),
        _ => Err(format!("`{word}` is not `node:name=value`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_a_node() {
        let words = ["a/b", "c.d", "x:y=z"].map(str::to_owned);
        assert_eq!(parameter("a/b:c.d=x:y=z"), Ok(words));
        assert!(parameter("a=1").is_err() && parameter("a:=1").is_err());
    }

    #[test]
    fn variables_are_names_and_values() {
        assert_eq!(variable("a=b=c"), Ok(("a".into(), "b=c".into())));
        assert_eq!(variable("a="), Ok(("a".into(), String::new())));
        assert!(variable("a").is_err() && variable("=1").is_err());
    }
}
