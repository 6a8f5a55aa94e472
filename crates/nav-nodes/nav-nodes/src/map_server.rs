//! Nodes that serve and save maps, as `nav2_map_server` has them: [`MapServer`] and
//! [`MapSaver`]. What is in the files is known to `periplus-maps`; here is who is told, under which
//! name.

mod saver;
mod server;

pub use saver::{MAP_SAVER, MapSaver, WAIT_NS};
pub use server::{MAP_SERVER, MapServer, MapServerSettings};
