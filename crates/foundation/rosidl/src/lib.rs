//! ROS interface texts (`.msg`, `.srv`, `.action`): parser, type hashes, schema texts, and Rust code
//! generation.
//!
//! [`parse()`] reads one text; a [`Registry`] holds many, adds the types implied by services and actions,
//! and returns for each type its definition, all types that it refers to, its [`Registry::hash`] and its
//! [`Registry::schema_text`]; [`Registry::ros1_text`] returns its definition and MD5 sum for ROS 1.
//! [`rust::package`] generates the Rust code of one package.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//! use periplus_rosidl::{InterfaceDialect, Registry, TypeName, parse};
//!
//! let mut sources = SourceMap::new();
//! let file = sources.add("String.msg", "string data\n");
//! let name = TypeName::message("std_msgs", "String");
//! let dialect = InterfaceDialect::Ros2;
//! let interface = parse(&name, file, &sources, dialect, &mut Diagnostics::new());
//! let mut registry = Registry::new();
//! registry.add(interface.expect("a message"));
//! let hash = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18";
//! assert_eq!(registry.hash(&name).as_deref(), Some(hash));
//! ```

mod definition;
mod expand;
mod hash;
mod literal;
mod name;
mod parse;
mod registry;
mod ros1;
pub mod rust;
mod schema;

pub use definition::{ArrayShape, Constant, Definition, ElementType, Field, Scalar, Type};
pub use expand::{Interface, expand};
pub use hash::TypeNumbers;
pub use literal::Literal;
pub use name::{InterfaceKind, TypeName};
pub use parse::{InterfaceDialect, MAX_TEXT_BYTES, parse};
pub use registry::Registry;
pub use ros1::Ros1Text;
pub use schema::SEPARATOR;
