//! `tf`: where frames are, as `tf2_echo`, `tf2_monitor` and `static_transform_publisher` tell it.

mod broadcast;
mod echo;
mod listen;
mod monitor;

pub use broadcast::{Broadcast, broadcast, read_broadcast};
pub use echo::{Echo, echo};
pub use monitor::{Monitor, monitor};
