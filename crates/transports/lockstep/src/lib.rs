//! Nodes in other processes that run in step with a graph.
//!
//! A graph in lockstep executes its events in one order. A message for a node of another process is such an event:
//! the graph waits until the process has handled it, and what the process publishes meanwhile is published at the
//! same time of the graph. A process that waits for a time, as in a timer or in a sleep, is woken by an event, too.
//!
//! - [`LockstepHost`]: the graph's side. It holds the publishers, subscriptions, clients and servers of the
//!   processes as endpoints of the graph.
//! - [`LockstepClient`]: the side of a process, which has an [`Inbox`] for each of its endpoints.
//!
//! ```
//! use periplus_graph::Graph;
//! use periplus_lockstep::{LockstepClient, LockstepHost};
//!
//! let graph = Graph::new();
//! let host = LockstepHost::new(&graph)?;
//! let link = host.expect("sleeper");
//! let process = std::thread::spawn(move || -> std::io::Result<i64> {
//!     let client = LockstepClient::connect(&link)?;
//!     client.wait(Some(1_000_000_000), false)?;
//!     Ok(client.now_ns())
//! });
//! host.admit(&mut |_| true);
//! graph.advance_to(2_000_000_000);
//! assert_eq!(process.join().expect("no panic")?, 1_000_000_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod client;
mod frame;
mod host;
mod inbox;
mod peer;
mod query;
mod socket;

pub use client::LockstepClient;
pub use host::LockstepHost;
pub use inbox::{Inbox, Received};
pub use query::{EndpointWords, NodeWords};

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks a mutex and ignores poisoning, so that a panic does not spread.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
