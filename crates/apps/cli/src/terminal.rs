//! Output to the terminal.

use std::io::{self, Write};
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use periplus_diagnostics::{Diagnostic, Diagnostics, RenderStyle, Severity, SourceMap, render};
use periplus_loader::{LoadContext, LoadedFile};
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::Search;

/// Exit code after Ctrl-C, as in shells.
pub(crate) const INTERRUPTED: u8 = 130;

/// Writes one line about the command itself to stderr.
pub(crate) fn complain(words: &str) {
    let _ = writeln!(anstream::stderr(), "error: {words}");
}

/// Writes a warning line to stderr.
pub(crate) fn warn(words: &str) {
    let _ = writeln!(anstream::stderr(), "warning: {words}");
}

/// Writes an informational line to stderr.
pub(crate) fn say(words: &str) {
    let _ = writeln!(anstream::stderr(), "{words}");
}

/// Writes the findings of a file; colours are stripped where the output does not show them.
pub(crate) fn findings(out: &mut dyn Write, loaded: &LoadedFile) -> io::Result<()> {
    diagnostics(out, &loaded.diagnostics, &loaded.sources)
}

/// Writes findings with the source texts that they refer to.
pub(crate) fn diagnostics(
    out: &mut dyn Write,
    diagnostics: &Diagnostics,
    sources: &SourceMap,
) -> io::Result<()> {
    for diagnostic in diagnostics.iter() {
        writeln!(out, "{}", render(diagnostic, sources, RenderStyle::Colour))?;
    }
    let unkept = diagnostics.unkept();
    if unkept > 0 {
        let more = Diagnostic::hint("more", format!("{unkept} more findings are not shown"));
        writeln!(out, "{}", render(&more, sources, RenderStyle::Colour))?;
    }
    Ok(())
}

/// Returns a count such as `2 errors, 1 warning`, or `no findings`.
pub(crate) fn counts(loaded: &LoadedFile) -> String {
    let kinds = [Severity::Error, Severity::Warning, Severity::Hint];
    let parts: Vec<String> = kinds
        .into_iter()
        .map(|severity| (loaded.diagnostics.count(severity), severity.name()))
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}{}", if count == 1 { "" } else { "s" }))
        .collect();
    if parts.is_empty() { "no findings".to_owned() } else { parts.join(", ") }
}

/// Progress bar; hidden where stderr is no terminal.
pub(crate) fn bar(length: u64, what: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let style =
        format!("{{bar:30}} {{percent}} %, {{human_pos}} of {{human_len}} {what}, {{eta}} left");
    let style = ProgressStyle::with_template(&style);
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Working folder of the user.
pub(crate) fn working_folder() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

/// Search paths of entities that a running world spawns.
pub(crate) fn search(resource_path: &[PathBuf]) -> Search {
    let working_folder = working_folder();
    let folders = resource_path.iter().map(|folder| working_folder.join(folder)).collect();
    Search { folders, working_folder, ..Search::default() }
}

/// Number of threads that can run in parallel.
pub(crate) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs a function with the file system and environment of this machine.
pub(crate) fn with_setting<T>(
    resource_path: &[PathBuf],
    arguments: Vec<(String, String)>,
    run: impl FnOnce(&LoadContext<'_>) -> T,
) -> T {
    let host = Machine;
    let working_folder = working_folder();
    let folders: Vec<PathBuf> =
        resource_path.iter().map(|folder| working_folder.join(folder)).collect();
    let resolver = Resolver::new(&host, &folders);
    run(&LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder,
        arguments,
        open_meshes: true,
    })
}
