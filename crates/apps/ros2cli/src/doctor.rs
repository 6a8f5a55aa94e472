//! `doctor`: diagnosis of a running system, with the parameter to change.
//!
//! A [`SystemObserver`] collects messages into a [`SystemObservation`]; [`examine`] finds problems. Neither needs a
//! network, so that a simulation in the same program can be diagnosed before anything runs for
//! real.

mod clocks;
mod endpoints;
mod frames;
mod network;
mod observation;
mod observer;
mod sensors;

use std::time::Duration;

use periplus_diagnostics::Diagnostics;
use periplus_os::{Stopwatch, sleep};

use crate::param::simulated_time;
use crate::{Outcome, Session};

pub use network::{NetworkSettings, domains_in};
pub use observation::{ScanFacts, SystemObservation, TopicStatistics};
pub use observer::SystemObserver;

/// Polling period for messages.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Returns all findings, causes first.
#[must_use]
pub fn examine(observation: &SystemObservation) -> Diagnostics {
    let mut found = Diagnostics::new();
    network::examine(observation, &mut found);
    endpoints::examine(observation, &mut found);
    clocks::examine(observation, &mut found);
    frames::examine(observation, &mut found);
    sensors::examine(observation, &mut found);
    found
}

/// Collects all messages for a time.
///
/// # Errors
/// When it was interrupted, or the graph refuses its node.
pub fn listen(session: &mut Session<'_>, time: Duration) -> Outcome<SystemObservation> {
    let seen = session.look();
    let node = session.node(None)?;
    let mut observer = SystemObserver::open(&node, &seen)?;
    let clock = Stopwatch::start();
    while clock.elapsed() < time {
        observer.hear();
        session.check_interrupted()?;
        sleep(POLL_PERIOD);
    }
    observer.hear();
    let simulated = simulated_time(session, &node, &seen);
    let seen = session.network.seen();
    Ok(observer.observation(seen, simulated, time))
}
