//! A subscribed topic: a connection and a thread for each of its publishers.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::io::{self, Write as _};
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use periplus_transport::lock;

use super::{Header, MAX_MESSAGE_BYTES, keep_alive, read_frame_after, read_header};
use crate::names::Ros1Type;
use crate::rpc::{self, RpcError};
use crate::xmlrpc::XmlRpcValue;

/// Timeout of a call to a publisher, and of the headers.
const PATIENCE: Duration = Duration::from_secs(5);

/// Longest pause before a publisher that cannot be reached is tried again.
const LONGEST_PAUSE: Duration = Duration::from_secs(4);

/// Takes the messages of one publisher.
pub(crate) type Receive = Box<dyn FnMut(&[u8]) + Send>;

/// Takes the messages of a topic.
pub(crate) trait Receiver: Send + Sync + 'static {
    /// Begins with a publisher, after its header; an error refuses it.
    fn begin(&self, publisher: &str, header: &Header) -> Result<Receive, String>;

    /// Reports that messages of a publisher cannot be received.
    fn complain(&self, publisher: &str, why: &str);
}

/// A subscribed topic, until this is dropped.
pub(crate) struct Subscription {
    shared: Arc<Shared>,
}

struct Shared {
    /// Name of the node.
    caller: String,
    topic: String,
    of: Ros1Type,
    receiver: Arc<dyn Receiver>,
    /// By the address of the publisher's node.
    sources: Mutex<BTreeMap<String, Arc<Source>>>,
}

/// Connection to a publisher.
#[derive(Default)]
struct Source {
    state: Mutex<SourceState>,
    closing: Condvar,
    received: AtomicU64,
    received_bytes: AtomicU64,
}

#[derive(Default)]
struct SourceState {
    is_closed: bool,
    stream: Option<TcpStream>,
}

/// Counts of a connection, for `getBusInfo` and `getBusStats`.
pub(crate) struct SourceReport {
    pub(crate) publisher: String,
    pub(crate) received: u64,
    pub(crate) received_bytes: u64,
}

/// Reason for which a connection ended.
enum End {
    /// Lost: a new connection may work.
    Lost,
    /// Refused: a new connection fails as well.
    Refused(String),
}

impl From<io::Error> for End {
    fn from(_: io::Error) -> Self {
        Self::Lost
    }
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lost => f.write_str("the connection was lost"),
            Self::Refused(why) => f.write_str(why),
        }
    }
}

impl Subscription {
    pub(crate) fn new(
        caller: &str,
        topic: &str,
        of: Ros1Type,
        receiver: Arc<dyn Receiver>,
    ) -> Self {
        let (caller, topic) = (caller.to_owned(), topic.to_owned());
        let sources = Mutex::default();
        Self { shared: Arc::new(Shared { caller, topic, of, receiver, sources }) }
    }

    /// Connects to these publishers, and leaves all others.
    pub(crate) fn update(&self, publishers: &BTreeSet<String>) {
        let mut sources = lock(&self.shared.sources);
        sources.retain(|publisher, source| {
            let stays = publishers.contains(publisher);
            if !stays {
                source.close();
            }
            stays
        });
        for publisher in publishers {
            if sources.contains_key(publisher) {
                continue;
            }
            let source = Arc::new(Source::default());
            let (shared, running, uri) = (self.shared.clone(), source.clone(), publisher.clone());
            let thread = std::thread::Builder::new().name("ros1-receive".to_owned());
            if thread.spawn(move || shared.run(&uri, &running)).is_ok() {
                sources.insert(publisher.clone(), source);
            }
        }
    }

    pub(crate) fn report(&self) -> Vec<SourceReport> {
        let sources = lock(&self.shared.sources);
        let reports = sources.iter().map(|(publisher, source)| SourceReport {
            publisher: publisher.clone(),
            received: source.received.load(Ordering::Relaxed),
            received_bytes: source.received_bytes.load(Ordering::Relaxed),
        });
        reports.collect()
    }
}

impl Drop for Subscription {
    fn drop(&mut self) {
        self.update(&BTreeSet::new());
    }
}

impl Shared {
    /// Receives from a publisher until it is left; a lost connection is tried again.
    fn run(&self, publisher: &str, source: &Source) {
        let mut pause = Duration::from_millis(100);
        loop {
            let before = source.received.load(Ordering::Relaxed);
            match self.receive(publisher, source) {
                Ok(()) | Err(End::Lost) => {}
                Err(End::Refused(why)) => {
                    if !lock(&source.state).is_closed {
                        self.receiver.complain(publisher, &why);
                    }
                    pause = LONGEST_PAUSE;
                }
            }
            if source.received.load(Ordering::Relaxed) > before {
                pause = Duration::from_millis(100);
            }
            if source.wait(pause) {
                return;
            }
            pause = (pause * 2).min(LONGEST_PAUSE);
        }
    }

    fn receive(&self, publisher: &str, source: &Source) -> Result<(), End> {
        let (host, port) = self.agree(publisher)?;
        let stream = rpc::connect(&host, port, PATIENCE)?;
        {
            let mut state = lock(&source.state);
            if state.is_closed {
                return Ok(());
            }
            state.stream = Some(stream.try_clone()?);
        }
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        let request = Header::new(&[
            ("callerid", &self.caller),
            ("md5sum", &self.of.md5),
            ("message_definition", &self.of.definition),
            ("tcp_nodelay", "1"),
            ("topic", &self.topic),
            ("type", &self.of.name),
        ]);
        (&stream).write_all(&request.write())?;
        let mut reader = io::BufReader::with_capacity(64 << 10, &stream);
        let header = read_header(&mut reader)?;
        if header.has("error") {
            return Err(End::Refused(header.get("error").to_owned()));
        }
        let mut receive = self.receiver.begin(publisher, &header).map_err(End::Refused)?;
        stream.set_read_timeout(None)?;
        keep_alive(&stream)?;
        let mut message = Vec::new();
        loop {
            read_frame_after(&mut reader, MAX_MESSAGE_BYTES, &mut message).map_err(|error| {
                match error.kind() {
                    io::ErrorKind::InvalidData => End::Refused(error.to_string()),
                    _ => End::Lost,
                }
            })?;
            source.received.fetch_add(1, Ordering::Relaxed);
            source.received_bytes.fetch_add(message.len() as u64, Ordering::Relaxed);
            receive(&message);
        }
    }

    /// Asks a publisher for the address of its TCPROS connections.
    fn agree(&self, publisher: &str) -> Result<(String, u16), End> {
        let protocols = XmlRpcValue::List(vec![XmlRpcValue::List(vec!["TCPROS".into()])]);
        let params = vec![self.caller.as_str().into(), self.topic.as_str().into(), protocols];
        let agreed = rpc::ask(publisher, "requestTopic", params, PATIENCE).map_err(|error| {
            match error {
                // A publisher that has ended, or does not have the topic yet.
                RpcError::Unreachable(_) | RpcError::Refused(_) => End::Lost,
                RpcError::Malformed(why) => End::Refused(why),
            }
        })?;
        match agreed.list() {
            Some(
                [XmlRpcValue::Text(protocol), XmlRpcValue::Text(host), XmlRpcValue::Int(port)],
            ) if protocol == "TCPROS" => {
                let port = u16::try_from(*port).map_err(|_| End::Lost)?;
                Ok((host.clone(), port))
            }
            Some([]) => Err(End::Refused("the publisher does not offer TCPROS".into())),
            _ => Err(End::Refused("requestTopic returned no host and port".into())),
        }
    }
}

impl Source {
    fn close(&self) {
        let mut state = lock(&self.state);
        state.is_closed = true;
        if let Some(stream) = state.stream.take() {
            let _ = stream.shutdown(Shutdown::Both);
        }
        self.closing.notify_all();
    }

    /// Waits; true if the connection is to end.
    fn wait(&self, pause: Duration) -> bool {
        let state = lock(&self.state);
        let waited = self.closing.wait_timeout_while(state, pause, |state| !state.is_closed);
        waited.unwrap_or_else(PoisonError::into_inner).0.is_closed
    }
}
