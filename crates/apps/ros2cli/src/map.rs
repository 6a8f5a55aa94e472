//! `map`: saving, loading and comparing maps, as `map_saver_cli` and `map_saver` do.

mod diff;
mod files;
mod save;
mod saver;

pub use diff::{Diff, diff};
pub use files::{Convert, convert, info};
pub use save::{Save, save, save_to};
pub use saver::{SaverCommand, saver_command};
