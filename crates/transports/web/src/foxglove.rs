//! Foxglove WebSocket protocol, version 1, for a graph: topics are channels of CDR with `ros2msg`
//! schemas; services and parameters map to those of the protocol.
//!
//! A [`Hub`] connects one graph with any number of clients. Each client is a [`Session`]: messages
//! from the client go into [`Session::text`] and [`Session::binary`], messages to it wait in its
//! [`Outbox`]. There are no sockets here; message bytes are shared with all other subscribers.
//!
//! A slow client loses old messages, but no latched ones, and blocks no other client: see
//! [`Outbox`].
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
