//! Handle of the DDS transport.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_cyclonedds_sys::{self as dds, Participant, Waker};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, Node};
use periplus_transport::{lock, stand_in, wait_until};

use crate::link::Link;
use crate::outgoing::{Lanes, Outgoing};
use crate::peers::Peers;
use crate::remote::{DiscoveryProgress, Remote};
use crate::{DdsError, Guid, Settings, user_data};

/// Time for sending the remaining samples when the transport is dropped.
const LAST_CHANCE: Duration = Duration::from_millis(300);

/// A DDS participant for one graph. It leaves the network when this is dropped.
pub struct DdsTransport {
    shared: Arc<Shared>,
    waker: Waker,
    participant: Participant,
    threads: Vec<JoinHandle<()>>,
}

/// State shared by the handle and the threads.
pub(crate) struct Shared {
    pub(crate) peers: Mutex<Peers>,
    /// Notified when the peers have changed.
    pub(crate) changed: Condvar,
    pub(crate) findings: Mutex<Diagnostics>,
    /// A graph to attach, with the node that represents all remote participants.
    pub(crate) joining: Mutex<Option<(Graph, Node)>>,
    pub(crate) lanes: Arc<Lanes>,
    /// All writers, for [`DdsTransport::flush`].
    pub(crate) writers: Mutex<Vec<Arc<Outgoing>>>,
    pub(crate) is_closing: AtomicBool,
    is_attached: AtomicBool,
}

impl Shared {
    pub(crate) fn report(&self, finding: Diagnostic) {
        lock(&self.findings).push(finding);
    }
}

impl DdsTransport {
    /// Joins the network.
    ///
    /// # Errors
    /// When there is no such network, or DDS refuses its settings.
    pub fn open(settings: &Settings) -> Result<Self, DdsError> {
        let network =
            |error: dds::Error| DdsError::Network { domain_id: settings.domain_id, why: error.why };
        let said = user_data::enclave(&settings.enclave);
        let participant = Participant::open(&settings.config(), &said).map_err(network)?;
        let (lanes, mut threads) = Lanes::start();
        let shared = Arc::new(Shared {
            peers: Mutex::new(Peers::new(participant.guid())),
            changed: Condvar::new(),
            findings: Mutex::default(),
            joining: Mutex::default(),
            lanes,
            writers: Mutex::default(),
            is_closing: AtomicBool::new(false),
            is_attached: AtomicBool::new(false),
        });
        let link = Link::new(&participant, shared.clone()).map_err(network)?;
        let waker = link.waker();
        let thread = std::thread::Builder::new().name("wire".to_owned());
        threads.push(thread.spawn(move || link.run()).expect("the system starts a thread"));
        Ok(Self { shared, waker, participant, threads })
    }

    /// Attaches a graph for the lifetime of this handle: its endpoints become visible on the
    /// network, and remote endpoints are connected to it. A node whose name begins with `_wire`
    /// represents all remote participants in the graph.
    ///
    /// # Errors
    /// When a graph is attached already.
    pub fn attach(&self, graph: &Graph) -> Result<(), DdsError> {
        if self.shared.is_attached.swap(true, Ordering::AcqRel) {
            return Err(DdsError::Attached);
        }
        let node = stand_in(graph, &self.participant.guid().0[2..12])?;
        *lock(&self.shared.joining) = Some((graph.clone(), node));
        self.waker.wake();
        Ok(())
    }

    /// Remote nodes, topics and services. Discovery takes a moment: see [`DdsTransport::wait_for`].
    #[must_use]
    pub fn remote(&self) -> Remote {
        lock(&self.shared.peers).view()
    }

    /// Progress of discovery. Cheaper than [`DdsTransport::remote`].
    #[must_use]
    pub fn progress(&self) -> DiscoveryProgress {
        lock(&self.shared.peers).progress()
    }

    /// Waits until the remote side satisfies the condition, at most for the timeout; true if it
    /// does.
    pub fn wait_for(&self, timeout: Duration, mut wanted: impl FnMut(&Remote) -> bool) -> bool {
        let peers = lock(&self.shared.peers);
        let mut seen = None;
        let waited = self.shared.changed.wait_timeout_while(peers, timeout, |peers| {
            // Skip the check while nothing has changed.
            if seen.replace(peers.changes()) == Some(peers.changes()) {
                return true;
            }
            !wanted(&peers.view())
        });
        !waited.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Waits until all matched readers have acknowledged everything published so far, at most for
    /// the timeout; true if they have. Best effort is not waited for.
    #[must_use]
    pub fn flush(&self, timeout: Duration) -> bool {
        wait_until(timeout, || {
            let writers = lock(&self.shared.writers).clone();
            let is_sent = self.shared.lanes.waiting() == 0;
            is_sent && writers.iter().all(|one| one.writer.wait_acknowledged(0))
        })
    }

    /// Returns the findings since the last call: incompatible types and QoS, malformed samples,
    /// errors of DDS.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        let mut findings = std::mem::take(&mut *lock(&self.shared.findings));
        for line in dds::take_log() {
            let text = format!("DDS: {}", line.text);
            findings.push(if line.is_error {
                Diagnostic::error("dds", text)
            } else {
                Diagnostic::warning("dds", text)
            });
        }
        findings
    }

    /// GUID of its participant.
    #[must_use]
    pub fn guid(&self) -> Guid {
        self.participant.guid()
    }
}

impl Drop for DdsTransport {
    fn drop(&mut self) {
        let _ = self.flush(LAST_CHANCE);
        self.shared.is_closing.store(true, Ordering::Release);
        self.waker.wake();
        self.shared.lanes.close();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
        lock(&self.shared.writers).clear();
    }
}

impl std::fmt::Debug for DdsTransport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DdsTransport").field("guid", &self.guid()).finish_non_exhaustive()
    }
}
