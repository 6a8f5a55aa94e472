//! The listening server.

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use tokio::sync::oneshot;

use crate::foxglove::Hub;
use crate::server::authorization::Authorization;
use crate::server::connection;
use crate::server::token::{MIN_TOKEN_CHARACTERS, encoded};
use crate::server::token_rate_limit::TokenRateLimit;

/// Limits of connections.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HttpLimits {
    /// Maximum number of connections, including those that became a WebSocket.
    pub(crate) connections: usize,
    /// Maximum number of requests per connection.
    pub(crate) requests: usize,
    /// Timeout of a request head, and idle time of a connection.
    pub(crate) head_timeout: Duration,
}

impl Default for HttpLimits {
    fn default() -> Self {
        Self { connections: 256, requests: 1000, head_timeout: Duration::from_secs(15) }
    }
}

/// Settings of the server.
#[derive(Clone, Debug)]
pub struct WebServerSettings {
    /// Address to listen on; port 0 is any free port.
    pub address: SocketAddr,
    /// Token for other machines; required if they can reach the server.
    pub token: Option<String>,
}

/// The HTTP and WebSocket server, open until this is dropped.
///
/// One thread serves all HTTP connections; each WebSocket has two further threads.
#[derive(Debug)]
pub struct WebServer {
    address: SocketAddr,
    token: Option<String>,
    state: Arc<ServerState>,
    /// Ends the thread of the listener.
    close: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// State shared by all connections.
#[derive(Debug)]
pub(crate) struct ServerState {
    pub(crate) hub: Arc<Hub>,
    pub(crate) authorization: Authorization,
    pub(crate) token_rate_limit: TokenRateLimit,
    pub(crate) is_closing: AtomicBool,
    pub(crate) limits: HttpLimits,
    connections: AtomicUsize,
}

impl WebServer {
    /// Starts listening.
    ///
    /// # Errors
    /// When the port is in use, or the address is reachable from other machines and the
    /// token is missing or too short.
    pub fn open(hub: Arc<Hub>, settings: WebServerSettings) -> io::Result<Self> {
        Self::open_within(hub, settings, HttpLimits::default())
    }

    fn open_within(
        hub: Arc<Hub>,
        settings: WebServerSettings,
        limits: HttpLimits,
    ) -> io::Result<Self> {
        let WebServerSettings { address, token } = settings;
        let is_loopback = address.ip().is_loopback();
        if !is_loopback && token.as_ref().is_none_or(String::is_empty) {
            let why = format!("{address} is reachable from other machines, which requires a token");
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        if !is_loopback && token.as_ref().is_some_and(|token| is_short(token)) {
            let why = format!(
                "the token is too short for {address}, which other machines can reach: it needs \
                 {MIN_TOKEN_CHARACTERS} characters or more; without `--token` one is made"
            );
            return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
        }
        let listener = TcpListener::bind(address)?;
        let address = listener.local_addr()?;
        let authorization = Authorization { is_loopback, token: token.clone() };
        let state = Arc::new(ServerState {
            hub,
            authorization,
            token_rate_limit: TokenRateLimit::default(),
            is_closing: AtomicBool::new(false),
            limits,
            connections: AtomicUsize::new(0),
        });
        let own = state.clone();
        let (close, closed) = oneshot::channel();
        listener.set_nonblocking(true)?;
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let listener = {
            let _context = runtime.enter();
            tokio::net::TcpListener::from_std(listener)?
        };
        let builder = std::thread::Builder::new().name("server".to_owned());
        let thread = builder.spawn(move || {
            runtime.spawn(accept(listener, own));
            // Dropping the runtime then closes the listener and all HTTP connections.
            let _ = runtime.block_on(closed);
        })?;
        Ok(Self { address, token, state, close: Some(close), thread: Some(thread) })
    }

    /// Address of the listener.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// URL for a browser.
    #[must_use]
    pub fn url(&self) -> String {
        let (ip, port) = (self.address.ip(), self.address.port());
        let host = match ip {
            _ if ip.is_unspecified() => "127.0.0.1".to_owned(),
            std::net::IpAddr::V6(ip) => format!("[{ip}]"),
            std::net::IpAddr::V4(ip) => ip.to_string(),
        };
        match &self.token {
            Some(token) if !ip.is_loopback() => {
                format!("http://{host}:{port}/?token={}", encoded(token))
            }
            _ => format!("http://{host}:{port}/"),
        }
    }
}

impl Drop for WebServer {
    fn drop(&mut self) {
        self.state.is_closing.store(true, Ordering::Release);
        drop(self.close.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn is_short(token: &str) -> bool {
    token.chars().count() < MIN_TOKEN_CHARACTERS
}

/// A counted connection, until this is dropped.
pub(crate) struct ConnectionSlot(Arc<ServerState>);

impl ConnectionSlot {
    /// Counts a connection; none if there are too many.
    fn new(state: &Arc<ServerState>) -> Option<Self> {
        let before = state.connections.fetch_add(1, Ordering::AcqRel);
        let slot = Self(state.clone());
        (before < state.limits.connections).then_some(slot)
    }

    pub(crate) fn state(&self) -> &ServerState {
        &self.0
    }
}

impl Drop for ConnectionSlot {
    fn drop(&mut self) {
        self.0.connections.fetch_sub(1, Ordering::AcqRel);
    }
}

/// Accepts connections until the runtime is dropped.
async fn accept(listener: tokio::net::TcpListener, state: Arc<ServerState>) {
    loop {
        let Ok((stream, from)) = listener.accept().await else {
            // Too many open files, or the client has left.
            tokio::time::sleep(Duration::from_millis(20)).await;
            continue;
        };
        if let Some(slot) = ConnectionSlot::new(&state)
            && stream.set_nodelay(true).is_ok()
        {
            tokio::spawn(connection::serve(stream, from.ip(), slot));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};
    use std::net::TcpStream;

    use periplus_graph::Graph;
    use periplus_os::{Stopwatch, sleep};

    use super::*;
    use crate::foxglove::{ClientLimits, Settings};

    const LONG: Duration = Duration::from_secs(20);
    const SHORT: Duration = Duration::from_millis(400);

    fn server(limits: HttpLimits, stalled: Duration) -> WebServer {
        let clients = ClientLimits { stalled, ..ClientLimits::default() };
        let settings = Settings { limits: clients, ..Settings::default() };
        let hub = Arc::new(Hub::open(&Graph::live(), settings).expect("a hub"));
        let address = "127.0.0.1:0".parse().expect("an address");
        let settings = WebServerSettings { address, token: None };
        WebServer::open_within(hub, settings, limits).expect("a server")
    }

    fn connect(server: &WebServer) -> TcpStream {
        let stream = TcpStream::connect(server.address()).expect("a connection");
        stream.set_read_timeout(Some(LONG)).expect("a timeout");
        stream
    }

    /// Reads until the server closes the connection.
    fn read(stream: &mut TcpStream) -> String {
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("it is closed");
        String::from_utf8_lossy(&bytes).into_owned()
    }

    #[track_caller]
    fn eventually(mut holds: impl FnMut() -> bool) {
        let since = Stopwatch::start();
        while !holds() {
            assert!(since.elapsed() < LONG);
            sleep(Duration::from_millis(10));
        }
    }

    #[test]
    fn a_head_sent_byte_by_byte_times_out() {
        let limits = HttpLimits { head_timeout: SHORT, ..HttpLimits::default() };
        let server = server(limits, LONG);
        let mut stream = connect(&server);
        let since = Stopwatch::start();
        let mut head = b"GET / HTTP/1.1\r\nX: ".iter().chain(std::iter::repeat(&b'x'));
        while server.state.connections.load(Ordering::Acquire) > 0 || since.elapsed() < SHORT / 2 {
            let _ = stream.write_all(&[*head.next().expect("without end")]);
            sleep(Duration::from_millis(20));
            assert!(since.elapsed() < LONG, "it is still there");
        }
        assert!(since.elapsed() >= SHORT);
    }

    #[test]
    fn an_idle_connection_is_closed() {
        let limits = HttpLimits { head_timeout: SHORT, ..HttpLimits::default() };
        let server = server(limits, LONG);
        let mut stream = connect(&server);
        stream.write_all(b"HEAD / HTTP/1.1\r\n\r\n").expect("it is sent");
        assert!(read(&mut stream).starts_with("HTTP/1.1 200 OK\r\n"));
    }

    #[test]
    fn the_requests_of_a_connection_are_limited() {
        let server = server(HttpLimits { requests: 3, ..HttpLimits::default() }, LONG);
        let mut stream = connect(&server);
        stream.write_all(&b"HEAD / HTTP/1.1\r\n\r\n".repeat(4)).expect("they are sent");
        let mut answers = String::new();
        let _ = stream.read_to_string(&mut answers);
        assert_eq!(answers.matches("HTTP/1.1 200 OK").count(), 3, "{answers}");
        assert_eq!(answers.matches("Connection: close").count(), 1, "{answers}");
    }

    #[test]
    fn connections_over_the_limit_are_closed() {
        let server = server(HttpLimits { connections: 2, ..HttpLimits::default() }, LONG);
        let held = [connect(&server), connect(&server)];
        eventually(|| server.state.connections.load(Ordering::Acquire) == 2);
        assert_eq!(read(&mut connect(&server)), "");
        drop(held);
        eventually(|| server.state.connections.load(Ordering::Acquire) == 0);
        let mut stream = connect(&server);
        stream.write_all(b"HEAD / HTTP/1.0\r\n\r\n").expect("it is sent");
        assert!(read(&mut stream).contains(" 200 OK\r\n"));
    }

    #[test]
    fn a_client_that_never_reads_is_disconnected() {
        let server = server(HttpLimits::default(), SHORT);
        let mut stream = connect(&server);
        stream.set_write_timeout(Some(SHORT)).expect("a timeout");
        // More answers than the buffers of the system hold.
        for _ in 0..900 {
            let _ = stream.write(&b"GET /none HTTP/1.1\r\n\r\n".repeat(1000));
            if server.state.connections.load(Ordering::Acquire) == 0 {
                break;
            }
        }
        eventually(|| server.state.connections.load(Ordering::Acquire) == 0);
    }
}
