//! Monitor of a recording.

use std::time::Duration;

use periplus_sim::{RunProgress, SimulationRecorder};

use crate::progress::ProgressLine;
use crate::terminal;

/// Polling period of a recording.
const PERIOD: Duration = Duration::from_millis(200);

/// Reports immediately when a recording ends before its run, for example on a full disk.
#[derive(Debug, Default)]
pub(crate) struct RecordingWatch {
    next: Duration,
    has_reported: bool,
}

impl RecordingWatch {
    /// Checks a recording, at a limited rate.
    pub(crate) fn check(
        &mut self,
        recorder: Option<&SimulationRecorder>,
        progress: RunProgress,
        line: &ProgressLine,
    ) {
        if self.has_reported || progress.wall < self.next {
            return;
        }
        self.next = progress.wall + PERIOD;
        let Some((path, why)) = recorder.and_then(SimulationRecorder::failure) else { return };
        self.has_reported = true;
        #[expect(clippy::cast_precision_loss, reason = "for display")]
        let time_s = progress.time_ns as f64 * 1e-9;
        line.aside(|| {
            terminal::warn(&format!(
                "recording to {} stopped at {time_s:.1} s: {why}; later messages are \
                 lost, those before can be read; the run continues",
                path.display()
            ));
            Ok(())
        });
    }
}
