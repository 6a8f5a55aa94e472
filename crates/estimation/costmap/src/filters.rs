//! Filters: layers over all others, that follow a mask drawn by somebody.

mod binary;
mod keepout;
mod mask;
mod speed;

pub use binary::BinaryFilter;
pub use keepout::KeepoutFilter;
pub use mask::{FilterInfo, FilterKind, Mask, Masked};
pub use speed::{SpeedFilter, SpeedLimit};
