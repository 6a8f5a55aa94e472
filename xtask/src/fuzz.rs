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

/// Settings of a run.
#[derive(Clone, clap::Args)]
pub(crate) struct Options {
    /// Duration of each target [s]; 0 only runs the seeds, which is the same in every run
    #[arg(long, default_value_t = 60)]
    seconds: u32,
    /// Number of targets that run at once
    #[arg(long, default_value = "1")]
    jobs: NonZero<usize>,
    /// Build in a third of the time: with less optimization, and without the address sanitizer
    #[arg(long)]
    quick: bool,
}

/// Runs the named targets, or all, each for some seconds from the kept seeds, some at once. New inputs go into a
/// copy, so that the seeds do not change; a crash is kept in `fuzz/artifacts`.
///
/// # Errors
/// When a target is unknown, cannot be built, or finds something.
pub(crate) fn run_all(options: &Options, wanted: &[String]) -> Result<(), Failed> {
    let known = targets(&root().join("fuzz/fuzz_targets"))?;
    if let Some(stranger) = wanted.iter().find(|name| !known.contains(name)) {
        return Err(Failed(format!(
            "unknown fuzz target `{stranger}`; known targets: {}",
            known.join(", ")
        )));
    }
    let chosen = if wanted.is_empty() { &known } else { wanted };
    timed("fuzz: build", || {
        let mut build = cargo_fuzz("build", options.quick);
        if let [target] = chosen {
            build.arg(target);
        }
        run(&mut build, TOOLS)
    })?;
    let next = AtomicUsize::new(0);
    let has_failed = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..options.jobs.get() {
            scope.spawn(|| {
                while let Some(target) = chosen.get(next.fetch_add(1, Ordering::Relaxed))
                    && !has_failed.load(Ordering::Relaxed)
                {
                    let outcome = timed(&format!("fuzz {target}"), || run_one(options, target));
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

/// A command of `cargo fuzz`. All of a run need the same options, or each would build everything again.
fn cargo_fuzz(command: &str, is_quick: bool) -> Command {
    let mut fuzz = Command::new("rustup");
    fuzz.current_dir(root()).args(["run", "nightly", "cargo", "fuzz", command]);
    if is_quick {
        fuzz.args(["--sanitizer", "none", "--codegen-units", "16"]);
        fuzz.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1");
    }
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
fn run_one(options: &Options, target: &str) -> Result<(), Failed> {
    let corpus =
        std::env::temp_dir().join(format!("periplus-fuzz-{target}-{}", std::process::id()));
    copy_seeds(&root().join("fuzz/seeds").join(target), &corpus)?;
    let mut fuzz = cargo_fuzz("run", options.quick);
    fuzz.arg(target)
        .arg(&corpus)
        .arg("--")
        .arg(match options.seconds {
            0 => "-runs=0".to_owned(),
            seconds => format!("-max_total_time={seconds}"),
        })
        .arg(format!("-timeout={SLOWEST_S}"))
        .arg(format!("-rss_limit_mb={LARGEST_MIB}"))
        .arg("-print_final_stats=1");
    let outcome = match options.jobs.get() {
        1 => run(&mut fuzz, TOOLS),
        _ => run_quietly(&mut fuzz),
    };
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
