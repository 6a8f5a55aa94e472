//! Profile of a run.

use std::time::Duration;

use periplus_os::Stopwatch;

/// Kind of work in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Work {
    /// Drives, joints, contacts.
    Physics,
    /// Rays, images and other measurements.
    Sensing,
    /// Message delivery and callbacks of nodes.
    Messages,
    /// Bag writing: encoding, compression, disk.
    Recording,
}

impl Work {
    /// All kinds, in the order of a step.
    pub const ALL: [Self; 4] = [Self::Physics, Self::Sensing, Self::Messages, Self::Recording];

    /// Returns the name for reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Physics => "physics",
            Self::Sensing => "sensing",
            Self::Messages => "messages",
            Self::Recording => "recording",
        }
    }
}

/// Wall time by kind of work.
#[derive(Clone, Debug, Default)]
pub struct WorkProfile {
    spent: [Duration; 4],
}

impl WorkProfile {
    /// Returns the time of one kind of work.
    #[must_use]
    pub fn spent(&self, work: Work) -> Duration {
        self.spent[work as usize]
    }

    /// Returns the total time.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.spent.iter().sum()
    }

    /// Adds the elapsed time of a stopwatch, and restarts it.
    pub(crate) fn lap(&mut self, work: Work, stopwatch: &mut Stopwatch) {
        self.spent[work as usize] += stopwatch.lap();
    }

    /// Adds a time.
    pub(crate) fn add(&mut self, work: Work, time: Duration) {
        self.spent[work as usize] += time;
    }

    /// Moves a time to another kind of work.
    pub(crate) fn shift(&mut self, from: Work, to: Work, time: Duration) {
        let time = time.min(self.spent[from as usize]);
        self.spent[from as usize] -= time;
        self.spent[to as usize] += time;
    }
}
