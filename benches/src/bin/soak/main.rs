//! A robot that drives for simulated hours with a lifelong map and costmaps: memory by simulated time, and
//! numbers that are not finite in what the run publishes. `soak PERIPLUS ROOT FOLDER [HOURS]`; `cargo xtask
//! soak` knows the first three.
//!
//! Two equal runs, side by side: files, options and seed are the same, and so is what happens. One is as
//! a user starts it; its memory is read whenever it prints how far it is. The other records all topics
//! into a pipe, which this program reads and checks: a recording keeps an index of its chunks for the end of
//! the file, about 0.8 kB for each simulated second, which would hide a leak of the run.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that measures"
)]

mod finite;
mod stream;

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, Stdio};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use crate::finite::FiniteCheck;
use crate::stream::Stream;

/// Memory may be this much larger in the last hour than in the one after the first, as a ratio.
const MAX_GROWTH_RATIO: f64 = 1.05;

/// Simulated hours, unless others are asked for.
const HOURS: f64 = 10.0;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [periplus, root, folder, rest @ ..] = &*words else {
        eprintln!("usage: soak PERIPLUS ROOT FOLDER [HOURS]");
        return ExitCode::from(2);
    };
    let hours = rest.first().map_or(Some(HOURS), |hours| hours.parse().ok());
    let Some(hours) = hours.filter(|hours: &f64| hours.is_finite() && *hours > 0.0) else {
        eprintln!("`{}` is not a number of hours", rest[0]);
        return ExitCode::from(2);
    };
    let [periplus, root, folder] = [periplus, root, folder].map(PathBuf::from);
    match soak(&periplus, &root, &folder, hours * 3600.0) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Killed when this is dropped.
struct Run(Child);

impl Drop for Run {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Memory at a simulated time.
#[derive(Clone, Copy)]
struct Sample {
    time_s: f64,
    resident_kb: u64,
}

/// kbot in its room in circles. Motion is exact (`--dynamics kinematic`), and one scan in ten counts for
/// the map, so that ten hours take minutes.
fn soak(periplus: &Path, root: &Path, folder: &Path, length_s: f64) -> Result<(), String> {
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok::<_, String>(path)
    };
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let circles = format!("- {{at: 0, until: {length_s}, rate: 1, linear: 0.3, angular: 0.3}}\n");
    let script = write("drive.yaml", &circles)?;
    let parameters = write(
        "slam.yaml",
        "slam_toolbox:\n  ros__parameters:\n    throttle_scans: 10\n    map_update_interval: 60.0\n",
    )?;
    let pipe = folder.join("run.mcap");
    let _ = std::fs::remove_file(&pipe);
    let made = Command::new("mkfifo").arg(&pipe).status();
    if !made.is_ok_and(|status| status.success()) {
        return Err(format!("`mkfifo {}` failed: the soak needs a pipe", pipe.display()));
    }
    let command = |map: &str| {
        let mut command = Command::new(periplus);
        command.current_dir(root).arg("sim").arg("worlds/closed_room.world");
        command.args(["--robot", "robots/kbot/urdf/kbot.urdf.xacro", "--dynamics", "kinematic"]);
        command.arg("--cmd").arg(&script).arg("--slam").arg(&parameters);
        command.args(["--slam-node", "lifelong", "--stack", "--duration", &length_s.to_string()]);
        command.arg("--slam-out").arg(folder.join(map));
        command
    };
    let failed = |error: std::io::Error| format!("{}: {error}", periplus.display());
    let start = Instant::now();
    let recorded = command("map_recorded").arg("--record").arg(&pipe).stderr(Stdio::null()).spawn();
    let mut recorded = Run(recorded.map_err(failed)?);
    let mut measured = Run(command("map").stderr(Stdio::piped()).spawn().map_err(failed)?);
    let (status_file, output) =
        (PathBuf::from(format!("/proc/{}/status", measured.0.id())), measured.0.stderr.take());
    let sampling = std::thread::spawn(move || output.map(|it| sample(it, &status_file)));
    let checked = opened(&pipe, &mut recorded).and_then(|source| follow(source, length_s));
    if checked.is_err() {
        let _ = measured.0.kill();
    }
    let samples = sampling.join().ok().flatten().unwrap_or_default();
    let _ = std::fs::remove_file(&pipe);
    let (check, last_s) = checked?;
    for (name, run) in [("recorded", &mut recorded), ("measured", &mut measured)] {
        let status = run.0.wait().map_err(failed)?;
        if !status.success() {
            return Err(format!("the {name} run ended with {status}"));
        }
    }
    println!(
        "{:.0} s for two runs of {length_s:.0} simulated s; {} messages with {} numbers that are not \
         integers",
        start.elapsed().as_secs_f64(),
        check.messages,
        check.numbers
    );
    print_hours(&samples, length_s);
    let mut faults = Vec::new();
    for ((topic, field), (count, time_s)) in &check.faults {
        faults.push(format!("{topic}: `{field}` is not finite {count} times, first at {time_s} s"));
    }
    if last_s < 0.99 * length_s {
        faults.push(format!("messages end at {last_s:.0} s of {length_s:.0}"));
    }
    let hour_s = length_s / 10.0;
    let early = median_kb(&samples, hour_s, 2.0 * hour_s);
    let late = median_kb(&samples, length_s - hour_s, f64::INFINITY);
    match early.zip(late) {
        Some((early, late)) => {
            let ratio = late as f64 / early as f64;
            println!(
                "{early} kB in the hour after the first, {late} kB in the last one: {ratio:.3}"
            );
            if ratio > MAX_GROWTH_RATIO {
                faults.push(format!("memory grew by {:.0} %", (ratio - 1.0) * 100.0));
            }
        }
        None => faults.push(
            "memory could not be measured: it is read from /proc every 10 s, and a run of this length is \
             over too soon, or there is no /proc"
                .to_owned(),
        ),
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

/// Reads memory whenever a run prints `T of LENGTH s simulated`, until its output ends.
fn sample(output: impl Read, status: &Path) -> Vec<Sample> {
    let mut samples = Vec::new();
    for line in BufReader::new(output).lines().map_while(Result::ok) {
        eprintln!("{line}");
        let time_s = line.split_once(" of ").and_then(|(time_s, rest)| {
            rest.contains(" s simulated").then(|| time_s.parse().ok()).flatten()
        });
        let sample = time_s.zip(resident_kb(status));
        samples.extend(sample.map(|(time_s, resident_kb)| Sample { time_s, resident_kb }));
    }
    samples
}

/// Opens the pipe, which waits until the run opens it, too; an error when the run ends before that.
fn opened(pipe: &Path, run: &mut Run) -> Result<File, String> {
    let (send, file) = channel();
    let path = pipe.to_owned();
    std::thread::spawn(move || send.send(File::open(path)));
    loop {
        match file.recv_timeout(Duration::from_millis(100)) {
            Ok(file) => return file.map_err(|error| format!("{}: {error}", pipe.display())),
            Err(_) => {
                if let Ok(Some(status)) = run.0.try_wait() {
                    return Err(format!("the recorded run ended with {status} before it recorded"));
                }
            }
        }
    }
}

/// Reads the recording to its end: the check of all messages, and the time of the last one \[s\].
fn follow(source: File, length_s: f64) -> Result<(FiniteCheck, f64), String> {
    let failed = |error: std::io::Error| format!("the recording of the run: {error}");
    let source = BufReader::with_capacity(1 << 20, source);
    let (mut check, mut last_s, mut shown_s) = (FiniteCheck::default(), 0.0, 0.0);
    let start = Instant::now();
    let visited = Stream::open(source).map_err(failed)?.each(|topic, time_ns, bytes| {
        last_s = time_ns as f64 * 1e-9;
        if last_s >= shown_s + length_s / 20.0 {
            shown_s = last_s;
            let wall_s = start.elapsed().as_secs_f64();
            eprintln!("{last_s:.0} of {length_s:.0} s checked after {wall_s:.0} s");
        }
        let checked = check.check(&topic.name, &topic.type_name, last_s, bytes);
        checked.map_err(|why| std::io::Error::new(std::io::ErrorKind::InvalidData, why))
    });
    visited.map_err(failed)?;
    Ok((check, last_s))
}

/// Memory that a process holds now.
fn resident_kb(status: &Path) -> Option<u64> {
    let text = std::fs::read_to_string(status).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.split_whitespace().next()?.parse().ok()
}

fn median_kb(samples: &[Sample], from_s: f64, to_s: f64) -> Option<u64> {
    let within = samples.iter().filter(|sample| (from_s..to_s).contains(&sample.time_s));
    let mut all: Vec<u64> = within.map(|sample| sample.resident_kb).collect();
    all.sort_unstable();
    all.get(all.len() / 2).copied()
}

/// A line for each tenth of the run.
fn print_hours(samples: &[Sample], length_s: f64) {
    println!("| simulated \\[h\\] | memory, median \\[kB\\] |\n|---|---|");
    for part in 0..10 {
        let [from_s, to_s] = [part, part + 1].map(|part| f64::from(part) * length_s / 10.0);
        let median = median_kb(samples, from_s, to_s).map_or("".to_owned(), |kb| kb.to_string());
        println!("| {:.1} to {:.1} | {median} |", from_s / 3600.0, to_s / 3600.0);
    }
}
