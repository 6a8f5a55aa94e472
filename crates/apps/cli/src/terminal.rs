//! What a person reads.

use std::io::{self, Write};
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use periplus_diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap, Style, render};
use periplus_loader::{Loaded, Setting};
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::Search;

/// The exit code of what a person stopped with Ctrl-C before its end, as shells have it.
pub(crate) const INTERRUPTED: u8 = 130;

/// Writes one line about the command itself to stderr.
pub(crate) fn complain(words: &str) {
    let _ = writeln!(anstream::stderr(), "error: {words}");
}

/// Writes one line to stderr about what goes wrong while the command goes on.
pub(crate) fn warn(words: &str) {
    let _ = writeln!(anstream::stderr(), "warning: {words}");
}

/// Writes one line about what was done to stderr.
pub(crate) fn say(words: &str) {
    let _ = writeln!(anstream::stderr(), "{words}");
}

/// Writes the findings of a file; colours are taken out on the way where nobody can see them.
pub(crate) fn findings(out: &mut dyn Write, loaded: &Loaded) -> io::Result<()> {
    diagnostics(out, &loaded.diagnostics, &loaded.sources)
}

/// Writes findings with the texts that they point into.
pub(crate) fn diagnostics(
    out: &mut dyn Write,
    diagnostics: &Diagnostics,
    sources: &SourceMap,
) -> io::Result<()> {
    for diagnostic in diagnostics.iter() {
        writeln!(out, "{}", render(diagnostic, sources, Style::Colour))?;
    }
    let unkept = diagnostics.unkept();
    if unkept > 0 {
        let more = Diagnostic::hint("more", format!("{unkept} more findings are not shown"));
        writeln!(out, "{}", render(&more, sources, Style::Colour))?;
    }
    Ok(())
}

/// `2 errors, 1 warning`, or `no findings`.
pub(crate) fn counts(loaded: &Loaded) -> String {
    let kinds = [Severity::Error, Severity::Warning, Severity::Hint];
    let parts: Vec<String> = kinds
        .into_iter()
        .map(|severity| (loaded.diagnostics.count(severity), severity.name()))
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" }))
        .collect();
    if parts.is_empty() { "no findings".to_owned() } else { parts.join(", ") }
}

/// A line that shows how far a long work is; nothing where stderr is no terminal.
pub(crate) fn bar(length: u64, what: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let style =
        format!("{{bar:30}} {{percent}} %, {{human_pos}} of {{human_len}} {what}, {{eta}} left");
    let style = ProgressStyle::with_template(&style);
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Where the user stands.
pub(crate) fn working_folder() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

/// Where things are looked for that a running world is told to spawn.
pub(crate) fn search(resource_path: &[PathBuf]) -> Search {
    let working_folder = working_folder();
    let folders = resource_path.iter().map(|folder| working_folder.join(folder)).collect();
    Search { folders, working_folder, ..Search::default() }
}

/// Threads that the machine can run side by side.
pub(crate) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs something with the machine as readers see it.
pub(crate) fn with_setting<T>(
    resource_path: &[PathBuf],
    arguments: Vec<(String, String)>,
    run: impl FnOnce(&Setting<'_>) -> T,
) -> T {
    let host = Machine;
    let working_folder = working_folder();
    let folders: Vec<PathBuf> =
        resource_path.iter().map(|folder| working_folder.join(folder)).collect();
    let resolver = Resolver::new(&host, &folders);
    run(&Setting { host: &host, resolver: &resolver, working_folder, arguments, open_meshes: true })
}
