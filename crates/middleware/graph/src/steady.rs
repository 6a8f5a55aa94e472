//! Steady time: it advances while simulated time is paused, reset, slower or faster than the host's
//! clock. Protocols between programs, such as the heartbeats of bonds, need it.
//!
//! A graph reads no clock. A transport drives the steady time of its graph from the host's steady
//! clock; without a transport, steady time is the graph's own.

use std::sync::{Arc, Mutex, Weak};
use std::time::Duration;

use crate::common::lock;
use crate::graph::Core;
use crate::{Graph, Node};

type React = dyn Fn(i64) + Send + Sync;

/// Steady time of one graph.
#[derive(Default)]
pub(crate) struct Steady {
    time: Mutex<Time>,
    callbacks: Mutex<Vec<Weak<React>>>,
}

#[derive(Default)]
struct Time {
    /// Steady time minus graph time while no driver exists \[ns\].
    ahead_ns: i64,
    driven: Option<Driven>,
}

struct Driven {
    start_ns: i64,
    now_ns: i64,
}

impl Steady {
    fn now_ns(&self, graph_ns: i64) -> i64 {
        let time = lock(&self.time);
        match &time.driven {
            Some(driven) => driven.now_ns,
            None => graph_ns.saturating_add(time.ahead_ns),
        }
    }

    fn is_driven(&self) -> bool {
        lock(&self.time).driven.is_some()
    }
}

/// Drives the steady time of a graph until it is dropped. A transport calls
/// [`SteadyDriver::advance_to`] periodically with its clock.
#[derive(Debug)]
pub struct SteadyDriver {
    graph: Graph,
}

impl SteadyDriver {
    fn core(&self) -> &Arc<Core> {
        &self.graph.0
    }

    /// Sets the steady time to the time since this driver was created and runs the callbacks. The
    /// time must not decrease.
    pub fn advance_to(&self, elapsed: Duration) {
        let steady = &self.core().common.steady;
        let elapsed_ns = i64::try_from(elapsed.as_nanos()).unwrap_or(i64::MAX);
        let now_ns = {
            let mut time = lock(&steady.time);
            let Some(driven) = &mut time.driven else { return };
            driven.now_ns = driven.now_ns.max(driven.start_ns.saturating_add(elapsed_ns));
            driven.now_ns
        };
        let callbacks: Vec<_> = {
            let mut callbacks = lock(&steady.callbacks);
            callbacks.retain(|callback| callback.strong_count() > 0);
            callbacks.iter().filter_map(Weak::upgrade).collect()
        };
        // Without the lock: a callback may create or drop others.
        for callback in callbacks {
            callback(now_ns);
        }
    }
}

impl Drop for SteadyDriver {
    fn drop(&mut self) {
        let graph_ns = self.graph.now_ns();
        let mut time = lock(&self.core().common.steady.time);
        if let Some(driven) = time.driven.take() {
            // Steady time continues with the graph from here.
            time.ahead_ns = driven.now_ns.saturating_sub(graph_ns);
        }
    }
}

/// A callback of [`Node::on_steady_time`]; it is removed when this is dropped.
#[must_use = "the callback ends when this is dropped"]
pub struct SteadyCallback {
    // The graph holds it weakly.
    _react: Arc<React>,
}

impl Graph {
    /// Creates the driver of steady time; none while another exists.
    #[must_use]
    pub fn steady_driver(&self) -> Option<SteadyDriver> {
        let now_ns = self.steady_now_ns();
        let mut time = lock(&self.0.common.steady.time);
        if time.driven.is_some() {
            return None;
        }
        time.driven = Some(Driven { start_ns: now_ns, now_ns });
        Some(SteadyDriver { graph: self.clone() })
    }

    /// Steady time \[ns\]. With a driver it advances while the graph is paused; otherwise it
    /// advances with the time of the graph.
    #[must_use]
    pub fn steady_now_ns(&self) -> i64 {
        self.0.common.steady.now_ns(self.now_ns())
    }

    /// True while a driver exists.
    #[must_use]
    pub fn has_steady_driver(&self) -> bool {
        self.0.common.steady.is_driven()
    }
}

impl Node {
    /// Calls back with the steady time \[ns\] whenever a driver advances it, on the driver's
    /// thread. Without a driver there are no callbacks; use a timer of the graph.
    pub fn on_steady_time(&self, react: impl Fn(i64) + Send + Sync + 'static) -> SteadyCallback {
        let react: Arc<React> = Arc::new(react);
        lock(&self.0.core.common.steady.callbacks).push(Arc::downgrade(&react));
        SteadyCallback { _react: react }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use std::sync::atomic::{AtomicI64, Ordering};

    use super::*;
    use crate::NodeSettings;

    const SECOND: i64 = 1_000_000_000;

    #[test]
    fn steady_time_goes_on_while_the_graph_is_paused() {
        let graph = Graph::new();
        graph.advance_to(5 * SECOND);
        assert_eq!(graph.steady_now_ns(), 5 * SECOND);
        let driver = graph.steady_driver().unwrap();
        assert!(graph.steady_driver().is_none());
        let node = graph.node(NodeSettings::new("one")).unwrap();
        let seen = Arc::new(AtomicI64::new(0));
        let own = seen.clone();
        let callback = node.on_steady_time(move |now_ns| own.store(now_ns, Ordering::SeqCst));
        graph.set_paused(true);
        driver.advance_to(Duration::from_secs(2));
        assert_eq!((graph.now_ns(), graph.steady_now_ns()), (5 * SECOND, 7 * SECOND));
        assert_eq!(seen.load(Ordering::SeqCst), 7 * SECOND);
        // Decreases neither with the driver's clock nor with the graph's.
        driver.advance_to(Duration::from_secs(1));
        graph.set_paused(false);
        graph.jump_to(0);
        assert_eq!(graph.steady_now_ns(), 7 * SECOND);
        drop(callback);
        driver.advance_to(Duration::from_secs(3));
        assert_eq!(seen.load(Ordering::SeqCst), 7 * SECOND);
        drop(driver);
        graph.advance_to(SECOND);
        assert_eq!(graph.steady_now_ns(), 9 * SECOND);
        assert!(!graph.has_steady_driver());
    }
}
