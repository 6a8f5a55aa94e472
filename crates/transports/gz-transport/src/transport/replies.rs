//! Sending of service responses. One thread sends them, so that an unreachable client blocks no
//! server.

use std::collections::BTreeMap;
use std::io::{self, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use super::shared::{Shared, thread};
use super::{listener, zmtp};

/// Timeout of a connection attempt.
const CONNECT: Duration = Duration::from_millis(500);

/// Maximum number of connections kept for later responses.
const MOST_KEPT: usize = 64;

/// A response to send.
pub(super) enum Reply {
    /// Receiver and bytes.
    To(SocketAddr, Vec<u8>),
    /// Ends the thread.
    End,
}

pub(super) fn channel() -> (Sender<Reply>, Receiver<Reply>) {
    std::sync::mpsc::channel()
}

pub(super) fn start(shared: &Arc<Shared>, waiting: Receiver<Reply>) -> JoinHandle<()> {
    let shared = shared.clone();
    thread("gz-answer", move || {
        let mut kept: BTreeMap<SocketAddr, TcpStream> = BTreeMap::new();
        for reply in waiting {
            let Reply::To(to, bytes) = reply else { return };
            // An unreachable client has left.
            let known = kept.remove(&to).filter(is_open);
            let sent = match known {
                Some(stream) => send(stream, &bytes),
                None => connect(&shared, to).and_then(|stream| send(stream, &bytes)),
            };
            if kept.len() == MOST_KEPT {
                kept.pop_first();
            }
            if let Ok(stream) = sent {
                kept.insert(to, stream);
            }
        }
    })
}

fn connect(shared: &Shared, to: SocketAddr) -> io::Result<TcpStream> {
    let mut stream = TcpStream::connect_timeout(&to, CONNECT)?;
    listener::greet(&mut stream, zmtp::Kind::Router, &shared.replier)?;
    stream.set_write_timeout(Some(CONNECT))?;
    Ok(stream)
}

fn send(mut stream: TcpStream, bytes: &[u8]) -> io::Result<TcpStream> {
    stream.write_all(bytes)?;
    Ok(stream)
}

/// True if the peer has not closed the connection; it sends nothing.
fn is_open(stream: &TcpStream) -> bool {
    if stream.set_nonblocking(true).is_err() {
        return false;
    }
    let is_quiet = match stream.peek(&mut [0]) {
        Ok(length) => length > 0,
        Err(error) => error.kind() == io::ErrorKind::WouldBlock,
    };
    is_quiet && stream.set_nonblocking(false).is_ok()
}
