//! Progress of a run in WebAssembly: there is no terminal.

use periplus_sim::RunProgress;

pub use self::NoProgressLine as ProgressLine;

/// Progress bar: shows nothing.
pub struct NoProgressLine;

impl NoProgressLine {
    pub(crate) fn new(_: Option<f64>, _: bool) -> Self {
        Self
    }

    pub(crate) fn show(&mut self, _: RunProgress) {}

    /// Writes something else to the terminal.
    pub fn aside(&self, write: impl FnOnce() -> std::io::Result<()>) {
        // There is no terminal that could refuse it.
        let _ = write();
    }

    pub(crate) fn clear(&self) {}
}
