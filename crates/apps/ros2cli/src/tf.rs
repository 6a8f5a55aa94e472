//! `tf`: transforms, as with `view_frames`, `tf2_echo`, `tf2_monitor` and
//! `static_transform_publisher`.

mod broadcast;
mod echo;
mod listen;
mod monitor;
mod tree;

pub use broadcast::{Broadcast, broadcast, read_broadcast};
pub use echo::{TfEchoOptions, echo};
pub use listen::stamped;
pub use monitor::{Monitor, monitor};
pub use tree::{Pictures, Tree, put_tree, tree};
