//! Recordings over the protocol, without sockets.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files")]

mod client;
mod fetch;
mod hostile;
mod live;
mod marks;
mod run;
mod upload;
