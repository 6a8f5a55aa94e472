//! Resolution of URIs to files. All access to the machine uses [`Host`].
//!
//! ```
//! use std::path::Path;
//!
//! use periplus_resources::{MemoryHost, Resolver};
//!
//! let host = MemoryHost::new()
//!     .with_file("/ws/cart/package.xml", "<package><name>cart</name></package>")
//!     .with_file("/ws/cart/meshes/wheel.stl", "solid wheel");
//! let resolver = Resolver::new(&host, &["/ws".into()]);
//! let file = resolver.resolve("package://cart/meshes/wheel.stl", Path::new("/home"));
//! assert_eq!(file.expect("the mesh"), Path::new("/ws/cart/meshes/wheel.stl"));
//! ```

mod crawl;
mod data_files;
mod dots;
mod fuel;
mod hooks;
mod host;
mod layout;
mod manifest;
mod memory;
mod miss;
mod nearest;
mod places;
mod resolver;
mod surroundings;
mod uri;

pub use dots::without_dots;
pub use host::{EntryKind, FileReadError, FileWriteError, Host, MAX_FILE_BYTES, Store};
pub use layout::{in_sources, package_of};
pub use manifest::package_name;
pub use memory::MemoryHost;
pub use miss::{ResolveError, ResolveErrorKind};
pub use nearest::nearest;
pub use places::SEARCH_VARIABLES;
pub use resolver::Resolver;
