//! The listening server.

use std::io;
use std::net::{Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::foxglove::Hub;

use crate::server::authorization::Authorization;
use crate::server::socket;
use crate::server::token::{MIN_TOKEN_CHARACTERS, encoded};
use crate::server::token_rate_limit::TokenRateLimit;

/// Maximum number of connections; each has a thread.
const MOST_CONNECTIONS: usize = 256;

/// Settings of the server.
#[derive(Clone, Debug)]
pub struct WebServerSettings {
    /// Address to listen on; port 0 is any free port.
    pub address: SocketAddr,
    /// Token for other machines; required if they can reach the server.
    pub token: Option<String>,
}

/// The HTTP and WebSocket server, open until this is dropped.
#[derive(Debug)]
pub struct WebServer {
    address: SocketAddr,
    token: Option<String>,
    room: Arc<Room>,
    thread: Option<JoinHandle<()>>,
}

/// State shared by all connections.
#[derive(Debug)]
pub(crate) struct Room {
    pub(crate) hub: Arc<Hub>,
    pub(crate) authorization: Authorization,
    pub(crate) token_rate_limit: TokenRateLimit,
    pub(crate) is_closing: AtomicBool,
    connections: AtomicUsize,
}

impl WebServer {
    /// Starts listening.
    ///
    /// # Errors
    /// When the port is in use, or the address is reachable from other machines and the
    /// token is missing or too short.
    pub fn open(hub: Arc<Hub>, settings: WebServerSettings) -> io::Result<Self> {
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
        let room = Arc::new(Room {
            hub,
            authorization,
            token_rate_limit: TokenRateLimit::default(),
            is_closing: AtomicBool::new(false),
            connections: AtomicUsize::new(0),
        });
        let own = room.clone();
        let builder = std::thread::Builder::new().name("server".to_owned());
        let thread = builder.spawn(move || accept(&listener, &own))?;
        Ok(Self { address, token, room, thread: Some(thread) })
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
        self.room.is_closing.store(true, Ordering::Release);
        // A connection wakes the accepting thread.
        let own = match self.address {
            SocketAddr::V4(_) => SocketAddr::from(([127, 0, 0, 1], self.address.port())),
            SocketAddr::V6(_) => SocketAddr::from((Ipv6Addr::LOCALHOST, self.address.port())),
        };
        let knock = if self.address.ip().is_unspecified() { own } else { self.address };
        let came = TcpStream::connect_timeout(&knock, Duration::from_secs(1));
        if let (Ok(_), Some(thread)) = (came, self.thread.take()) {
            let _ = thread.join();
        }
    }
}

fn is_short(token: &str) -> bool {
    token.chars().count() < MIN_TOKEN_CHARACTERS
}

/// A counted connection, until this is dropped.
struct Place(Arc<Room>);

impl Drop for Place {
    fn drop(&mut self) {
        self.0.connections.fetch_sub(1, Ordering::AcqRel);
    }
}

fn accept(listener: &TcpListener, room: &Arc<Room>) {
    loop {
        let came = listener.accept();
        if room.is_closing.load(Ordering::Acquire) {
            return;
        }
        let Ok((stream, _)) = came else {
            // Too many open files, or the client has left.
            periplus_os::sleep(Duration::from_millis(20));
            continue;
        };
        let before = room.connections.fetch_add(1, Ordering::AcqRel);
        let place = Place(room.clone());
        if before >= MOST_CONNECTIONS {
            continue;
        }
        let builder = std::thread::Builder::new().name("connection".to_owned());
        let _ = builder.spawn(move || {
            let _ = socket::serve(stream, &place.0);
        });
    }
}
