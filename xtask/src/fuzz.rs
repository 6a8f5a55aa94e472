//! Running the fuzz targets.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, root, run, timed};

/// A single input that takes longer than this is a finding; seconds.
const SLOWEST_S: u32 = 10;
/// A single input that takes more than this is a finding; MiB.
const LARGEST_MIB: u32 = 2048;

/// Runs the named targets, or all, each for some seconds from the kept seeds. New inputs go into a
/// copy, so that the seeds do not change; a crash is kept in `fuzz/artifacts`.
///
/// # Errors
/// When a target is unknown, cannot be built, or finds something.
pub(crate) fn run_all(seconds: u32, wanted: &[String]) -> Result<(), Failed> {
    let known = targets(&root().join("fuzz/fuzz_targets"))?;
    if let Some(stranger) = wanted.iter().find(|name| !known.contains(name)) {
        return Err(Failed(format!(
            "unknown fuzz target `{stranger}`; known targets: {}",
            known.join(", ")
        )));
    }
    let chosen = if wanted.is_empty() { &known } else { wanted };
    chosen
        .iter()
        .try_for_each(|target| timed(&format!("fuzz {target}"), || run_one(seconds, target)))
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

fn run_one(seconds: u32, target: &str) -> Result<(), Failed> {
    let corpus =
        std::env::temp_dir().join(format!("periplus-fuzz-{target}-{}", std::process::id()));
    copy_seeds(&root().join("fuzz/seeds").join(target), &corpus)?;
    let mut fuzz = Command::new("rustup");
    fuzz.current_dir(root())
        .args(["run", "nightly", "cargo", "fuzz", "run", target])
        .arg(&corpus)
        .arg("--")
        .arg(format!("-max_total_time={seconds}"))
        .arg(format!("-timeout={SLOWEST_S}"))
        .arg(format!("-rss_limit_mb={LARGEST_MIB}"))
        .arg("-print_final_stats=1");
    // The toolchain that runs this task must not be forced upon nightly's.
    for variable in ["CARGO", "RUSTC", "RUSTUP_TOOLCHAIN"] {
        fuzz.env_remove(variable);
    }
    let outcome = run(
        &mut fuzz,
        "the input that failed is in fuzz/artifacts; required are \
         `rustup toolchain install nightly` and `cargo install --locked cargo-fuzz`",
    );
    let _ = fs::remove_dir_all(&corpus);
    outcome
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
