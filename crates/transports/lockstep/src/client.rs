//! The side of a process.

use std::collections::HashMap;
use std::io::{self, Write as _};
use std::sync::atomic::{AtomicI64, AtomicU32, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_graph::{History, KEEP_ALL_MAX_MESSAGES, Qos};

use crate::frame::{Body, Kind, Reader, append, is_pause};
use crate::inbox::{Inbox, Received};
use crate::lock;
use crate::query::{EndpointWords, NewEndpoint, NodeWords, Query, Reply};
use crate::socket::{Stream, connect};

/// A process that runs in step with a graph.
///
/// Only one thread may talk to the graph at a time; others wait for it.
pub struct LockstepClient {
    line: Mutex<Line>,
    inboxes: Mutex<HashMap<u32, Arc<Inbox>>>,
    last_id: AtomicU32,
    last_call: AtomicU64,
    now_ns: AtomicI64,
    /// Number of things that have arrived.
    arrivals: AtomicU64,
    pause: Pause,
}

/// Called while a call waits for the graph; an error ends the call.
type Pause = Box<dyn Fn() -> io::Result<()> + Send + Sync>;

/// Period at which it is called.
const PAUSE_PERIOD: Duration = Duration::from_millis(100);

struct Line {
    stream: Stream,
    reader: Reader,
    /// Frames that are sent with the next question or wait.
    out: Vec<u8>,
    /// True from a wait to the turn that ends it. A wait that `pause` has ended leaves it true.
    is_idle: bool,
    /// True once the graph has gone.
    has_ended: bool,
}

/// Size above which frames are sent at once [bytes].
const SEND_ABOVE_BYTES: usize = 256 << 10;

impl LockstepClient {
    /// Connects to a graph, and waits until it is this process' turn.
    ///
    /// # Errors
    /// When the graph is not there or refuses the process.
    pub fn connect(link: &str) -> io::Result<Self> {
        Self::connect_with(link, || Ok(()))
    }

    /// Same as [`LockstepClient::connect`], for a process that has signals to look at: `pause` is called
    /// repeatedly while a call waits for the graph, and its error ends the call.
    ///
    /// # Errors
    /// As [`LockstepClient::connect`].
    pub fn connect_with(
        link: &str,
        pause: impl Fn() -> io::Result<()> + Send + Sync + 'static,
    ) -> io::Result<Self> {
        let (address, token) = link.rsplit_once('#').ok_or(io::ErrorKind::InvalidInput)?;
        let stream = connect(address)?;
        stream.set_read_timeout(Some(PAUSE_PERIOD))?;
        let client = Self {
            pause: Box::new(pause),
            line: Mutex::new(Line {
                stream,
                reader: Reader::default(),
                out: Vec::new(),
                is_idle: false,
                has_ended: false,
            }),
            inboxes: Mutex::default(),
            last_id: 0.into(),
            last_call: 0.into(),
            now_ns: 0.into(),
            arrivals: 0.into(),
        };
        client.ask(&Query::Hello { token: token.to_owned(), pid: std::process::id() })?;
        let mut line = lock(&client.line);
        line.is_idle = true;
        client.wait_go(&mut line)?;
        drop(line);
        Ok(client)
    }

    /// The time of the graph \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.now_ns.load(Ordering::Acquire)
    }

    /// Number of messages, requests and responses that have arrived.
    #[must_use]
    pub fn arrivals(&self) -> u64 {
        self.arrivals.load(Ordering::Acquire)
    }

    /// Waits until the graph has come to `wake_ns`, or, if `wants_messages`, until something has arrived. After an
    /// error of `pause` the process may go on, and a later wait continues this one.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn wait(&self, wake_ns: Option<i64>, wants_messages: bool) -> io::Result<()> {
        let mut line = lock(&self.line);
        // A wait that was ended early is still registered at the graph.
        if !line.is_idle {
            let wake = wake_ns.unwrap_or(i64::MAX).to_le_bytes();
            append(&mut line.out, Kind::Idle, &[&wake, &[u8::from(wants_messages)]]);
            line.send()?;
            line.is_idle = true;
        }
        self.wait_go(&mut line)
    }

    /// Creates a node; returns its number. This and all that follows does nothing once a wait has found that the graph
    /// has gone: a program then ends as if it were alone.
    ///
    /// # Errors
    /// When the name is not valid, or the graph goes meanwhile.
    pub fn node(&self, words: &NodeWords) -> io::Result<u32> {
        let id = self.next_id();
        self.ask(&Query::Node { id, words: words.clone() })?;
        Ok(id)
    }

    /// Creates a publisher; returns its number.
    ///
    /// # Errors
    /// When the topic has another type, or the graph has gone.
    pub fn publisher(
        &self,
        node: u32,
        topic: &str,
        type_name: &str,
        type_hash: Option<&str>,
        qos: Qos,
    ) -> io::Result<u32> {
        let new = self.new_endpoint(node, topic, type_name, type_hash);
        let id = new.id;
        self.ask(&Query::Publisher(new, qos))?;
        Ok(id)
    }

    /// Creates a subscription; returns its number and its inbox.
    ///
    /// # Errors
    /// As [`LockstepClient::publisher`].
    pub fn subscription(
        &self,
        node: u32,
        topic: &str,
        type_name: &str,
        type_hash: Option<&str>,
        qos: Qos,
    ) -> io::Result<(u32, Arc<Inbox>)> {
        let new = self.new_endpoint(node, topic, type_name, type_hash);
        let capacity = match qos.history {
            History::KeepLast => qos.depth,
            History::KeepAll => KEEP_ALL_MAX_MESSAGES,
        };
        let (id, inbox) = self.inbox(new.id, capacity);
        self.ask(&Query::Subscription(new, qos))?;
        Ok((id, inbox))
    }

    /// Creates a service client; returns its number and the inbox of its responses.
    ///
    /// # Errors
    /// As [`LockstepClient::publisher`].
    pub fn client(
        &self,
        node: u32,
        service: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> io::Result<(u32, Arc<Inbox>)> {
        let new = self.new_endpoint(node, service, type_name, type_hash);
        let (id, inbox) = self.inbox(new.id, usize::MAX);
        self.ask(&Query::Client(new))?;
        Ok((id, inbox))
    }

    /// Creates a server; returns its number and the inbox of its requests.
    ///
    /// # Errors
    /// As [`LockstepClient::publisher`], and when the service has a server.
    pub fn server(
        &self,
        node: u32,
        service: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> io::Result<(u32, Arc<Inbox>)> {
        let new = self.new_endpoint(node, service, type_name, type_hash);
        let (id, inbox) = self.inbox(new.id, usize::MAX);
        self.ask(&Query::Server(new))?;
        Ok((id, inbox))
    }

    /// Publishes a message as CDR.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn publish(&self, publisher: u32, cdr: &[u8]) -> io::Result<()> {
        self.post(Kind::Publish, &[&publisher.to_le_bytes(), cdr])
    }

    /// Sends a request; returns the number that its response will have.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn call(&self, client: u32, cdr: &[u8]) -> io::Result<u64> {
        let number = self.last_call.fetch_add(1, Ordering::Relaxed) + 1;
        self.post(Kind::Call, &[&client.to_le_bytes(), &number.to_le_bytes(), cdr])?;
        Ok(number)
    }

    /// Answers a call by its number; `None` refuses it.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn answer(&self, call: u64, cdr: Option<&[u8]>) -> io::Result<()> {
        match cdr {
            Some(cdr) => self.post(Kind::Answer, &[&call.to_le_bytes(), cdr]),
            None => self.post(Kind::Refuse, &[&call.to_le_bytes()]),
        }
    }

    /// Removes a node or an endpoint.
    pub fn remove(&self, id: u32) {
        lock(&self.inboxes).remove(&id);
        // A graph that has gone has nothing to remove.
        let _ = self.post(Kind::Drop, &[&id.to_le_bytes()]);
    }

    /// Number of subscriptions of a publisher, publishers of a subscription, or servers of a client.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn matched(&self, id: u32) -> io::Result<usize> {
        match self.ask(&Query::Matched { id })? {
            Reply::Count(count) => Ok(count),
            _ => Ok(0),
        }
    }

    /// Topics with their types.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn topics(&self) -> io::Result<Vec<(String, String)>> {
        self.names(&Query::Topics)
    }

    /// Services with their types.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn services(&self) -> io::Result<Vec<(String, String)>> {
        self.names(&Query::Services)
    }

    /// The nodes.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn nodes(&self) -> io::Result<Vec<NodeWords>> {
        match self.ask(&Query::Nodes)? {
            Reply::Nodes(nodes) => Ok(nodes),
            _ => Ok(Vec::new()),
        }
    }

    /// Publishers or subscriptions of a topic.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn endpoints(&self, topic: &str, publishers: bool) -> io::Result<Vec<EndpointWords>> {
        match self.ask(&Query::Endpoints { topic: topic.to_owned(), publishers })? {
            Reply::Endpoints(endpoints) => Ok(endpoints),
            _ => Ok(Vec::new()),
        }
    }

    /// Policies by which the other side of an endpoint is incompatible, as ROS names them, since the last call.
    ///
    /// # Errors
    /// When the graph has gone.
    pub fn events(&self, id: u32) -> io::Result<Vec<String>> {
        match self.ask(&Query::Events { id })? {
            Reply::Words(words) => Ok(words),
            _ => Ok(Vec::new()),
        }
    }

    fn names(&self, query: &Query) -> io::Result<Vec<(String, String)>> {
        match self.ask(query)? {
            Reply::Names(names) => Ok(names),
            _ => Ok(Vec::new()),
        }
    }

    fn next_id(&self) -> u32 {
        self.last_id.fetch_add(1, Ordering::Relaxed) + 1
    }

    fn new_endpoint(
        &self,
        node: u32,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> NewEndpoint {
        NewEndpoint {
            id: self.next_id(),
            node,
            name: name.to_owned(),
            type_name: type_name.to_owned(),
            type_hash: type_hash.map(str::to_owned),
        }
    }

    fn inbox(&self, id: u32, capacity: usize) -> (u32, Arc<Inbox>) {
        let inbox = Arc::new(Inbox::new(capacity));
        lock(&self.inboxes).insert(id, inbox.clone());
        (id, inbox)
    }

    fn post(&self, kind: Kind, parts: &[&[u8]]) -> io::Result<()> {
        let mut line = lock(&self.line);
        if line.has_ended {
            return Ok(());
        }
        append(&mut line.out, kind, parts);
        if line.out.len() > SEND_ABOVE_BYTES { line.send() } else { Ok(()) }
    }

    fn ask(&self, query: &Query) -> io::Result<Reply> {
        let mut line = lock(&self.line);
        if line.has_ended {
            return Ok(query.reply_of_nobody());
        }
        if line.is_idle {
            return Err(io::Error::other("the simulation answers only in the turn of the process"));
        }
        let json = serde_json::to_vec(query)?;
        append(&mut line.out, Kind::Query, &[&json]);
        line.send()?;
        loop {
            let Line { stream, reader, .. } = &mut *line;
            let (kind, body) = match reader.next(stream) {
                Ok(frame) => frame,
                // The graph answers at once, or is gone.
                Err(error) if is_pause(&error) => continue,
                Err(error) => return Err(error),
            };
            if kind == Kind::Reply {
                return match serde_json::from_slice(body)? {
                    Reply::Failed(reason) => Err(io::Error::other(reason)),
                    reply => Ok(reply),
                };
            }
            self.receive(kind, body)?;
        }
    }

    fn wait_go(&self, line: &mut Line) -> io::Result<()> {
        let Line { stream, reader, is_idle, has_ended, .. } = line;
        loop {
            let (kind, body) = match reader.next(stream) {
                Ok(frame) => frame,
                Err(error) if is_pause(&error) => {
                    (self.pause)()?;
                    continue;
                }
                Err(error) => {
                    *has_ended = true;
                    return Err(error);
                }
            };
            if kind == Kind::Go {
                self.now_ns.store(Body(body).i64()?, Ordering::Release);
                *is_idle = false;
                return Ok(());
            }
            self.receive(kind, body)?;
        }
    }

    fn receive(&self, kind: Kind, body: &[u8]) -> io::Result<()> {
        let mut body = Body(body);
        let id = body.u32()?;
        let time_ns = if kind == Kind::Message { body.i64()? } else { 0 };
        let number = body.u64()?;
        let received = Received { time_ns, number, cdr: body.rest().to_vec() };
        self.arrivals.fetch_add(1, Ordering::AcqRel);
        let inbox = lock(&self.inboxes).get(&id).cloned();
        if let Some(inbox) = inbox {
            inbox.push(received);
        }
        Ok(())
    }
}

impl Line {
    fn send(&mut self) -> io::Result<()> {
        let sent = self.stream.write_all(&self.out);
        self.has_ended |= sent.is_err();
        self.out.clear();
        sent
    }
}
