//! `periplus check`.

use std::io::{self, Write};
use std::process::ExitCode;

use periplus_diagnostics::{Severity, to_json};
use periplus_formats::{Language, Loaded, describe, load, summarise};
use serde_json::{Value, json};

use crate::options::{CheckOptions, split};
use crate::terminal::{self, counts, with_setting};

const BOLD: clap::builder::styling::Style = clap::builder::styling::Style::new().bold();

pub(crate) fn run(options: &CheckOptions) -> io::Result<ExitCode> {
    let (files, arguments) = split(&options.words);
    if files.is_empty() {
        terminal::complain("no file is given, only `name:=value`; see `periplus check --help`");
        return Ok(ExitCode::from(2));
    }
    let mut out = anstream::AutoStream::auto(io::stdout().lock());
    with_setting(&options.search.resource_path, arguments, |setting| {
        let mut failed = false;
        let mut reports = Vec::new();
        for (index, file) in files.iter().enumerate() {
            let loaded = load(file, setting);
            let severities: &[Severity] = if options.strict {
                &[Severity::Error, Severity::Warning]
            } else {
                &[Severity::Error]
            };
            failed |= severities.iter().any(|severity| loaded.diagnostics.count(*severity) > 0);
            let name = file.display().to_string();
            if options.json {
                reports.push(report(&name, &loaded));
            } else {
                if index > 0 && !options.quiet {
                    writeln!(out)?;
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

fn show(out: &mut dyn Write, name: &str, loaded: &Loaded, quiet: bool) -> io::Result<()> {
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
    if loaded.language == Language::Xacro && loaded.scene.is_none() && loaded.document.is_some() {
        writeln!(out, "  macros and properties for others to include")?;
    }
    Ok(())
}

fn report(name: &str, loaded: &Loaded) -> Value {
    let findings = loaded.diagnostics.iter().map(|finding| to_json(finding, &loaded.sources));
    json!({
        "file": name,
        "language": loaded.language,
        "errors": loaded.diagnostics.count(Severity::Error),
        "warnings": loaded.diagnostics.count(Severity::Warning),
        "hints": loaded.diagnostics.count(Severity::Hint),
        "findings": findings.collect::<Vec<_>>(),
        "contents": loaded.scene.as_ref().map(summarise),
        "mesh": loaded.mesh,
        "files": loaded.files,
    })
}
