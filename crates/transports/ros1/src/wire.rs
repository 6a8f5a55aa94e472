//! Handle of the ROS 1 transport.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, Weak};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Graph, Node};
use periplus_transport::{Bell, lock, stand_in, wait_until};

use crate::client::{MasterClient, SystemState};
use crate::error::Ros1Error;
use crate::link::Link;
use crate::master::Master;
use crate::node::{NodeEvents, Place, SubscriptionReport, SubscriptionReporter};
use crate::outgoing::{Lane, Outgoing};
use crate::rpc::RpcError;
use crate::settings::{Settings, is_own};
use crate::tcpros::Publication;
use crate::xmlrpc::XmlRpcValue;

/// Time for sending the remaining messages when the transport is dropped.
const LAST_CHANCE: Duration = Duration::from_millis(300);

/// Caller of calls that belong to no node.
pub(crate) const CALLER: &str = "/periplus";

/// Use of a master by a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MasterUse {
    /// Join the master that answers; start one if none does and its address is on this machine.
    JoinOrStart,
    /// Join the master that answers; without one there is an error.
    Join,
}

/// A graph in ROS 1. It leaves the master when this is dropped.
pub struct Ros1Transport {
    shared: Arc<Shared>,
    lane: Lane,
    threads: Vec<JoinHandle<()>>,
    client: MasterClient,
    /// Declared last, so that it ends after everything that calls it.
    master: Option<Master>,
}

/// State shared by the handle, the threads and the ports.
#[derive(Default)]
pub(crate) struct Shared {
    /// Rings when the link thread has work.
    bell: Bell,
    findings: Mutex<Diagnostics>,
    /// A graph to attach, with the node that represents all remote programs.
    pub(crate) joining: Mutex<Option<(Graph, Node)>>,
    /// Publishers of each topic in the last notification of the master.
    announced: Mutex<BTreeMap<String, BTreeSet<String>>>,
    /// Subscribed topics, by the node that subscribes.
    pub(crate) reports: Mutex<Option<SubscriptionReporter>>,
    is_closing: AtomicBool,
    is_attached: AtomicBool,
    /// Set when [`Ros1Transport::remote`] was called, so that the link thread asks the master.
    pub(crate) is_observed: AtomicBool,
    /// Everything that other programs have registered, as last seen.
    pub(crate) remote: Mutex<Arc<SystemState>>,
    /// Published topics, for [`Ros1Transport::flush`].
    publications: Mutex<Vec<Weak<Publication>>>,
}

impl Shared {
    pub(crate) fn report(&self, finding: Diagnostic) {
        lock(&self.findings).push(finding);
    }

    /// Wakes the link thread.
    pub(crate) fn wake(&self) {
        self.bell.ring();
    }

    /// Sleeps until the link thread has work, at most for the timeout; false when the transport is closed.
    pub(crate) fn sleep(&self, timeout: Duration) -> bool {
        self.bell.wait(timeout);
        !self.is_closing.load(Ordering::Acquire)
    }

    /// Notes the publishers of a topic.
    pub(crate) fn announce(&self, topic: &str, publishers: BTreeSet<String>) {
        lock(&self.announced).insert(topic.to_owned(), publishers);
        self.wake();
    }

    /// Notes a published topic.
    pub(crate) fn note(&self, publication: &Arc<Publication>) {
        let mut all = lock(&self.publications);
        all.retain(|one| one.strong_count() > 0);
        all.push(Arc::downgrade(publication));
    }

    fn is_sent(&self) -> bool {
        lock(&self.publications).iter().filter_map(Weak::upgrade).all(|one| one.is_idle())
    }

    /// Topics whose publishers have changed, with all their publishers.
    pub(crate) fn take_announced(&self) -> BTreeMap<String, BTreeSet<String>> {
        std::mem::take(&mut lock(&self.announced))
    }
}

impl NodeEvents for Shared {
    fn publishers(&self, topic: &str, publishers: Vec<String>) {
        self.announce(topic, publishers.into_iter().collect());
    }

    fn shutdown(&self, node: &str, why: &str) {
        let message = format!("`{node}` was asked to end by {why}");
        self.report(
            Diagnostic::warning("ros1-shutdown", message)
                .help("it is a part of this program and goes on; end the program with Ctrl-C"),
        );
    }

    fn subscriptions(&self, node: &str) -> Vec<SubscriptionReport> {
        let report = lock(&self.reports).clone();
        report.map(|report| report(node)).unwrap_or_default()
    }
}

impl Ros1Transport {
    /// Joins a master, or starts one.
    ///
    /// # Errors
    /// When no master answers and none is started, or no port can be opened.
    pub fn open(settings: &Settings, use_of_master: MasterUse) -> Result<Self, Ros1Error> {
        let (host, port) = settings.master()?;
        let client = MasterClient::new(&settings.master_uri, CALLER);
        let master = match client.ask("getPid", Vec::new()) {
            Ok(_) => None,
            Err(RpcError::Unreachable(_))
                if use_of_master == MasterUse::JoinOrStart && is_own(&host) =>
            {
                Some(Master::open(settings.address(), &settings.host, port)?)
            }
            Err(why) => return Err(Ros1Error::Master { uri: settings.master_uri.clone(), why }),
        };
        let shared = Arc::new(Shared::default());
        let (lane, converting) = Lane::start("ros1-convert", Outgoing::send);
        let place = Place {
            address: settings.address(),
            host: settings.host.clone(),
            master_uri: settings.master_uri.clone(),
        };
        let link = Link::new(place, client.clone(), shared.clone(), lane.clone(), master.is_some());
        let thread = std::thread::Builder::new().name("ros1".to_owned());
        let linking = thread.spawn(move || link.run()).expect("the system starts a thread");
        Ok(Self { shared, lane, threads: vec![linking, converting], client, master })
    }

    /// Attaches a graph for the lifetime of this handle: its nodes, topics and services are registered, and those of
    /// other programs are connected to it. A node whose name begins with `_wire` represents all other programs in
    /// the graph.
    ///
    /// # Errors
    /// When a graph is attached already.
    pub fn attach(&self, graph: &Graph) -> Result<(), Ros1Error> {
        if self.shared.is_attached.swap(true, Ordering::AcqRel) {
            return Err(Ros1Error::Attached);
        }
        let node = stand_in(graph, b"ros1")?;
        *lock(&self.shared.joining) = Some((graph.clone(), node));
        self.shared.wake();
        Ok(())
    }

    /// True if this program has started the master.
    #[must_use]
    pub fn is_master(&self) -> bool {
        self.master.is_some()
    }

    /// Client of the master.
    #[must_use]
    pub fn client(&self) -> &MasterClient {
        &self.client
    }

    /// Everything that other programs have registered, as seen within the last second or two; the first call returns
    /// nothing. It does not wait for the master.
    #[must_use]
    pub fn remote(&self) -> Arc<SystemState> {
        self.shared.is_observed.store(true, Ordering::Release);
        lock(&self.shared.remote).clone()
    }

    /// Sets parameters of the parameter server by their full names.
    ///
    /// # Errors
    /// When the master does not answer.
    pub fn set_parameters(&self, parameters: Vec<(String, XmlRpcValue)>) -> Result<(), Ros1Error> {
        self.client
            .set_parameters(parameters)
            .map_err(|why| Ros1Error::Master { uri: self.client.uri().to_owned(), why })
    }

    /// Names of the subscribers that get the next message of a topic which nodes of this program publish; none if
    /// they do not publish it.
    #[must_use]
    pub fn subscribers_of(&self, topic: &str) -> Option<BTreeSet<String>> {
        let all = lock(&self.shared.publications);
        let its = all.iter().filter_map(Weak::upgrade).filter(|one| one.topic == topic);
        its.map(|one| one.subscribers().into_iter().collect())
            .reduce(|all: BTreeSet<String>, more| &all | &more)
    }

    /// Waits until everything published so far was sent, at most for the timeout; true if it was.
    #[must_use]
    pub fn flush(&self, timeout: Duration) -> bool {
        wait_until(timeout, || self.lane.is_idle() && self.shared.is_sent())
    }

    /// Returns the findings since the last call.
    #[must_use]
    pub fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut *lock(&self.shared.findings))
    }
}

impl Drop for Ros1Transport {
    fn drop(&mut self) {
        let _ = self.flush(LAST_CHANCE);
        self.shared.is_closing.store(true, Ordering::Release);
        self.shared.wake();
        self.lane.end();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
    }
}

impl std::fmt::Debug for Ros1Transport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Ros1Transport").field("master", &self.client.uri()).finish_non_exhaustive()
    }
}
