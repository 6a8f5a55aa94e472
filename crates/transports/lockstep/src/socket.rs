//! The socket between a graph and a process: of the Unix domain where there is one, else TCP on the loopback.

use std::io;

#[cfg(unix)]
pub(crate) use unix::{Listener, Stream};

#[cfg(not(unix))]
pub(crate) use tcp::{Listener, Stream};

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::DirBuilderExt as _;
    use std::os::unix::net::{UnixListener, UnixStream};
    use std::path::PathBuf;
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::io;

    pub(crate) type Stream = UnixStream;

    static COUNT: AtomicU64 = AtomicU64::new(0);

    /// Socket in a folder that only this user can enter.
    pub(crate) struct Listener {
        pub(crate) listener: UnixListener,
        folder: PathBuf,
    }

    impl Listener {
        pub(crate) fn open() -> io::Result<Self> {
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let name = format!("periplus-{}-{number}", std::process::id());
            let folder = std::env::temp_dir().join(name);
            // A crashed program of the same number may have left one.
            let _ = std::fs::remove_dir_all(&folder);
            std::fs::DirBuilder::new().mode(0o700).create(&folder)?;
            let listener = UnixListener::bind(folder.join("step"))?;
            listener.set_nonblocking(true)?;
            Ok(Self { listener, folder })
        }

        pub(crate) fn address(&self) -> String {
            self.folder.join("step").display().to_string()
        }

        pub(crate) fn accept(&self) -> io::Result<Stream> {
            let (stream, _) = self.listener.accept()?;
            stream.set_nonblocking(false)?;
            Ok(stream)
        }
    }

    impl Drop for Listener {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.folder);
        }
    }

    pub(crate) fn connect(address: &str) -> io::Result<Stream> {
        UnixStream::connect(address)
    }
}

#[cfg(not(unix))]
mod tcp {
    use std::net::{TcpListener, TcpStream};

    use super::io;

    pub(crate) type Stream = TcpStream;

    pub(crate) struct Listener {
        listener: TcpListener,
    }

    impl Listener {
        pub(crate) fn open() -> io::Result<Self> {
            let listener = TcpListener::bind("127.0.0.1:0")?;
            listener.set_nonblocking(true)?;
            Ok(Self { listener })
        }

        pub(crate) fn address(&self) -> String {
            self.listener.local_addr().map(|it| it.to_string()).unwrap_or_default()
        }

        pub(crate) fn accept(&self) -> io::Result<Stream> {
            let (stream, _) = self.listener.accept()?;
            stream.set_nonblocking(false)?;
            stream.set_nodelay(true)?;
            Ok(stream)
        }
    }

    pub(crate) fn connect(address: &str) -> io::Result<Stream> {
        let stream = TcpStream::connect(address)?;
        stream.set_nodelay(true)?;
        Ok(stream)
    }
}

/// Time for which a read polls before it sleeps: a process that answers at once costs no change of
/// threads.
#[cfg(unix)]
const SPIN: std::time::Duration = std::time::Duration::from_micros(50);

/// Something that bytes come from.
pub(crate) trait Source {
    /// Reads at least one byte; none at the end.
    fn receive(&mut self, buffer: &mut [u8]) -> io::Result<usize>;
}

impl Source for Stream {
    /// Reads, at first without sleeping.
    fn receive(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        #[cfg(unix)]
        {
            use rustix::net::{RecvFlags, recv};
            let start = periplus_transport::Since::now();
            while start.elapsed() < SPIN {
                match recv(&*self, &mut *buffer, RecvFlags::DONTWAIT) {
                    Ok((count, _)) => return Ok(count),
                    Err(rustix::io::Errno::AGAIN) => std::thread::yield_now(),
                    Err(error) => return Err(error.into()),
                }
            }
        }
        io::Read::read(self, buffer)
    }
}

/// Connects to the socket of a graph.
pub(crate) fn connect(address: &str) -> io::Result<Stream> {
    #[cfg(unix)]
    return unix::connect(address);
    #[cfg(not(unix))]
    tcp::connect(address)
}
