//! Services of the graph, and services of other programs that the graph calls.

use std::collections::{BTreeMap, BTreeSet};
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Node, RawCall, RawCalls, ServiceInfo};
use periplus_transport::{Since, lock};

use super::{Net, Ports, port};
use crate::codec::{Into as Target, ServiceCodec};
use crate::names::{Ros1Type, ros1_type, service_definition};
use crate::node::NodePort;
use crate::tcpros::{ServiceConnection, ServiceEnd, Serving};
use crate::wire::CALLER;

/// Period at which the master is asked for a service without a server: ROS 1 has no notification of new servers.
const ASK: Duration = Duration::from_secs(1);

#[derive(Default)]
pub(super) struct Services {
    /// By service: the node in the graph, and the type in ROS 2.
    serving: BTreeMap<String, (String, String)>,
    calling: BTreeMap<String, Calling>,
}

/// A service of another program that the graph calls.
struct Calling {
    /// Type in ROS 2.
    of: String,
    definition: Ros1Type,
    codec: Arc<ServiceCodec>,
    server: Option<Server>,
    asked: Option<Since>,
}

/// A server of another program.
struct Server {
    uri: String,
    /// Makes it visible in the graph.
    calls: RawCalls,
    jobs: Sender<RawCall>,
    /// Set by the thread that calls when the server does not answer any more.
    is_lost: Arc<AtomicBool>,
    /// Connection of that thread.
    stream: Arc<Mutex<Option<TcpStream>>>,
}

impl Drop for Server {
    fn drop(&mut self) {
        if let Some(stream) = lock(&self.stream).take() {
            let _ = stream.shutdown(Shutdown::Both);
        }
    }
}

impl Services {
    /// Registers and unregisters services. `services` has only the graph's own endpoints.
    pub(super) fn sync(
        &mut self,
        net: &Net,
        ports: &mut Ports,
        node: &Node,
        services: &[ServiceInfo],
    ) {
        let mut unserved: BTreeSet<String> = self.serving.keys().cloned().collect();
        let mut uncalled: BTreeSet<String> = self.calling.keys().cloned().collect();
        for service in services {
            let known = ros1_type(&service.type_name).and_then(|of| service_definition(&of));
            let Some(definition) = known else { continue };
            if let Some(server) = &service.server {
                let serving = (server.clone(), service.type_name.clone());
                if self.serving.get(&service.name) != Some(&serving) {
                    self.remove(net, ports, &service.name);
                    if serve(net, ports, node, server, service, definition).is_some() {
                        self.serving.insert(service.name.clone(), serving);
                    }
                }
                unserved.remove(&service.name);
            } else if !service.clients.is_empty() {
                uncalled.remove(&service.name);
                if !self.calling.contains_key(&service.name)
                    && let Some(codec) = ServiceCodec::new(&service.type_name)
                {
                    let calling = Calling {
                        of: service.type_name.clone(),
                        definition,
                        codec: Arc::new(codec),
                        server: None,
                        asked: None,
                    };
                    self.calling.insert(service.name.clone(), calling);
                }
            }
        }
        for name in unserved {
            self.remove(net, ports, &name);
        }
        self.calling.retain(|name, _| !uncalled.contains(name));
    }

    fn remove(&mut self, net: &Net, ports: &Ports, service: &str) {
        let Some((node, _)) = self.serving.remove(service) else { return };
        if let Some(port) = ports.get(&node) {
            unregister(net, port, service);
        }
    }

    /// Finds the servers of the services that the graph calls.
    pub(super) fn meet(&mut self, net: &Net, node: &Node) {
        for (name, calling) in &mut self.calling {
            if let Some(server) = &calling.server
                && !server.is_lost.load(Ordering::Acquire)
            {
                continue;
            }
            calling.server = None;
            if calling.asked.is_some_and(|asked| asked.elapsed() < ASK) {
                continue;
            }
            calling.asked = Some(Since::now());
            let Ok(uri) = net.client.service(name) else { continue };
            match calling.open(net, node, name, &uri) {
                Ok(server) => calling.server = server,
                // The address of a server that has ended without a word.
                Err(ServiceEnd::Lost(_)) => {}
                Err(ServiceEnd::Refused(why)) => {
                    let message = format!("the service `{name}` of {uri} cannot be called: {why}");
                    net.say(Diagnostic::warning("type-mismatch", message));
                }
            }
        }
    }

    /// Gives the requests of the graph to the threads that call.
    pub(super) fn send_questions(&self, net: &Net) {
        for (name, calling) in &self.calling {
            let Some(server) = &calling.server else { continue };
            while let Some(call) = server.calls.take() {
                if server.jobs.send(call).is_err() {
                    let message = format!("the service `{name}` of {} has ended", server.uri);
                    net.say(Diagnostic::warning("ros1-service", message));
                    server.is_lost.store(true, Ordering::Release);
                }
            }
        }
    }

    /// Registers everything again.
    pub(super) fn register_again(&self, net: &Net, ports: &Ports) {
        for (service, (node, _)) in &self.serving {
            if let Some(port) = ports.get(node) {
                register(net, port, service);
            }
        }
    }

    /// Unregisters everything.
    pub(super) fn leave(&mut self, net: &Net, ports: &Ports) {
        for service in self.serving.keys().cloned().collect::<Vec<_>>() {
            self.remove(net, ports, &service);
        }
        self.calling.clear();
    }

    /// Nodes with services.
    pub(super) fn nodes(&self) -> impl Iterator<Item = String> {
        self.serving.values().map(|(node, _)| node.clone())
    }
}

impl Calling {
    /// Asks a server for its type, and makes it visible in the graph.
    fn open(
        &self,
        net: &Net,
        node: &Node,
        name: &str,
        uri: &str,
    ) -> Result<Option<Server>, ServiceEnd> {
        let md5 = self.definition.md5.clone();
        ServiceConnection::open(uri, CALLER, name, &md5, true)?;
        let calls = match node.raw_server(name, &self.of, None) {
            Ok(calls) => calls,
            Err(error) => {
                net.complain_of_graph(&error);
                return Ok(None);
            }
        };
        let shared = net.shared.clone();
        calls.on_call(move || shared.wake());
        let (jobs, work) = channel();
        let (is_lost, stream): (Arc<AtomicBool>, Arc<Mutex<_>>) = Default::default();
        let caller = Caller {
            uri: uri.to_owned(),
            name: name.to_owned(),
            md5,
            codec: self.codec.clone(),
            is_lost: is_lost.clone(),
            stream: stream.clone(),
            shared: net.shared.clone(),
        };
        let thread = std::thread::Builder::new().name("ros1-call".to_owned());
        let spawned = thread.spawn(move || caller.run(&work));
        spawned.map_err(|error| ServiceEnd::Lost(error.to_string()))?;
        Ok(Some(Server { uri: uri.to_owned(), calls, jobs, is_lost, stream }))
    }
}

/// Thread that calls a server, one request after the other.
struct Caller {
    uri: String,
    name: String,
    md5: String,
    codec: Arc<ServiceCodec>,
    is_lost: Arc<AtomicBool>,
    stream: Arc<Mutex<Option<TcpStream>>>,
    shared: Arc<crate::wire::Shared>,
}

impl Caller {
    fn run(&self, work: &Receiver<RawCall>) {
        let mut connection = None;
        for call in work {
            // A call that is dropped gives its caller an error.
            match self.call(&mut connection, &call) {
                Ok(cdr) => call.answer(cdr),
                Err(end) => {
                    let message = format!("the service `{}` of {}: {end}", self.name, self.uri);
                    self.shared.report(Diagnostic::warning("ros1-service", message));
                    if matches!(end, ServiceEnd::Lost(_)) {
                        self.is_lost.store(true, Ordering::Release);
                        self.shared.wake();
                        return;
                    }
                }
            }
        }
    }

    fn call(
        &self,
        connection: &mut Option<ServiceConnection>,
        call: &RawCall,
    ) -> Result<Vec<u8>, ServiceEnd> {
        let wrong = |error: &dyn std::fmt::Display| ServiceEnd::Refused(error.to_string());
        let cdr = call.request.cdr().map_err(|error| wrong(&error))?;
        let request = self.codec.request(Target::Ros1, cdr).map_err(|error| wrong(&error))?;
        // A connection that has lain idle may have been closed; a new one is tried once.
        let is_kept = connection.is_some();
        let mut result = self.call_on(connection, &request);
        if is_kept && matches!(result, Err(ServiceEnd::Lost(_))) {
            result = self.call_on(connection, &request);
        }
        self.codec.response(Target::Ros2, &result?).map_err(|error| wrong(&error))
    }

    fn call_on(
        &self,
        connection: &mut Option<ServiceConnection>,
        request: &[u8],
    ) -> Result<Vec<u8>, ServiceEnd> {
        let open = match connection.take() {
            Some(open) => open,
            None => {
                let open =
                    ServiceConnection::open(&self.uri, CALLER, &self.name, &self.md5, false)?;
                *lock(&self.stream) = Some(open.stream()?);
                open
            }
        };
        let answer = open.call(request);
        if !matches!(answer, Err(ServiceEnd::Lost(_))) {
            *connection = Some(open);
        }
        answer
    }
}

/// Serves a service of the graph.
fn serve(
    net: &Net,
    ports: &mut Ports,
    node: &Node,
    server: &str,
    service: &ServiceInfo,
    definition: Ros1Type,
) -> Option<()> {
    let codec = Arc::new(ServiceCodec::new(&service.type_name)?);
    let client = node.raw_client(&service.name, &service.type_name, service.type_hash.as_deref());
    let client = client.map_err(|error| net.complain_of_graph(&error)).ok()?;
    let port = port(net, ports, server)?;
    port.serve(Serving {
        caller: port.name().to_owned(),
        service: service.name.clone(),
        of: definition,
        serve: Box::new(move |request, answer| {
            let cdr = match codec.request(Target::Ros2, &request) {
                Ok(cdr) => cdr,
                Err(error) => return answer(Err(format!("malformed request: {error}"))),
            };
            let codec = codec.clone();
            client.call(cdr, move |answered| {
                let response = answered.map_err(|error| error.to_string()).and_then(|message| {
                    let cdr = message.cdr().map_err(|error| error.to_string())?;
                    codec.response(Target::Ros1, cdr).map_err(|error| error.to_string())
                });
                answer(response);
            });
        }),
    });
    register(net, port, &service.name);
    Some(())
}

fn register(net: &Net, port: &NodePort, service: &str) {
    let params =
        vec![port.name().into(), service.into(), port.service_uri().into(), port.uri().into()];
    net.tell_master("registerService", params);
}

fn unregister(net: &Net, port: &NodePort, service: &str) {
    port.unserve(service);
    let params = vec![port.name().into(), service.into(), port.service_uri().into()];
    net.tell_master("unregisterService", params);
}
