//! `cargo xtask attack`: hostile inputs of every kind, each of which must be refused or borne.
//!
//! Sound files of ours are changed by a random stream with a fixed seed, and bombs are written by hand
//! (`attack/crafted.rs`). Each input goes to the command that reads its kind, in a process with limits.
//! A crash, more than 10 s of processor time or more than 500 MB is a fault; the input is then kept under
//! `target/attack/found`, with the command that shows it.

mod crafted;
mod kinds;
mod mutate;
mod random;
mod runner;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use crate::step::{Failed, build_program, root, timed};
use kinds::{KINDS, Kind};
use runner::{Fault, ONE, SEVERAL};

/// Seed of all inputs; another one makes others.
pub(crate) const SEED: u64 = 20_261_122;

/// Processes at a time.
const WORKERS: usize = 2;

/// Requested runs.
pub(crate) struct Wish {
    pub(crate) seed: u64,
    /// Only kinds with this in their names.
    pub(crate) only: Option<String>,
    /// Every Nth input.
    pub(crate) every: usize,
    /// The program; without it a release build.
    pub(crate) program: Option<PathBuf>,
}

/// Inputs of a kind for one process.
struct Batch {
    kind: &'static Kind,
    /// Number, name and bytes.
    inputs: Vec<(usize, String, Vec<u8>)>,
}

/// A fault that was found.
struct Found {
    kind: &'static str,
    fault: Fault,
    kept: PathBuf,
}

/// Attacks the program and prints what it did not bear.
pub(crate) fn attack(wish: &Wish) -> Result<(), Failed> {
    let program = match &wish.program {
        Some(program) => program.canonicalize().map_err(|error| words("the program", &error))?,
        None => {
            timed("attack: periplus", build_program)?;
            root().join("target/release/periplus")
        }
    };
    let folder = root().join("target/attack");
    let kept = folder.join("found");
    if kept.exists() {
        std::fs::remove_dir_all(&kept).map_err(|error| words("old findings", &error))?;
    }
    std::fs::create_dir_all(&kept).map_err(|error| words("the folder for findings", &error))?;
    let start = Instant::now();
    let is_wanted = |kind: &&Kind| wish.only.as_ref().is_none_or(|only| kind.name.contains(only));
    let all = AtomicUsize::new(0);
    // The inputs of one kind at a time are held in memory.
    let kinds = KINDS.iter().filter(is_wanted);
    let batches = Mutex::new(kinds.flat_map(|kind| batches(kind, wish, &all)));
    let next = || batches.lock().ok()?.next();
    let found = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for worker in 0..WORKERS {
            let (next, found, program) = (&next, &found, &program);
            let (own, kept) = (folder.join(format!("worker{worker}")), &kept);
            scope.spawn(move || {
                while let Some(batch) = next() {
                    let faults = try_batch(program, &own, kept, &batch);
                    for one in &faults {
                        println!("{}: {}: {}", one.kind, one.fault, one.kept.display());
                    }
                    if let Ok(mut found) = found.lock() {
                        found.extend(faults);
                    }
                }
                let _ = std::fs::remove_dir_all(own);
            });
        }
    });
    let found = found.into_inner().unwrap_or_default();
    let all = all.load(Ordering::Relaxed);
    println!("{all} inputs, {} faults, {:.0} s", found.len(), start.elapsed().as_secs_f64());
    if found.is_empty() {
        return Ok(());
    }
    Err(Failed(format!(
        "{} hostile inputs are not borne; each is kept in {} with its command",
        found.len(),
        kept.display()
    )))
}

/// Every Nth input of a kind, in batches; adds their number to `all`.
fn batches(kind: &'static Kind, wish: &Wish, all: &AtomicUsize) -> Vec<Batch> {
    let inputs = kind.inputs(wish.seed).into_iter().enumerate().step_by(wish.every.max(1));
    let mut inputs: Vec<_> = inputs.map(|(at, (end, bytes))| (at, end, bytes)).collect();
    all.fetch_add(inputs.len(), Ordering::Relaxed);
    let mut batches = Vec::new();
    while !inputs.is_empty() {
        let rest = inputs.split_off(kind.batch.min(inputs.len()));
        batches.push(Batch { kind, inputs: std::mem::replace(&mut inputs, rest) });
    }
    batches
}

fn words(what: &str, error: &std::io::Error) -> Failed {
    Failed(format!("{what}: {error}"))
}

/// Tries all inputs of a batch at once, and one by one where that is not borne.
fn try_batch(program: &Path, own: &Path, kept: &Path, batch: &Batch) -> Vec<Found> {
    if batch.inputs.len() > 1 && try_inputs(program, own, batch.kind, &batch.inputs).is_ok() {
        return Vec::new();
    }
    let mut found = Vec::new();
    for input in &batch.inputs {
        let one = std::slice::from_ref(input);
        if let Err(fault) = try_inputs(program, own, batch.kind, one) {
            let place = kept.join(format!("{}-{}", batch.kind.name, input.0));
            // The folder as it was, with the input, what is beside it, and the command.
            let _ = std::fs::rename(own, &place);
            let line = format!("periplus {}\n{fault}\n", line(batch.kind, one).join(" "));
            let _ = std::fs::write(place.join("command.txt"), line);
            found.push(Found { kind: batch.kind.name, fault, kept: place });
        }
    }
    found
}

/// Name of an input in its folder. Crafted files that include themselves know it.
fn name(kind: &Kind, number: usize, end: &str, is_alone: bool) -> String {
    match kind.called {
        Some(name) => name.to_owned(),
        None if is_alone => format!("x.{end}"),
        None => format!("x{number}.{end}"),
    }
}

fn line(kind: &Kind, inputs: &[(usize, String, Vec<u8>)]) -> Vec<String> {
    let is_alone = inputs.len() == 1;
    let names = || inputs.iter().map(|(at, end, _)| name(kind, *at, end, is_alone));
    let fill = |word: &&str| match *word {
        "{}" => names().collect(),
        word => vec![word.to_owned()],
    };
    kind.words.iter().flat_map(fill).collect()
}

fn try_inputs(
    program: &Path,
    own: &Path,
    kind: &Kind,
    inputs: &[(usize, String, Vec<u8>)],
) -> Result<(), Fault> {
    let put = |name: &str, bytes: &[u8]| {
        let path = own.join(name);
        let folder = path.parent().unwrap_or(own);
        std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, bytes))
    };
    let _ = std::fs::remove_dir_all(own);
    let is_alone = inputs.len() == 1;
    let beside = kind.beside.iter().map(|(name, file)| {
        let bytes = std::fs::read(root().join(file)).unwrap_or_default();
        put(name, &bytes)
    });
    let hostile = inputs.iter().map(|(at, end, bytes)| put(&name(kind, *at, end, is_alone), bytes));
    for outcome in beside.chain(hostile) {
        outcome.map_err(|error| Fault::Broken(format!("the input cannot be written: {error}")))?;
    }
    let limits = if is_alone { ONE } else { SEVERAL };
    runner::run(program, &line(kind, inputs), own, &own.join("stderr.txt"), limits)
}
