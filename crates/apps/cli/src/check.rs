//! `periplus check`.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use periplus_diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap, to_json};
use periplus_loader::{FileFormat, LoadedFile, describe, load, summarise};
use serde_json::{Value, json};

use crate::error::CliError;
use crate::options::{CheckOptions, split};
use crate::terminal::{self, counts, with_setting};

const BOLD: clap::builder::styling::Style = clap::builder::styling::Style::new().bold();

pub(crate) fn run(options: &CheckOptions) -> Result<ExitCode, CliError> {
    let (files, arguments) = split(&options.words);
    if files.is_empty() {
        return Err(CliError::usage(
            "no file is given, only `name:=value`; see `periplus check --help`",
        ));
    }
    let mut out = anstream::AutoStream::auto(io::stdout().lock());
    with_setting(&options.search.resource_path, arguments, |setting| {
        let mut failed = false;
        let mut reports = Vec::new();
        // Several files share the arguments: an argument that no file declares is an error.
        let mut unknown: Vec<&str> =
            setting.arguments.iter().map(|(name, _)| name.as_str()).collect();
        for (index, file) in files.iter().enumerate() {
            let mut loaded = load(file, setting);
            let of_this = loaded.unknown_arguments(&setting.arguments);
            unknown.retain(|name| of_this.contains(name));
            if index + 1 == files.len() {
                unknown.iter().for_each(|name| loaded.warn_of_argument(name));
            }
            let more = beyond(file, &mut loaded);
            let severities: &[Severity] = if options.strict {
                &[Severity::Error, Severity::Warning]
            } else {
                &[Severity::Error]
            };
            let is_bad = |found: &Diagnostics| severities.iter().any(|it| found.count(*it) > 0);
            failed |= is_bad(&loaded.diagnostics);
            failed |= more.iter().any(|(found, _)| is_bad(found));
            let name = file.display().to_string();
            if options.json {
                reports.push(report(&name, &loaded, &more));
            } else {
                if index > 0 && !options.quiet {
                    writeln!(out)?;
                }
                for (found, sources) in &more {
                    terminal::diagnostics(&mut out, found, sources)?;
                }
                show(&mut out, &name, &loaded, options.quiet)?;
            }
        }
        if options.json {
            writeln!(out, "{:#}", json!({ "files": reports, "ok": !failed }))?;
        }
        out.flush()?;
        Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    })
}

fn show(out: &mut dyn Write, name: &str, loaded: &LoadedFile, quiet: bool) -> io::Result<()> {
    terminal::findings(out, loaded)?;
    if quiet {
        return Ok(());
    }
    writeln!(out, "{BOLD}{name}{BOLD:#}: {}, {}", loaded.language.name(), counts(loaded))?;
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
    if loaded.language == FileFormat::Xacro && loaded.scene.is_none() && loaded.document.is_some() {
        writeln!(out, "  macros and properties only, to be included by other files")?;
    }
    Ok(())
}

/// Findings of parameter files, from the nodes that read them.
pub(crate) fn beyond(file: &Path, loaded: &mut LoadedFile) -> Vec<(Diagnostics, SourceMap)> {
    if loaded.language != FileFormat::Parameters || loaded.diagnostics.has_errors() {
        return Vec::new();
    }
    match crate::doctor::examine_parameters(file) {
        Ok(found) => found,
        Err(why) => {
            loaded.diagnostics.push(Diagnostic::error("bad-parameters", why));
            Vec::new()
        }
    }
}

fn report(name: &str, loaded: &LoadedFile, more: &[(Diagnostics, SourceMap)]) -> Value {
    let own = std::iter::once((&loaded.diagnostics, &loaded.sources));
    let all = own.chain(more.iter().map(|(found, sources)| (found, sources)));
    let findings: Vec<Value> = all
        .clone()
        .flat_map(|(found, sources)| found.iter().map(|finding| to_json(finding, sources)))
        .collect();
    let count = |severity| all.clone().map(|(found, _)| found.count(severity)).sum::<usize>();
    json!({
        "file": name,
        "language": loaded.language,
        "errors": count(Severity::Error),
        "warnings": count(Severity::Warning),
        "hints": count(Severity::Hint),
        "findings": findings,
        "contents": loaded.scene.as_ref().map(summarise),
        "mesh": loaded.mesh,
        "lines": loaded.contents,
        "files": loaded.files,
    })
}
