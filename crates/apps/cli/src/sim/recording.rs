//! A recording that fails while a run goes on.

use std::io;
use std::time::Duration;

use periplus_sim::{Progress, Recorder};

use crate::terminal;

/// How often a recording is looked at.
const PERIOD: Duration = Duration::from_millis(200);

/// Reports at once when a recording ends before its run, such as on a full disk.
#[derive(Debug, Default)]
pub(crate) struct RecordingWatch {
    next: Duration,
    has_reported: bool,
}

/// Writes to a terminal on which something else is.
type Aside<'a> = dyn Fn(&mut dyn FnMut() -> io::Result<()>) + 'a;

impl RecordingWatch {
    /// Looks at a recording, if it is time.
    pub(crate) fn look(
        &mut self,
        recorder: Option<&Recorder>,
        progress: Progress,
        aside: &Aside<'_>,
    ) {
        if self.has_reported || progress.wall < self.next {
            return;
        }
        self.next = progress.wall + PERIOD;
        let Some((path, why)) = recorder.and_then(Recorder::failure) else { return };
        self.has_reported = true;
        #[expect(clippy::cast_precision_loss, reason = "seconds, to be read")]
        let time_s = progress.time_ns as f64 * 1e-9;
        aside(&mut || {
            terminal::warn(&format!(
                "recording to {} has stopped at {time_s:.1} s: {why}; messages from here on are \
                 lost, those before can be read; the run goes on",
                path.display()
            ));
            Ok(())
        });
    }
}
