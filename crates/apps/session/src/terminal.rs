//! Output to the terminal.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::PathBuf;

use periplus_diagnostics::{Diagnostic, Diagnostics, RenderStyle, SourceMap, render};
use periplus_loader::LoadedFile;
use periplus_sim::Search;

/// Writes an error line to stderr.
pub fn complain(words: &str) {
    let _ = writeln!(anstream::stderr(), "error: {words}");
}

/// Writes a warning line to stderr.
pub fn warn(words: &str) {
    let _ = writeln!(anstream::stderr(), "warning: {words}");
}

/// Writes an informational line to stderr.
pub fn say(words: &str) {
    let _ = writeln!(anstream::stderr(), "{words}");
}

/// Writes the findings of a file; colours are stripped where the output does not show them.
///
/// # Errors
/// A failed write.
pub fn findings(out: &mut dyn Write, loaded: &LoadedFile) -> io::Result<()> {
    diagnostics(out, &loaded.diagnostics, &loaded.sources)
}

/// Findings with the same message that are written one by one.
const MAX_EQUAL_FINDINGS: usize = 5;

/// Writes findings with the source texts that they refer to.
///
/// # Errors
/// A failed write.
pub fn diagnostics(
    out: &mut dyn Write,
    diagnostics: &Diagnostics,
    sources: &SourceMap,
) -> io::Result<()> {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for diagnostic in diagnostics.iter() {
        let count = counts.entry((diagnostic.code, &*diagnostic.message)).or_default();
        *count += 1;
        if *count <= MAX_EQUAL_FINDINGS {
            writeln!(out, "{}", render(diagnostic, sources, RenderStyle::Colour))?;
        }
    }
    for ((code, message), count) in
        counts.into_iter().filter(|(_, count)| *count > MAX_EQUAL_FINDINGS)
    {
        let text = format!("{} more findings are equal: {message}", count - MAX_EQUAL_FINDINGS);
        let more = Diagnostic::hint("more", text).note(format!("all have the code `{code}`"));
        writeln!(out, "{}", render(&more, sources, RenderStyle::Colour))?;
    }
    let unkept = diagnostics.unkept();
    if unkept > 0 {
        let more = Diagnostic::hint("more", format!("{unkept} more findings are not shown"));
        writeln!(out, "{}", render(&more, sources, RenderStyle::Colour))?;
    }
    Ok(())
}

/// Writes findings of a running graph or network, which have no source text, to stderr.
///
/// # Errors
/// A failed write.
pub fn print_findings(findings: &Diagnostics) -> io::Result<()> {
    diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())
}

/// Working folder of the user.
#[must_use]
pub fn working_folder() -> PathBuf {
    if cfg!(target_family = "wasm") {
        // Files in memory have absolute paths.
        return PathBuf::from("/");
    }
    std::env::current_dir().unwrap_or_default()
}

/// Search paths of files: these folders, then those of the environment.
#[must_use]
pub fn search(resource_path: &[PathBuf]) -> Search {
    let working_folder = working_folder();
    let folders = resource_path.iter().map(|folder| working_folder.join(folder)).collect();
    Search { folders, working_folder, ..Search::default() }
}

/// Number of threads that can run in parallel.
#[must_use]
pub fn processors() -> usize {
    periplus_os::processors()
}
