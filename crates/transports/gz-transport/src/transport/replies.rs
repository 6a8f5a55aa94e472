//! Answers on their way to who asked. One thread takes them there, so that nobody waits for one who
//! cannot be reached.

use std::collections::BTreeMap;
use std::io::{self, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use super::shared::{Shared, thread};
use super::{listener, zmtp};

/// How long a connection may take to be made.
const CONNECT: Duration = Duration::from_millis(500);

/// So many connections are kept for the next answer.
const MOST_KEPT: usize = 64;

/// An answer to be sent.
pub(super) enum Reply {
    /// To whom, and what.
    To(SocketAddr, Vec<u8>),
    /// It is over.
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
            // Who cannot be reached has gone, and waits for no answer.
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

/// Whether the other side is still there: it says nothing, but its end can be read.
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
