//! Costmap filters: layers on top of all others that apply a mask.

mod binary;
mod keepout;
mod mask;
mod speed;

pub use binary::BinaryFilter;
pub use keepout::KeepoutFilter;
pub use mask::{FilterInfo, FilterKind, FilterMask, MaskFilter};
pub use speed::{SpeedFilter, SpeedLimit};
