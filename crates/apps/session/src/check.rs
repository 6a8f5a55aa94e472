//! Checks of files, as `periplus check` reports them.

mod parameters;

use std::fmt::{self, Write as _};
use std::io::{self, Write};
use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap, to_json};
use periplus_loader::{FileFormat, LoadContext, LoadedFile, describe, load, summarise};
use serde_json::{Value, json};

use crate::terminal;

pub use parameters::examine_parameters;

/// Bold text in a terminal, and its end.
const BOLD: &str = "\u{1b}[1m";
const PLAIN: &str = "\u{1b}[0m";

/// Checked file.
#[derive(Debug)]
pub struct CheckedFile {
    /// Path as the user wrote it.
    pub name: String,
    /// The file with its findings.
    pub loaded: LoadedFile,
    /// Findings of the nodes that read the file, for parameter files.
    pub more: Vec<(Diagnostics, SourceMap)>,
}

impl CheckedFile {
    /// Checks a file of any format.
    #[must_use]
    pub fn read(file: &Path, context: &LoadContext<'_>) -> Self {
        let mut loaded = load(file, context);
        let more = findings_of_nodes(file, &mut loaded);
        Self { name: file.display().to_string(), loaded, more }
    }

    /// As [`Self::read`], with a warning for each argument that the file does not declare.
    #[must_use]
    pub fn read_alone(file: &Path, context: &LoadContext<'_>) -> Self {
        let mut checked = Self::read(file, context);
        let unknown = checked.loaded.unknown_arguments(&context.arguments);
        let unknown: Vec<String> = unknown.into_iter().map(str::to_owned).collect();
        unknown.iter().for_each(|name| checked.loaded.warn_of_argument(name));
        checked
    }

    /// Returns true if the file has errors, or with `is_strict` warnings.
    #[must_use]
    pub fn is_bad(&self, is_strict: bool) -> bool {
        self.count(Severity::Error) > 0 || (is_strict && self.count(Severity::Warning) > 0)
    }

    /// Number of findings of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings().map(|(found, _)| found.count(severity)).sum()
    }

    /// Findings with the texts that they refer to.
    fn findings(&self) -> impl Iterator<Item = (&Diagnostics, &SourceMap)> {
        let own = std::iter::once((&self.loaded.diagnostics, &self.loaded.sources));
        own.chain(self.more.iter().map(|(found, sources)| (found, sources)))
    }

    /// Report as JSON.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let findings: Vec<Value> = self
            .findings()
            .flat_map(|(found, sources)| found.iter().map(|finding| to_json(finding, sources)))
            .collect();
        json!({
            "file": self.name,
            "language": self.loaded.language,
            "errors": self.count(Severity::Error),
            "warnings": self.count(Severity::Warning),
            "hints": self.count(Severity::Hint),
            "findings": findings,
            "contents": self.loaded.scene.as_ref().map(summarise),
            "mesh": self.loaded.mesh,
            "lines": self.loaded.contents,
            "files": self.loaded.files,
        })
    }

    /// Writes the findings, and without `is_quiet` what the file contains.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_text(&self, out: &mut dyn Write, is_quiet: bool) -> io::Result<()> {
        for (found, sources) in &self.more {
            terminal::diagnostics(out, found, sources)?;
        }
        let loaded = &self.loaded;
        terminal::findings(out, loaded)?;
        if is_quiet {
            return Ok(());
        }
        let (name, language) = (&self.name, loaded.language.name());
        writeln!(out, "{BOLD}{name}{PLAIN}: {language}, {}", FindingCounts(&loaded.diagnostics))?;
        if let Some(scene) = &loaded.scene {
            write!(out, "{}", describe(&summarise(scene)))?;
        }
        if let Some(mesh) = &loaded.mesh {
            let [x, y, z] = mesh.size_m;
            writeln!(
                out,
                "  {} triangles, {} vertices, {x:.4} x {y:.4} x {z:.4} m, parts: {}",
                mesh.triangles,
                mesh.vertices,
                mesh.submeshes.join(", ")
            )?;
        }
        for line in &loaded.contents {
            writeln!(out, "  {line}")?;
        }
        if let Some(advice) = loaded.language.advice() {
            writeln!(out, "  {advice}")?;
        }
        let has_macros_only = loaded.language == FileFormat::Xacro
            && loaded.scene.is_none()
            && loaded.document.is_some();
        if has_macros_only {
            writeln!(out, "  macros and properties only, to be included by other files")?;
        }
        Ok(())
    }
}

/// Report of several files as JSON: those of the files, and `ok`.
#[must_use]
pub fn report(files: &[Value], is_ok: bool) -> Value {
    json!({ "files": files, "ok": is_ok })
}

/// Counts such as `2 errors, 1 warning`, or `no findings`.
struct FindingCounts<'a>(&'a Diagnostics);

impl fmt::Display for FindingCounts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [Severity::Error, Severity::Warning, Severity::Hint];
        let mut text = String::new();
        for (count, severity) in kinds.map(|severity| (self.0.count(severity), severity)) {
            if count > 0 {
                let gap = if text.is_empty() { "" } else { ", " };
                let plural = if count == 1 { "" } else { "s" };
                write!(text, "{gap}{count} {}{plural}", severity.name())?;
            }
        }
        f.write_str(if text.is_empty() { "no findings" } else { &text })
    }
}

/// Findings of parameter files, from the nodes that read them.
fn findings_of_nodes(file: &Path, loaded: &mut LoadedFile) -> Vec<(Diagnostics, SourceMap)> {
    if loaded.language != FileFormat::Parameters || loaded.diagnostics.has_errors() {
        return Vec::new();
    }
    match examine_parameters(file) {
        Ok(found) => found,
        Err(why) => {
            loaded.diagnostics.push(Diagnostic::error("bad-parameters", why.to_string()));
            Vec::new()
        }
    }
}
