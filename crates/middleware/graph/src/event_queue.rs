//! Queue of events in the order of execution.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Order of events of one node at the same time: events from other nodes come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Rank {
    Jump,
    Message,
    Request,
    Answer,
    Timer,
}

/// Order of all events: time, then node, topic, and sequence number of the message. The ordinal
/// separates events that are equal otherwise, such as two subscriptions of one node to one topic,
/// by age.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Key {
    pub(crate) time_ns: i64,
    pub(crate) node: Arc<str>,
    pub(crate) rank: Rank,
    pub(crate) name: Arc<str>,
    pub(crate) sequence: u64,
    pub(crate) ordinal: u64,
}

impl Ord for Key {
    fn cmp(&self, other: &Self) -> Ordering {
        self.time_ns
            .cmp(&other.time_ns)
            .then_with(|| compare(&self.node, &other.node))
            .then(self.rank.cmp(&other.rank))
            .then_with(|| compare(&self.name, &other.name))
            .then(self.sequence.cmp(&other.sequence))
            .then(self.ordinal.cmp(&other.ordinal))
    }
}

impl PartialOrd for Key {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Compares names; equal ones are mostly the same object, which need not be read.
fn compare(one: &Arc<str>, other: &Arc<str>) -> Ordering {
    if Arc::ptr_eq(one, other) { Ordering::Equal } else { one.cmp(other) }
}

/// An event in the queue.
pub(crate) trait Event: Send + Sync {
    fn happen(&self, key: &Key);

    /// Returns the new time of the event after a jump of the clock to `now_ns`.
    fn time_after_jump(&self, now_ns: i64) -> i64 {
        now_ns
    }

    /// The event was removed without being executed.
    fn forget(&self, _key: &Key) {}
}

#[derive(Default)]
pub(crate) struct EventQueue {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    events: BTreeMap<Key, Arc<dyn Event>>,
    /// Times of the timers \[ns\], by node and ordinal.
    timers: HashMap<(Arc<str>, u64), i64>,
    is_closed: bool,
}

impl State {
    fn insert(&mut self, key: Key, event: Arc<dyn Event>) {
        if key.rank == Rank::Timer {
            self.timers.insert((key.node.clone(), key.ordinal), key.time_ns);
        }
        self.events.insert(key, event);
    }

    /// An event is no longer in the queue.
    fn forget(&mut self, key: &Key) {
        if key.rank == Rank::Timer {
            self.timers.remove(&(key.node.clone(), key.ordinal));
        }
    }

    fn pop_first(&mut self) -> Option<(Key, Arc<dyn Event>)> {
        let (key, event) = self.events.pop_first()?;
        self.forget(&key);
        Some((key, event))
    }

    fn remove(&mut self, key: &Key) -> Option<(Key, Arc<dyn Event>)> {
        let (key, event) = self.events.remove_entry(key)?;
        self.forget(&key);
        Some((key, event))
    }
}

impl EventQueue {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn add(&self, key: Key, event: Arc<dyn Event>) {
        let mut state = self.lock();
        if !state.is_closed {
            state.insert(key, event);
        }
        drop(state);
        self.changed.notify_one();
    }

    pub(crate) fn remove(&self, key: &Key) {
        let removed = self.lock().remove(key);
        drop(removed);
    }

    /// Removes and returns the first event that is due.
    pub(crate) fn next_due(&self, now_ns: i64) -> Option<(Key, Arc<dyn Event>)> {
        let mut state = self.lock();
        let (first, _) = state.events.first_key_value()?;
        if first.time_ns <= now_ns { state.pop_first() } else { None }
    }

    /// Waits for the next event that is due (live mode); none when the queue is closed. Messages
    /// are always due: one published just before the clock jumped back must not wait for the old
    /// time.
    pub(crate) fn wait_due(&self, now_ns: impl Fn() -> i64) -> Option<(Key, Arc<dyn Event>)> {
        let mut state = self.lock();
        loop {
            if state.is_closed {
                return None;
            }
            let now_ns = now_ns();
            let is_due = |key: &&Key| key.time_ns <= now_ns || key.rank != Rank::Timer;
            if let Some(key) = state.events.keys().find(is_due).cloned() {
                return state.remove(&key);
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Time of the first event \[ns\]; none if the queue is empty.
    pub(crate) fn first_ns(&self) -> Option<i64> {
        self.lock().events.first_key_value().map(|(key, _)| key.time_ns)
    }

    /// True if an event is due.
    pub(crate) fn is_due(&self, now_ns: i64) -> bool {
        self.first_ns().is_some_and(|first_ns| first_ns <= now_ns)
    }

    /// Wakes the waiting thread if an event is due. Most steps of time have no event for most
    /// nodes, and waking a thread costs more than this check.
    pub(crate) fn wake_if_due(&self, now_ns: i64) {
        // A thread that is about to wait has read the old time under the lock.
        if self.first_ns().is_some_and(|first_ns| first_ns <= now_ns) {
            self.changed.notify_one();
        }
    }

    /// Closes the queue; no more events are executed.
    pub(crate) fn close(&self) {
        let mut state = self.lock();
        state.is_closed = true;
        let events = std::mem::take(&mut state.events);
        state.timers.clear();
        drop(state);
        self.changed.notify_one();
        drop(events);
    }

    /// Removes a timer, if it is in the queue.
    pub(crate) fn remove_timer(&self, node: &Arc<str>, ordinal: u64) {
        let mut state = self.lock();
        let Some(time_ns) = state.timers.get(&(node.clone(), ordinal)).copied() else { return };
        let key = Key {
            time_ns,
            node: node.clone(),
            rank: Rank::Timer,
            name: "".into(),
            sequence: 0,
            ordinal,
        };
        let removed = state.remove(&key);
        drop(state);
        drop(removed);
    }

    /// Removes all events that are due, except timers.
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

    /// Reschedules after a jump of the clock: timers restart, everything else is due now.
    pub(crate) fn rebase(&self, now_ns: i64) {
        let mut state = self.lock();
        state.timers.clear();
        for (key, event) in std::mem::take(&mut state.events) {
            state.insert(Key { time_ns: event.time_after_jump(now_ns), ..key }, event);
        }
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

    /// Regression test: each step of time (200 per second) woke the threads of all nodes, which was
    /// most of the CPU load of an idle live node.
    #[test]
    fn steps_of_time_wake_a_thread_only_for_what_is_due() {
        const STEPS: i64 = 50;
        let event_queue = EventQueue::default();
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
        event_queue.add(key, Arc::new(Nothing));
        let due = std::thread::scope(|scope| {
            let waiting = scope.spawn(|| {
                event_queue.wait_due(|| {
                    looks.fetch_add(1, Ordering::Relaxed);
                    now_ns.load(Ordering::Acquire)
                })
            });
            for step in 1..=STEPS {
                now_ns.store(step, Ordering::Release);
                event_queue.wake_if_due(step);
                std::thread::sleep(Duration::from_millis(2));
            }
            waiting.join().unwrap()
        });
        assert_eq!(due.map(|(key, _)| key.time_ns), Some(STEPS));
        // One wake-up at the start and one when the event is due; the system may add spurious ones.
        assert!(looks.load(Ordering::Relaxed) <= 10, "{looks:?} looks");
    }

    /// Regression test: each alarm that had rung was looked for among the events of all nodes when it was dropped, so that
    /// a hundred robots cost each other half of their time.
    #[test]
    fn a_removed_timer_is_found_by_its_node_and_ordinal() {
        let queue = EventQueue::default();
        let key = |node: &str, time_ns, ordinal| Key {
            time_ns,
            node: node.into(),
            rank: Rank::Timer,
            name: "".into(),
            sequence: 0,
            ordinal,
        };
        for (node, time_ns, ordinal) in [("a", 10, 1), ("a", 20, 2), ("b", 30, 1)] {
            queue.add(key(node, time_ns, ordinal), Arc::new(Nothing));
        }
        let times = |queue: &EventQueue| -> Vec<i64> {
            queue.lock().events.keys().map(|key| key.time_ns).collect()
        };
        queue.remove_timer(&"a".into(), 2);
        queue.remove_timer(&"a".into(), 3);
        assert_eq!(times(&queue), [10, 30]);
        // One that has happened is in the index no more, one that jumped is.
        assert!(queue.next_due(10).is_some());
        assert_eq!(queue.lock().timers.len(), 1);
        queue.rebase(5);
        queue.remove_timer(&"b".into(), 1);
        assert!(times(&queue).is_empty() && queue.lock().timers.is_empty());
    }
}
