//! A WebSocket: one thread receives from the client and one sends to it.

use std::io::{self, IoSlice, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use crate::foxglove::{ClientSession, Outbox, OutboxItem, WebSocketFrame};
use periplus_os::{Stopwatch, sleep};
use tungstenite::error::Error;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Message, WebSocket};

use crate::server::frame;
use crate::server::listener::ServerState;
use crate::server::timeout_stream::TimeoutStream;

/// Ping period for a client without traffic.
const PING_PERIOD: Duration = Duration::from_secs(15);

/// Period at which the writer checks for shutdown.
const SHUTDOWN_POLL: Duration = Duration::from_millis(200);

/// Serves a client until it leaves. `came` are the bytes that it sent after its request.
pub(crate) fn serve(
    stream: TcpStream,
    came: Vec<u8>,
    session: ClientSession,
    state: &ServerState,
) -> io::Result<()> {
    let outbox = session.outbox().clone();
    let writing = stream.try_clone()?;
    let builder = std::thread::Builder::new().name("viewer".to_owned());
    std::thread::scope(|scope| {
        let outlet = outbox.clone();
        let writer = builder.spawn_scoped(scope, move || {
            let _ = write(&writing, &outlet, state);
            // Wakes the reading thread.
            let _ = writing.shutdown(Shutdown::Both);
        })?;
        receive(stream, came, session, state);
        let _ = writer.join();
        Ok(())
    })
}

/// Receives from a client until it leaves.
fn receive(stream: TcpStream, came: Vec<u8>, mut session: ClientSession, state: &ServerState) {
    let outbox = session.outbox().clone();
    let limits = state.hub.settings().limits;
    let config = WebSocketConfig::default()
        .max_message_size(Some(limits.message))
        .max_frame_size(Some(limits.message));
    let line = Line { stream, outbox: outbox.clone() };
    let mut socket = WebSocket::from_partially_read(line, came, Role::Server, Some(config));
    let mut allowance = Allowance::new(limits.rate_hz);
    let why = loop {
        match socket.read() {
            Ok(Message::Text(text)) => session.text(&text),
            Ok(Message::Binary(bytes)) => session.binary(&bytes),
            Ok(_) => {}
            Err(error) => break error,
        }
        allowance.spend();
    };
    let close = match why {
        Error::ConnectionClosed | Error::AlreadyClosed | Error::Io(_) => None,
        Error::Capacity(error) => Some((1009, error.to_string())),
        Error::Utf8(_) => Some((1007, "a text message is not UTF-8".to_owned())),
        other => Some((1002, other.to_string())),
    };
    if let Some((code, why)) = close {
        outbox.push(WebSocketFrame::raw(frame::close(code, &why)));
    }
    outbox.end("");
    drop(session);
}

/// Sends the outbox of a client until it is closed.
fn write(stream: &TcpStream, outbox: &Outbox, state: &ServerState) -> io::Result<()> {
    let mut stream = TimeoutStream::new(stream, state.hub.settings().limits.stalled)?;
    let mut idle = Stopwatch::start();
    loop {
        if state.is_closing.load(Ordering::Acquire) {
            outbox.end("the server shuts down");
        }
        match outbox.take(SHUTDOWN_POLL) {
            OutboxItem::Frame(frame) => {
                send(&mut stream, &frame)?;
                idle = Stopwatch::start();
            }
            OutboxItem::Nothing if idle.elapsed() >= PING_PERIOD => {
                stream.write_all(&frame::ping())?;
                idle = Stopwatch::start();
            }
            OutboxItem::Nothing => {}
            OutboxItem::End(why) => {
                // No close frame to a client that has left.
                return if why.is_empty() {
                    Ok(())
                } else {
                    stream.write_all(&frame::close(1001, &why))
                };
            }
        }
    }
}

/// Sends a message without concatenating its parts.
fn send(stream: &mut TimeoutStream<'_>, frame: &WebSocketFrame) -> io::Result<()> {
    use crate::foxglove::FrameKind;
    let [head, body] = frame.parts();
    let before = match frame.kind() {
        FrameKind::Raw => Vec::new(),
        kind => frame::header(kind == FrameKind::Text, head.len() + body.len()),
    };
    let mut parts = [IoSlice::new(&before), IoSlice::new(head), IoSlice::new(body)];
    let mut parts = &mut parts[..];
    IoSlice::advance_slices(&mut parts, 0);
    while !parts.is_empty() {
        match stream.write_vectored(parts) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(count) => IoSlice::advance_slices(&mut parts, count),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// The socket as seen by the reader: frames that the WebSocket library sends while reading (pongs,
/// close) go through the outbox, so that they do not interleave with a message.
struct Line {
    stream: TcpStream,
    outbox: Arc<Outbox>,
}

impl Read for Line {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.stream.read(buffer)
    }
}

impl Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.outbox.push(WebSocketFrame::raw(bytes.to_vec()));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Rate limit for a client: a sustained rate of messages, and twice that number at once. The
/// connection is not read while the limit is exceeded.
struct Allowance {
    rate_hz: f64,
    left: f64,
    since: Stopwatch,
}

impl Allowance {
    fn new(rate_hz: f64) -> Self {
        Self { rate_hz, left: 2.0 * rate_hz, since: Stopwatch::start() }
    }

    fn spend(&mut self) {
        let earned = self.since.lap().as_secs_f64() * self.rate_hz;
        self.left = (self.left + earned).min(2.0 * self.rate_hz) - 1.0;
        if self.left < 0.0 {
            sleep(Duration::from_secs_f64(-self.left / self.rate_hz));
        }
    }
}
