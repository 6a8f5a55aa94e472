//! The page in a browser and other programs that read Foxglove's WebSocket protocol.
//!
//! [`foxglove`] is the protocol over a graph, without sockets; [`server`] is the port: HTTP, the files of
//! the page, WebSocket and authorization.
//!
//! ```
//! use std::sync::Arc;
//!
//! use periplus_graph::Graph;
//! use periplus_web::foxglove::{Hub, Settings};
//! use periplus_web::server::{WebServer, WebServerSettings};
//!
//! let hub = Arc::new(Hub::open(&Graph::live(), Settings::default())?);
//! let settings = WebServerSettings { address: "127.0.0.1:0".parse()?, token: None };
//! let server = WebServer::open(hub, settings)?;
//! assert!(server.url().starts_with("http://127.0.0.1:"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod foxglove;
#[cfg(not(target_family = "wasm"))]
pub mod server;
