//! Foxglove WebSocket protocol, version 1, for a graph: topics are channels of CDR with `ros2msg`
//! schemas; services and parameters map to those of the protocol.
//!
//! A [`Hub`] connects one graph with any number of clients. Each client is a [`ClientSession`]: messages
//! from the client go into [`ClientSession::text`] and [`ClientSession::binary`], messages to it wait in its
//! [`Outbox`]. There are no sockets here; message bytes are shared with all other subscribers.
//!
//! A slow client loses old messages, but no latched ones, and blocks no other client: see
//! [`Outbox`].
//!
//! Source: `docs/ws-protocol/spec.md` of `foxglove/ws-protocol`.

mod fetch_queue;
mod frame;
mod grid;
mod hub;
mod mesh_requests;
mod network_endpoints;
mod outbox;
mod outgoing;
pub mod protocol;
mod recent_frames;
mod recordings;
mod session;
mod settings;

pub use frame::{FrameKind, WebSocketFrame};
pub use hub::Hub;
pub use network_endpoints::{NetworkEndpoint, NetworkEndpoints, NetworkService, NetworkTopic};
pub use outbox::{Outbox, OutboxItem};
pub use recordings::{
    JobError, JobRequest, Jobs, OpenRecordingError, RecordingSettings, Recordings,
};
pub use session::ClientSession;
pub use settings::{ClientLimits, Settings};
