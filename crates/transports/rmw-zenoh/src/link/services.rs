//! Services and clients over Zenoh.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Node, Qos, RawCalls, ServiceInfo};
use periplus_transport::{lock, unix_ns};
use zenoh::Wait;
use zenoh::bytes::ZBytes;
use zenoh::liveliness::LivelinessToken;
use zenoh::query::{ConsolidationMode, Query, QueryTarget, Queryable};
use zenoh::sample::Locality;

use super::net::Net;
use crate::attachment::{Attachment, Gid};
use crate::outgoing::Job;
use crate::token::{End, EntityKind};

/// Query timeout. The result of an action may take any time; the token reports a server that
/// leaves.
const PATIENCE: Duration = Duration::from_secs(365 * 24 * 3600);

#[derive(Default)]
pub(super) struct Services {
    serving: BTreeMap<String, Serving>,
    calling: BTreeMap<String, Calling>,
}

/// A service of the graph on the network.
struct Serving {
    node: String,
    end: End,
    _queryable: Queryable<()>,
    _token: LivelinessToken,
}

/// A remote service that the graph calls.
struct Calling {
    end: End,
    /// By client node.
    tokens: BTreeMap<String, (Gid, LivelinessToken)>,
    /// Makes the server visible in the graph, while there is one.
    server: Option<RawCalls>,
    /// Sequence number of the last request.
    number: i64,
}

impl Services {
    /// Creates and removes endpoints. `services` has only the graph's own.
    pub(super) fn sync(&mut self, net: &Net, node: &Node, services: &[ServiceInfo]) {
        let mut unserved: BTreeSet<String> = self.serving.keys().cloned().collect();
        let mut uncalled: BTreeSet<String> = self.calling.keys().cloned().collect();
        for service in services {
            let end = end(service);
            if let Some(server) = &service.server {
                let is_same = |one: &Serving| one.end == end && one.node == *server;
                if !self.serving.get(&service.name).is_some_and(is_same) {
                    self.serving.remove(&service.name);
                    if let Some(made) = serve(net, node, server, end) {
                        self.serving.insert(service.name.clone(), made);
                    }
                }
                unserved.remove(&service.name);
            } else if !service.clients.is_empty() {
                if self.calling.get(&service.name).is_none_or(|one| one.end != end) {
                    self.calling.insert(service.name.clone(), Calling::new(end));
                }
                if let Some(one) = self.calling.get_mut(&service.name) {
                    one.tell(net, &service.clients);
                }
                uncalled.remove(&service.name);
            }
        }
        self.serving.retain(|name, _| !unserved.contains(name));
        self.calling.retain(|name, _| !uncalled.contains(name));
    }

    /// Finds the servers of the services that the graph calls.
    pub(super) fn meet(&mut self, net: &Net, node: &Node) {
        for calling in self.calling.values_mut() {
            if net.heard_by(&calling.end, EntityKind::Server).is_empty() {
                calling.server = None;
            } else if calling.server.is_none() {
                let End { name, type_name, type_hash, .. } = &calling.end;
                match node.raw_server(name, type_name, type_hash.as_deref()) {
                    Ok(calls) => {
                        let shared = net.shared.clone();
                        calls.on_call(move || shared.wake());
                        calling.server = Some(calls);
                    }
                    Err(error) => net.complain_of_graph(error),
                }
            }
        }
    }

    /// Sends the requests of the graph.
    pub(super) fn send_questions(&mut self, net: &Net) {
        for calling in self.calling.values_mut() {
            calling.send(net);
        }
    }
}

fn end(service: &ServiceInfo) -> End {
    let ServiceInfo { name, type_name, type_hash, .. } = service.clone();
    End { name, type_name, type_hash, qos: Qos::reliable(10) }
}

/// Answers remote requests by calling the graph.
fn serve(net: &Net, node: &Node, server: &str, end: End) -> Option<Serving> {
    let hash = end.type_hash.as_deref();
    let client = match node.raw_client(&end.name, &end.type_name, hash) {
        Ok(client) => client,
        Err(error) => {
            net.complain_of_graph(error);
            return None;
        }
    };
    let (shared, lane, name) = (net.shared.clone(), net.lane.clone(), end.name.clone());
    let strange = Mutex::new(false);
    let queryable = net
        .session
        .declare_queryable(end.key(net.domain_id))
        .complete(true)
        .allowed_origin(Locality::Remote)
        .callback(move |query: Query| {
            let asked = query.attachment().and_then(|one| Attachment::read(&one.to_bytes()));
            let (Some(asked), Some(body)) = (asked, query.payload()) else {
                if !std::mem::replace(&mut *lock(&strange), true) {
                    let message = format!("the service `{name}` received a request without the attachment of rmw_zenoh");
                    shared.report(Diagnostic::warning("strange-question", message));
                }
                return;
            };
            let body = body.to_bytes().into_owned();
            let lane = lane.clone();
            client.call(body, move |answered| {
                // Without a response the query ends without a reply.
                let Ok(message) = answered else { return };
                let Ok(body) = message.cdr().map(ZBytes::from) else { return };
                lane.schedule(Job::Once(Box::new(move || {
                    let beside = Attachment { time_ns: unix_ns(), ..asked }.write();
                    let key = query.key_expr().clone();
                    let _ = query.reply(key, body).attachment(beside).wait();
                })));
            });
        })
        .wait();
    let queryable = queryable.map_err(|error| net.complain(&error)).ok()?;
    let (_, token) = net.token(EntityKind::Server, server, Some(end.clone()))?;
    Some(Serving { node: server.to_owned(), end, _queryable: queryable, _token: token })
}

impl Calling {
    fn new(end: End) -> Self {
        Self { end, tokens: BTreeMap::new(), server: None, number: 0 }
    }

    /// Declares tokens for the client nodes.
    fn tell(&mut self, net: &Net, nodes: &[String]) {
        self.tokens.retain(|node, _| nodes.contains(node));
        for node in nodes {
            if !self.tokens.contains_key(node)
                && let Some(made) = net.token(EntityKind::Client, node, Some(self.end.clone()))
            {
                self.tokens.insert(node.clone(), made);
            }
        }
    }

    fn send(&mut self, net: &Net) {
        let Some(calls) = &self.server else { return };
        let Some((gid, _)) = self.tokens.values().next() else { return };
        while let Some(call) = calls.take() {
            let Ok(body) = call.request.cdr().map(ZBytes::from) else { continue };
            self.number += 1;
            let beside = Attachment { number: self.number, time_ns: unix_ns(), gid: *gid }.write();
            let (session, key) = (net.session.clone(), self.end.keys(net.domain_id));
            // The first response is used; without one the call is dropped and its caller gets an
            // error.
            let call = Arc::new(Mutex::new(Some(call)));
            net.lane.schedule(Job::Once(Box::new(move || {
                let _ = session
                    .get(key)
                    .payload(body)
                    .attachment(beside)
                    .target(QueryTarget::AllComplete)
                    .consolidation(ConsolidationMode::None)
                    .allowed_destination(Locality::Remote)
                    .timeout(PATIENCE)
                    .callback(move |reply| {
                        if let Ok(sample) = reply.result()
                            && let Some(call) = lock(&call).take()
                        {
                            call.answer(sample.payload().to_bytes().into_owned());
                        }
                    })
                    .wait();
            })));
        }
    }
}
