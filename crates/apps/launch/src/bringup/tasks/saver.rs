//! `map_saver`: waits for a map, saves it, and ends.

use std::path::Path;

use periplus_graph::{Mailbox, Node, Qos};
use periplus_maps::{Distro, Wish, Words, from_message, read_words, render};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_os::{Machine, unix_ns};
use periplus_resources::Store as _;

use super::{Done, Task, TaskContext};
use crate::bringup::report::LaunchLog;

/// Task that saves one map.
pub(crate) struct Saver {
    wish: Wish,
    distro: Distro,
    maps: Mailbox<OccupancyGrid>,
}

impl Saver {
    /// Parses the arguments of the program.
    ///
    /// # Errors
    /// A message with the invalid argument.
    pub(crate) fn new(node: &Node, words: &[String], distro: Distro) -> Result<Self, String> {
        let (topic, wish) = match read_words(words, distro) {
            Ok(Words::Save { topic, wish }) => (topic, wish),
            Ok(Words::Help) => {
                return Err("use `periplus map save -h` for help".into());
            }
            Err(error) => return Err(error.to_string()),
        };
        let maps = node.mailbox(&topic, Qos::latched(1)).map_err(|error| error.to_string())?;
        Ok(Self { wish, distro, maps })
    }

    fn save(&self, map: &OccupancyGrid) -> Result<String, String> {
        let grid = from_message(map).map_err(|error| error.to_string())?;
        // The default name is the time.
        let unix_s = unix_ns().div_euclid(1_000_000_000);
        let (saving, _) =
            self.wish.settle(self.distro, unix_s).map_err(|error| error.to_string())?;
        let files = render(&grid, &saving);
        Machine.replace(Path::new(&files.image_path), &files.image)?;
        Machine.replace(Path::new(&files.yaml_path), files.yaml.as_bytes())?;
        Ok(files.yaml_path)
    }
}

impl Task for Saver {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        let Some(map) = self.maps.latest() else { return Done::No };
        stage.said.push(match self.save(&map) {
            Ok(path) => LaunchLog::info(format!("map saved to {path}")),
            Err(why) => LaunchLog::error(format!("the map was not saved: {why}")),
        });
        Done::Yes
    }
}
