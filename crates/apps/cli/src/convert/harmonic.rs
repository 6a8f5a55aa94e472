//! `periplus convert --to harmonic`: files of Gazebo Classic for current Gazebo, with a report and a comparison run.

mod compare;
mod difference;
mod drive;
mod launch;
mod measure;
mod output;
mod project;
mod record;
mod report;

use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

use crate::error::CliError;
use crate::options::{ConvertOptions, split};
use crate::terminal;

use compare::Comparison;
use project::Project;

/// Runs the conversion of a file.
pub(super) fn run(options: &ConvertOptions) -> Result<ExitCode, CliError> {
    let (files, arguments) = split(&options.words);
    let [file] = files.as_slice() else {
        return Err(CliError::usage("convert takes one file; see `periplus convert --help`"));
    };
    if options.model.is_some() || options.resolution.is_some() || options.output.is_some() {
        return Err(CliError::usage(
            "`--to harmonic` converts whole files into the folder `--out`; `--model`, `--output` and \
             `--resolution` are for the other formats",
        ));
    }
    let Some(folder) = options.out.as_deref() else {
        return Err(CliError::usage("`--to harmonic` needs `--out FOLDER` for the new files"));
    };
    if launch::is_launch_file(file) {
        return launch::run(file, arguments, folder, options);
    }
    let project = Project::read(file, arguments, &options.search)?;
    if project.is_current() {
        terminal::say(&format!(
            "{}: nothing of Gazebo Classic in it, so nothing is written; it loads in current Gazebo as it is",
            file.display()
        ));
        if options.json {
            writeln!(
                io::stdout().lock(),
                "{:#}",
                report::json(&project, &[], &Comparison::not_needed())
            )?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let comparison = if options.no_compare {
        Comparison::not_run("left out with --no-compare")
    } else {
        Comparison::run(&project, &options.search)
    };
    let written = output::write(&project, &comparison, folder)?;
    if options.json {
        writeln!(io::stdout().lock(), "{:#}", report::json(&project, &written, &comparison))?;
    } else {
        summary(&project, &comparison, &written, folder);
    }
    Ok(if comparison.is_unexplained() { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// Lines for the terminal.
fn summary(project: &Project, comparison: &Comparison, written: &[String], folder: &Path) {
    for line in report::counts(project) {
        terminal::say(&line);
    }
    terminal::say(&comparison.summary());
    terminal::say(&format!(
        "{} files in {}; read {} first",
        written.len(),
        folder.display(),
        folder.join(output::REPORT).display()
    ));
}
