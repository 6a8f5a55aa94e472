//! Services: requests and responses.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::net::{SocketAddr, TcpStream};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use periplus_gz_msgs::{
    DiscoveryKind, DiscoveryPublisher, DiscoveryScope, DiscoverySubscriber, ServicePublisher,
    bare_name,
};
use periplus_transport::{Since, lock};

use super::replies::Reply;
use super::shared::{Kind, Shared};
use super::{listener, sockets, uuid, zmtp};
use crate::{Name, ServiceCallError};

/// Maximum size of a request or response \[bytes\]: a world as text, with its height maps.
const LARGEST: usize = 64 << 20;

/// Period at which a call checks for a new server.
const LOOK: Duration = Duration::from_millis(50);

/// Callback for requests.
pub(super) type Take = Box<dyn Fn(ServiceRequest) + Send + Sync>;

/// A received request.
#[derive(Debug)]
pub struct ServiceRequest {
    /// The request.
    pub request: Vec<u8>,
    /// Sends the response.
    pub answer: ServiceReply,
}

/// Return path of a response, usable at any later time. If it is dropped, the client times out.
pub struct ServiceReply {
    shared: Arc<Shared>,
    to: Option<SocketAddr>,
    parts: [Vec<u8>; 3],
}

impl ServiceReply {
    /// Sends the response; none reports failure.
    pub fn send(self, answer: Option<&[u8]>) {
        let Some(to) = self.to else { return };
        let [topic, node, request] = &self.parts;
        let is_done: &[u8] = if answer.is_some() { b"1" } else { b"0" };
        let bytes = answer.unwrap_or_default();
        let message = zmtp::message(&[topic, node, request, bytes, is_done]);
        // Fails only after the transport is closed.
        let _ = self.shared.replies.send(Reply::To(to, message));
    }
}

impl std::fmt::Debug for ServiceReply {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Answer").field("to", &self.to).finish_non_exhaustive()
    }
}

/// A service that is advertised until this is dropped.
pub struct GzService {
    shared: Arc<Shared>,
    name: Name,
    id: u64,
}

impl GzService {
    /// Name of the service.
    #[must_use]
    pub fn service(&self) -> &str {
        self.name.topic()
    }
}

impl Drop for GzService {
    fn drop(&mut self) {
        lock(&self.shared.calling.servers).remove(&self.id);
        self.shared.withdraw(Kind::Services, self.id);
    }
}

impl std::fmt::Debug for GzService {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Server").field(&self.name.topic()).finish()
    }
}

struct Serving {
    name: Name,
    types: [String; 2],
    take: Take,
}

/// State of a call: pending, response, or failure.
type Outcome = Option<Result<Vec<u8>, ServiceCallError>>;

#[derive(Default)]
pub(super) struct Calling {
    servers: Mutex<BTreeMap<u64, Arc<Serving>>>,
    asked: Mutex<BTreeMap<String, Outcome>>,
    pub(super) answered: Condvar,
}

pub(super) fn serve(
    shared: &Arc<Shared>,
    name: Name,
    request_type: &str,
    response_type: &str,
    take: Take,
) -> GzService {
    let offer = DiscoveryPublisher {
        topic: name.full().to_owned(),
        address: shared.replying.clone(),
        process_uuid: shared.process.clone(),
        node_uuid: shared.node.clone(),
        scope: DiscoveryScope::ALL,
        msg_pub: None,
        srv_pub: Some(ServicePublisher {
            socket_id: shared.replier.clone(),
            request_type: request_type.to_owned(),
            response_type: response_type.to_owned(),
        }),
    };
    let types = [request_type.to_owned(), response_type.to_owned()];
    // Under the lock, so that no request arrives before the server is registered.
    let mut servers = lock(&shared.calling.servers);
    let id = shared.offer(Kind::Services, offer);
    servers.insert(id, Arc::new(Serving { name: name.clone(), types, take }));
    drop(servers);
    GzService { shared: shared.clone(), name, id }
}

/// True if both names are one type in different releases.
fn is_same_type(a: &str, b: &str) -> bool {
    a == b || bare_name(a).is_some_and(|a| bare_name(b) == Some(a))
}

/// Receives requests on a connection.
pub(super) fn take_requests(shared: &Arc<Shared>, mut stream: TcpStream) {
    while let Ok(event) = zmtp::read(&mut stream, LARGEST) {
        let parts = match event {
            zmtp::Event::Message(parts) => parts,
            zmtp::Event::Ping(context) => match stream.write_all(&zmtp::pong(&context)) {
                Ok(()) => continue,
                Err(_) => return,
            },
            zmtp::Event::Subscribe(..) => continue,
        };
        if let Some((serving, call)) = request(shared, parts) {
            (serving.take)(call);
        }
    }
}

/// Parses a request: topic; address and id of the response receiver; its node; id of the request;
/// the request; both types.
fn request(shared: &Arc<Shared>, parts: Vec<Vec<u8>>) -> Option<(Arc<Serving>, ServiceRequest)> {
    let [topic, address, _, node, number, request, request_type, response_type] =
        <[Vec<u8>; 8]>::try_from(parts).ok()?;
    let text = |bytes: &'_ [u8]| std::str::from_utf8(bytes).ok().map(str::to_owned);
    let types = [text(&request_type)?, text(&response_type)?];
    let servers = lock(&shared.calling.servers);
    let wanted = servers.values().find(|serving| {
        serving.name.full().as_bytes() == topic
            && serving.types.iter().zip(&types).all(|(a, b)| is_same_type(a, b))
    });
    let serving = wanted?.clone();
    drop(servers);
    let to = sockets::address(&text(&address)?).filter(|to| shared.ways.is_for(*to));
    // A client that expects no response type gets none.
    let to = to.filter(|_| bare_name(&types[1]) != Some("Empty"));
    let answer = ServiceReply { shared: shared.clone(), to, parts: [topic, node, number] };
    Some((serving, ServiceRequest { request, answer }))
}

/// Receives responses on a connection.
pub(super) fn take_answers(shared: &Arc<Shared>, mut stream: TcpStream) {
    while let Ok(event) = zmtp::read(&mut stream, LARGEST) {
        let zmtp::Event::Message(parts) = event else { continue };
        let Ok([_, _, number, answer, is_done]) = <[Vec<u8>; 5]>::try_from(parts) else { continue };
        let Ok(number) = String::from_utf8(number) else { continue };
        if let Some(outcome) = lock(&shared.calling.asked).get_mut(&number) {
            *outcome =
                Some(if is_done == b"1" { Ok(answer) } else { Err(ServiceCallError::Refused) });
            shared.calling.answered.notify_all();
        }
    }
}

pub(super) fn call(
    shared: &Arc<Shared>,
    name: &Name,
    types: [&str; 2],
    request: &[u8],
    timeout: Duration,
) -> Result<Vec<u8>, ServiceCallError> {
    let start = Since::now();
    let offer = find(shared, name, types, start, timeout).ok_or(ServiceCallError::Nobody)?;
    let told = offer.srv_pub.unwrap_or_default();
    let to = sockets::address(&offer.address).filter(|to| shared.ways.is_for(*to));
    let left = timeout.saturating_sub(start.elapsed()).max(LOOK);
    let stream = to.and_then(|to| TcpStream::connect_timeout(&to, left).ok());
    let mut stream = stream.ok_or(ServiceCallError::Nobody)?;
    let number = uuid::new();
    lock(&shared.calling.asked).insert(number.clone(), None);
    let message = zmtp::message(&[
        name.full().as_bytes(),
        shared.receiving.as_bytes(),
        shared.receiver.as_bytes(),
        shared.node.as_bytes(),
        number.as_bytes(),
        request,
        told.request_type.as_bytes(),
        told.response_type.as_bytes(),
    ]);
    let asked = listener::greet(&mut stream, zmtp::Kind::Router, &uuid::new())
        .and_then(|()| stream.write_all(&message));
    let mut outcome = None;
    if asked.is_ok() && bare_name(&told.response_type) == Some("Empty") {
        outcome = Some(Ok(Vec::new()));
    } else if asked.is_ok() {
        let left = timeout.saturating_sub(start.elapsed());
        let waiting = |asked: &mut BTreeMap<String, Outcome>| {
            matches!(asked.get(&number), Some(None)) && !shared.is_closing()
        };
        let asked = lock(&shared.calling.asked);
        let waited = shared.calling.answered.wait_timeout_while(asked, left, waiting);
        let (mut asked, _) = waited.unwrap_or_else(PoisonError::into_inner);
        outcome = asked.remove(&number).flatten();
    }
    lock(&shared.calling.asked).remove(&number);
    outcome.unwrap_or(Err(ServiceCallError::Late))
}

/// Finds a server, waiting for discovery up to the deadline.
fn find(
    shared: &Shared,
    name: &Name,
    types: [&str; 2],
    start: Since,
    timeout: Duration,
) -> Option<DiscoveryPublisher> {
    let mut is_asked = false;
    loop {
        let remote = shared.remote(Kind::Services);
        let found = remote.of(name).iter().find(|offer| {
            offer.srv_pub.as_ref().is_some_and(|told| {
                is_same_type(&told.request_type, types[0])
                    && is_same_type(&told.response_type, types[1])
            })
        });
        if let Some(found) = found {
            return Some(found.clone());
        }
        if start.elapsed() >= timeout || shared.is_closing() {
            return None;
        }
        if !is_asked {
            is_asked = true;
            let topic = name.full().to_owned();
            shared.tell(Kind::Services, DiscoveryKind::SUBSCRIBE, |told| {
                told.sub = Some(DiscoverySubscriber { topic });
            });
        }
        let _ = shared.news.wait_timeout(remote, LOOK);
    }
}
