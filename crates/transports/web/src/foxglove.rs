//! A graph as Foxglove's WebSocket protocol has it, version 1: topics are channels of CDR with
//! `ros2msg` schemas, services are services, parameters are parameters.
//!
//! A [`Hub`] stands between one graph and any number of clients. Each client is a [`Session`]: what it
//! sends goes in ([`Session::text`], [`Session::binary`]), what it is to get waits in its [`Outbox`].
//! Nothing here knows sockets; the bytes of messages are shared with all others who hear them.
//!
//! Who is slow loses what is old and not what is latched, and holds up nobody: see [`Outbox`].
//!
//! Source: `docs/ws-protocol/spec.md` of `foxglove/ws-protocol`.

mod far;
mod frame;
mod grid;
mod hub;
mod outbox;
mod outgoing;
pub mod protocol;
mod recent_frames;
mod session;
mod settings;

pub use far::{Far, FarEnd, FarService, FarTopic};
pub use frame::{Frame, Kind};
pub use hub::Hub;
pub use outbox::{Outbox, Taken};
pub use session::Session;
pub use settings::{Limits, Settings};
