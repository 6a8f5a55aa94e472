//! `topic`.

mod echo;
mod list;
mod publish;
mod rates;

pub use echo::{Echo, echo};
pub use list::{List, find, info, list, type_of};
pub use publish::{Publish, publish};
pub use rates::{Rate, bandwidth, delay, hz};
