//! Nodes of `nav2_map_server` that serve and save maps: [`MapServer`] and [`MapSaver`]. The file
//! formats are in `periplus-maps`.

mod saver;
mod server;

pub use saver::{MAP_SAVER, MapSaver, MapSaverParams};
pub use server::{MAP_SERVER, MapServer, MapServerParams};
