//! Incoming messages of a topic. Zenoh's threads publish them in the graph directly.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Mutex;
use std::time::Duration;

use periplus_graph::RawPublisher;
use periplus_transport::{Foreign, Since, lock};

use crate::attachment::Gid;

/// Maximum number of queued messages of unknown publishers.
const MOST_EARLY: usize = 64;

/// Time after which a publisher without a token is accepted.
const PATIENCE: Duration = Duration::from_millis(500);

#[derive(Default)]
pub(super) struct Inbox(Mutex<Inner>);

#[derive(Default)]
struct Inner {
    /// A publisher of the graph for each remote publisher.
    feeds: BTreeMap<Gid, Feed>,
    early: VecDeque<(Gid, Vec<u8>, Since)>,
}

pub(super) struct Feed {
    pub(super) publisher: RawPublisher,
    /// True if its token was received.
    pub(super) is_known: bool,
}

impl Inbox {
    /// Publishes or queues a message; true if its publisher is unknown so far.
    pub(super) fn take(&self, gid: Gid, bytes: Vec<u8>) -> bool {
        let mut inner = lock(&self.0);
        // Under the lock, so that it does not overtake queued messages.
        if let Some(feed) = inner.feeds.get(&gid) {
            feed.publisher.publish(bytes);
            return false;
        }
        if inner.early.len() == MOST_EARLY {
            inner.early.pop_front();
        }
        inner.early.push_back((gid, bytes, Since::now()));
        true
    }

    /// Creates and removes publishers in the graph to match the known remote publishers. `make`
    /// creates one.
    pub(super) fn feed(
        &self,
        known: &[Gid],
        foreign: &Foreign,
        mut make: impl FnMut() -> Option<RawPublisher>,
    ) {
        let mut inner = lock(&self.0);
        inner.feeds.retain(|gid, feed| {
            // A publisher without a token does not report that it leaves.
            let stays = !feed.is_known || known.contains(gid);
            if !stays {
                lock(foreign).remove(&feed.publisher.id());
            }
            stays
        });
        for gid in known {
            if let Some(feed) = inner.feeds.get_mut(gid) {
                feed.is_known = true;
            } else if let Some(publisher) = make() {
                inner.admit(*gid, Feed { publisher, is_known: true }, foreign);
            }
        }
    }

    /// Accepts publishers that have sent messages and whose tokens did not arrive in time.
    pub(super) fn take_strangers(
        &self,
        foreign: &Foreign,
        mut make: impl FnMut() -> Option<RawPublisher>,
    ) {
        let mut inner = lock(&self.0);
        while let Some((gid, _, since)) = inner.early.front() {
            let gid = *gid;
            if since.elapsed() < PATIENCE {
                return;
            }
            let Some(publisher) = make() else { return };
            inner.admit(gid, Feed { publisher, is_known: false }, foreign);
        }
    }

    /// Publishers to remove with the inbox.
    pub(super) fn close(&self, foreign: &Foreign) {
        let mut inner = lock(&self.0);
        for feed in std::mem::take(&mut inner.feeds).into_values() {
            lock(foreign).remove(&feed.publisher.id());
        }
    }
}

impl Inner {
    /// Adds a publisher and publishes its queued messages.
    fn admit(&mut self, gid: Gid, feed: Feed, foreign: &Foreign) {
        lock(foreign).insert(feed.publisher.id());
        self.early.retain_mut(|(from, bytes, _)| {
            let is_its = *from == gid;
            if is_its {
                feed.publisher.publish(std::mem::take(bytes));
            }
            !is_its
        });
        self.feeds.insert(gid, feed);
    }
}
