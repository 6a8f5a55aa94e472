//! Where the time of a run goes.

use std::time::Duration;

use periplus_os::Stopwatch;

/// What is done in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Work {
    /// Drives, joints, contacts.
    Physics,
    /// Rays, pictures and the other measurements.
    Sensing,
    /// Delivering messages, and what nodes do with them.
    Messages,
    /// Writing the bag: encoding, compressing, disk.
    Recording,
}

impl Work {
    /// All, in the order of a step.
    pub const ALL: [Self; 4] = [Self::Physics, Self::Sensing, Self::Messages, Self::Recording];

    /// Its name for a person.
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
pub struct Shares {
    spent: [Duration; 4],
}

impl Shares {
    /// Time spent on one kind of work.
    #[must_use]
    pub fn spent(&self, work: Work) -> Duration {
        self.spent[work as usize]
    }

    /// Time spent on all.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.spent.iter().sum()
    }

    /// Adds what a stopwatch shows, and starts it again.
    pub(crate) fn lap(&mut self, work: Work, stopwatch: &mut Stopwatch) {
        self.spent[work as usize] += stopwatch.lap();
    }

    /// Adds a time.
    pub(crate) fn add(&mut self, work: Work, time: Duration) {
        self.spent[work as usize] += time;
    }

    /// Counts a time as work of another kind.
    pub(crate) fn shift(&mut self, from: Work, to: Work, time: Duration) {
        let time = time.min(self.spent[from as usize]);
        self.spent[from as usize] -= time;
        self.spent[to as usize] += time;
    }
}
