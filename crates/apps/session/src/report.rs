//! Report of a run.

mod people;

use std::io::{self, Write};
use std::time::Duration;

use periplus_sim::{RecordingSummary, Simulation, Work, WorkProfile};
use serde_json::{Value, json};

/// Report of a run.
pub struct RunReport<'a> {
    /// The simulation after the run.
    pub simulation: &'a Simulation,
    /// Time from the start of the program to the first step.
    pub start_up: Duration,
    /// Wall time of all steps.
    pub wall: Duration,
    /// Recording, if there is one.
    pub recording: Option<&'a RecordingSummary>,
}

impl RunReport<'_> {
    /// Writes the report as text.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let simulated_s = self.simulated_s();
        let wall_s = self.wall.as_secs_f64();
        let factor = self.factor();
        writeln!(out, "{simulated_s:.3} s simulated in {wall_s:.2} s: {factor:.1} x real time")?;
        let shares = self.simulation.shares();
        let parts = Work::ALL.map(|work| format!("{} {:.0} %", work.name(), percent(shares, work)));
        writeln!(out, "  {}", parts.join(", "))?;
        if let Some(recording) = self.recording {
            writeln!(
                out,
                "  {}: {} messages on {} topics, {}",
                recording.path.display(),
                recording.messages,
                recording.topics,
                size(recording.bytes)
            )?;
        }
        match self.simulation.people_report() {
            Some(report) => people::write_text(&report, out),
            None => Ok(()),
        }
    }

    /// JSON report.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let shares = self.simulation.shares();
        let timing = Work::ALL
            .map(|work| (format!("{}_s", work.name()), json!(shares.spent(work).as_secs_f64())));
        json!({
            "simulated_s": self.simulated_s(),
            "wall_s": self.wall.as_secs_f64(),
            "start_up_s": self.start_up.as_secs_f64(),
            "real_time_factor": self.factor(),
            "step_s": seconds(self.simulation.step_ns()),
            "work": timing.into_iter().collect::<serde_json::Map<_, _>>(),
            "models": self.simulation.models().collect::<Vec<_>>(),
            "people": self.simulation.people_report().as_ref().map(people::to_json),
            "recording": self.recording.map(|recording| json!({
                "path": recording.path,
                "messages": recording.messages,
                "topics": recording.topics,
                "bytes": recording.bytes,
            })),
        })
    }

    fn simulated_s(&self) -> f64 {
        seconds(self.simulation.time_ns())
    }

    fn factor(&self) -> f64 {
        self.simulated_s() / self.wall.as_secs_f64().max(1e-9)
    }
}

#[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
fn seconds(time_ns: i64) -> f64 {
    time_ns as f64 / 1e9
}

fn percent(shares: &WorkProfile, work: Work) -> f64 {
    shares.spent(work).as_secs_f64() / shares.total().as_secs_f64().max(1e-9) * 100.0
}

#[expect(clippy::cast_precision_loss, reason = "for display")]
fn size(bytes: u64) -> String {
    match bytes {
        0..10_000 => format!("{bytes} bytes"),
        10_000..10_000_000 => format!("{:.1} kB", bytes as f64 * 1e-3),
        _ => format!("{:.1} MB", bytes as f64 * 1e-6),
    }
}
