//! `tf monitor`.

use std::collections::BTreeMap;
use std::time::Duration;

use periplus_os::{Stopwatch, sleep, unix_ns};
use periplus_tf::TransformKind;
use serde_json::json;

use super::listen::{AUTHORITY, Frames, stamp_ns};
use crate::failure::endless;
use crate::{Failure, Outcome, Session};

/// Polling period for transforms.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Options of `tf monitor`.
#[derive(Clone, Debug, PartialEq)]
pub struct Monitor {
    /// Two frames to monitor the chain between; all frames if `None`.
    pub between: Option<(String, String)>,
    /// Duration of a report.
    pub gather: Duration,
    /// Exit after the first report.
    pub once: bool,
}

/// Delay and rate statistics of a frame.
#[derive(Default)]
struct Delays {
    count: usize,
    sum_s: f64,
    most_s: f64,
}

impl Delays {
    fn add(&mut self, delay_s: f64) {
        self.count += 1;
        self.sum_s += delay_s;
        self.most_s = self.most_s.max(delay_s);
    }

    fn mean_s(&self) -> f64 {
        self.sum_s / self.count.max(1) as f64
    }
}

/// Reports delays and rates of each frame periodically.
///
/// Source: `tf2_ros/src/tf2_monitor.cpp`.
///
/// # Errors
/// When the output cannot be written.
pub fn monitor(session: &mut Session<'_>, monitor: &Monitor) -> Outcome {
    endless(run(session, monitor))
}

fn run(session: &mut Session<'_>, monitor: &Monitor) -> Outcome {
    let mut frames = Frames::open(session)?;
    loop {
        let clock = Stopwatch::start();
        let mut by_frame: BTreeMap<String, Delays> = BTreeMap::new();
        let (mut all, mut net) = (Delays::default(), Delays::default());
        while clock.elapsed() < monitor.gather {
            for heard in frames.hear(session) {
                let now_ns = unix_ns();
                for transform in &heard.message.transforms {
                    // Static transforms have no delay.
                    let late_ns = match heard.kind {
                        TransformKind::Moving => now_ns - stamp_ns(transform),
                        TransformKind::Fixed => 0,
                    };
                    let late_s = late_ns as f64 * 1e-9;
                    all.add(late_s);
                    let child = transform.child_frame_id.trim_start_matches('/').to_owned();
                    by_frame.entry(child).or_default().add(late_s);
                }
            }
            if let Some((a, b)) = &monitor.between
                && let Ok(found) = frames.survey.buffer.lookup(a, b, 0)
                && found.time_ns != 0
            {
                net.add((unix_ns() - found.time_ns) as f64 * 1e-9);
            }
            session.check_interrupted()?;
            sleep(POLL_PERIOD);
        }
        let chain = match &monitor.between {
            Some((a, b)) => Some(chain(&frames, a, b)?),
            None => None,
        };
        if let Some(chain) = &chain {
            by_frame.retain(|frame, _| chain.contains(frame));
        }
        report(session, monitor, chain.as_deref(), &by_frame, &all, &net)?;
        if monitor.once {
            return Ok(());
        }
    }
}

fn chain(frames: &Frames, a: &str, b: &str) -> Outcome<Vec<String>> {
    // Reports why there is none, in the words of tf2.
    if let Err(error) = frames.survey.buffer.lookup(a, b, 0) {
        return Err(Failure::failed(error.to_string()));
    }
    let chain = frames.survey.buffer.chain(b, a).unwrap_or_default();
    Ok(chain.into_iter().map(str::to_owned).collect())
}

fn report(
    session: &mut Session<'_>,
    monitor: &Monitor,
    chain: Option<&[String]>,
    by_frame: &BTreeMap<String, Delays>,
    all: &Delays,
    net: &Delays,
) -> Outcome {
    let rate_hz = all.count as f64 / monitor.gather.as_secs_f64().max(1e-9);
    if session.json {
        let frames: Vec<_> = by_frame
            .iter()
            .map(|(frame, delays)| {
                json!({
                    "frame": frame, "count": delays.count, "average_delay_s": delays.mean_s(),
                    "max_delay_s": delays.most_s,
                })
            })
            .collect();
        return session.put(&json!({
            "chain": chain, "frames": frames, "rate_hz": rate_hz,
            "net_delay_s": { "average": net.mean_s(), "max": net.most_s },
        }));
    }
    let out = &mut session.out;
    match (&monitor.between, chain) {
        (Some((a, b)), Some(chain)) => {
            writeln!(out, "\nRESULTS: for {a} to {b}")?;
            writeln!(out, "Chain is: {}", chain.join(" -> "))?;
            writeln!(out, "Net delay     avg = {:.6}: max = {:.6}", net.mean_s(), net.most_s)?;
        }
        _ => writeln!(out, "\nRESULTS: for all Frames")?,
    }
    writeln!(out, "\nFrames:")?;
    for (frame, delays) in by_frame {
        writeln!(
            out,
            "Frame: {frame}, published by {AUTHORITY}, Average Delay: {:.6}, Max Delay: {:.6}",
            delays.mean_s(),
            delays.most_s
        )?;
    }
    writeln!(out, "\nAll Broadcasters:")?;
    writeln!(
        out,
        "Node: {AUTHORITY} {rate_hz:.3} Hz, Average Delay: {:.6} Max Delay: {:.6}",
        all.mean_s(),
        all.most_s
    )?;
    out.flush()?;
    Ok(())
}
