//! Calls of the master to nodes: one thread for each node with calls, so that a node that does not answer delays
//! no other node.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_transport::lock;

use super::state::Notification;
use crate::rpc;
use crate::xmlrpc::RpcCall;

/// Timeout of a call to a node.
const PATIENCE: Duration = Duration::from_secs(5);

/// Maximum number of calls that wait for one node; older ones of the same method and topic are outdated anyway.
const MAX_WAITING: usize = 1024;

/// Maximum number of nodes that are called at the same time.
const MAX_NODES: usize = 256;

/// Calls that wait, by the address of the node. A node with an entry has a thread.
#[derive(Clone, Default)]
pub(super) struct Notifier(Arc<Mutex<BTreeMap<String, VecDeque<RpcCall>>>>);

impl Notifier {
    /// Makes calls, in this order for each node.
    pub(super) fn send(&self, notifications: Vec<Notification>) {
        for Notification { address, call } in notifications {
            let mut waiting = lock(&self.0);
            if let Some(calls) = waiting.get_mut(&address) {
                // An update has all publishers, so that the last one of a topic counts.
                calls.retain(|old| {
                    old.method != call.method
                        || old.params.get(1) != call.params.get(1)
                        || call.method == "shutdown"
                });
                if calls.len() < MAX_WAITING {
                    calls.push_back(call);
                }
                continue;
            }
            if waiting.len() >= MAX_NODES {
                continue;
            }
            waiting.insert(address.clone(), VecDeque::from([call]));
            drop(waiting);
            let this = self.clone();
            let thread = std::thread::Builder::new().name("ros1-notify".to_owned());
            let calling = address.clone();
            if thread.spawn(move || this.run(&calling)).is_err() {
                lock(&self.0).remove(&address);
            }
        }
    }

    fn run(&self, address: &str) {
        loop {
            let call = {
                let mut waiting = lock(&self.0);
                match waiting.get_mut(address).and_then(VecDeque::pop_front) {
                    Some(call) => call,
                    None => {
                        waiting.remove(address);
                        return;
                    }
                }
            };
            // A node that does not answer has ended without a word; others go on.
            let _ = rpc::call(address, &call, PATIENCE);
        }
    }
}
