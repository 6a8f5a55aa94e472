//! `doctor`: diagnosis of a running system, with the parameter to change.
//!
//! [`Ears`] collect messages into a [`Picture`]; [`examine`] finds its problems. Neither needs a
//! network, so that a simulation in the same program can be diagnosed before anything runs for
//! real.

mod clocks;
mod ears;
mod ends;
mod frames;
mod network;
mod picture;
mod sensors;

use std::time::Duration;

use periplus_diagnostics::Diagnostics;
use periplus_os::{Stopwatch, sleep};

use crate::param::simulated_time;
use crate::{Outcome, Session};

pub use ears::Ears;
pub use network::{Surroundings, domains_in};
pub use picture::{Heard, Picture, ScanFacts};

/// Polling period for messages.
const LOOK: Duration = Duration::from_millis(5);

/// Returns all findings, causes first.
#[must_use]
pub fn examine(picture: &Picture) -> Diagnostics {
    let mut found = Diagnostics::new();
    network::examine(picture, &mut found);
    ends::examine(picture, &mut found);
    clocks::examine(picture, &mut found);
    frames::examine(picture, &mut found);
    sensors::examine(picture, &mut found);
    found
}

/// Collects all messages for a time.
///
/// # Errors
/// When it was interrupted, or the graph refuses its node.
pub fn listen(session: &mut Session<'_>, time: Duration) -> Outcome<Picture> {
    let seen = session.look();
    let node = session.node(None)?;
    let mut ears = Ears::open(&node, &seen)?;
    let clock = Stopwatch::start();
    while clock.elapsed() < time {
        ears.hear();
        session.go_on()?;
        sleep(LOOK);
    }
    ears.hear();
    let simulated = simulated_time(session, &node, &seen);
    let seen = session.network.seen();
    Ok(ears.picture(seen, simulated, time))
}
