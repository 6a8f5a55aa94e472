//! A node of ROS 1: its port with the slave API, its topics and services.
//!
//! Source: `wiki.ros.org/ROS/Slave_API`.

use std::collections::BTreeMap;
use std::net::{IpAddr, TcpStream};
use std::sync::{Arc, Mutex, OnceLock};

use periplus_transport::lock;

use crate::error::Ros1Error;
use crate::master::process_id;
use crate::rpc::uri_host;
use crate::server::{Handler, Server};
use crate::tcpros::{Header, Publication, Serving, SourceReport, read_header_after};
use crate::xmlrpc::{RpcCall, RpcFault, XmlRpcValue};

/// A subscribed topic with its connections, for reports.
pub(crate) struct SubscriptionReport {
    pub(crate) topic: String,
    pub(crate) of: String,
    pub(crate) sources: Vec<SourceReport>,
}

/// Reports the subscribed topics of a node by its name.
pub(crate) type SubscriptionReporter = Arc<dyn Fn(&str) -> Vec<SubscriptionReport> + Send + Sync>;

/// Takes notifications for a node from the master and other programs.
pub(crate) trait NodeEvents: Send + Sync + 'static {
    /// The publishers of a topic have changed.
    fn publishers(&self, topic: &str, publishers: Vec<String>);

    /// The node is asked to end.
    fn shutdown(&self, node: &str, why: &str);

    /// Subscribed topics of the node.
    fn subscriptions(&self, node: &str) -> Vec<SubscriptionReport>;
}

/// A node on its port, until this is dropped.
pub(crate) struct NodePort {
    api: Arc<NodeApi>,
    _server: Server,
}

struct NodeApi {
    name: String,
    host: String,
    port: OnceLock<u16>,
    master_uri: String,
    publications: Mutex<BTreeMap<String, Arc<Publication>>>,
    services: Mutex<BTreeMap<String, Arc<Serving>>>,
    events: Arc<dyn NodeEvents>,
}

/// Addresses of a process: to listen at, and for other programs.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// Address to listen at.
    pub(crate) address: IpAddr,
    /// Name or address under which others reach this machine.
    pub(crate) host: String,
    pub(crate) master_uri: String,
}

impl NodePort {
    pub(crate) fn open(
        place: &Place,
        name: &str,
        events: Arc<dyn NodeEvents>,
    ) -> Result<Self, Ros1Error> {
        let api = Arc::new(NodeApi {
            name: name.to_owned(),
            host: place.host.clone(),
            port: OnceLock::new(),
            master_uri: place.master_uri.clone(),
            publications: Mutex::default(),
            services: Mutex::default(),
            events,
        });
        let server = Server::open(place.address, 0, api.clone()).map_err(|error| {
            Ros1Error::Port { address: place.address.to_string(), why: error.to_string() }
        })?;
        let _ = api.port.set(server.port());
        Ok(Self { api, _server: server })
    }

    /// Name of the node.
    pub(crate) fn name(&self) -> &str {
        &self.api.name
    }

    /// Address of the slave API.
    pub(crate) fn uri(&self) -> String {
        format!("http://{}:{}/", uri_host(&self.api.host), self.api.port())
    }

    /// Address of the services.
    pub(crate) fn service_uri(&self) -> String {
        format!("rosrpc://{}:{}", uri_host(&self.api.host), self.api.port())
    }

    pub(crate) fn publish(&self, publication: Arc<Publication>) {
        let topic = publication.topic.clone();
        lock(&self.api.publications).insert(topic, publication);
    }

    /// Removes a topic and closes its connections.
    pub(crate) fn unpublish(&self, topic: &str) {
        if let Some(publication) = lock(&self.api.publications).remove(topic) {
            publication.close();
        }
    }

    pub(crate) fn serve(&self, serving: Serving) {
        lock(&self.api.services).insert(serving.service.clone(), Arc::new(serving));
    }

    pub(crate) fn unserve(&self, service: &str) {
        lock(&self.api.services).remove(service);
    }
}

impl Drop for NodePort {
    fn drop(&mut self) {
        for publication in std::mem::take(&mut *lock(&self.api.publications)).values() {
            publication.close();
        }
    }
}

impl Handler for NodeApi {
    fn call(&self, call: RpcCall) -> Result<XmlRpcValue, RpcFault> {
        let texts: Vec<&str> = call.params.iter().map_while(XmlRpcValue::text).collect();
        let done =
            |value: XmlRpcValue| Ok(XmlRpcValue::List(vec![XmlRpcValue::Int(1), "".into(), value]));
        let wrong = |text: String| {
            Ok(XmlRpcValue::List(vec![XmlRpcValue::Int(-1), text.into(), XmlRpcValue::Int(0)]))
        };
        match (call.method.as_str(), texts.as_slice()) {
            ("getPid", _) => done(process_id().into()),
            ("getMasterUri", _) => done(self.master_uri.clone().into()),
            ("getBusStats", _) => done(self.bus_stats()),
            ("getBusInfo", _) => done(self.bus_info()),
            ("getPublications", _) => {
                let publications = lock(&self.publications);
                let pairs = publications.values();
                let pairs = pairs.map(|one| vec![one.topic.clone(), one.of.name.clone()].into());
                done(XmlRpcValue::List(pairs.collect()))
            }
            ("getSubscriptions", _) => {
                let all = self.events.subscriptions(&self.name).into_iter();
                let pairs = all.map(|one| vec![one.topic, one.of].into());
                done(XmlRpcValue::List(pairs.collect()))
            }
            ("shutdown", &[caller, ..]) => {
                let why = texts.get(1).copied().unwrap_or_default();
                self.events.shutdown(&self.name, &format!("{caller}: {why}"));
                // No result without an effect.
                wrong(format!("{} ends with its program", self.name))
            }
            // Nodes of ROS 1 read parameters when they start.
            ("paramUpdate", _) => done(XmlRpcValue::Int(0)),
            ("publisherUpdate", &[_, topic]) => {
                let Some(publishers) = call.params.get(2).and_then(XmlRpcValue::list) else {
                    return wrong("publisherUpdate takes a list of addresses".into());
                };
                let publishers = publishers.iter().filter_map(XmlRpcValue::text).map(str::to_owned);
                self.events.publishers(topic, publishers.collect());
                done(XmlRpcValue::Int(0))
            }
            ("requestTopic", &[_, topic]) => self.request_topic(topic, call.params.get(2)),
            (method, _) => {
                let text =
                    format!("method `{method}` is not supported, or its parameters are wrong");
                Err(RpcFault { code: -1, text })
            }
        }
    }

    fn connect(&self, front: [u8; 4], stream: TcpStream) {
        // What is wrong with a connection concerns its peer alone.
        let Ok(header) = read_header_after(front, &mut &stream) else { return };
        let _ = self.connect_with(&header, stream);
    }
}

impl NodeApi {
    fn port(&self) -> u16 {
        self.port.get().copied().unwrap_or_default()
    }

    fn request_topic(
        &self,
        topic: &str,
        protocols: Option<&XmlRpcValue>,
    ) -> Result<XmlRpcValue, RpcFault> {
        let answer = |code, text: String, value| {
            Ok(XmlRpcValue::List(vec![XmlRpcValue::Int(code), text.into(), value]))
        };
        if !lock(&self.publications).contains_key(topic) {
            let text = format!("{} does not publish [{topic}]", self.name);
            return answer(0, text, XmlRpcValue::Int(0));
        }
        let offered = protocols.and_then(XmlRpcValue::list).unwrap_or_default();
        let names = offered.iter().filter_map(|one| one.list()?.first()?.text());
        let names: Vec<&str> = names.collect();
        if !names.contains(&"TCPROS") {
            let text = format!("{} is not supported; TCPROS is", names.join(", "));
            return answer(0, text, XmlRpcValue::List(Vec::new()));
        }
        let host = &self.host;
        let place =
            vec!["TCPROS".into(), host.as_str().into(), XmlRpcValue::Int(self.port().into())];
        answer(1, format!("ready on {host}:{}", self.port()), XmlRpcValue::List(place))
    }

    fn connect_with(&self, header: &Header, stream: TcpStream) -> std::io::Result<()> {
        if header.has("service") {
            let name = header.get("service");
            let serving = lock(&self.services).get(name).cloned();
            return match serving {
                Some(serving) => serving.connect(header, &stream),
                None => refuse(&stream, &format!("{} does not serve [{name}]", self.name)),
            };
        }
        let topic = header.get("topic");
        let publication = lock(&self.publications).get(topic).cloned();
        match publication {
            Some(publication) => publication.serve(header, stream),
            None => refuse(&stream, &format!("{} does not publish [{topic}]", self.name)),
        }
    }

    /// Connections: `[id, peer, direction, protocol, topic, is connected, text]`.
    fn bus_info(&self) -> XmlRpcValue {
        let mut all = Vec::new();
        let row = |id: i32, peer: String, way: &str, topic: &str| {
            XmlRpcValue::List(vec![
                XmlRpcValue::Int(id),
                peer.into(),
                way.into(),
                "TCPROS".into(),
                topic.into(),
                XmlRpcValue::Bool(true),
                format!("TCPROS connection on port {}", self.port()).into(),
            ])
        };
        for publication in lock(&self.publications).values() {
            for link in publication.report().1 {
                all.push(row(link.id, link.peer, "o", &publication.topic));
            }
        }
        for subscription in self.events.subscriptions(&self.name) {
            for (id, source) in (0..).zip(subscription.sources) {
                all.push(row(id, source.publisher, "i", &subscription.topic));
            }
        }
        XmlRpcValue::List(all)
    }

    /// Counts of topics sent, topics received, and services.
    fn bus_stats(&self) -> XmlRpcValue {
        let count = |number: u64| XmlRpcValue::Int(i32::try_from(number).unwrap_or(i32::MAX));
        let mut sent = Vec::new();
        for publication in lock(&self.publications).values() {
            let (bytes, links) = publication.report();
            let links = links.iter().map(|link| {
                let row = vec![
                    XmlRpcValue::Int(link.id),
                    count(link.sent_bytes),
                    count(link.sent),
                    XmlRpcValue::Bool(true),
                ];
                XmlRpcValue::List(row)
            });
            let links = XmlRpcValue::List(links.collect());
            sent.push(XmlRpcValue::List(vec![
                publication.topic.clone().into(),
                count(bytes),
                links,
            ]));
        }
        let mut received = Vec::new();
        for subscription in self.events.subscriptions(&self.name) {
            let links = (0..).zip(&subscription.sources).map(|(id, source)| {
                XmlRpcValue::List(vec![
                    XmlRpcValue::Int(id),
                    count(source.received_bytes),
                    count(source.received),
                    XmlRpcValue::Int(-1),
                    XmlRpcValue::Bool(true),
                ])
            });
            received.push(XmlRpcValue::List(vec![
                subscription.topic.into(),
                XmlRpcValue::List(links.collect()),
            ]));
        }
        let services =
            XmlRpcValue::List(vec![XmlRpcValue::Int(0), XmlRpcValue::Int(0), XmlRpcValue::Int(0)]);
        XmlRpcValue::List(vec![XmlRpcValue::List(sent), XmlRpcValue::List(received), services])
    }
}

fn refuse(mut stream: &TcpStream, why: &str) -> std::io::Result<()> {
    std::io::Write::write_all(&mut stream, &Header::new(&[("error", why)]).write())
}
