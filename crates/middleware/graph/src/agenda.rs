//! What is to be done, in order.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// When in the life of its node something happens, at one and the same time: what came from others
/// before what the node does by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Jump,
    Message,
    Request,
    Answer,
    Timer,
}

/// The order of everything that happens: time, then node, then topic, then the number of the
/// message. The last number tells apart what is equal otherwise: two subscriptions of one node to
/// one topic, by their age.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Key {
    pub(crate) time_ns: i64,
    pub(crate) node: Arc<str>,
    pub(crate) rank: Rank,
    pub(crate) name: Arc<str>,
    pub(crate) sequence: u64,
    pub(crate) ordinal: u64,
}

/// Something that can happen.
pub(crate) trait Event: Send + Sync {
    fn happen(&self, key: &Key);

    /// When it happens instead, now that the clock jumped to `now_ns`.
    fn time_after_jump(&self, now_ns: i64) -> i64 {
        now_ns
    }

    /// It will not happen after all.
    fn forget(&self, _key: &Key) {}
}

#[derive(Default)]
pub(crate) struct Agenda {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    events: BTreeMap<Key, Arc<dyn Event>>,
    is_closed: bool,
}

impl Agenda {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn add(&self, key: Key, event: Arc<dyn Event>) {
        let mut state = self.lock();
        if !state.is_closed {
            state.events.insert(key, event);
        }
        drop(state);
        self.changed.notify_one();
    }

    pub(crate) fn remove(&self, key: &Key) {
        let removed = self.lock().events.remove(key);
        drop(removed);
    }

    /// The first of what is due.
    pub(crate) fn next_due(&self, now_ns: i64) -> Option<(Key, Arc<dyn Event>)> {
        let mut state = self.lock();
        let first = state.events.first_entry()?;
        (first.key().time_ns <= now_ns).then(|| first.remove_entry())
    }

    /// Waits for what is due, in live; none when the agenda is closed. Messages are always due: one
    /// published just before the clock jumped back must not wait for the old time.
    pub(crate) fn wait_due(&self, now_ns: impl Fn() -> i64) -> Option<(Key, Arc<dyn Event>)> {
        let mut state = self.lock();
        loop {
            if state.is_closed {
                return None;
            }
            let now_ns = now_ns();
            let is_due = |key: &&Key| key.time_ns <= now_ns || key.rank != Rank::Timer;
            if let Some(key) = state.events.keys().find(is_due).cloned() {
                return state.events.remove_entry(&key);
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Time of the first event \[ns\]; none where nothing is planned.
    pub(crate) fn first_ns(&self) -> Option<i64> {
        self.lock().events.first_key_value().map(|(key, _)| key.time_ns)
    }

    /// Wakes the thread that waits for what is due if something is at this time. Most steps of time
    /// have nothing for most nodes, and a thread that wakes for nothing costs more than the look.
    pub(crate) fn wake_if_due(&self, now_ns: i64) {
        // A thread that is about to wait has read the old time under the lock.
        if self.first_ns().is_some_and(|first_ns| first_ns <= now_ns) {
            self.changed.notify_one();
        }
    }

    /// Nothing happens any more.
    pub(crate) fn close(&self) {
        let mut state = self.lock();
        state.is_closed = true;
        let events = std::mem::take(&mut state.events);
        drop(state);
        self.changed.notify_one();
        drop(events);
    }

    /// Takes a timer out.
    pub(crate) fn remove_timer(&self, node: &str, ordinal: u64) {
        let is_it =
            |key: &Key| key.rank == Rank::Timer && key.ordinal == ordinal && *key.node == *node;
        let mut state = self.lock();
        let key = state.events.keys().find(|key| is_it(key)).cloned();
        let removed = key.and_then(|key| state.events.remove(&key));
        drop(state);
        drop(removed);
    }

    /// Forgets all that is due but timers.
    pub(crate) fn drop_due(&self, now_ns: i64) {
        let mut state = self.lock();
        let all = std::mem::take(&mut state.events);
        let (keep, drop): (BTreeMap<_, _>, BTreeMap<_, _>) =
            all.into_iter().partition(|(key, _)| key.rank == Rank::Timer || now_ns < key.time_ns);
        state.events = keep;
        std::mem::drop(state);
        for (key, event) in drop {
            event.forget(&key);
        }
    }

    /// The clock jumped: timers start anew, all else is due now.
    pub(crate) fn rebase(&self, now_ns: i64) {
        let mut state = self.lock();
        let all = std::mem::take(&mut state.events);
        state.events = all
            .into_iter()
            .map(|(key, event)| (Key { time_ns: event.time_after_jump(now_ns), ..key }, event))
            .collect();
        drop(state);
        self.changed.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};
    use std::time::Duration;

    use super::*;

    struct Nothing;

    impl Event for Nothing {
        fn happen(&self, _key: &Key) {}
    }

    /// Every step of time, 200 in a second, woke the threads of all nodes: most of the CPU of a live node
    /// that had little to do.
    #[test]
    fn steps_of_time_wake_a_thread_only_for_what_is_due() {
        const STEPS: i64 = 50;
        let agenda = Agenda::default();
        let (now_ns, looks) = (AtomicI64::new(0), AtomicU64::new(0));
        let name: Arc<str> = "node".into();
        let key = Key {
            time_ns: STEPS,
            node: name.clone(),
            rank: Rank::Timer,
            name,
            sequence: 0,
            ordinal: 0,
        };
        agenda.add(key, Arc::new(Nothing));
        let due = std::thread::scope(|scope| {
            let waiting = scope.spawn(|| {
                agenda.wait_due(|| {
                    looks.fetch_add(1, Ordering::Relaxed);
                    now_ns.load(Ordering::Acquire)
                })
            });
            for step in 1..=STEPS {
                now_ns.store(step, Ordering::Release);
                agenda.wake_if_due(step);
                std::thread::sleep(Duration::from_millis(2));
            }
            waiting.join().unwrap()
        });
        assert_eq!(due.map(|(key, _)| key.time_ns), Some(STEPS));
        // Once at the beginning, once when it is due; systems may wake a thread by themselves.
        assert!(looks.load(Ordering::Relaxed) <= 10, "{looks:?} looks");
    }
}
