//! Progress of a run.

use std::io::IsTerminal as _;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use periplus_sim::RunProgress;

/// Period of lines without a terminal.
const LINE_PERIOD: Duration = Duration::from_secs(10);

/// Redraw period of the progress bar.
const REDRAW_PERIOD: Duration = Duration::from_millis(100);

/// Progress bar at the bottom of the terminal; hidden where stderr is not a terminal.
pub struct ProgressLine {
    bar: ProgressBar,
    drawn: Duration,
    end_s: Option<f64>,
    /// Time of the next line without a terminal; `None` if nothing is shown.
    next_line: Option<Duration>,
}

impl ProgressLine {
    /// Progress of a run of `end_s` simulated seconds, or without end.
    pub(crate) fn new(end_s: Option<f64>, is_quiet: bool) -> Self {
        let bar = match end_s {
            _ if is_quiet => ProgressBar::hidden(),
            Some(_) => ProgressBar::new(1000).with_style(style("{bar:30} {msg}")),
            None => ProgressBar::new_spinner().with_style(style("{spinner} {msg}")),
        };
        let is_drawn = is_quiet || std::io::stderr().is_terminal();
        let next_line = (!is_drawn && end_s.is_some()).then_some(LINE_PERIOD);
        Self { bar, drawn: Duration::ZERO, end_s, next_line }
    }

    /// Updates the display, at a limited rate.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "for display"
    )]
    pub(crate) fn show(&mut self, progress: RunProgress) {
        if progress.wall < self.drawn + REDRAW_PERIOD {
            return;
        }
        self.drawn = progress.wall;
        let time_s = progress.time_ns as f64 * 1e-9;
        let factor = progress.real_time_factor;
        if let (Some(due), Some(end_s)) = (self.next_line, self.end_s)
            && progress.wall >= due
        {
            self.next_line = Some(progress.wall + LINE_PERIOD);
            crate::terminal::say(&format!(
                "{time_s:.1} of {end_s} s simulated, {factor:.1} x real time"
            ));
        }
        match self.end_s {
            Some(end_s) => {
                self.bar.set_position((time_s / end_s * 1000.0) as u64);
                self.bar.set_message(format!("{time_s:.1} of {end_s} s, {factor:.1} x real time"));
            }
            None => {
                self.bar.tick();
                self.bar
                    .set_message(format!("{time_s:.1} s, {factor:.1} x real time; Ctrl-C ends"));
            }
        }
    }

    /// Writes something else to the terminal.
    pub fn aside(&self, write: impl FnOnce() -> std::io::Result<()>) {
        // A closed terminal must not end a run.
        let _ = self.bar.suspend(write);
    }

    /// Clears the bar.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner())
}
