//! Takes connections of others.

use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use super::shared::{Shared, thread};

/// What to do with a connection.
pub(super) type Meet = fn(&Arc<Shared>, TcpStream);

/// After a failure the next connection is waited for so long: there may be too many open.
const PAUSE: Duration = Duration::from_millis(50);

pub(super) fn start(
    shared: &Arc<Shared>,
    name: &'static str,
    listener: TcpListener,
    meet: Meet,
) -> JoinHandle<()> {
    let shared = shared.clone();
    thread(name, move || {
        loop {
            let accepted = listener.accept();
            if shared.is_closing() {
                return;
            }
            let Ok((stream, from)) = accepted else {
                std::thread::sleep(PAUSE);
                continue;
            };
            if !shared.ways.is_for(from) {
                continue;
            }
            let Some(admitted) = shared.admit(&stream) else { continue };
            let shared = shared.clone();
            thread(name, move || {
                meet(&shared, stream);
                drop(admitted);
            });
        }
    })
}

/// How long the other side may take to say what it is.
pub(super) const PATIENCE: Duration = Duration::from_secs(5);

/// Makes a connection ready, and shakes hands on it.
pub(super) fn greet(
    stream: &mut TcpStream,
    kind: super::zmtp::Kind,
    identity: &str,
) -> std::io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    super::zmtp::shake_hands(stream, kind, identity.as_bytes())?;
    stream.set_read_timeout(None)
}
