//! HTTP and WebSocket server for the viewer page.
//!
//! A [`Server`] listens on one address. HTTP requests get the files of the page, which are part of
//! the program; WebSocket connections become clients of a [`Hub`](crate::foxglove::Hub). Without a
//! token only this machine is admitted, and of its browsers only pages that came from it: see
//! [`Door`].

mod admit;
mod authority;
mod frame;
mod guesses;
mod http;
mod listener;
mod page;
mod patient;
mod socket;
mod token;

pub use admit::{Door, Refused};
pub use http::{Head, HeadError, LONGEST_HEAD};
pub use listener::{Server, ServerSettings};
pub use token::{MIN_TOKEN_CHARACTERS, token};
