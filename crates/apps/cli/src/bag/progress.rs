//! Progress of long conversions.

use indicatif::{ProgressBar, ProgressStyle};

/// Progress bar at the bottom of the terminal; hidden where stderr is not a terminal.
pub(super) struct ProgressLine(ProgressBar);

impl ProgressLine {
    pub(super) fn new(messages: u64) -> Self {
        let style = "{bar:30} {percent} %, {human_pos} messages, {eta} left";
        let style = ProgressStyle::with_template(style);
        Self(
            ProgressBar::new(messages)
                .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())),
        )
    }

    pub(super) fn show(&self, messages: u64) {
        self.0.set_position(messages);
    }

    pub(super) fn clear(&self) {
        self.0.finish_and_clear();
    }
}
