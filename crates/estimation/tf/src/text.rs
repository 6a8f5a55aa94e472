//! Text output of tf2 about its frames.

use std::fmt::Write as _;

use crate::buffer::Buffer;

/// Formats a time in seconds with six decimals, as tf2 does.
#[must_use]
pub fn display_time(time_ns: i64) -> String {
    format!("{:.6}", seconds(time_ns))
}

/// Converts whole seconds and the rest separately, which keeps the digits of late times.
fn seconds(time_ns: i64) -> f64 {
    let rest = time_ns % 1_000_000_000;
    ((time_ns - rest) / 1_000_000_000) as f64 + 1e-9 * rest as f64
}

impl Buffer {
    /// Returns the answer of the service `tf2_frames`: parent, broadcaster, rate, times and buffer
    /// length of each frame; with a current time, also the age of the newest sample.
    ///
    /// Source: `BufferCore::allFramesAsYAML`.
    #[must_use]
    pub fn frames_yaml(&self, now_ns: Option<i64>) -> String {
        if self.is_empty() {
            return "[]".into();
        }
        let mut text = String::new();
        for frame in self.kept_frames() {
            let span_ns = frame.newest_ns - frame.oldest_ns;
            let rate_hz = frame.rate_hz();
            // Writing to a `String` cannot fail.
            let _ = write!(
                text,
                "{}: \n  parent: '{}'\n  broadcaster: '{}'\n  rate: {rate_hz:.3}\n  \
                 most_recent_transform: {}\n  oldest_transform: {}\n",
                frame.name,
                frame.parent,
                frame.authority,
                display_time(frame.newest_ns),
                display_time(frame.oldest_ns),
            );
            if let Some(now_ns) = now_ns.filter(|&now_ns| now_ns != 0) {
                let _ =
                    writeln!(text, "  transform_delay: {:.3}", seconds(now_ns - frame.newest_ns));
            }
            let _ = writeln!(text, "  buffer_length: {:.3}", seconds(span_ns));
        }
        text
    }

    /// Returns a line for each frame that has a parent. Source: `BufferCore::allFramesAsString`.
    #[must_use]
    pub fn frames_text(&self) -> String {
        self.kept_frames()
            .map(|frame| format!("Frame {} exists with parent {}.\n", frame.name, frame.parent))
            .collect()
    }
}
