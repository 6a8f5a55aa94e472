//! What is done with a case of each kind. A kind is one module with a `check`, and one line in
//! [`KINDS`].

use std::path::{Path, PathBuf};

use periplus_resources::{Host, Kind};

use crate::{Case, Differences, Unreadable};

mod grid_coords;
mod map_load;
mod map_pixel;
mod map_save;
mod path_expand;
mod raytrace_2d;
mod rsp;
mod rviz_palette;
mod teleop_keys;
mod tf2;

/// Does with what is given what a user of a distribution would, and tells every difference.
pub type Check = fn(&Case, distro: &str, &Setting<'_>, &mut Differences) -> Result<(), Unreadable>;

/// What there is beside a case.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// The folder of the cases.
    pub folder: &'a Path,
    /// The machine.
    pub host: &'a dyn Host,
}

impl Setting<'_> {
    /// A file that cases name, such as `nav2_maps/nav2_map_server/testmap.pgm`: in the folder of the
    /// cases, beside it, or in a folder `maps` beside it.
    #[must_use]
    pub fn file(&self, name: &str) -> Option<PathBuf> {
        let beside = self.folder.join("..");
        let in_maps = name.split_once('/').map(|(_, rest)| beside.join("maps").join(rest));
        let places = [Some(self.folder.join(name)), Some(beside.join(name)), in_maps];
        let mut places = places.into_iter().flatten();
        places.find(|place| self.host.kind(place) == Some(Kind::File))
    }
}

/// All kinds that are checked, in the order of their names.
pub const KINDS: &[(&str, Check)] = &[
    ("grid_coords", grid_coords::check),
    ("map_load", map_load::check),
    ("map_pixel", map_pixel::check),
    ("map_save", map_save::check),
    ("map_save_pixel", map_save::check_pixels),
    ("path_expand", path_expand::check),
    ("raytrace_2d", raytrace_2d::check),
    ("rsp", rsp::check),
    ("rviz_palette", rviz_palette::check),
    ("teleop_keys", teleop_keys::check),
    ("tf2_advanced", tf2::check_lookup),
    ("tf2_cache", tf2::check_cache),
    ("tf2_frames_yaml", tf2::check_frames_yaml),
    ("tf2_lookup", tf2::check_lookup),
    ("tf2_set", tf2::check_set),
    ("tf2_static", tf2::check_lookup),
];
