//! XML trees with source locations.
//!
//! The reader is as lenient as TinyXML-2, which Gazebo uses, where that loses nothing: undeclared prefixes,
//! double hyphens in comments, bare ampersands. Tolerated faults are warnings. Depth, entity expansion and
//! encodings are bounded; external entities are never read.

mod canonical;
mod decode;
mod entities;
mod read;
mod tree;
mod write;

pub use canonical::canonical;
pub use decode::{EncodingError, decode};
pub use read::{MAX_DEPTH, parse};
pub use smol_str::SmolStr;
pub use tree::{Attribute, Document, Element, Text, XmlNode};
pub use write::{write_document, write_element};
