//! `topic`.

mod echo;
mod list;
mod publish;
mod rates;

pub use echo::{TopicEchoOptions, echo};
pub use list::{TopicListOptions, find, info, list, type_of};
pub use publish::{Publish, publish};
pub use rates::{Rate, bandwidth, delay, hz};
