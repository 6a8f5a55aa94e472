//! Ray and Optuna: the module `periplus.sweeps` in Python.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use periplus_diagnostics::plain_words;
use serde_json::{Value, json};

use super::SweepOptions;
use crate::error::CliError;
use crate::own_command::{interpreter, own_command};
use crate::terminal;

/// Module with Ray and Optuna.
const MODULE: &str = "periplus.sweeps";

/// Time between two looks at the request to stop.
const POLL_PERIOD: Duration = Duration::from_millis(100);

/// Jobs for a Ray cluster.
pub(super) struct RayWork<'a> {
    /// Address of the cluster.
    pub(super) address: &'a str,
    /// File of the plan.
    pub(super) plan_file: &'a Path,
    /// Numbers of the jobs.
    pub(super) missing: &'a [usize],
}

impl SweepOptions {
    /// Runs jobs on a Ray cluster. Returns the number of starts, with those of runs that were lost.
    pub(super) fn run_on_ray(
        &self,
        work: &RayWork<'_>,
        failures: &mut [Option<String>],
        stop: &AtomicBool,
    ) -> Result<Option<usize>, CliError> {
        let mut command = module("ray")?;
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(not_started)?;
        let order = json!({
            "address": work.address,
            "plan": work.plan_file,
            "jobs": work.missing,
            "artifacts": !self.no_artifacts,
        });
        if let Some(mut stdin) = child.stdin.take() {
            // A module that has ended already reports the reason itself.
            let _ = stdin.write_all(order.to_string().as_bytes());
        }
        let bar = terminal::bar(work.missing.len() as u64, "runs", self.is_silent());
        let mut started = None;
        let (sender, lines) = mpsc::channel();
        if let Some(out) = child.stdout.take() {
            thread::spawn(move || {
                let lines = BufReader::new(out).lines().map_while(Result::ok);
                lines.take_while(|line| sender.send(line.clone()).is_ok()).for_each(drop);
            });
        }
        loop {
            let line = match lines.recv_timeout(POLL_PERIOD) {
                Ok(line) => line,
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) if stop.load(Ordering::Relaxed) => {
                    // Ray ends the tasks of a driver that is gone.
                    let _ = child.kill();
                    break;
                }
                Err(RecvTimeoutError::Timeout) => continue,
            };
            let Ok(event) = serde_json::from_str::<Value>(&line) else { continue };
            if let Some(index) = event["job"].as_u64() {
                bar.inc(1);
                let failure = event["failure"].as_str().map(str::to_owned);
                if let Some(found) = usize::try_from(index).ok().and_then(|it| failures.get_mut(it))
                {
                    *found = failure;
                }
            }
            if let Some(count) = event["started"].as_u64() {
                started = usize::try_from(count).ok();
            }
        }
        bar.finish_and_clear();
        let status = child.wait().map_err(not_started)?;
        if !status.success() && !stop.load(Ordering::Relaxed) {
            // The module has printed the reason.
            return Err(CliError::Reported(1));
        }
        Ok(started)
    }

    /// Searches with Optuna: the module calls this command for each point.
    pub(super) fn search_with_optuna(&self, metric: &str) -> Result<ExitCode, CliError> {
        let (column, direction) = match metric.rsplit_once(':') {
            Some((column, "min")) => (column, "minimize"),
            Some((column, "max")) => (column, "maximize"),
            Some((_, other)) => {
                return Err(CliError::usage(format!(
                    "`--search {metric}`: the direction is `{other}`; it must be `min` or `max`"
                )));
            }
            None => (metric, "minimize"),
        };
        let parameters = self.parameters.iter().map(|range| match range.interval() {
            Some([low, high]) => json!({ "name": range.name(), "low": low, "high": high }),
            None => json!({ "name": range.name(), "values": range.values() }),
        });
        let text = |path: &Path| path.display().to_string();
        let mut words = vec!["--seeds".to_owned(), self.seeds.to_string()];
        if let Some(seed) = self.seed {
            words.extend(["--seed".to_owned(), seed.to_string()]);
        }
        for (name, value) in &self.variables {
            words.extend(["--set".to_owned(), format!("{name}={value}")]);
        }
        if let Some(workers) = self.workers {
            words.extend(["--workers".to_owned(), workers.to_string()]);
        }
        if let Some(address) = &self.ray {
            words.extend(["--ray".to_owned(), address.clone()]);
        }
        for folder in &self.search_options.resource_path {
            words.extend(["--resource-path".to_owned(), text(folder)]);
        }
        for (is_given, word) in [(self.no_artifacts, "--no-artifacts"), (self.fresh, "--fresh")] {
            words.extend(is_given.then(|| word.to_owned()));
        }
        let order = json!({
            "program": own_command(),
            "scenario": text(&self.scenario),
            "out": text(&self.folder()?),
            "options": words,
            "parameters": parameters.collect::<Vec<_>>(),
            "column": column,
            "direction": direction,
            "trials": self.trials,
            "sampler_seed": self.seed.unwrap_or(0),
            "quiet": self.is_silent(),
            "json": self.json,
        });
        let mut child = module("search")?.stdin(Stdio::piped()).spawn().map_err(not_started)?;
        if let Some(mut stdin) = child.stdin.take() {
            let _ = stdin.write_all(order.to_string().as_bytes());
        }
        let code = child.wait().map_err(not_started)?.code().unwrap_or(1);
        Ok(u8::try_from(code).map_or(ExitCode::FAILURE, ExitCode::from))
    }
}

fn module(part: &str) -> Result<Command, CliError> {
    let interpreter = interpreter();
    let mut command = Command::new(interpreter.command().map_err(CliError::failed)?);
    command.args(["-m", MODULE, part]);
    Ok(command)
}

fn not_started(error: std::io::Error) -> CliError {
    CliError::failed(format!("`python -m {MODULE}` cannot run: {}", plain_words(&error)))
}
