//! Types known only at run time.

mod adapt;
mod layout;
mod part;
mod recoding;
mod registry;
mod value;

pub use adapt::Adaptation;
pub use layout::Layout;
pub use part::Part;
pub use recoding::{RecodeError, Recoding};
pub use registry::TypeRegistry;
pub use value::{DynamicMessage, Value};

pub(crate) use layout::{Element, Shape};
