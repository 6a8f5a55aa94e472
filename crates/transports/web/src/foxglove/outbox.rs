//! Send queue of a client.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use periplus_graph::Sample;
use periplus_msgs::Message as _;
use periplus_msgs::map_msgs::OccupancyGridUpdate;
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_transport::lock;

use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::grid::{Difference, difference};
use crate::foxglove::protocol;

/// Maximum size of the queued messages of a subscription, estimated from its last message; at least
/// one message is kept \[bytes\].
const MOST_WAITING: usize = 256 << 10;

/// Send queue of a client, read by the thread of its socket.
///
/// - Responses and announcements come first and are never dropped; a client with too many of them
///   queued is disconnected.
/// - Latched topics keep the last messages of each publisher, up to its depth.
/// - Other topics keep the newest messages, up to the publisher's depth and a few hundred
///   kilobytes; best-effort topics keep one. Older messages are dropped.
/// - A client that subscribes to a map and its updates gets the map once, then updates relative to
///   the map that it has.
/// - Subscriptions take turns, so that a camera does not delay a scan.
pub struct Outbox {
    waiting: Mutex<Waiting>,
    filled: Condvar,
    emptied: Condvar,
}

/// Room for further responses in an outbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Room {
    /// There is room.
    Free,
    /// The client has not read enough yet.
    Full,
    /// The outbox is closed.
    Closed,
}

#[derive(Default)]
struct Waiting {
    urgent: VecDeque<WebSocketFrame>,
    urgent_bytes: usize,
    most_urgent_bytes: usize,
    time_ns: Option<i64>,
    lanes: BTreeMap<u32, Lane>,
    /// The subscription served last.
    served: u32,
    end: Option<String>,
}

/// Queue of a subscription.
#[derive(Default)]
struct Lane {
    samples: VecDeque<(Sample, Rule)>,
    /// Size of the last message \[bytes\].
    size: usize,
    dropped: u64,
    /// The subscription to the updates of this map, if any.
    updates: Option<u32>,
    /// The map that the client has.
    told: Option<Arc<OccupancyGrid>>,
}

/// Queueing rule for messages of a publisher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rule {
    /// Depth for this publisher.
    pub(crate) depth: usize,
    /// True for latched topics.
    pub(crate) is_latched: bool,
}

/// Result of taking from an outbox.
#[derive(Debug)]
pub enum OutboxItem {
    /// A frame to send.
    Frame(WebSocketFrame),
    /// Nothing arrived before the timeout.
    Nothing,
    /// The outbox is closed, with the reason if there is one.
    End(String),
}

impl Outbox {
    pub(crate) fn new(most_urgent_bytes: usize) -> Self {
        let waiting = Waiting { most_urgent_bytes, ..Waiting::default() };
        Self { waiting: Mutex::new(waiting), filled: Condvar::new(), emptied: Condvar::new() }
    }

    /// Waits until at most this many bytes of responses are queued, at most for `patience`.
    pub(crate) fn wait_for_room(&self, most_bytes: usize, patience: Duration) -> Room {
        let is_full =
            |waiting: &mut Waiting| waiting.end.is_none() && waiting.urgent_bytes > most_bytes;
        if cfg!(target_family = "wasm") {
            // Without threads no frames are taken during a request: its answer waits as a whole.
            let is_closed = lock(&self.waiting).end.is_some();
            return if is_closed { Room::Closed } else { Room::Free };
        }
        let waited = self.emptied.wait_timeout_while(lock(&self.waiting), patience, is_full);
        let mut waiting = waited.unwrap_or_else(PoisonError::into_inner).0;
        match (waiting.end.is_some(), is_full(&mut waiting)) {
            (true, _) => Room::Closed,
            (false, true) => Room::Full,
            (false, false) => Room::Free,
        }
    }

    /// Queues a frame that must not be dropped.
    pub fn push(&self, frame: WebSocketFrame) {
        let mut waiting = lock(&self.waiting);
        if waiting.end.is_some() {
            return;
        }
        waiting.urgent_bytes += frame.len();
        waiting.urgent.push_back(frame);
        if waiting.urgent_bytes > waiting.most_urgent_bytes {
            waiting.urgent.clear();
            waiting.lanes.clear();
            waiting.end = Some("the send queue of this client is full".to_owned());
        }
        drop(waiting);
        self.filled.notify_one();
        // A full outbox has been closed.
        self.emptied.notify_all();
    }

    /// Queues the time; it replaces an older one.
    pub(crate) fn tell_time(&self, time_ns: i64) {
        lock(&self.waiting).time_ns = Some(time_ns);
        self.filled.notify_one();
    }

    /// Opens the queue of a subscription.
    pub(crate) fn open(&self, subscription_id: u32) {
        lock(&self.waiting).lanes.insert(subscription_id, Lane::default());
    }

    /// Redirects the updates of a map to the subscription `updates`.
    pub(crate) fn pair(&self, subscription_id: u32, updates: Option<u32>) {
        if let Some(lane) = lock(&self.waiting).lanes.get_mut(&subscription_id)
            && lane.updates != updates
        {
            lane.updates = updates;
            lane.told = None;
        }
    }

    /// Closes the queue of a subscription and drops its messages.
    pub(crate) fn shut(&self, subscription_id: u32) {
        lock(&self.waiting).lanes.remove(&subscription_id);
    }

    /// Queues a message for a subscription.
    pub(crate) fn offer(&self, subscription_id: u32, sample: &Sample, rule: Rule) {
        let mut waiting = lock(&self.waiting);
        let Some(lane) = waiting.lanes.get_mut(&subscription_id) else { return };
        lane.offer(sample, rule);
        drop(waiting);
        self.filled.notify_one();
    }

    /// Closes the outbox with a reason.
    pub fn end(&self, why: &str) {
        lock(&self.waiting).end.get_or_insert_with(|| why.to_owned());
        self.filled.notify_all();
        self.emptied.notify_all();
    }

    /// Number of dropped messages.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        lock(&self.waiting).lanes.values().map(|lane| lane.dropped).sum()
    }

    /// Takes the next frame, waiting at most for `patience`.
    #[must_use]
    pub fn take(&self, patience: Duration) -> OutboxItem {
        let waiting = lock(&self.waiting);
        let is_idle = |waiting: &mut Waiting| !waiting.has_any() && waiting.end.is_none();
        let waited = self.filled.wait_timeout_while(waiting, patience, is_idle);
        self.pop(waited.unwrap_or_else(PoisonError::into_inner).0)
    }

    /// Takes the next frame, without waiting.
    #[must_use]
    pub fn try_take(&self) -> OutboxItem {
        self.pop(lock(&self.waiting))
    }

    fn pop(&self, mut waiting: MutexGuard<'_, Waiting>) -> OutboxItem {
        if let Some(frame) = waiting.urgent.pop_front() {
            waiting.urgent_bytes -= frame.len();
            drop(waiting);
            self.emptied.notify_all();
            return OutboxItem::Frame(frame);
        }
        if let Some(why) = &waiting.end {
            return OutboxItem::End(why.clone());
        }
        if let Some(time_ns) = waiting.time_ns.take() {
            return OutboxItem::Frame(protocol::time(time_ns));
        }
        let Some((id, sample)) = waiting.next_sample() else { return OutboxItem::Nothing };
        let lane = waiting.lanes.get_mut(&id);
        let (updates, told) = lane.map_or((None, None), |lane| (lane.updates, lane.told.take()));
        drop(waiting);
        // Not under the lock: this may encode the message.
        if let Some(updates) = updates
            && let Ok(map) = sample.message::<OccupancyGrid>()
        {
            let new = told.as_ref().map_or(Difference::All, |told| difference(told, &map));
            if let Some(lane) = lock(&self.waiting).lanes.get_mut(&id) {
                lane.told = Some(map);
            }
            match new {
                Difference::All => {}
                Difference::None => return OutboxItem::Nothing,
                Difference::Part(part) => return update(updates, sample.time_ns, &part),
            }
        }
        let Some(frame) =
            WebSocketFrame::sample(protocol::message_head(id, sample.time_ns), sample)
        else {
            return OutboxItem::Nothing;
        };
        if let Some(lane) = lock(&self.waiting).lanes.get_mut(&id) {
            lane.size = frame.len();
        }
        OutboxItem::Frame(frame)
    }
}

fn update(subscription_id: u32, time_ns: i64, part: &OccupancyGridUpdate) -> OutboxItem {
    let Ok(cdr) = part.to_cdr() else { return OutboxItem::Nothing };
    let mut bytes = protocol::message_head(subscription_id, time_ns);
    bytes.extend(cdr);
    OutboxItem::Frame(WebSocketFrame::binary(bytes))
}

impl Waiting {
    fn has_any(&self) -> bool {
        !self.urgent.is_empty()
            || self.time_ns.is_some()
            || self.lanes.values().any(|lane| !lane.samples.is_empty())
    }

    /// Takes the oldest message of the next subscription in turn.
    fn next_sample(&mut self) -> Option<(u32, Sample)> {
        let has = |(id, lane): (&u32, &Lane)| (!lane.samples.is_empty()).then_some(*id);
        let after = self.lanes.range(self.served.saturating_add(1)..).find_map(has);
        let id = after.or_else(|| self.lanes.iter().find_map(has))?;
        self.served = id;
        let (sample, _) = self.lanes.get_mut(&id)?.samples.pop_front()?;
        Some((id, sample))
    }
}

impl Lane {
    fn offer(&mut self, sample: &Sample, rule: Rule) {
        let fitting = if rule.is_latched { rule.depth } else { MOST_WAITING / self.size.max(1) };
        let most = rule.depth.min(fitting).max(1);
        let of_same = |(one, _): &(Sample, Rule)| one.publisher == sample.publisher;
        while self.samples.iter().filter(|one| of_same(one)).count() >= most {
            let Some(oldest) = self.samples.iter().position(of_same) else { break };
            self.samples.remove(oldest);
            self.dropped += 1;
        }
        self.samples.push_back((sample.clone(), rule));
    }
}

impl std::fmt::Debug for Outbox {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Outbox").finish_non_exhaustive()
    }
}
