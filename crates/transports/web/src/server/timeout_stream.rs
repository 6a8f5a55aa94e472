//! Writes with a timeout for clients that read nothing.

use std::io::{self, IoSlice, Write};
use std::net::TcpStream;
use std::time::Duration;

use periplus_os::Stopwatch;

/// Maximum wait of one system call. It is short because a call that has written a part of the bytes
/// returns only after its full wait.
const CALL_WAIT: Duration = Duration::from_millis(250);

/// A stream whose writes fail once the client has read nothing for a while.
pub(crate) struct TimeoutStream<'a> {
    stream: &'a TcpStream,
    patience: Duration,
}

impl<'a> TimeoutStream<'a> {
    pub(crate) fn new(stream: &'a TcpStream, patience: Duration) -> io::Result<Self> {
        stream.set_write_timeout(Some(CALL_WAIT.min(patience)))?;
        Ok(Self { stream, patience })
    }

    fn wait(&self, mut call: impl FnMut() -> io::Result<usize>) -> io::Result<usize> {
        let since = Stopwatch::start();
        loop {
            match call() {
                Err(error) if is_late(&error) && since.elapsed() < self.patience => {}
                result => return result,
            }
        }
    }
}

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

impl Write for TimeoutStream<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut stream = self.stream;
        self.wait(|| stream.write(bytes))
    }

    fn write_vectored(&mut self, parts: &[IoSlice<'_>]) -> io::Result<usize> {
        let mut stream = self.stream;
        self.wait(|| stream.write_vectored(parts))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
