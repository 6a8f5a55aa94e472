//! One process as the graph sees it.

use std::collections::HashMap;
use std::io::{self, Write as _};
use std::sync::{Arc, Mutex, Weak};
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{
    Alarm, EndpointInfo, Graph, GraphError, Node, NodeSettings, QosEvent, RawCall, RawCalls,
    RawClient, RawMailbox, RawPublisher,
};

use periplus_transport::Since;

use crate::frame::{Body, Kind, Reader, append, is_pause};
use crate::lock;
use crate::query::{EndpointWords, NewEndpoint, NodeWords, Query, Reply};
use crate::socket::Stream;

/// A process that runs in step with the graph.
pub(crate) struct Peer {
    pub(crate) label: String,
    graph: Graph,
    /// Hidden node for the alarms.
    alarms: Node,
    state: Mutex<State>,
    findings: Mutex<Diagnostics>,
}

struct State {
    stream: Option<Stream>,
    reader: Reader,
    /// Frames that are sent when it is the process' turn.
    out: Vec<u8>,
    entities: HashMap<u32, Entity>,
    calls: HashMap<u64, (u32, RawCall)>,
    last_call: u64,
    /// True if messages wake it.
    wants_messages: bool,
    alarm: Option<(i64, Alarm)>,
    pid: u32,
}

enum Entity {
    Node(Node),
    Publisher(RawPublisher, EndpointWords),
    Subscription(RawMailbox),
    Client(Arc<RawClient>),
    /// Kept so that the server stays in the graph.
    Server {
        _calls: RawCalls,
    },
}

/// Time after which a process that does not return is reported \[s\].
const PATIENCE: Duration = Duration::from_secs(10);

/// Time after which it is given up.
const LAST_PATIENCE: Duration = Duration::from_secs(120);

/// Period at which a read looks at the time.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

impl Peer {
    pub(crate) fn new(
        graph: &Graph,
        label: String,
        number: usize,
        stream: Stream,
        reader: Reader,
        pid: u32,
    ) -> io::Result<Arc<Self>> {
        stream.set_read_timeout(Some(LOOK_AGAIN))?;
        let name = format!("_process_{number}");
        let alarms = graph.node(NodeSettings::new(name).bare().keep_names());
        let alarms = alarms.map_err(io::Error::other)?;
        let state = State {
            stream: Some(stream),
            reader,
            out: Vec::new(),
            entities: HashMap::new(),
            calls: HashMap::new(),
            last_call: 0,
            wants_messages: false,
            alarm: None,
            pid,
        };
        let findings = Mutex::default();
        Ok(Arc::new(Self {
            label,
            graph: graph.clone(),
            alarms,
            state: Mutex::new(state),
            findings,
        }))
    }

    pub(crate) fn is_gone(&self) -> bool {
        lock(&self.state).stream.is_none()
    }

    pub(crate) fn take_findings(&self) -> Diagnostics {
        std::mem::take(&mut *lock(&self.findings))
    }

    /// Closes the connection and removes the endpoints.
    pub(crate) fn close(&self) {
        let mut state = lock(&self.state);
        let gone = state.part();
        drop(state);
        drop(gone);
    }

    /// Lets the process work until all of its threads wait.
    pub(crate) fn turn(self: &Arc<Self>) {
        let mut state = lock(&self.state);
        if state.stream.is_none() {
            return;
        }
        let ended = self.converse(&mut state);
        let gone = match ended {
            Ok(()) => None,
            Err(error) => {
                if error.kind() != io::ErrorKind::UnexpectedEof && !is_reset(&error) {
                    self.report(
                        Diagnostic::error(
                            "lockstep",
                            format!("`{}` no longer runs in step: {error}", self.label),
                        )
                        .help("its messages are no longer in the run; see its own messages above"),
                    );
                }
                Some(state.part())
            }
        };
        drop(state);
        drop(gone);
    }

    fn report(&self, finding: Diagnostic) {
        lock(&self.findings).push(finding);
    }

    /// Adds a frame for the process, which wakes it if it waits for messages.
    fn deliver(self: &Arc<Self>, kind: Kind, parts: &[&[u8]]) {
        let mut state = lock(&self.state);
        if state.stream.is_none() {
            return;
        }
        append(&mut state.out, kind, parts);
        let is_awake = state.wants_messages;
        drop(state);
        if is_awake {
            self.turn();
        }
    }

    fn converse(self: &Arc<Self>, state: &mut State) -> io::Result<()> {
        append(&mut state.out, Kind::Go, &[&self.graph.now_ns().to_le_bytes()]);
        state.send()?;
        loop {
            let (kind, body) = self.next_frame(state)?;
            let mut body = Body(&body);
            match kind {
                Kind::Idle => {
                    let wake_ns = body.i64()?;
                    state.wants_messages = body.u8()? == 1;
                    self.set_alarm(state, wake_ns);
                    return Ok(());
                }
                Kind::Publish => {
                    let id = body.u32()?;
                    if let Some(Entity::Publisher(publisher, _)) = state.entities.get(&id) {
                        publisher.publish(body.rest().to_vec());
                    }
                }
                Kind::Call => {
                    let (id, number) = (body.u32()?, body.u64()?);
                    if let Some(Entity::Client(client)) = state.entities.get(&id) {
                        let peer = Arc::downgrade(self);
                        client.clone().call_in_order(body.rest().to_vec(), move |answer| {
                            let Some(peer) = Weak::upgrade(&peer) else { return };
                            // As in ROS 2, a client gets no answer to a call that failed.
                            let Ok(answer) = answer else { return };
                            let Ok(cdr) = answer.cdr() else { return };
                            let (id, number) = (id.to_le_bytes(), number.to_le_bytes());
                            peer.deliver(Kind::Response, &[&id, &number, cdr]);
                        });
                    }
                }
                Kind::Answer => {
                    let call = state.calls.remove(&body.u64()?);
                    if let Some((_, call)) = call {
                        call.answer(body.rest().to_vec());
                    }
                }
                Kind::Refuse => drop(state.calls.remove(&body.u64()?)),
                Kind::Drop => {
                    let id = body.u32()?;
                    let gone = state.entities.remove(&id);
                    state.calls.retain(|_, (server, _)| *server != id);
                    drop(gone);
                }
                Kind::Query => {
                    let query = serde_json::from_slice(body.rest())?;
                    let reply = self.answer(state, query);
                    let reply = serde_json::to_vec(&reply)?;
                    let mut out = Vec::new();
                    append(&mut out, Kind::Reply, &[&reply]);
                    let Some(stream) = &mut state.stream else { return Ok(()) };
                    stream.write_all(&out)?;
                }
                _ => return Err(io::ErrorKind::InvalidData.into()),
            }
        }
    }

    /// Reads the next frame; a process that does not answer for long is reported, and then given up.
    fn next_frame(&self, state: &mut State) -> io::Result<(Kind, Vec<u8>)> {
        let mut since: Option<Since> = None;
        let mut is_reported = false;
        loop {
            let State { stream, reader, pid, .. } = state;
            let Some(stream) = stream else { return Err(io::ErrorKind::UnexpectedEof.into()) };
            match reader.next(stream) {
                Ok((kind, body)) => return Ok((kind, body.to_vec())),
                Err(error) if is_pause(&error) => {}
                Err(error) => return Err(error),
            }
            let waited = since.get_or_insert_with(Since::now).elapsed();
            if waited > PATIENCE && !is_reported {
                is_reported = true;
                let message = format!(
                    "`{}` has not come back for {} s: the run waits for it at {:.3} s of simulated time",
                    self.label,
                    PATIENCE.as_secs(),
                    self.graph.now_ns() as f64 * 1e-9
                );
                self.report(Diagnostic::warning("node-does-not-return", message).help(
                    "a callback computes for long, or waits for something that is not of ROS; \
                     its stack is printed by the process",
                ));
                dump_stack(*pid);
            }
            if waited > LAST_PATIENCE {
                let seconds = LAST_PATIENCE.as_secs();
                return Err(io::Error::other(format!("it did not come back for {seconds} s")));
            }
        }
    }

    fn set_alarm(self: &Arc<Self>, state: &mut State, wake_ns: i64) {
        if state.alarm.as_ref().is_some_and(|(at_ns, _)| *at_ns == wake_ns) {
            return;
        }
        state.alarm = None;
        if wake_ns == i64::MAX {
            return;
        }
        let peer = Arc::downgrade(self);
        let alarm = self.alarms.alarm(wake_ns, move || {
            let Some(peer) = Weak::upgrade(&peer) else { return };
            let rung = lock(&peer.state).alarm.take();
            drop(rung);
            peer.turn();
        });
        state.alarm = Some((wake_ns, alarm));
    }

    fn answer(self: &Arc<Self>, state: &mut State, query: Query) -> Reply {
        self.try_answer(state, query).unwrap_or_else(|error| Reply::Failed(error.to_string()))
    }

    fn try_answer(self: &Arc<Self>, state: &mut State, query: Query) -> Result<Reply, GraphError> {
        let node_of = |state: &State, new: &NewEndpoint| match state.entities.get(&new.node) {
            Some(Entity::Node(node)) => Ok(node.clone()),
            _ => Err(GraphError::Value { reason: "the node was destroyed".into() }),
        };
        let (id, entity) = match query {
            Query::Hello { .. } => return Ok(Reply::Done),
            Query::Node { id, words } => {
                let settings = NodeSettings::new(words.name).namespace(&words.namespace);
                let settings = settings.bare().keep_names().share_name();
                (id, Entity::Node(self.graph.node(settings)?))
            }
            Query::Publisher(new, qos) => {
                let node = node_of(state, &new)?;
                let hash = new.type_hash.as_deref();
                let publisher = node.raw_publisher(&new.name, &new.type_name, hash, qos)?;
                let words = EndpointWords {
                    node: node.full_name().to_owned(),
                    type_name: new.type_name,
                    type_hash: new.type_hash,
                    qos,
                };
                (new.id, Entity::Publisher(publisher, words))
            }
            Query::Subscription(new, qos) => {
                let (peer, id) = (Arc::downgrade(self), new.id);
                let react = move |sample: &periplus_graph::Sample| {
                    let Some(peer) = Weak::upgrade(&peer) else { return };
                    let Ok(cdr) = sample.cdr() else { return };
                    let head = [sample.time_ns.to_le_bytes(), sample.sequence.to_le_bytes()];
                    peer.deliver(Kind::Message, &[&id.to_le_bytes(), &head[0], &head[1], cdr]);
                };
                let hash = new.type_hash.as_deref();
                let node = node_of(state, &new)?;
                let own = node.raw_subscription(&new.name, &new.type_name, hash, qos, react)?;
                (new.id, Entity::Subscription(own))
            }
            Query::Client(new) => {
                let hash = new.type_hash.as_deref();
                let client = node_of(state, &new)?.raw_client(&new.name, &new.type_name, hash)?;
                (new.id, Entity::Client(Arc::new(client)))
            }
            Query::Server(new) => {
                let (peer, id) = (Arc::downgrade(self), new.id);
                let react = move |call: RawCall| {
                    if let Some(peer) = Weak::upgrade(&peer) {
                        peer.ask(id, call);
                    }
                };
                let hash = new.type_hash.as_deref();
                let node = node_of(state, &new)?;
                match node.raw_server_with(&new.name, &new.type_name, hash, react) {
                    Ok(calls) => (new.id, Entity::Server { _calls: calls }),
                    // Two nodes of one name have the same services, as in ROS 2; the first answers.
                    Err(GraphError::ServerExists { .. }) => return Ok(Reply::Done),
                    Err(error) => return Err(error),
                }
            }
            Query::Matched { id } => return Ok(Reply::Count(self.matched(state, id))),
            Query::Topics => {
                let topics = self.graph.topics().into_iter();
                let used =
                    topics.filter(|it| !it.publishers.is_empty() || !it.subscriptions.is_empty());
                return Ok(Reply::Names(used.map(|it| (it.name, it.type_name)).collect()));
            }
            Query::Services => {
                let services = self.graph.services().into_iter();
                let served = services.filter(|it| it.server.is_some());
                return Ok(Reply::Names(served.map(|it| (it.name, it.type_name)).collect()));
            }
            Query::Nodes => return Ok(Reply::Nodes(self.nodes())),
            Query::Endpoints { topic, publishers } => {
                return Ok(Reply::Endpoints(self.endpoints(&topic, publishers)));
            }
            Query::Events { id } => return Ok(Reply::Words(events(state, id))),
        };
        state.entities.insert(id, entity);
        Ok(Reply::Done)
    }

    /// Hands a request to the process.
    fn ask(self: &Arc<Self>, server: u32, call: RawCall) {
        let Ok(cdr) = call.request.cdr().map(<[u8]>::to_vec) else { return };
        let mut state = lock(&self.state);
        state.last_call += 1;
        let number = state.last_call;
        state.calls.insert(number, (server, call));
        drop(state);
        self.deliver(Kind::Request, &[&server.to_le_bytes(), &number.to_le_bytes(), &cdr]);
    }

    fn matched(&self, state: &State, id: u32) -> usize {
        let topic = |name: &str| self.graph.topics().into_iter().find(|topic| topic.name == name);
        match state.entities.get(&id) {
            Some(Entity::Publisher(publisher, words)) => {
                let fits =
                    |end: &&EndpointInfo| words.qos.incompatible_policies(&end.qos).is_empty();
                let topic = topic(publisher.topic());
                topic.map_or(0, |topic| topic.subscriptions.iter().filter(fits).count())
            }
            Some(Entity::Subscription(own)) => {
                let asked = own.qos();
                let fits = |end: &&EndpointInfo| end.qos.incompatible_policies(&asked).is_empty();
                let topic = topic(own.topic());
                topic.map_or(0, |topic| topic.publishers.iter().filter(fits).count())
            }
            Some(Entity::Client(client)) => usize::from(client.is_ready()),
            _ => 0,
        }
    }

    fn nodes(&self) -> Vec<NodeWords> {
        let nodes = self.graph.nodes().into_iter();
        nodes
            .filter_map(|node| {
                let (namespace, name) = node.name.rsplit_once('/')?;
                Some(NodeWords { name: name.to_owned(), namespace: namespace.to_owned() })
            })
            .collect()
    }

    fn endpoints(&self, topic: &str, publishers: bool) -> Vec<EndpointWords> {
        let topics = self.graph.topics();
        let Some(topic) = topics.into_iter().find(|it| it.name == topic) else { return Vec::new() };
        let ends = if publishers { topic.publishers } else { topic.subscriptions };
        let words = |end: EndpointInfo| EndpointWords {
            node: end.node,
            type_name: topic.type_name.clone(),
            type_hash: topic.type_hash.clone(),
            qos: end.qos,
        };
        ends.into_iter().map(words).collect()
    }
}

fn events(state: &State, id: u32) -> Vec<String> {
    let events = match state.entities.get(&id) {
        Some(Entity::Publisher(publisher, _)) => publisher.events(),
        Some(Entity::Subscription(own)) => own.events(),
        _ => Vec::new(),
    };
    events
        .into_iter()
        .filter_map(|event| match event {
            QosEvent::Incompatible { policies, .. } => {
                policies.last().map(|one| one.policy.to_string())
            }
            _ => None,
        })
        .collect()
}

impl State {
    fn send(&mut self) -> io::Result<()> {
        let sent = self.stream.as_mut().map_or(Ok(()), |stream| stream.write_all(&self.out));
        self.out.clear();
        sent
    }

    /// Forgets the connection; returns what must be dropped without the lock.
    fn part(&mut self) -> (HashMap<u32, Entity>, HashMap<u64, (u32, RawCall)>) {
        self.stream = None;
        self.alarm = None;
        self.out.clear();
        (std::mem::take(&mut self.entities), std::mem::take(&mut self.calls))
    }
}

fn is_reset(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::ConnectionReset | io::ErrorKind::BrokenPipe)
}

/// Asks a process of Python to print the stacks of its threads.
#[cfg(unix)]
fn dump_stack(pid: u32) {
    let pid = i32::try_from(pid).ok().and_then(rustix::process::Pid::from_raw);
    if let Some(pid) = pid {
        // The process may have ended.
        let _ = rustix::process::kill_process(pid, rustix::process::Signal::USR1);
    }
}

#[cfg(not(unix))]
fn dump_stack(_: u32) {}
