//! SLAM on logs of real robots, against relations that are known.

mod page;
mod peers;
mod program;
mod record;

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, cargo, root, run};
use record::Record;

/// Seeds of the particles.
const SEEDS: &str = "1,2,3";
/// The page of the docs, and its picture.
const PAGE: &str = "docs/slam-benchmark.md";
const PICTURE: &str = "docs/pictures/slam-maps.png";

/// Parts of the benchmark; all of them make the page.
pub(crate) struct Wish {
    /// Names of logs, with commas between.
    pub(crate) logs: Option<String>,
    /// Names of runs, with commas between.
    pub(crate) runs: Option<String>,
    /// One line of JSON for each run, in place of tables.
    pub(crate) json: bool,
    /// Compare with the page in place of writing it.
    pub(crate) check: bool,
    /// Go on with runs that were interrupted.
    pub(crate) resume: bool,
    /// Write the page from the runs that are there, and map nothing again.
    pub(crate) page: bool,
    /// The program whose memory is measured, in place of a release build.
    pub(crate) program: Option<PathBuf>,
}

/// Maps all logs of `../shared/datasets`, as they are and perturbed, by the graph, and as they are by
/// particles with three seeds; measures the memory of the program; writes the page of the docs.
pub(crate) fn bench(wish: &Wish) -> Result<(), Failed> {
    let Ok(logs) = root().join("../shared/datasets").canonicalize() else {
        println!("SKIPPED: there is no ../shared/datasets to make maps of");
        return run(&mut example("worlds"), "a world with known truth failed");
    };
    let out = target().join("slam-bench");
    std::fs::create_dir_all(&out).map_err(failed(&out))?;

    let is_part = wish.logs.is_some() || wish.runs.is_some();
    let graph = out.join(if is_part { "graph-part.json" } else { "graph.json" });
    let particles = out.join(if is_part { "particles-part.json" } else { "particles.json" });
    // Thirty maps each: as they are only.
    let is_wanted =
        |run: &str| wish.runs.as_ref().is_none_or(|it| it.split(',').any(|it| it == run));
    if !wish.page {
        let why = "a log of the folder cannot be read";
        let mut command = logs_example(&logs, &graph, wish.resume);
        wanted(&mut command, "--only", wish.logs.as_deref());
        wanted(&mut command, "--runs", wish.runs.as_deref());
        run(quiet(&mut command, wish), why)?;
        if is_wanted("plain") {
            let mut command = logs_example(&logs, &particles, wish.resume);
            command.args(["--method", "gmapping", "--runs", "plain", "--seeds", SEEDS]);
            wanted(&mut command, "--only", wish.logs.as_deref());
            run(quiet(&mut command, wish), why)?;
        }
    }
    let mut records = record::read(&graph)?;
    if is_wanted("plain") {
        records.extend(record::read(&particles)?);
    }
    if wish.json {
        for record in &records {
            println!("{}", record.line);
        }
        return Ok(());
    }
    if wish.check {
        return page::check(&root().join(PAGE), &records);
    }
    if is_part {
        println!("\n{}", page::tables(&records, &[]));
        return Ok(());
    }
    let whole = if wish.page {
        program::read(&out)?
    } else {
        program::measure(wish.program.as_deref(), &logs, &names(&records), &out)?
    };
    let mut picture = example("maps");
    picture.arg(&logs).arg(&out).arg(root().join(PICTURE));
    run(&mut picture, "the picture of the maps cannot be drawn")?;
    let page = root().join(PAGE);
    std::fs::write(&page, page::whole(&records, &whole)).map_err(failed(&page))?;
    println!("\n{PAGE} and {PICTURE} are written");
    if wish.page {
        return Ok(());
    }
    run(&mut example("worlds"), "a world with known truth failed")
}

/// Logs in the order in which they come.
fn names<'a>(records: impl IntoIterator<Item = &'a Record>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for record in records {
        if !names.contains(&record.log) {
            names.push(record.log.clone());
        }
    }
    names
}

/// Maps logs, and writes a line of JSON for each run.
fn logs_example(logs: &Path, json: &Path, resume: bool) -> Command {
    let mut command = example("logs");
    command.arg(logs).arg("--json").arg(json);
    if resume {
        command.arg("--resume");
    }
    command
}

/// Passes an option on.
fn wanted(command: &mut Command, name: &str, value: Option<&str>) {
    if let Some(value) = value {
        command.args([name, value]);
    }
}

/// Without the example's own table where the output is for a program.
fn quiet<'a>(command: &'a mut Command, wish: &Wish) -> &'a mut Command {
    if wish.json { command.stdout(std::process::Stdio::null()) } else { command }
}

fn example(name: &str) -> Command {
    let mut command = cargo();
    command.args(["run", "--quiet", "--release", "--package", "periplus-slam"]);
    command.args(["--example", name, "--"]);
    command
}

fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into)
}

fn failed(path: &Path) -> impl FnOnce(std::io::Error) -> Failed {
    let path = path.display().to_string();
    move |error| Failed(format!("{path}: {error}"))
}

/// Drives through our worlds by the real simulator, ten seeds each, and holds maps and trajectories of
/// `periplus slam` against the truth.
pub(crate) fn worlds() -> Result<(), Failed> {
    let mut command = cargo();
    command.args(["build", "--release", "--package", "periplus-cli", "--package"]);
    run(command.args(["periplus-benches", "--bins"]), "the programs cannot be built")?;
    let target = target();
    let mut race = std::process::Command::new(target.join("release/slam_worlds"));
    race.current_dir(root()).arg(target.join("release/periplus")).arg(target.join("slam-worlds"));
    run(&mut race, "a drive or a map failed")
}
