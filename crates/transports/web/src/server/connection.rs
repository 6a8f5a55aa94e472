//! HTTP connections: requests for files, and the upgrade to a WebSocket.

use std::convert::Infallible;
use std::io;
use std::net::{IpAddr, TcpStream};
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use hyper::body::{Bytes, Incoming};
use hyper::header::{
    CONNECTION, HeaderValue, SEC_WEBSOCKET_ACCEPT, SEC_WEBSOCKET_KEY, SEC_WEBSOCKET_PROTOCOL,
    SEC_WEBSOCKET_VERSION, UPGRADE,
};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::upgrade::Upgraded;
use hyper::{Method, Request, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use socket2::SockRef;
use tokio_io_timeout::TimeoutStream;
use tungstenite::handshake::derive_accept_key;

use crate::foxglove::{ClientSession, protocol};
use crate::server::authorization::AdmissionError;
use crate::server::http::{Answer, empty, is_upgrade, lists, plain_text, query, value};
use crate::server::listener::ConnectionSlot;
use crate::server::{page, socket};

/// Maximum size of a request head \[bytes\]; browsers send less than 2 kB.
const MAX_HEAD_BYTES: usize = 16 << 10;

/// Maximum number of headers of a request.
const MAX_HEADERS: usize = 100;

/// Stream of a connection: its writes fail if the client reads nothing for a while.
type Stream = Pin<Box<TimeoutStream<tokio::net::TcpStream>>>;

/// Serves the requests of a client until it leaves, or its connection becomes a WebSocket.
pub(crate) async fn serve(
    stream: tokio::net::TcpStream,
    address: IpAddr,
    slot: ConnectionSlot,
) -> hyper::Result<()> {
    let (slot, requests) = (Arc::new(slot), AtomicUsize::new(0));
    let limits = slot.state().limits;
    let mut stream = TimeoutStream::new(stream);
    stream.set_write_timeout(Some(slot.state().hub.settings().limits.stalled));
    let service = service_fn(|request: Request<Incoming>| {
        let mut answer = respond(request, address, &slot);
        if requests.fetch_add(1, Ordering::Relaxed) + 1 >= limits.requests {
            close_after(&mut answer);
        }
        std::future::ready(Ok::<_, Infallible>(answer))
    });
    let stream: Stream = Box::pin(stream);
    bounded_http()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.head_timeout)
        .title_case_headers(true)
        // The hub below has no clock of the day.
        .auto_date_header(false)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades()
        .await
}

/// HTTP/1 with the limits of this server on the heads of requests.
#[must_use]
pub fn bounded_http() -> http1::Builder {
    let mut http = http1::Builder::new();
    http.max_header_size(MAX_HEAD_BYTES).max_headers(MAX_HEADERS).max_buf_size(MAX_HEAD_BYTES);
    http
}

fn close_after(answer: &mut Answer) {
    answer.headers_mut().insert(CONNECTION, HeaderValue::from_static("close"));
}

/// Response to a request.
fn respond(request: Request<Incoming>, address: IpAddr, slot: &Arc<ConnectionSlot>) -> Answer {
    if is_upgrade(request.headers()) {
        return match upgrade(request, address, slot) {
            Ok(answer) => answer,
            Err((status, why)) => {
                let mut answer = plain_text(status, &why);
                close_after(&mut answer);
                answer
            }
        };
    }
    if matches!(*request.method(), Method::GET | Method::HEAD) {
        return page::answer(request.uri().path(), request.headers());
    }
    let why = "only GET and HEAD are supported";
    let mut answer = plain_text(StatusCode::METHOD_NOT_ALLOWED, why);
    close_after(&mut answer);
    answer
}

/// Starts the upgrade to a WebSocket if the client is admitted.
fn upgrade(
    request: Request<Incoming>,
    address: IpAddr,
    slot: &Arc<ConnectionSlot>,
) -> Result<Answer, (StatusCode, String)> {
    let state = slot.state();
    let headers = request.headers();
    if query(request.uri(), "token").is_some() && state.token_rate_limit.are_too_many(address) {
        let why = "too many wrong tokens from this address; wait a minute";
        return Err((StatusCode::TOO_MANY_REQUESTS, why.to_owned()));
    }
    if let Err(refused) = state.authorization.admit(request.uri(), headers) {
        if refused == AdmissionError::WrongToken {
            state.token_rate_limit.add(address);
        }
        return Err((StatusCode::FORBIDDEN, refused.to_string()));
    }
    let known = |name: &&&str| lists(headers, SEC_WEBSOCKET_PROTOCOL, name);
    let Some(subprotocol) = protocol::SUBPROTOCOLS.iter().find(known) else {
        let names = protocol::SUBPROTOCOLS.join(" or ");
        let why = format!("this WebSocket requires the subprotocol {names}");
        return Err((StatusCode::BAD_REQUEST, why));
    };
    let version = value(headers, SEC_WEBSOCKET_VERSION);
    let key = value(headers, SEC_WEBSOCKET_KEY).map(|key| derive_accept_key(key.as_bytes()));
    let key = key.and_then(|key| HeaderValue::try_from(key).ok());
    let (Some(key), Some("13"), &Method::GET) = (key, version.as_deref(), request.method()) else {
        let why = "this server requires WebSocket version 13".to_owned();
        return Err((StatusCode::UPGRADE_REQUIRED, why));
    };
    let Some(session) = state.hub.join() else {
        return Err((StatusCode::SERVICE_UNAVAILABLE, "too many viewers are connected".to_owned()));
    };
    let mut answer = empty(StatusCode::SWITCHING_PROTOCOLS);
    let own = answer.headers_mut();
    own.insert(UPGRADE, HeaderValue::from_static("websocket"));
    own.insert(CONNECTION, HeaderValue::from_static("Upgrade"));
    own.insert(SEC_WEBSOCKET_ACCEPT, key);
    own.insert(SEC_WEBSOCKET_PROTOCOL, HeaderValue::from_static(subprotocol));
    let slot = slot.clone();
    tokio::spawn(async move {
        if let Ok(upgraded) = hyper::upgrade::on(request).await {
            // A client whose connection fails here has left; dropping the session reports it.
            let _ = start(upgraded, session, slot);
        }
    });
    Ok(answer)
}

/// Starts the threads of a WebSocket.
fn start(upgraded: Upgraded, session: ClientSession, slot: Arc<ConnectionSlot>) -> io::Result<()> {
    let (stream, came) = into_std(upgraded)?;
    let builder = std::thread::Builder::new().name("connection".to_owned());
    builder.spawn(move || socket::serve(stream, came.into(), session, slot.state()))?;
    Ok(())
}

/// Blocking stream of an upgraded connection, and the bytes that were already read from it.
fn into_std(upgraded: Upgraded) -> io::Result<(TcpStream, Bytes)> {
    let parts = upgraded.downcast::<TokioIo<Stream>>();
    let parts = parts.map_err(|_| io::Error::other("the connection is not a TCP stream"))?;
    // The stream cannot be moved out of its timeout, so that its handle is duplicated.
    let stream = parts.io.into_inner();
    let stream = TcpStream::from(SockRef::from(stream.get_ref()).try_clone()?);
    stream.set_nonblocking(false)?;
    Ok((stream, parts.read_buf))
}
