//! Map files: a YAML description and an image.
//!
//! [`load`] reads both with the rules of ROS 1, Humble, or Jazzy and later, which differ in the
//! interpretation of pixels ([`Rule`]). [`render`] writes both, byte for byte like the map savers
//! of these distributions. [`compare`] aligns and compares two maps. [`from_message`] and
//! [`to_message`] convert maps from and to messages; [`palette`] has the colours of `RViz`.
//!
//! ```
//! use periplus_maps::{Distro, Status, load};
//! use periplus_resources::MemoryHost;
//!
//! let host = MemoryHost::new()
//!     .with_file("/maps/room.yaml", "image: room.pgm\nresolution: 0.5\norigin: [-1.0, 0, 0]\n\
//!         negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
//!     .with_file("/maps/room.pgm", b"P2 3 1 255 0 205 254");
//! let loaded = load("/maps/room.yaml", Distro::Jazzy, &host);
//! assert_eq!(loaded.status, Status::Success);
//! assert_eq!(loaded.map.unwrap().grid.cells, [100, -1, 0]);
//! ```

mod align;
mod boxes;
mod compare;
mod description;
mod distro;
mod load;
mod message;
mod number;
pub mod palette;
mod rule;
mod save;
mod truth;
mod words;

pub use align::{Alignment, align};
pub use boxes::{MIN_WALL_PERCENT, WallBox, wall_boxes};
pub use compare::{CompareOptions, MapComparison, Overlap, Walls, compare, picture};
pub use description::{Description, read_description};
pub use distro::{Distro, Mode};
pub use load::{Loaded, Map, Status, expand_home, grid_of, load, load_image};
pub use message::{BadMap, from_message, to_message};
pub use rule::Rule;
pub use save::{BadThresholds, Format, MapFiles, PgmRows, Saving, Wish, render, render_yaml};
pub use truth::{BesideTruth, beside_truth, beside_truth_at};
pub use words::{Words, WrongWords, read_words, usage};
