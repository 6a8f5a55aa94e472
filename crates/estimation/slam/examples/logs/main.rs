//! All logs of a folder, as they are and perturbed, in one table.
//!
//! `logs FOLDER [--only NAME,..] [--runs plain,rotate,..] [--method graph|gmapping] [--seeds 1,2,3]
//! [--set particles=30,..] [--threads N] [--out DIR] [--json FILE [--resume]] [--why]
//! [--remarks]`.
//!
//! Runs are shared out among threads; times are CPU of the thread that a run is on. `--json` writes a line
//! for each run as soon as it has ended, and with `--resume` runs that the file has are not done again.
//! `--out` writes maps and trajectories, `--why` prints which relations carry the error.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a tool that reads logs, measures time and prints results"
)]

mod perturb;
mod print;
mod score;
mod why;

use std::collections::BTreeMap;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use periplus_bags::read_carmen;
use periplus_geometry::Pose2;
use periplus_slam::{Method, Relation, read_relations};

use perturb::{RUNS, perturbed};
use score::{Log, Outcome, Show, race, values};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        arguments.iter().position(|it| it == name).and_then(|at| arguments.get(at + 1)).cloned()
    };
    let list = |name: &str| -> Option<Vec<String>> {
        after(name).map(|it| it.split(',').map(str::to_owned).collect())
    };
    let folder = PathBuf::from(arguments.first().cloned().unwrap_or("../shared/datasets".into()));
    let (only, runs, out) = (list("--only"), list("--runs"), after("--out").map(PathBuf::from));
    for run in runs.iter().flatten() {
        assert!(RUNS.contains(&run.as_str()), "`{run}` is no run; there are {}", RUNS.join(", "));
    }
    let method: Method = after("--method").map_or(Method::Graph, |it| it.parse().unwrap());
    let seeds: Vec<Option<u64>> =
        list("--seeds").map_or(vec![None], |it| it.iter().map(|it| it.parse().ok()).collect());
    let set = after("--set").unwrap_or_default();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = after("--threads").map_or(cores, |it| it.parse().unwrap()).max(1);
    let has = |name: &str| arguments.iter().any(|it| it == name);

    let logs = logs(&folder, only.as_deref());
    assert!(!logs.is_empty(), "no log in {} has that name", folder.display());
    let mut jobs: Vec<(usize, &'static str, Option<u64>)> = Vec::new();
    for log in 0..logs.len() {
        for run in RUNS {
            if runs.as_ref().is_none_or(|runs| runs.iter().any(|it| it == run)) {
                jobs.extend(seeds.iter().map(|&seed| (log, run, seed)));
            }
        }
    }
    let path = after("--json").map(PathBuf::from);
    let head = |&(log, run, seed): &(usize, &'static str, Option<u64>)| {
        print::head(&logs[log].name, run, method, seed)
    };
    let heads: Vec<String> = jobs.iter().map(head).collect();
    let before = match &path {
        Some(path) if has("--resume") => fs::read_to_string(path).unwrap_or_default(),
        _ => String::new(),
    };
    jobs.retain(|job| !before.lines().any(|line| line.starts_with(&head(job))));
    let json = path.as_ref().map(|path| {
        let mut file = fs::File::create(path).unwrap();
        file.write_all(before.as_bytes()).unwrap();
        file
    });
    // The shortest logs first: most of the table is there soon.
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&it| (logs[jobs[it].0].log.scans.len(), it));

    let (next, done) = (AtomicUsize::new(0), Mutex::new((json, BTreeMap::new())));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let show =
                    Show { why: has("--why"), remarks: has("--remarks"), out: out.as_deref() };
                while let Some(&number) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (log, run, seed) = jobs[number];
                    let log = &logs[log];
                    let copy = perturbed(&log.log, run);
                    let values = values(method, &set, seed);
                    let outcome = race(log, (run, &copy), (method, &values, seed), &show);
                    let mut done = done.lock().unwrap();
                    if let Some(json) = &mut done.0 {
                        json.write_all(print::json(&outcome).as_bytes()).unwrap();
                    }
                    let count = done.1.len() + 1;
                    eprintln!("[{count}/{}] {}", jobs.len(), print::progress(&outcome));
                    done.1.insert(number, outcome);
                }
            });
        }
    });
    let outcomes: Vec<Outcome> = done.into_inner().unwrap().1.into_values().collect();
    print!("{}", print::table(&outcomes));
    if let Some(path) = path {
        // In order, whichever was done first.
        let text = fs::read_to_string(&path).unwrap();
        let order = |line: &&str| heads.iter().position(|head| line.starts_with(head));
        let mut lines: Vec<&str> = text.lines().collect();
        lines.sort_by_key(order);
        fs::write(path, lines.join("\n") + "\n").unwrap();
    }
}

/// Logs of a folder, by name.
fn logs(folder: &Path, only: Option<&[String]>) -> Vec<Log> {
    let mut folders: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
    folders.sort();
    let read = |folder: &PathBuf| {
        let name = folder.file_name()?.to_string_lossy().into_owned();
        if only.is_some_and(|only| !only.contains(&name)) {
            return None;
        }
        let log = read_carmen(&fs::read(folder.join("raw.clf")).ok()?);
        let truth = fs::read_to_string(folder.join("truth.txt")).ok().map(|text| poses(&text));
        Some(Log { name, log, relations: relations(folder), truth })
    };
    folders.iter().filter_map(read).collect()
}

fn relations(folder: &Path) -> Vec<Relation> {
    let names = ["intel.clean.relations", "aces.relations", "agreement.relations"];
    let text = names.iter().find_map(|name| fs::read_to_string(folder.join(name)).ok());
    read_relations(&text.unwrap_or_default()).unwrap()
}

/// Poses of lines `stamp x y yaw`.
fn poses(text: &str) -> Vec<Pose2> {
    let numbers =
        |line: &str| -> Vec<f64> { line.split(' ').map(|it| it.parse().unwrap()).collect() };
    text.lines().map(numbers).map(|it| Pose2::new(it[1], it[2], it[3])).collect()
}
