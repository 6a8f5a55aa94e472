//! Settings of a hub.

use std::collections::BTreeMap;
use std::time::Duration;

/// Identity of the server, and limits for clients.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Name shown by clients.
    pub name: String,
    /// Id of the run: a client that reconnects to another run discards its data.
    pub session_id: String,
    /// Additional information about the server.
    pub metadata: BTreeMap<String, String>,
    /// Limits for clients.
    pub limits: ClientLimits,
}

/// Limits for clients. Each is far above the needs of a viewer, and far below values that would
/// slow the run down.
#[derive(Clone, Copy, Debug)]
pub struct ClientLimits {
    /// Maximum number of clients.
    pub clients: usize,
    /// Maximum size of a client's message \[bytes\]: a map of 4000 by 4000 cells fits.
    pub message: usize,
    /// Maximum numbers of subscriptions, of client channels and of pending calls per client.
    pub entries: usize,
    /// Maximum size of queued responses and announcements per client \[bytes\]; a client that
    /// exceeds it is disconnected.
    pub waiting: usize,
    /// Maximum sustained rate of messages from a client \[Hz\].
    pub rate_hz: f64,
    /// Time after which a client that reads nothing is disconnected.
    pub stalled: Duration,
}

impl Default for ClientLimits {
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
