//! ROS interface texts (`.msg`, `.srv`, `.action`): what they say, the hash and the schema text
//! that belong to each type, and Rust code for them.
//!
//! [`parse()`] reads one text; a [`Registry`] holds many, knows the types that services and actions
//! imply, and answers for a type: its definition, everything it refers to, its [`Registry::hash`]
//! and its [`Registry::schema_text`]; [`Registry::ros1_text`] is what ROS 1 knows a type by. [`rust::package`] writes one package as Rust.

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

pub use definition::{Constant, Definition, Element, Field, Scalar, Shape, Type};
pub use expand::{Interface, expand};
pub use hash::TypeNumbers;
pub use literal::Literal;
pub use name::{Kind, TypeName};
pub use parse::{Dialect, LARGEST_TEXT, parse};
pub use registry::Registry;
pub use ros1::Ros1Text;
pub use schema::SEPARATOR;
