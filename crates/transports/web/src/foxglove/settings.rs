//! What a hub is told.

use std::collections::BTreeMap;
use std::time::Duration;

/// What a hub says of itself, and how much it lets clients do.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Its name, as clients show it.
    pub name: String,
    /// Tells runs apart: a client that finds another one after a break forgets what it had.
    pub session_id: String,
    /// More about the server, for whoever knows the keys.
    pub metadata: BTreeMap<String, String>,
    /// How much clients may do.
    pub limits: Limits,
}

/// How much clients may do. Each bound is far above what a person with a viewer needs, and far below
/// what would hurt the run.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Clients at one time.
    pub clients: usize,
    /// Largest message of a client \[bytes\]: a map of 4000 by 4000 cells fits.
    pub message: usize,
    /// Subscriptions, own channels and waiting calls of one client, each.
    pub entries: usize,
    /// Answers and announcements that wait for one client \[bytes\]; who has more is sent away.
    pub waiting: usize,
    /// Messages of one client per second, in the long run.
    pub rate_hz: f64,
    /// A client that reads nothing for this long is disconnected.
    pub stalled: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            clients: 32,
            message: 32 << 20,
            entries: 4096,
            waiting: 256 << 20,
            rate_hz: 2_000.0,
            stalled: Duration::from_secs(10),
        }
    }
}
