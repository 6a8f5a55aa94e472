//! The graph's side.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::Graph;
use periplus_transport::Since;

use crate::frame::{Kind, Reader, append};
use crate::lock;
use crate::peer::Peer;
use crate::query::{Query, Reply};
use crate::socket::{Listener, Stream};

/// The processes that run in step with a graph. They are released when this is dropped.
pub struct LockstepHost {
    graph: Graph,
    listener: Listener,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Number of processes that were announced.
    count: usize,
    /// Announced processes by their token, with their number and label.
    expected: BTreeMap<String, (usize, String)>,
    peers: Vec<Arc<Peer>>,
    findings: Diagnostics,
}

/// Period at which the arrival of a process is checked.
const LOOK_AGAIN: Duration = Duration::from_millis(2);

/// Time for a process to start and to connect.
const START_TIMEOUT: Duration = Duration::from_secs(60);

impl LockstepHost {
    /// Listens for processes.
    ///
    /// # Errors
    /// When there is no socket.
    pub fn new(graph: &Graph) -> io::Result<Self> {
        Ok(Self { graph: graph.clone(), listener: Listener::open()?, state: Mutex::default() })
    }

    /// Announces a process; returns the link by which it connects ([`crate::LockstepClient::connect`]).
    pub fn expect(&self, label: &str) -> String {
        let mut state = lock(&self.state);
        state.count += 1;
        let number = state.count;
        let token = format!("{}-{number}", std::process::id());
        state.expected.insert(token.clone(), (number, label.to_owned()));
        format!("{}#{token}", self.listener.address())
    }

    /// Waits until the announced processes have connected, and lets each of them, in the order in which they were
    /// announced, work until it waits. `is_running` returns by its label if a process runs: one that has ended is not
    /// waited for.
    ///
    /// The time of the graph does not advance meanwhile; call this before it advances.
    pub fn admit(&self, is_running: &mut dyn FnMut(&str) -> bool) {
        let mut arrived: BTreeMap<usize, (String, Stream, Reader, u32)> = BTreeMap::new();
        let start = Since::now();
        while !lock(&self.state).expected.is_empty() {
            match self.listener.accept() {
                Ok(stream) => {
                    if let Some((number, one)) = self.greet(stream) {
                        arrived.insert(number, one);
                    }
                    continue;
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(error) => {
                    let text = format!("a process cannot connect: {error}");
                    lock(&self.state).findings.push(Diagnostic::error("lockstep", text));
                }
            }
            let mut state = lock(&self.state);
            let is_late = start.elapsed() > START_TIMEOUT;
            let State { expected, findings, .. } = &mut *state;
            expected.retain(|_, (_, label)| {
                if !is_running(label) {
                    return false;
                }
                if is_late {
                    let seconds = START_TIMEOUT.as_secs();
                    let text = format!("`{label}` did not call `rclpy.init` or `rospy.init_node` within {seconds} s");
                    let help = "the program runs freely, not in step with the simulation";
                    findings.push(Diagnostic::warning("lockstep", text).help(help));
                }
                !is_late
            });
            drop(state);
            std::thread::sleep(LOOK_AGAIN);
        }
        for (number, (label, stream, reader, pid)) in arrived {
            match Peer::new(&self.graph, label, number, stream, reader, pid) {
                Ok(peer) => {
                    lock(&self.state).peers.push(peer.clone());
                    peer.turn();
                }
                Err(error) => {
                    let text = format!("a process cannot join: {error}");
                    lock(&self.state).findings.push(Diagnostic::error("lockstep", text));
                }
            }
        }
    }

    /// Reads the greeting of a process that has connected.
    fn greet(&self, mut stream: Stream) -> Option<(usize, (String, Stream, Reader, u32))> {
        stream.set_read_timeout(Some(Duration::from_secs(5))).ok()?;
        let mut reader = Reader::default();
        let (kind, body) = reader.next(&mut stream).ok()?;
        if kind != Kind::Query {
            return None;
        }
        let Ok(Query::Hello { token, pid }) = serde_json::from_slice(body) else { return None };
        let (number, label) = lock(&self.state).expected.remove(&token)?;
        let mut out = Vec::new();
        append(&mut out, Kind::Reply, &[&serde_json::to_vec(&Reply::Done).ok()?]);
        io::Write::write_all(&mut stream, &out).ok()?;
        Some((number, (label, stream, reader, pid)))
    }

    /// True if a process was let in and has gone.
    #[must_use]
    pub fn is_gone(&self, label: &str) -> bool {
        let state = lock(&self.state);
        let mut named = state.peers.iter().filter(|peer| peer.label == label).peekable();
        named.peek().is_some() && named.all(|peer| peer.is_gone())
    }

    /// Number of processes that run in step.
    #[must_use]
    pub fn running(&self) -> usize {
        lock(&self.state).peers.iter().filter(|peer| !peer.is_gone()).count()
    }

    /// Findings since the last call: processes that did not come back, or did not connect.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        let mut state = lock(&self.state);
        let mut findings = std::mem::take(&mut state.findings);
        for peer in &state.peers {
            for finding in peer.take_findings().iter() {
                findings.push(finding.clone());
            }
        }
        findings
    }
}

impl Drop for LockstepHost {
    fn drop(&mut self) {
        for peer in std::mem::take(&mut lock(&self.state).peers) {
            peer.close();
        }
    }
}
