//! ROS interface texts (`.msg`, `.srv`, `.action`): parser, type hashes, schema texts, and Rust code
//! generation.
//!
//! [`parse()`] reads one text; a [`Registry`] holds many, adds the types implied by services and actions,
//! and returns for each type its definition, all types that it refers to, its [`Registry::hash`] and its
//! [`Registry::schema_text`]; [`Registry::ros1_text`] returns its definition and MD5 sum for ROS 1.
//! [`rust::package`] generates the Rust code of one package.

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
