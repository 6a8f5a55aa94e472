//! `periplus bag convert` and `periplus bag cut`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_bags::files::{Bag, BagKind, Conversion, Storage, WriteSettings, convert};

use super::options::{ConvertOptions, CutOptions, SelectOptions};
use super::outputs;
use super::progress::ProgressLine;
use crate::error::CliError;
use crate::terminal;

pub(super) fn run(options: &ConvertOptions) -> Result<ExitCode, CliError> {
    let paths: Vec<&PathBuf> = options.bags.iter().chain(&options.input).collect();
    let mut bags = Vec::new();
    for path in paths {
        bags.push(super::open(path)?);
    }
    if !outputs::is_one(&options.output) {
        let settings = options.write.settings(&options.output, Storage::Mcap);
        return write(&bags, &options.output, &options.select, settings);
    }
    let (wanted, findings, sources) = outputs::read(&options.output)?;
    terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &sources)?;
    if findings.has_errors() {
        return Ok(ExitCode::FAILURE);
    }
    for one in wanted {
        let settings = one.write.settings(&one.output, Storage::Mcap);
        let code = write(&bags, &one.output, &one.select, settings)?;
        if code != ExitCode::SUCCESS {
            return Ok(code);
        }
    }
    Ok(ExitCode::SUCCESS)
}

pub(super) fn cut(options: &CutOptions) -> Result<ExitCode, CliError> {
    if options.select.is_all() {
        return Err(CliError::usage(
            "nothing to cut: select topics or times, or use `bag convert`",
        ));
    }
    let bag = super::open(&options.bag)?;
    let settings = options.write.settings(&options.output, bag.storage());
    let is_file = bag.kind() == BagKind::Ros1 && Storage::of_path(&options.output).is_none();
    let output =
        if is_file { options.output.with_extension("bag") } else { options.output.clone() };
    write(&[bag], &output, &options.select, settings)
}

fn write(
    bags: &[Bag],
    output: &Path,
    select: &SelectOptions,
    write: WriteSettings,
) -> Result<ExitCode, CliError> {
    let mut unknown = select.unknown(bags).peekable();
    if unknown.peek().is_some() {
        unknown.for_each(|name| terminal::complain(&format!("no recording has a topic `{name}`")));
        return Err(CliError::Reported(2));
    }
    let selection = select.of(bags);
    // Conversion runs alone, so it may use all cores.
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let write = WriteSettings { threads, ..write };
    let line = ProgressLine::new(bags.iter().map(Bag::message_count).sum());
    let done =
        convert(bags, output, Conversion { selection, write }, &mut |count| line.show(count));
    line.clear();
    match done {
        Ok(report) => {
            super::tell(&report.findings)?;
            let (messages, topics) = (report.info.messages(), report.info.topics.len());
            terminal::say(&format!("{}: {messages} messages on {topics} topics", output.display()));
            Ok(ExitCode::SUCCESS)
        }
        Err(error) => Err(CliError::failed(error)),
    }
}
