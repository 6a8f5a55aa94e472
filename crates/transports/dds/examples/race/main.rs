//! Compares this transport with its peers: rate, latency and CPU time for each pair of sender and
//! receiver. `cargo xtask bench wire` builds the peers and runs it.
//!
//! All pairs run one after the other with the same samples. All programs use the same protocol (see
//! [`peer`]); their CPU time is read from the system for each thread.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a benchmark"
)]

mod load;
mod ours;
mod peer;
mod table;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;

use load::{LOADS, Load, PAIRS};
use peer::{Peers, Side};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match words.split_first() {
        Some((first, rest)) if first == "peer" => ours::run(rest),
        _ => race(&words),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Runs `FAST PYTHON SCRIPT FOLDER [ONLY]`: prints the tables and writes `wire.json` into the
/// folder.
fn race(words: &[String]) -> Result<(), String> {
    let [fast, python, script, folder, only @ ..] = words else {
        return Err("usage: race FAST PYTHON SCRIPT FOLDER [ONLY]".to_owned());
    };
    let [fast, python, script, folder] = [fast, python, script, folder].map(PathBuf::from);
    let only = only.first().map_or("", String::as_str);
    let (tables, figures) = compare(&fast, &python, &script, &folder, only)?;
    print!("{tables}");
    let record = folder.join("wire.json");
    std::fs::write(&record, format!("{figures:#}\n"))
        .map_err(|error| format!("{}: {error}", record.display()))
}

/// Runs all pairs under all loads whose name contains `only`; returns the tables and the figures.
fn compare(
    fast: &Path,
    python: &Path,
    script: &Path,
    folder: &Path,
    only: &str,
) -> Result<(String, Value), String> {
    let peers = Peers::find(fast, python, script)?;
    let mut lines = Vec::new();
    let mut domain_id = 150;
    for load in LOADS.iter().filter(|load| load.name.contains(only)) {
        let template = folder.join(format!("{}.cdr", load.kind.name()));
        std::fs::write(&template, load.kind.template())
            .map_err(|error| format!("{}: {error}", template.display()))?;
        if !load.is_large {
            lines.push(waking(&peers, load)?);
        }
        for pair in PAIRS.iter().filter(|pair| pair.is_for(load)) {
            if !peers.has(pair.from) || !peers.has(pair.to) {
                continue;
            }
            domain_id += 1;
            eprintln!("{}: {} to {}", load.name, pair.from.name(), pair.to.name());
            lines.push(measure(&peers, load, pair.from, pair.to, domain_id, &template)?);
        }
    }
    let figures = Value::from(lines);
    Ok((table::tables(&figures), figures))
}

/// Measures the CPU time of a program that wakes as often as it would publish, without publishing.
fn waking(peers: &Peers, load: &Load) -> Result<Value, String> {
    let words = ["loop".to_owned(), load.count.to_string(), load.period_us.to_string()];
    let mut program = peers.start(Side::Ours, None, &words)?;
    program.expect("begin")?;
    let (before, start) = (program.cpu(), std::time::Instant::now());
    program.expect("done")?;
    let core = peer::share(&before, &program.cpu(), start.elapsed().as_secs_f64());
    Ok(serde_json::json!({
        "load": load.name,
        "from": "a loop that only wakes",
        "publisher_core": core,
    }))
}

fn measure(
    peers: &Peers,
    load: &Load,
    from: Side,
    to: Side,
    domain_id: u32,
    template: &Path,
) -> Result<Value, String> {
    let common = [
        domain_id.to_string(),
        String::new(),
        format!("rt/{}", load.kind.name()),
        load.kind.dds_type().to_owned(),
        load.depth.to_string(),
    ];
    let words = |verb: &str| {
        let mut words = common.clone().to_vec();
        verb.clone_into(&mut words[1]);
        words
    };
    let mut subscriber = peers.start(to, load.buffer, &words("sub"))?;
    subscriber.expect("ready")?;
    let mut publishing = words("pub");
    publishing.push(template.to_string_lossy().into_owned());
    publishing.push(load.count.to_string());
    publishing.push(load.period_us.to_string());
    let mut publisher = peers.start(from, load.buffer, &publishing)?;
    publisher.expect("begin")?;
    let (publisher_before, subscriber_before) = (publisher.cpu(), subscriber.cpu());
    let start = std::time::Instant::now();
    publisher.expect("done")?;
    let publishing_s = start.elapsed().as_secs_f64();
    let (publisher_after, subscriber_after) = (publisher.cpu(), subscriber.cpu());
    // Messages in transit may still arrive.
    std::thread::sleep(std::time::Duration::from_millis(1_500));
    let got = subscriber.end("got")?;
    let mut words = got.split(' ').map(|word| word.parse::<f64>().unwrap_or(f64::NAN));
    let span_s = words.next().unwrap_or(0.0);
    let mut latencies_us: Vec<f64> = words.collect();
    latencies_us.sort_by(f64::total_cmp);
    let received = latencies_us.len();
    let quantile = |share: f64| {
        let place = (received as f64 * share) as usize;
        latencies_us.get(place.min(received.saturating_sub(1))).copied()
    };
    let rate_hz = if span_s > 0.0 { (received - 1) as f64 / span_s } else { 0.0 };
    Ok(serde_json::json!({
        "load": load.name,
        "from": from.name(),
        "to": to.name(),
        "sent": load.count,
        "received": received,
        "rate_hz": rate_hz,
        "p50_us": quantile(0.5),
        "p95_us": quantile(0.95),
        "p99_us": quantile(0.99),
        "publisher_core": peer::share(&publisher_before, &publisher_after, publishing_s),
        "subscriber_core": peer::share(&subscriber_before, &subscriber_after, publishing_s),
        "publisher_threads": peer::threads(&publisher_before, &publisher_after, publishing_s),
        "subscriber_threads": peer::threads(&subscriber_before, &subscriber_after, publishing_s),
    }))
}
