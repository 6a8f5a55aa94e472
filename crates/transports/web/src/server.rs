//! HTTP and WebSocket server for the viewer page.
//!
//! A [`WebServer`] listens on one address. HTTP requests get the files of the page, which are part of
//! the program; WebSocket connections become clients of a [`Hub`](crate::foxglove::Hub). Without a
//! token only this machine is admitted, and of its browsers only pages that came from it: see
//! [`Authorization`].

mod authority;
mod authorization;
mod connection;
mod frame;
mod http;
mod listener;
mod page;
mod socket;
mod timeout_stream;
mod token;
mod token_rate_limit;

pub use authorization::{AdmissionError, Authorization};
pub use connection::bounded_http;
pub use listener::{WebServer, WebServerSettings};
pub use page::embedded_page;
pub use token::{MIN_TOKEN_CHARACTERS, TokenError, token};
