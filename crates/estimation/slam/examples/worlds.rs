//! Generated worlds with ground truth, in one table: campuses, ramps, halls, glass, crowds, doors, low-cost
//! scanners, long rings, repetitive areas: `worlds [--kind K,K] [--seeds N] [--seed S] [--short] [--why]`.
//! With `--why` it prints remarks, and the closures that are wrong by ground truth.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

#[path = "../tests/worlds/mod.rs"]
mod worlds;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use periplus_geometry::normalize_angle;
use worlds::Moment;
use worlds::kinds::{KINDS, Kind, Outcome, Verdict, outcome};

/// Closures off by more are wrong \[m, rad\].
const WRONG_M: f64 = 0.5;
const WRONG_RAD: f64 = 0.2;

/// Printed row of a run, with the values summed over seeds.
struct Row {
    text: String,
    verdict: Verdict,
    loops_m: f64,
    ms: f64,
    bytes: usize,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        arguments.iter().position(|it| it == name).and_then(|at| arguments.get(at + 1)).cloned()
    };
    let wanted = after("--kind");
    let seeds: u64 = after("--seeds").map_or(20, |it| it.parse().unwrap());
    let only: Option<u64> = after("--seed").map(|it| it.parse().unwrap());
    let is_short = arguments.iter().any(|it| it == "--short");
    let tells_why = arguments.iter().any(|it| it == "--why");
    let is_wanted =
        |kind: &&Kind| wanted.as_ref().is_none_or(|it| it.split(',').any(|it| it == kind.name));
    let seeds: Vec<u64> = only.map_or((0..seeds).collect(), |it| vec![it]);
    // All kinds of a seed before the next, so that an interrupted run has covered each kind.
    let jobs: Vec<(Kind, u64)> = seeds
        .iter()
        .flat_map(|&seed| KINDS.iter().filter(is_wanted).map(move |kind| (*kind, seed)))
        .collect();
    println!(
        "{:<10} {:>4} {:>6} {:>6} | {:>7} {:>7} {:>7} {:>5} | {:>6} {:>6} | {:>8} {:>5} {:>4} | {:<15} remarks",
        "world",
        "seed",
        "scans",
        "way m",
        "rms m",
        "max m",
        "loops m",
        "of",
        "ms",
        "kB",
        "closures",
        "wrong",
        "lost",
        "verdict"
    );
    let next = AtomicUsize::new(0);
    let rows: Mutex<BTreeMap<usize, Row>> = Mutex::default();
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some((kind, seed)) = jobs.get(at) else { return };
                    let row = race(kind, *seed, is_short, tells_why);
                    let mut rows = rows.lock().unwrap();
                    eprintln!("{:>3} of {}: {}", rows.len() + 1, jobs.len(), row.text);
                    rows.insert(at, row);
                }
            });
        }
    });
    let rows = rows.into_inner().unwrap();
    for kind in KINDS.iter().filter(is_wanted) {
        let of = jobs.iter().zip(rows.values()).filter(|((it, _), _)| it.name == kind.name);
        of.for_each(|it| println!("{}", it.1.text));
    }
    println!();
    for kind in KINDS.iter().filter(is_wanted) {
        let of = jobs.iter().zip(rows.values()).filter(|((it, _), _)| it.name == kind.name);
        let of: Vec<&Row> = of.map(|it| it.1).collect();
        let count = |verdict: Verdict| of.iter().filter(|it| it.verdict == verdict).count();
        let mut loops: Vec<f64> = of.iter().map(|it| it.loops_m).collect();
        loops.sort_by(f64::total_cmp);
        let bytes = of.iter().map(|it| it.bytes).max().unwrap_or(0);
        println!(
            "{:<10} {:>3} runs: {:>2} right, {:>2} right, yet reported, {:>2} wrong, reported, {:>2} SILENTLY WRONG; loops \
             {:.3} m in the median, {:.3} at most; {:.2} ms a scan, {} kB at most",
            kind.name,
            of.len(),
            count(Verdict::Right),
            count(Verdict::RightYetReported),
            count(Verdict::WrongReported),
            count(Verdict::SilentlyWrong),
            loops[loops.len() / 2],
            loops[loops.len() - 1],
            of.iter().map(|it| it.ms).sum::<f64>() / of.len() as f64,
            bytes / 1000
        );
    }
}

/// Nanoseconds of this thread on a CPU.
fn cpu_ns() -> u64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|it| it.parse().ok()).unwrap_or(0)
}

fn race(kind: &Kind, seed: u64, is_short: bool, tells_why: bool) -> Row {
    let moments = (kind.drive)(seed, is_short);
    let begin = cpu_ns();
    let Outcome { slam, judgement, verdict, remedy } = outcome(kind, &moments);
    let runs = if remedy.is_some() { 2.0 } else { 1.0 };
    let ms = (cpu_ns() - begin) as f64 * 1e-6 / moments.len() as f64 / runs;
    let (wrong, why) = wrong_closures(&slam, &moments);
    let accepted = slam.closures().iter().filter(|it| it.is_accepted).count();
    let mut remarks: BTreeMap<String, usize> = BTreeMap::new();
    for remark in slam.remarks().iter().filter(|it| it.is_warning()) {
        let word = format!("{:?}", remark.kind);
        let word = word.split('(').next().unwrap_or_default();
        *remarks.entry(word.to_owned()).or_default() += 1;
    }
    let remarks: Vec<String> =
        remarks.iter().map(|(word, count)| format!("{word} {count}")).collect();
    let mut text = format!(
        "{:<10} {:>4} {:>6} {:>6.0} | {:>7.3} {:>7.3} {:>7.3} {:>5} | {:>6.2} {:>6} | {:>8} {:>5} {:>4} | {:<15} {}{}",
        kind.name,
        seed,
        moments.len(),
        judgement.way_m,
        judgement.rms_m,
        judgement.most_m,
        judgement.loops_m,
        judgement.loops,
        ms,
        slam.size() / 1000,
        format!("{accepted}/{}", slam.closures().len()),
        wrong,
        slam.counts().lost,
        verdict.words(),
        remarks.join(", "),
        remedy.map_or_else(String::new, |it| format!(" (made again: {it})"))
    );
    if tells_why {
        for (way_m, count, mean_m) in &judgement.stretches {
            if *mean_m > 0.5 * kind.wrong_m {
                let _ = write!(
                    text,
                    "\n    off by {mean_m:.2} m after {way_m:.0} m ({count} relations)"
                );
            }
        }
        text.push_str(&why);
        for remark in slam.remarks() {
            let _ = write!(text, "\n    {:.1} s: {remark}", remark.time_ns as f64 * 1e-9);
        }
    }
    Row { text, verdict, loops_m: judgement.loops_m, ms, bytes: slam.size() }
}

/// Closures that are part of the map and wrong by the truth: how many, and which.
fn wrong_closures(slam: &periplus_slam::Slam, moments: &[Moment]) -> (usize, String) {
    let keyframes = slam.kept();
    let mut wrong = 0;
    let mut why = String::new();
    for closure in slam.closures() {
        let (old, new) =
            (&moments[keyframes[closure.keyframes.0]], &moments[keyframes[closure.keyframes.1]]);
        let truth = old.truth.inverse() * new.truth;
        let off = truth.inverse() * closure.old_from_new;
        let (metres, turn) = (libm::hypot(off.x_m, off.y_m), normalize_angle(off.yaw_rad).abs());
        let is_wrong = metres > WRONG_M || turn > WRONG_RAD;
        wrong += usize::from(is_wrong && closure.is_accepted);
        if !is_wrong || closure.is_accepted {
            let _ = write!(
                why,
                "\n    {}{}: keyframes {:?} at ({:.1}, {:.1}) m off by {metres:.2} m, {:.1} degrees; region {:.1} m, \
                 {:.0} % agree: {}",
                if is_wrong { "WRONG " } else { "" },
                if closure.is_accepted { "accepted" } else { "refused though right" },
                closure.keyframes,
                new.truth.x_m,
                new.truth.y_m,
                turn.to_degrees(),
                closure.region_m,
                100.0 * closure.agreeing,
                closure.reason
            );
        }
    }
    (wrong, why)
}
