//! Services and clients over DDS.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_cyclonedds_sys::{DataReader, DataWriter, DdsQos, Guid, WaitToken, Waker};
use periplus_graph::{Node, RawCall, RawCalls, RawClient, ServiceInfo};
use periplus_transport::{Since, lock};

use super::net::{Net, Subject};
use crate::names;
use crate::outgoing::{Outgoing, Parcel, Response};
use crate::peers::Peers;
use crate::request::{self, Mapping, Ticket};

/// Time that a response waits for the discovery of its client's reader before it is dropped.
const PATIENCE: Duration = Duration::from_millis(500);

/// Maximum number of pending calls per service; then the oldest is dropped.
const MOST_CALLS: usize = 10_000;

#[derive(Default)]
pub(super) struct Services {
    serving: BTreeMap<String, Serving>,
    calling: BTreeMap<String, Calling>,
    /// Responses of the graph to be sent.
    answers: Arc<Mutex<Vec<Answer>>>,
}

/// A service of the graph on the network.
struct Serving {
    node: String,
    type_name: String,
    client: RawClient,
    questions: DataReader,
    token: WaitToken,
    /// One writer for clients of all vendors: rmw_fastrtps considers a service ready only if there
    /// are as many response writers as request readers. Each response is sent to its client only,
    /// so that no client gets the format of another vendor.
    answers: Arc<Outgoing>,
    waker: Waker,
}

/// A response that waits for its client's reader.
struct Answer {
    service: String,
    ticket: Ticket,
    body: Vec<u8>,
    /// Participant of the client.
    client: Guid,
    since: Since,
}

/// A remote service that the graph calls.
struct Calling {
    nodes: Vec<String>,
    type_name: String,
    type_hash: Option<String>,
    /// Each request is sent to one server only, in the format of its vendor.
    questions: DataWriter,
    answers: DataReader,
    token: WaitToken,
    /// The server, while there is one.
    server: Option<Server>,
    /// Sequence number of the last request.
    number: i64,
    waiting: BTreeMap<(Mapping, i64), RawCall>,
}

struct Server {
    participant: Guid,
    mapping: Mapping,
    /// Makes the server visible in the graph.
    calls: RawCalls,
}

impl Services {
    /// Creates and removes endpoints. `services` has only the graph's own.
    pub(super) fn sync(&mut self, net: &Net, node: &Node, services: &[ServiceInfo]) {
        let mut unserved: BTreeSet<String> = self.serving.keys().cloned().collect();
        let mut uncalled: BTreeSet<String> = self.calling.keys().cloned().collect();
        for service in services {
            if let Some(server) = &service.server {
                let known = self.serving.get(&service.name);
                let same = known.is_some_and(|one| one.type_name == service.type_name);
                if !same {
                    self.serving.remove(&service.name);
                    self.serve(net, node, service, server);
                } else if let Some(one) = self.serving.get_mut(&service.name) {
                    one.node.clone_from(server);
                }
                unserved.remove(&service.name);
            } else if !service.clients.is_empty() {
                let known = self.calling.get(&service.name);
                if known.is_none_or(|one| one.type_name != service.type_name) {
                    self.calling.remove(&service.name);
                    self.call(net, service);
                }
                if let Some(one) = self.calling.get_mut(&service.name) {
                    one.nodes.clone_from(&service.clients);
                }
                uncalled.remove(&service.name);
            }
        }
        self.serving.retain(|name, _| !unserved.contains(name));
        self.calling.retain(|name, _| !uncalled.contains(name));
    }

    fn serve(&mut self, net: &Net, node: &Node, service: &ServiceInfo, server: &str) {
        let (request, reply) = names::service(&service.name);
        let (question, answer) = names::service_types(&service.type_name);
        let type_hash = service.type_hash.as_deref();
        let qos = DdsQos::default();
        let asked = Subject { topic: &request, type_name: &question, type_hash };
        let told = Subject { topic: &reply, type_name: &answer, type_hash };
        let client = match node.raw_client(&service.name, &service.type_name, type_hash) {
            Ok(client) => client,
            Err(error) => return net.complain("wire", error.to_string()),
        };
        // Responses to many callers may be queued.
        let many = DdsQos { depth: Some(1000), ..qos };
        let Some(answers) = net.writer(&told, &many) else { return };
        let Some((questions, token)) = net.reader(&asked, &many) else { return };
        let (node, type_name) = (server.to_owned(), service.type_name.clone());
        let waker = net.waitset.waker();
        let serving = Serving { node, type_name, client, questions, token, answers, waker };
        self.serving.insert(service.name.clone(), serving);
    }

    fn call(&mut self, net: &Net, service: &ServiceInfo) {
        let (request, reply) = names::service(&service.name);
        let (question, answer) = names::service_types(&service.type_name);
        let type_hash = service.type_hash.as_deref();
        let qos = DdsQos { depth: Some(1000), ..DdsQos::default() };
        let asked = Subject { topic: &request, type_name: &question, type_hash };
        let told = Subject { topic: &reply, type_name: &answer, type_hash };
        // The response reader comes first: a server that sees the request writer may respond at
        // once.
        let Some((answers, token)) = net.reader(&told, &qos) else { return };
        let Some(questions) = net.raw_writer(&asked, &qos) else { return };
        let calling = Calling {
            nodes: Vec::new(),
            type_name: service.type_name.clone(),
            type_hash: service.type_hash.clone(),
            questions,
            answers,
            token,
            server: None,
            number: 0,
            waiting: BTreeMap::new(),
        };
        self.calling.insert(service.name.clone(), calling);
    }

    /// Finds the servers of the services that the graph calls.
    pub(super) fn meet(&mut self, net: &Net, node: &Node, peers: &Peers) {
        for (name, calling) in &mut self.calling {
            let servers = peers.servers(name);
            let is_there = |one: &Server| servers.iter().any(|(guid, _)| *guid == one.participant);
            if !calling.server.as_ref().is_none_or(is_there) {
                // Pending callers get an error.
                calling.server = None;
                calling.waiting.clear();
            }
            if calling.server.is_some() {
                continue;
            }
            let Some((participant, vendor)) = servers.into_iter().next() else { continue };
            let type_hash = calling.type_hash.as_deref();
            match node.raw_server(name, &calling.type_name, type_hash) {
                Ok(calls) => {
                    let waker = net.waitset.waker();
                    calls.on_call(move || waker.wake());
                    let mapping = Mapping::of(vendor);
                    calling.server = Some(Server { participant, mapping, calls });
                }
                Err(error) => net.complain("wire", error.to_string()),
            }
        }
    }

    /// Receives requests and responses, and sends the requests of the graph.
    pub(super) fn take(&mut self, net: &Net, tokens: &[WaitToken]) {
        for (name, serving) in &self.serving {
            if tokens.contains(&serving.token) {
                serving.take(net, name, &self.answers);
            }
        }
        for (name, calling) in &mut self.calling {
            if tokens.contains(&calling.token) {
                calling.take_answers();
            }
            calling.send_questions(net, name);
        }
    }

    /// Sends the responses whose clients are discovered.
    pub(super) fn answer(&mut self) {
        let mut answers = std::mem::take(&mut *lock(&self.answers));
        if answers.is_empty() {
            return;
        }
        answers.retain(|answer| {
            let Some(serving) = self.serving.get(&answer.service) else { return false };
            if serving.answers.writer.reaches(answer.client) {
                let (bytes, related) = request::write_answer(answer.ticket, &answer.body);
                let client = answer.client;
                serving.answers.put(Parcel::Response(Response { bytes, related, client }));
                return false;
            }
            answer.since.elapsed() < PATIENCE
        });
        lock(&self.answers).append(&mut answers);
    }

    /// Endpoints with their nodes; true for writers.
    pub(super) fn ends(&self) -> impl Iterator<Item = (&str, Guid, bool)> {
        let serving = self.serving.values().flat_map(|one| {
            let node = one.node.as_str();
            [(node, one.answers.writer.guid(), true), (node, one.questions.guid(), false)]
        });
        let calling = self.calling.values().flat_map(|one| {
            let ends = [(one.answers.guid(), false), (one.questions.guid(), true)];
            let nodes = one.nodes.iter();
            nodes.flat_map(move |node| ends.map(|(guid, writes)| (node.as_str(), guid, writes)))
        });
        serving.chain(calling)
    }
}

impl Serving {
    /// Forwards requests to the graph.
    fn take(&self, net: &Net, name: &str, answers: &Arc<Mutex<Vec<Answer>>>) {
        loop {
            let sample = match self.questions.take() {
                Ok(Some(sample)) => sample,
                Ok(None) => return,
                Err(error) => return net.complain("wire", error.to_string()),
            };
            let Some(source) = sample.source else { continue };
            let Some((ticket, body)) = request::read_question(sample) else {
                net.complain(
                    "strange-question",
                    format!("the service `{name}` received a request that is too short"),
                );
                continue;
            };
            let (answers, waker) = (answers.clone(), self.waker.clone());
            let service = name.to_owned();
            self.client.call(body, move |answered| {
                // Without a response the caller waits, as for any server that fails.
                let Ok(message) = answered else { return };
                let Ok(body) = message.cdr() else { return };
                lock(&answers).push(Answer {
                    service,
                    ticket,
                    body: body.to_vec(),
                    client: source.writer.participant(),
                    since: Since::now(),
                });
                waker.wake();
            });
        }
    }
}

impl Calling {
    fn take_answers(&mut self) {
        let (caller, answers_to) = (self.questions.guid(), self.answers.guid());
        while let Ok(Some(sample)) = self.answers.take() {
            let answer = request::read_answer(sample, caller, answers_to);
            let Some((mapping, number, body)) = answer else { continue };
            if let Some(call) = self.waiting.remove(&(mapping, number)) {
                call.answer(body);
            }
        }
    }

    fn send_questions(&mut self, net: &Net, name: &str) {
        let Some(server) = &self.server else { return };
        // Discovery reports a server shortly before its reader is matched.
        if !self.questions.reaches(server.participant) {
            return;
        }
        let mapping = server.mapping;
        let (caller, answers_to) = (self.questions.guid(), self.answers.guid());
        while let Some(call) = server.calls.take() {
            let body = match call.request.cdr() {
                Ok(body) => body,
                Err(error) => {
                    net.complain("wire", format!("a request to `{name}` has {error}"));
                    continue;
                }
            };
            self.number += 1;
            let (bytes, related) =
                request::write_question(mapping, caller, answers_to, self.number, body);
            match self.questions.write_to(server.participant, bytes, related) {
                // The server just left; pending callers get an error when discovery reports that.
                Ok(None) => {}
                Ok(Some(sequence)) => {
                    let number = if mapping == Mapping::Fast { sequence } else { self.number };
                    if self.waiting.len() == MOST_CALLS {
                        self.waiting.pop_first();
                    }
                    self.waiting.insert((mapping, number), call);
                }
                Err(error) => net.complain("wire", format!("a request to `{name}`: {error}")),
            }
        }
    }
}
