//! Resolution of URIs to files. All access to the machine uses [`Host`].

mod crawl;
mod data_files;
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

pub use host::{EntryKind, FileReadError, FileWriteError, Host, MAX_FILE_BYTES, Store};
pub use layout::{in_sources, package_of};
pub use manifest::package_name;
pub use memory::MemoryHost;
pub use miss::{ResolveError, ResolveErrorKind};
pub use nearest::nearest;
pub use places::SEARCH_VARIABLES;
pub use resolver::Resolver;
