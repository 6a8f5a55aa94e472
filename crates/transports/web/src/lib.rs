//! The page in a browser and other programs that read Foxglove's WebSocket protocol.
//!
//! [`foxglove`] is the protocol over a graph, without sockets; [`server`] is the port: HTTP, the files of
//! the page, WebSocket and authorization.

pub mod foxglove;
pub mod server;
