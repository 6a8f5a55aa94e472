//! Running the fuzz targets.

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::step::{Failed, root, run, timed};

/// A single input that takes longer than this is a finding; seconds.
const SLOWEST_S: u32 = 10;
/// A single input that takes more than this is a finding; MiB.
const LARGEST_MIB: u32 = 2048;

/// Runs the named targets, or all, each for some seconds from the kept seeds, some at once. New inputs go into a
/// copy, so that the seeds do not change; a crash is kept in `fuzz/artifacts`.
///
/// # Errors
/// When a target is unknown, cannot be built, or finds something.
pub(crate) fn run_all(seconds: u32, jobs: NonZero<usize>, wanted: &[String]) -> Result<(), Failed> {
    let known = targets(&root().join("fuzz/fuzz_targets"))?;
    if let Some(stranger) = wanted.iter().find(|name| !known.contains(name)) {
        return Err(Failed(format!(
            "unknown fuzz target `{stranger}`; known targets: {}",
            known.join(", ")
        )));
    }
    let chosen = if wanted.is_empty() { &known } else { wanted };
    timed("fuzz: build", || {
        let mut build = cargo_fuzz("build");
        if let [target] = chosen {
            build.arg(target);
        }
        run(&mut build, TOOLS)
    })?;
    let next = AtomicUsize::new(0);
    let has_failed = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..jobs.get() {
            scope.spawn(|| {
                while let Some(target) = chosen.get(next.fetch_add(1, Ordering::Relaxed))
                    && !has_failed.load(Ordering::Relaxed)
                {
                    let outcome =
                        timed(&format!("fuzz {target}"), || run_one(seconds, target, jobs.get()));
                    if let Err(Failed(why)) = outcome {
                        eprintln!("{why}");
                        has_failed.store(true, Ordering::Relaxed);
                    }
                }
            });
        }
    });
    if has_failed.into_inner() {
        return Err(Failed("a fuzz target has failed; see above".to_owned()));
    }
    Ok(())
}

/// Requirements of fuzz targets, and the folder of their findings.
const TOOLS: &str = "the input that failed is in fuzz/artifacts; required are \
                     `rustup toolchain install nightly` and `cargo install --locked cargo-fuzz`";

/// A command of `cargo fuzz`.
fn cargo_fuzz(command: &str) -> Command {
    let mut fuzz = Command::new("rustup");
    fuzz.current_dir(root()).args(["run", "nightly", "cargo", "fuzz", command]);
    // The toolchain that runs this task must not be forced upon nightly's.
    for variable in ["CARGO", "RUSTC", "RUSTUP_TOOLCHAIN"] {
        fuzz.env_remove(variable);
    }
    fuzz
}

fn targets(folder: &Path) -> Result<Vec<String>, Failed> {
    let entries = fs::read_dir(folder).map_err(|error| failed(folder, &error))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| {
            entry.ok()?.file_name().to_str()?.strip_suffix(".rs").map(str::to_owned)
        })
        .collect();
    names.sort();
    Ok(names)
}

/// Runs a target; of several at once only what failed is printed.
fn run_one(seconds: u32, target: &str, jobs: usize) -> Result<(), Failed> {
    let corpus =
        std::env::temp_dir().join(format!("periplus-fuzz-{target}-{}", std::process::id()));
    copy_seeds(&root().join("fuzz/seeds").join(target), &corpus)?;
    let mut fuzz = cargo_fuzz("run");
    fuzz.arg(target)
        .arg(&corpus)
        .arg("--")
        .arg(format!("-max_total_time={seconds}"))
        .arg(format!("-timeout={SLOWEST_S}"))
        .arg(format!("-rss_limit_mb={LARGEST_MIB}"))
        .arg("-print_final_stats=1");
    let outcome = if jobs == 1 { run(&mut fuzz, TOOLS) } else { run_quietly(&mut fuzz) };
    let _ = fs::remove_dir_all(&corpus);
    outcome
}

/// Runs a program, and prints its output only if it fails.
fn run_quietly(command: &mut Command) -> Result<(), Failed> {
    let output = command.output().map_err(|error| Failed(format!("{error}: {TOOLS}")))?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    Err(Failed(format!("{text}\n{TOOLS}")))
}

/// Copies the seeds of a target, if it has any.
fn copy_seeds(seeds: &Path, corpus: &PathBuf) -> Result<(), Failed> {
    fs::create_dir_all(corpus).map_err(|error| failed(corpus, &error))?;
    let Ok(entries) = fs::read_dir(seeds) else {
        println!("no seeds in {}", seeds.display());
        return Ok(());
    };
    for seed in entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file()) {
        let copy = corpus.join(seed.file_name().unwrap_or_default());
        fs::copy(&seed, copy).map_err(|error| failed(&seed, &error))?;
    }
    Ok(())
}

fn failed(path: &Path, error: &std::io::Error) -> Failed {
    Failed(format!("{}: {error}", path.display()))
}
