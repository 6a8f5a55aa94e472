//! Output to the terminal.

use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use periplus_loader::LoadContext;

pub(crate) use periplus_session::terminal::{
    complain, diagnostics, findings, print_findings, processors, say, search, working_folder,
};

/// Exit code after Ctrl-C, as in shells.
pub(crate) const INTERRUPTED: u8 = 130;

/// Progress bar; hidden where stderr is not a terminal.
pub(crate) fn bar(length: u64, what: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let style =
        format!("{{bar:30}} {{percent}} %, {{human_pos}} of {{human_len}} {what}, {{eta}} left");
    let style = ProgressStyle::with_template(&style);
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Runs a function with the file system and environment of this machine.
pub(crate) fn with_setting<T>(
    resource_path: &[PathBuf],
    arguments: Vec<(String, String)>,
    run: impl FnOnce(&LoadContext<'_>) -> T,
) -> T {
    search(resource_path)
        .with_context(true, |context| run(&LoadContext { arguments, ..context.clone() }))
}
