//! Loading the corpus: what PyPI's xacro and libsdformat do, and we.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_loader::{LoadContext, load};
use periplus_os::Machine;
use periplus_resources::{Host as _, Resolver};
use serde_json::json;

use crate::files::{Job, accepted, megabytes};
use crate::peers::seconds;

/// One line of the comparison.
pub(crate) struct Row {
    pub(crate) work: &'static str,
    pub(crate) peer: &'static str,
    pub(crate) files: usize,
    pub(crate) megabytes: f64,
    pub(crate) peer_seconds: f64,
    pub(crate) our_seconds: f64,
}

/// Runs both sides in turns.
pub(crate) fn compare(oracles: &Path, turns: usize) -> Result<Vec<Row>, String> {
    let xacro = accepted(
        &oracles.join("xacro.jsonl"),
        |file| json!({ "file": file }).to_string(),
        |_| true,
    )?;
    let is_expanded = |file: &str| file.contains("/expanded/");
    let sdf = accepted(&oracles.join("sdf.jsonl"), str::to_owned, |answer| {
        answer["kind"] == "sdf" && !answer["file"].as_str().is_some_and(is_expanded)
    })?;
    let urdf =
        accepted(&oracles.join("sdf.jsonl"), str::to_owned, |answer| answer["kind"] == "urdf")?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracles/xacro_oracle.py");
    let python = || {
        let mut command = Command::new("python3");
        command.arg(&script);
        command
    };
    let libsdformat = || Command::new(oracles.join("bin/sdf_oracle"));
    Ok(vec![
        row("xacro expanded", "PyPI xacro 2.1.1", &xacro, turns, python, expand_all)?,
        row("SDF and worlds loaded", "libsdformat 12.3", &sdf, turns, libsdformat, load_all)?,
        row("URDF to SDF model", "libsdformat 12.3", &urdf, turns, libsdformat, load_all)?,
    ])
}

fn row(
    work: &'static str,
    peer: &'static str,
    jobs: &[Job],
    turns: usize,
    program: impl Fn() -> Command,
    ours: impl Fn(&[Job]),
) -> Result<Row, String> {
    let (mut peer_seconds, mut our_seconds) = (f64::INFINITY, f64::INFINITY);
    for turn in 1..=turns {
        eprintln!("{work}, turn {turn} of {turns}");
        peer_seconds = peer_seconds.min(seconds(&mut program(), jobs)?);
        let started = Instant::now();
        ours(jobs);
        our_seconds = our_seconds.min(started.elapsed().as_secs_f64());
    }
    Ok(Row { work, peer, files: jobs.len(), megabytes: megabytes(jobs), peer_seconds, our_seconds })
}

/// Folders that both sides look in, as `cargo xtask bench` sets them.
fn search() -> Vec<PathBuf> {
    std::env::var_os("PERIPLUS_ORACLE_PATH")
        .map(|folders| std::env::split_paths(&folders).collect())
        .unwrap_or_default()
}

/// Jobs of one repository after the other: a fresh resolver each, as a fresh command would have.
fn repositories(jobs: &[Job]) -> impl Iterator<Item = (PathBuf, &[Job])> {
    let repository = |job: &Job| {
        let is_root = |path: &&Path| path.parent().is_some_and(|parent| parent.ends_with("corpus"));
        job.file.ancestors().find(is_root).map(Path::to_owned).unwrap_or_default()
    };
    jobs.chunk_by(move |a, b| repository(a) == repository(b))
        .map(move |chunk| (repository(&chunk[0]), chunk))
}

fn expand_all(jobs: &[Job]) {
    let host = Machine;
    for (repository, jobs) in repositories(jobs) {
        let folders: Vec<PathBuf> = search().into_iter().chain([repository]).collect();
        let resolver = Resolver::new(&host, &folders);
        for job in jobs {
            let mut sources = SourceMap::new();
            let mut diagnostics = Diagnostics::new();
            let Ok(bytes) = host.read(&job.file) else { continue };
            let Ok(text) = periplus_xml::decode(&bytes) else { continue };
            let file = sources.add(job.file.display().to_string(), text);
            let Some(document) = periplus_xml::parse(file, &sources, &mut diagnostics) else {
                continue;
            };
            let setting = periplus_xacro::XacroContext {
                path: job.file.clone(),
                working_folder: PathBuf::from("/"),
                arguments: Vec::new(),
                host: &host,
                resolver: &resolver,
            };
            let expanded =
                periplus_xacro::expand(&document, setting, &mut sources, &mut diagnostics);
            // The peer writes its result too.
            let text = expanded.map(|expanded| periplus_xml::write_document(&expanded.document));
            std::hint::black_box(text);
        }
    }
}

fn load_all(jobs: &[Job]) {
    let host = Machine;
    for (repository, jobs) in repositories(jobs) {
        let folders: Vec<PathBuf> = search().into_iter().chain([repository]).collect();
        let resolver = Resolver::new(&host, &folders);
        let setting = LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder: PathBuf::from("/"),
            arguments: Vec::new(),
            // libsdformat does not look into meshes.
            open_meshes: false,
        };
        for job in jobs {
            std::hint::black_box(load(&job.file, &setting));
        }
    }
}

/// The rows as a table for a person.
pub(crate) fn table(rows: &[Row]) -> String {
    let mut out = format!(
        "{:24} {:18} {:>6} {:>7} {:>10} {:>10} {:>8}\n",
        "work", "peer", "files", "MB", "peer s", "ours s", "ratio"
    );
    for row in rows {
        let _ = writeln!(
            out,
            "{:24} {:18} {:6} {:7.2} {:10.3} {:10.3} {:7.1}x",
            row.work,
            row.peer,
            row.files,
            row.megabytes,
            row.peer_seconds,
            row.our_seconds,
            row.peer_seconds / row.our_seconds
        );
    }
    let (peers, ours) = rows
        .iter()
        .fold((0.0, 0.0), |(peers, ours), row| (peers + row.peer_seconds, ours + row.our_seconds));
    let _ = writeln!(out, "all together {:>56.3} {ours:10.3} {:7.1}x", peers, peers / ours);
    out
}
