//! Types that are known only when the program runs.

mod adapt;
mod layout;
mod registry;
mod value;

pub use adapt::Adaptation;
pub use layout::Layout;
pub use registry::TypeRegistry;
pub use value::{DynamicMessage, Value};

pub(crate) use layout::{Element, Shape};
