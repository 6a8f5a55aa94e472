//! State shared by the threads of a transport.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::net::{Shutdown, TcpListener, TcpStream, UdpSocket};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread::JoinHandle;

use periplus_gz_msgs::{Discovery, DiscoveryKind, DiscoveryPublisher};
use periplus_transport::lock;

use super::calls::Calling;
use super::publish::Hearers;
use super::remote::Remote;
use super::replies::{self, Reply};
use super::sockets::Ways;
use super::subscribe::Ears;
use super::{calls, discovery, listener, packet, publish, uuid, zmtp};
use crate::{GzTransportError, Settings};

/// Maximum number of open connections.
const MOST_CONNECTIONS: usize = 1_000;

/// Maximum number of connections without a finished handshake; one more closes the oldest. Each has
/// a thread, and silent connections cost no more than these.
const MAX_GREETINGS: usize = 32;

/// Topics or services; each has its own discovery port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Topics,
    Services,
}

pub(super) struct Shared {
    pub(super) settings: Settings,
    pub(super) ways: Ways,
    /// Id of this process and of its only node.
    pub(super) process: String,
    pub(super) node: String,
    /// Addresses of the sockets for publishing, serving, and receiving responses.
    pub(super) publishing: String,
    pub(super) replying: String,
    pub(super) receiving: String,
    /// Socket identities of the last two for routers.
    pub(super) replier: String,
    pub(super) receiver: String,
    senders: Vec<UdpSocket>,
    remote: [Mutex<Remote>; 2],
    /// Notified when new advertisements arrive.
    pub(super) news: Condvar,
    /// Advertisements of this program by id.
    offers: [Mutex<BTreeMap<u64, DiscoveryPublisher>>; 2],
    pub(super) hearers: Hearers,
    pub(super) ears: Ears,
    pub(super) calling: Calling,
    pub(super) replies: Sender<Reply>,
    /// Counter of changes of the subscribers.
    pub(super) hearings: AtomicU64,
    pub(super) is_closing: AtomicBool,
    connections: Mutex<BTreeMap<u64, TcpStream>>,
    /// Ids of the connections without a finished handshake, in ascending order of age.
    greetings: Mutex<BTreeSet<u64>>,
    next_id: AtomicU64,
}

/// Joins the network.
pub(super) fn open(
    settings: &Settings,
) -> Result<(Arc<Shared>, Vec<JoinHandle<()>>), GzTransportError> {
    let ways = Ways::of(settings);
    let address = ways.told;
    let network = |error: io::Error| GzTransportError::Network { address, why: error.to_string() };
    let bound = || TcpListener::bind((address, 0)).and_then(|it| Ok((it.local_addr()?, it)));
    let (publishing, publisher) = bound().map_err(network)?;
    let (replying, replier) = bound().map_err(network)?;
    let (receiving, receiver) = bound().map_err(network)?;
    let group = settings.group;
    let topics = ways.receiver(group, settings.topic_port).map_err(network)?;
    let services = ways.receiver(group, settings.service_port).map_err(network)?;
    let senders = ways.senders().map_err(network)?;
    let (replies, waiting) = replies::channel();
    let shared = Arc::new(Shared {
        settings: settings.clone(),
        ways,
        process: uuid::new(),
        node: uuid::new(),
        publishing: format!("tcp://{publishing}"),
        replying: format!("tcp://{replying}"),
        receiving: format!("tcp://{receiving}"),
        replier: uuid::new(),
        receiver: uuid::new(),
        senders,
        remote: Default::default(),
        news: Condvar::new(),
        offers: Default::default(),
        hearers: Hearers::default(),
        ears: Ears::default(),
        calling: Calling::default(),
        replies,
        hearings: AtomicU64::new(0),
        is_closing: AtomicBool::new(false),
        connections: Mutex::default(),
        greetings: Mutex::default(),
        next_id: AtomicU64::new(0),
    });
    let as_publisher = (zmtp::Kind::Pub, String::new());
    let as_replier = (zmtp::Kind::Router, shared.replier.clone());
    let as_receiver = (zmtp::Kind::Router, shared.receiver.clone());
    let threads = vec![
        discovery::start(&shared, Kind::Topics, topics),
        discovery::start(&shared, Kind::Services, services),
        listener::start(&shared, "gz-publish", publisher, as_publisher, publish::meet),
        listener::start(&shared, "gz-reply", replier, as_replier, calls::take_requests),
        listener::start(&shared, "gz-receive", receiver, as_receiver, calls::take_answers),
        replies::start(&shared, waiting),
    ];
    Ok((shared, threads))
}

/// Starts a named thread.
pub(super) fn thread(name: &str, run: impl FnOnce() + Send + 'static) -> JoinHandle<()> {
    let thread = std::thread::Builder::new().name(name.to_owned());
    thread.spawn(run).expect("the system starts a thread")
}

impl Shared {
    pub(super) fn is_closing(&self) -> bool {
        self.is_closing.load(Ordering::Acquire)
    }

    pub(super) fn next_id(&self) -> u64 {
        self.next_id.fetch_add(1, Ordering::Relaxed)
    }

    pub(super) fn remote(&self, kind: Kind) -> MutexGuard<'_, Remote> {
        lock(&self.remote[kind as usize])
    }

    /// Sends a discovery message to all programs.
    pub(super) fn tell(&self, kind: Kind, what: DiscoveryKind, fill: impl FnOnce(&mut Discovery)) {
        let packet = packet::write(&self.process, what, fill);
        let port = match kind {
            Kind::Topics => self.settings.topic_port,
            Kind::Services => self.settings.service_port,
        };
        for sender in &self.senders {
            // The network may be back at the next heartbeat.
            let _ = sender.send_to(&packet, (self.settings.group, port));
        }
    }

    /// Advertisements of this program.
    pub(super) fn offers(&self, kind: Kind) -> Vec<DiscoveryPublisher> {
        lock(&self.offers[kind as usize]).values().cloned().collect()
    }

    /// Advertises something until it is [withdrawn](Self::withdraw) by its id.
    pub(super) fn offer(&self, kind: Kind, offer: DiscoveryPublisher) -> u64 {
        let id = self.next_id();
        lock(&self.offers[kind as usize]).insert(id, offer.clone());
        self.tell(kind, DiscoveryKind::ADVERTISE, |told| told.r#pub = Some(offer));
        id
    }

    pub(super) fn withdraw(&self, kind: Kind, id: u64) {
        let offer = lock(&self.offers[kind as usize]).remove(&id);
        if let Some(offer) = offer {
            self.tell(kind, DiscoveryKind::UNADVERTISE, |told| told.r#pub = Some(offer));
        }
    }

    /// Registers a connection, so that it is closed with the transport; none if there are too many.
    pub(super) fn admit(self: &Arc<Self>, stream: &TcpStream) -> Option<Admitted> {
        let id = self.next_id();
        let mut connections = lock(&self.connections);
        if connections.len() == MOST_CONNECTIONS || self.is_closing() {
            return None;
        }
        connections.insert(id, stream.try_clone().ok()?);
        Some(Admitted { shared: self.clone(), id })
    }

    /// Counts a connection as in handshake until the returned value is dropped. If there are too
    /// many, the oldest is closed.
    pub(super) fn begin_greeting(self: &Arc<Self>, admitted: &Admitted) -> Greeting {
        let oldest = {
            let mut greetings = lock(&self.greetings);
            greetings.insert(admitted.id);
            if greetings.len() > MAX_GREETINGS { greetings.pop_first() } else { None }
        };
        if let Some(oldest) = oldest
            && let Some(stream) = lock(&self.connections).get(&oldest)
        {
            let _ = stream.shutdown(Shutdown::Both);
        }
        Greeting { shared: self.clone(), id: admitted.id }
    }

    /// Ends all threads.
    pub(super) fn close(&self) {
        self.is_closing.store(true, Ordering::Release);
        for kind in [Kind::Topics, Kind::Services] {
            self.tell(kind, DiscoveryKind::BYE, |_| {});
        }
        for stream in lock(&self.connections).values() {
            let _ = stream.shutdown(Shutdown::Both);
        }
        let _ = self.replies.send(Reply::End);
        self.news.notify_all();
        self.calling.answered.notify_all();
        // Connects to each listener to wake its thread.
        for address in [&self.publishing, &self.replying, &self.receiving] {
            if let Some(address) = super::sockets::address(address) {
                let _ = TcpStream::connect(address);
            }
        }
    }
}

/// A registered connection.
pub(super) struct Admitted {
    shared: Arc<Shared>,
    id: u64,
}

impl Drop for Admitted {
    fn drop(&mut self) {
        lock(&self.shared.connections).remove(&self.id);
    }
}

/// A connection in handshake.
pub(super) struct Greeting {
    shared: Arc<Shared>,
    id: u64,
}

impl Drop for Greeting {
    fn drop(&mut self) {
        lock(&self.shared.greetings).remove(&self.id);
    }
}
