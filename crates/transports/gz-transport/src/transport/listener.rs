//! Accepts TCP connections.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_transport::Since;

use super::shared::{Shared, thread};
use super::zmtp;

/// Handler of a connection after the handshake.
pub(super) type Meet = fn(&Arc<Shared>, TcpStream);

/// Pause after a failed accept, which may be caused by too many open files.
const PAUSE: Duration = Duration::from_millis(50);

pub(super) fn start(
    shared: &Arc<Shared>,
    name: &'static str,
    listener: TcpListener,
    (kind, identity): (zmtp::Kind, String),
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
            let greeting = shared.begin_greeting(&admitted);
            let (shared, identity, mut stream) = (shared.clone(), identity.clone(), stream);
            thread(name, move || {
                let outcome = greet(&mut stream, kind, &identity);
                drop(greeting);
                if outcome.is_ok() {
                    meet(&shared, stream);
                }
                drop(admitted);
            });
        }
    })
}

/// Timeout of the handshake.
pub(super) const PATIENCE: Duration = Duration::from_secs(5);

/// Configures a connection and performs the handshake.
pub(super) fn greet(
    stream: &mut TcpStream,
    kind: zmtp::Kind,
    identity: &str,
) -> std::io::Result<()> {
    stream.set_nodelay(true)?;
    let mut limited = Limited { stream, clock: Since::now(), patience: PATIENCE };
    zmtp::shake_hands(&mut limited, kind, identity.as_bytes())?;
    stream.set_read_timeout(None)
}

/// A connection whose reads share one timeout.
struct Limited<'a> {
    stream: &'a mut TcpStream,
    clock: Since,
    patience: Duration,
}

impl Read for Limited<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let left = self.patience.saturating_sub(self.clock.elapsed());
        if left.is_zero() {
            return Err(std::io::ErrorKind::TimedOut.into());
        }
        self.stream.set_read_timeout(Some(left))?;
        self.stream.read(buffer)
    }
}

impl Write for Limited<'_> {
    fn write(&mut self, buffer: &[u8]) -> std::io::Result<usize> {
        self.stream.write(buffer)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.stream.flush()
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "tests of a network wait for it")]
mod tests {
    use std::io::ErrorKind;

    use super::super::{shared, sockets};
    use super::*;
    use crate::Settings;

    #[test]
    fn silent_connections_make_few_threads_and_shut_nobody_out() {
        let settings = Settings { partition: "greetings".into(), ..Settings::default() };
        let (shared, threads) = shared::open(&settings).unwrap();
        let address = sockets::address(&shared.publishing).unwrap();
        let mut silent: Vec<TcpStream> =
            (0..200).map(|_| TcpStream::connect(address).unwrap()).collect();
        // A peer that sends its greeting is served in spite of the silent ones.
        let mut subscriber = TcpStream::connect(address).unwrap();
        greet(&mut subscriber, zmtp::Kind::Sub, "").unwrap();
        let is_open = |stream: &mut TcpStream| {
            stream.set_nonblocking(true).unwrap();
            let mut bytes = [0; 128];
            loop {
                match stream.read(&mut bytes) {
                    Ok(0) => return false,
                    Ok(_) => {}
                    Err(error) => return error.kind() == ErrorKind::WouldBlock,
                }
            }
        };
        let mut open = usize::MAX;
        for _ in 0..100 {
            open = silent.iter_mut().filter_map(|one| is_open(one).then_some(())).count();
            if open <= 40 {
                break;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(open <= 40, "{open} silent connections are open");
        assert!(is_open(&mut subscriber));
        shared.close();
        threads.into_iter().for_each(|thread| thread.join().unwrap());
    }

    #[test]
    fn a_greeting_in_drops_ends_in_time() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let dripping = std::thread::spawn(move || {
            let mut stream = TcpStream::connect(address).unwrap();
            // Until the peer closes the connection.
            (0..50)
                .take_while(|_| {
                    std::thread::sleep(Duration::from_millis(20));
                    stream.write_all(&[0xff]).is_ok()
                })
                .count()
        });
        let (mut stream, _) = listener.accept().unwrap();
        let patience = Duration::from_millis(200);
        let mut limited = Limited { stream: &mut stream, clock: Since::now(), patience };
        let error = limited.read_exact(&mut [0; 64]).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock), "{error}");
        drop(stream);
        assert!(dripping.join().unwrap() < 50);
    }
}
