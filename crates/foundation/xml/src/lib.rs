//! XML trees in which every node knows the place it came from.
//!
//! The reader is as lenient as TinyXML-2, which Gazebo reads with, where that loses nothing:
//! undeclared prefixes, double hyphens in comments, bare ampersands. Everything it forgives is a
//! warning. Depth, entity expansion and encodings are bounded; external entities are never read.

mod canonical;
mod decode;
mod entities;
mod read;
mod tree;
mod write;

pub use canonical::canonical;
pub use decode::decode;
pub use read::{DEEPEST, parse};
pub use smol_str::SmolStr;
pub use tree::{Attribute, Document, Element, Node, Text};
pub use write::{write_document, write_element};
