//! One port with the page and the socket behind it.
//!
//! A [`Server`] listens on one address. Who asks by HTTP gets the files of the page, which are part of
//! the program; who asks for a WebSocket becomes a client of a [`Hub`](crate::foxglove::Hub). Without a token only this
//! machine is heard, and of its browsers only pages that came from it: see [`Door`].

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
