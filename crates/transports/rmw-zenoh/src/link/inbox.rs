//! What arrives on a topic. Zenoh's own threads bring it, and publish it in the graph at once.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Mutex;
use std::time::Duration;

use periplus_graph::RawPublisher;
use periplus_transport::{Foreign, Since, lock};

use crate::attachment::Gid;

/// Messages of publishers that are not known yet; so many wait.
const MOST_EARLY: usize = 64;

/// So long a publisher that is not known may take to say who it is; then it is taken as it is.
const PATIENCE: Duration = Duration::from_millis(500);

#[derive(Default)]
pub(super) struct Inbox(Mutex<Inner>);

#[derive(Default)]
struct Inner {
    /// A publisher of the graph stands for each elsewhere.
    feeds: BTreeMap<Gid, Feed>,
    early: VecDeque<(Gid, Vec<u8>, Since)>,
}

pub(super) struct Feed {
    pub(super) publisher: RawPublisher,
    /// Whether it said who it is.
    pub(super) is_known: bool,
}

impl Inbox {
    /// A message; whether somebody must see who sent it.
    pub(super) fn take(&self, gid: Gid, bytes: Vec<u8>) -> bool {
        let mut inner = lock(&self.0);
        // Under the lock, so that none overtakes those that waited.
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

    /// Lets publishers stand for those that are there now, and for none else. `make` makes one.
    pub(super) fn feed(
        &self,
        known: &[Gid],
        foreign: &Foreign,
        mut make: impl FnMut() -> Option<RawPublisher>,
    ) {
        let mut inner = lock(&self.0);
        inner.feeds.retain(|gid, feed| {
            // Who never said that it is there does not say when it goes.
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

    /// Takes those as they are who have sent messages and did not say in time who they are.
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

    /// Those whose publishers are to go with the inbox.
    pub(super) fn close(&self, foreign: &Foreign) {
        let mut inner = lock(&self.0);
        for feed in std::mem::take(&mut inner.feeds).into_values() {
            lock(foreign).remove(&feed.publisher.id());
        }
    }
}

impl Inner {
    /// From now on the publisher stands for this one; what of it waited is published.
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
