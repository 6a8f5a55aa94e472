//! Subscriptions.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_gz_msgs::{DiscoveryKind, DiscoveryPublisher, DiscoverySubscriber};
use periplus_transport::lock;

use super::discovery::subscriber;
use super::shared::{Kind, Shared, thread};
use super::{listener, sockets, zmtp};
use crate::Name;

/// Maximum size of a message \[bytes\]: a point cloud of 8 million points.
const LARGEST: usize = 256 << 20;

/// Timeout of a connection attempt, and pause after a lost connection.
const CONNECT: Duration = Duration::from_secs(2);
const PAUSE: Duration = Duration::from_millis(200);

/// Delay before a subscription is announced to the publisher, so that the filter is active: a program
/// that publishes one message and exits does so as soon as it has a subscriber.
const GRACE: Duration = Duration::from_millis(10);

/// A received message.
#[derive(Clone, Copy, Debug)]
pub struct ReceivedMessage<'a> {
    /// Full type name, as declared by the publisher.
    pub type_name: &'a str,
    /// The message.
    pub bytes: &'a [u8],
}

/// Callback for messages.
pub(super) type Take = Box<dyn Fn(ReceivedMessage<'_>) + Send + Sync>;

/// A subscription that exists until this is dropped.
pub struct GzSubscription {
    shared: Arc<Shared>,
    ear: Arc<Ear>,
}

pub(super) struct Ear {
    id: u64,
    name: Name,
    type_name: String,
    take: Take,
}

#[derive(Default)]
pub(super) struct Ears {
    all: Mutex<BTreeMap<u64, Arc<Ear>>>,
    /// Connections to publishers by address.
    lines: Mutex<BTreeMap<String, Arc<Line>>>,
}

impl Ears {
    /// Subscribed topics with their types.
    pub(super) fn all(&self) -> Vec<(Name, String)> {
        lock(&self.all).values().map(|ear| (ear.name.clone(), ear.type_name.clone())).collect()
    }

    fn of(&self, name: &[u8]) -> Vec<Arc<Ear>> {
        let all = lock(&self.all);
        all.values().filter(|ear| ear.name.full().as_bytes() == name).cloned().collect()
    }
}

pub(super) fn subscribe(
    shared: &Arc<Shared>,
    name: Name,
    type_name: &str,
    take: Take,
) -> GzSubscription {
    let id = shared.next_id();
    let topic = name.full().to_owned();
    let ear = Arc::new(Ear { id, name, type_name: type_name.to_owned(), take });
    lock(&shared.ears.all).insert(id, ear.clone());
    shared.tell(Kind::Topics, DiscoveryKind::SUBSCRIBE, |told| {
        told.sub = Some(DiscoverySubscriber { topic });
    });
    follow(shared);
    GzSubscription { shared: shared.clone(), ear }
}

impl GzSubscription {
    /// Number of publishers of the topic.
    #[must_use]
    pub fn publishers(&self) -> usize {
        self.shared.remote(Kind::Topics).of(&self.ear.name).len()
    }

    /// Name of the topic.
    #[must_use]
    pub fn topic(&self) -> &str {
        self.ear.name.topic()
    }
}

impl Drop for GzSubscription {
    fn drop(&mut self) {
        lock(&self.shared.ears.all).remove(&self.ear.id);
        follow(&self.shared);
    }
}

impl std::fmt::Debug for GzSubscription {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Subscription").field(&self.ear.name.topic()).finish()
    }
}

/// A connection to a publisher.
#[derive(Default)]
struct Line(Mutex<Wish>);

#[derive(Default)]
struct Wish {
    /// Subscribed topics, with the advertisements that they match.
    topics: BTreeMap<Name, DiscoveryPublisher>,
    stream: Option<TcpStream>,
    is_closed: bool,
}

impl Line {
    /// Sets the subscribed topics of this connection.
    fn want(&self, shared: &Shared, topics: BTreeMap<Name, DiscoveryPublisher>) {
        let mut wish = lock(&self.0);
        let before = std::mem::replace(&mut wish.topics, topics);
        let gone = before.iter().filter(|(name, _)| !wish.topics.contains_key(name));
        let gone: Vec<_> = gone.collect();
        let come = wish.topics.iter().filter(|(name, _)| !before.contains_key(name));
        if let Some(mut stream) = wish.stream.as_ref() {
            // The reading thread notices a lost connection.
            for (name, _) in &gone {
                let _ = stream.write_all(&zmtp::subscription(false, name.full()));
            }
            for (name, offer) in come {
                let _ = stream.write_all(&zmtp::subscription(true, name.full()));
                tell(shared, DiscoveryKind::NEW_CONNECTION, name, offer);
            }
        }
        for (name, offer) in gone {
            tell(shared, DiscoveryKind::END_CONNECTION, name, offer);
        }
        wish.is_closed = wish.topics.is_empty();
        if wish.is_closed
            && let Some(stream) = &wish.stream
        {
            let _ = stream.shutdown(Shutdown::Both);
        }
    }

    fn is_closed(&self) -> bool {
        lock(&self.0).is_closed
    }

    /// Sends all filters on a new connection.
    fn connected(&self, shared: &Shared, stream: &TcpStream) -> std::io::Result<()> {
        let mut writing = stream.try_clone()?;
        let mut wish = lock(&self.0);
        for name in wish.topics.keys() {
            writing.write_all(&zmtp::subscription(true, name.full()))?;
        }
        std::thread::sleep(GRACE);
        for (name, offer) in &wish.topics {
            tell(shared, DiscoveryKind::NEW_CONNECTION, name, offer);
        }
        wish.stream = Some(writing);
        Ok(())
    }
}

/// Announces or ends a subscription to the publisher: Gazebo's programs send nothing without it.
fn tell(shared: &Shared, what: DiscoveryKind, name: &Name, offer: &DiscoveryPublisher) {
    let type_name = offer.msg_pub.as_ref().map(|it| it.msg_type.clone()).unwrap_or_default();
    let ear = subscriber(shared, name, type_name, offer.process_uuid.clone());
    shared.tell(Kind::Topics, what, |told| told.r#pub = Some(ear));
}

/// Updates the connections to match subscriptions and advertisements.
pub(super) fn follow(shared: &Arc<Shared>) {
    let mut lines = lock(&shared.ears.lines);
    let mut wanted: BTreeMap<String, BTreeMap<Name, DiscoveryPublisher>> = BTreeMap::new();
    let heard = shared.ears.all();
    let remote = shared.remote(Kind::Topics);
    for (name, _) in heard {
        for offer in remote.of(&name) {
            let topics = wanted.entry(offer.address.clone()).or_default();
            topics.insert(name.clone(), offer.clone());
        }
    }
    drop(remote);
    lines.retain(|address, line| {
        let stays = wanted.contains_key(address);
        if !stays {
            line.want(shared, BTreeMap::new());
        }
        stays
    });
    for (address, topics) in wanted {
        let line = lines.entry(address.clone()).or_insert_with(|| {
            let line = Arc::new(Line::default());
            start(shared, &address, line.clone());
            line
        });
        line.want(shared, topics);
    }
}

fn start(shared: &Arc<Shared>, address: &str, line: Arc<Line>) {
    let Some(to) = sockets::address(address).filter(|to| shared.ways.is_for(*to)) else { return };
    let shared = shared.clone();
    thread("gz-subscribe", move || {
        while !shared.is_closing() && !line.is_closed() {
            if let Ok(stream) = TcpStream::connect_timeout(&to, CONNECT)
                && let Some(admitted) = shared.admit(&stream)
            {
                // A lost connection is retried while there are subscriptions.
                let _ = listen(&shared, &line, stream);
                lock(&line.0).stream = None;
                drop(admitted);
            }
            if !line.is_closed() {
                std::thread::sleep(PAUSE);
            }
        }
    });
}

fn listen(shared: &Shared, line: &Line, mut stream: TcpStream) -> std::io::Result<()> {
    listener::greet(&mut stream, zmtp::Kind::Sub, "")?;
    line.connected(shared, &stream)?;
    loop {
        match zmtp::read(&mut stream, LARGEST)? {
            zmtp::Event::Message(parts) => {
                // Topic, address, message, type; programs that count messages append one part.
                let [topic, _, bytes, type_name, ..] = parts.as_slice() else { continue };
                let Ok(type_name) = std::str::from_utf8(type_name) else { continue };
                for ear in shared.ears.of(topic) {
                    (ear.take)(ReceivedMessage { type_name, bytes });
                }
            }
            zmtp::Event::Ping(context) => {
                if let Some(stream) = &mut lock(&line.0).stream {
                    stream.write_all(&zmtp::pong(&context))?;
                }
            }
            zmtp::Event::Subscribe(..) => {}
        }
    }
}
