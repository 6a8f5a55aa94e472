//! TCPROS: headers and messages with their lengths before them, all little endian.
//!
//! Source: `wiki.ros.org/ROS/TCPROS` and `wiki.ros.org/ROS/Connection Header`.

mod frame;
mod header;
mod publication;
mod service;
mod subscription;

use std::io;
use std::net::TcpStream;
use std::time::Duration;

pub use frame::MAX_MESSAGE_BYTES;
pub(crate) use frame::{Frame, read_frame, read_frame_after};
pub use header::{Header, MAX_HEADER_BYTES, MalformedHeader};
pub(crate) use header::{read_header, read_header_after};
pub(crate) use publication::Publication;
pub(crate) use service::{ServiceConnection, ServiceEnd, Serving};
pub(crate) use subscription::{Receive, Receiver, SourceReport, Subscription};

/// Silence after which the system asks whether the peer of a connection still exists.
const KEEPALIVE: Duration = Duration::from_secs(60);

/// Ends a connection whose peer has vanished without closing it.
fn keep_alive(stream: &TcpStream) -> io::Result<()> {
    let keepalive = socket2::TcpKeepalive::new().with_time(KEEPALIVE);
    socket2::SockRef::from(stream).set_tcp_keepalive(&keepalive)
}
