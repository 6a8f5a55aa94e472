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
//! use periplus_graph::{Graph, NodeSettings, Qos};
//! use periplus_lockstep::{LockstepClient, LockstepHost, NodeWords};
//! use periplus_msgs::std_msgs::String as Text;
//!
//! let graph = Graph::new();
//! let host = LockstepHost::new(&graph)?;
//! let link = host.expect("talker");
//! let process = std::thread::spawn(move || -> std::io::Result<()> {
//!     let client = LockstepClient::connect(&link)?;
//!     let node = client.node(&NodeWords { name: "talker".into(), ..NodeWords::default() })?;
//!     let publisher = client.publisher(node, "/chatter", "std_msgs/msg/String", None, Qos::reliable(1))?;
//!     client.wait(Some(1_000_000_000), false)?;
//!     client.publish(publisher, b"\0\x01\0\0\x03\0\0\0hi\0")?;
//!     client.wait(None, false)
//! });
//! host.admit(&mut |_| true);
//! let heard = graph.node(NodeSettings::new("listener"))?.mailbox::<Text>("/chatter", Qos::reliable(1))?;
//! graph.advance_to(2_000_000_000);
//! let (sample, text) = heard.drain_samples().remove(0);
//! assert_eq!((sample.time_ns, text.data.as_str()), (1_000_000_000, "hi"));
//! drop(host);
//! # let _ = process.join();
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
