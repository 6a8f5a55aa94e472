//! `periplus report`: one HTML file about a run, or about two runs and their difference.
//!
//! The file needs no server, no network and no script. All parts come from the recording; missing parts are left out
//! or named.

mod comparison;
mod goals;
mod html;
mod log_messages;
mod map;
mod overview;
mod parameters;
mod plot;
mod scores;
mod series;

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_bags::files::Bag;
use periplus_session::recorded::RecordedFrames;
use serde_json::json;

use self::html::{Section, document, escape};
use crate::error::CliError;
use crate::paths;
use crate::score::{ScoreSettings, put_json};
use crate::terminal::say;

/// Write a report of a run, or of two runs and their difference, as one HTML file
///
/// The file has the scores of `periplus score` (if the truth is known), the map with paths and goals, plots of speed,
/// localization error and distance to obstacles, log errors and parameters. It needs no server, no network and no script,
/// and can be sent or printed.
#[derive(Debug, Args)]
pub(crate) struct ReportOptions {
    /// Recording (.mcap, .db3, .bag, or a folder of `ros2 bag`)
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Second recording, to which the first is compared
    #[arg(value_name = "B")]
    second: Option<PathBuf>,
    /// HTML file to write [default: the name of RUN with `.html`]
    #[arg(long, short = 'o', value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// Print the scores of the runs as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: ScoreSettings,
}

pub(crate) fn run(options: &ReportOptions) -> Result<ExitCode, CliError> {
    let runs: Vec<&Path> =
        std::iter::once(&options.run).chain(&options.second).map(PathBuf::as_path).collect();
    let html = html_of(&runs, &options.settings)?;
    let output = options.output.clone().unwrap_or_else(|| options.run.with_extension("html"));
    paths::write(&output, html.as_bytes())?;
    say(&format!("report: {}", output.display()));
    if options.json {
        let scores: Vec<_> =
            runs.iter().map(|run| scores::to_json(run, &options.settings)).collect();
        put_json(&json!({ "report": output.display().to_string(), "runs": scores }))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns the report of one recording, or of two and their difference, as HTML.
///
/// # Errors
/// When a recording cannot be read.
pub fn report_html(runs: &[&Path]) -> Result<String, ReportError> {
    html_of(runs, &ScoreSettings::default()).map_err(|error| ReportError(error.message()))
}

/// Reason for which there is no report, as text for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportError(String);

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ReportError {}

/// A recording that is open.
struct OpenRun {
    path: PathBuf,
    /// `A` or `B` if there are two.
    label: &'static str,
    bag: Bag,
    frames: RecordedFrames,
}

/// Returns the report of one or two recordings.
pub(crate) fn html_of(runs: &[&Path], settings: &ScoreSettings) -> Result<String, CliError> {
    let labels = if runs.len() > 1 { ["A", "B"] } else { ["", ""] };
    let mut open = Vec::new();
    for (path, label) in runs.iter().zip(labels) {
        let bag = paths::log(path)?;
        let frames = RecordedFrames::read(&bag)?;
        open.push(OpenRun { path: (*path).to_owned(), label, bag, frames });
    }
    let names: Vec<String> = open.iter().map(|run| name_of(&run.path)).collect();
    let title = match names.as_slice() {
        [a, b] => format!("Comparison of {a} (A) and {b} (B)"),
        _ => format!("Run {}", names.join(", ")),
    };
    let mut sections: Vec<Section> = Vec::new();
    for run in &open {
        sections.push(overview::section(run)?);
    }
    if let [first, second] = open.as_slice() {
        sections.push(scores::comparison(first, second, settings));
        sections.push(comparison::section(first, second)?);
    }
    for run in &open {
        if open.len() == 1 {
            sections.push(scores::section(run, settings));
        }
        sections.extend(map::section(run)?);
        sections.extend(series::section(run, settings)?);
        sections.extend(map::costmaps(run)?);
        sections.extend(goals::section(run)?);
        sections.push(log_messages::section(run)?);
        sections.push(parameters::section(run)?);
    }
    Ok(document(&title, &sections))
}

/// Returns the name of a recording without its folder.
fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}

impl OpenRun {
    /// Returns a heading, with the label of one of two runs.
    fn heading(&self, text: &str) -> String {
        if self.label.is_empty() { text.to_owned() } else { format!("{}: {text}", self.label) }
    }

    /// Returns the frame of the robot.
    fn base(&self) -> Option<String> {
        self.frames.base("odom", None)
    }
}

/// Returns a table row of a name and a value.
fn row(name: &str, value: &str) -> String {
    format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(name), escape(value))
}
