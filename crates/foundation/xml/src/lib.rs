//! XML trees with source locations.
//!
//! The reader is as lenient as TinyXML-2, which Gazebo uses, where that loses nothing: undeclared prefixes,
//! double hyphens in comments, bare ampersands. Tolerated faults are warnings. Depth, entity expansion and
//! encodings are bounded; external entities are never read.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//!
//! let mut sources = SourceMap::new();
//! let file = sources.add("cart.urdf", "<robot>\n  <link name='wheel'/>\n</robot>");
//! let mut diagnostics = Diagnostics::new();
//! let document = periplus_xml::parse(file, &sources, &mut diagnostics).expect("XML");
//! let link = document.root.child("link").expect("a link");
//! assert_eq!(link.value("name"), Some("wheel"));
//! let span = link.name_origin().0.expect("a location");
//! assert_eq!(sources.locate(span).1.line, 2);
//! ```

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
