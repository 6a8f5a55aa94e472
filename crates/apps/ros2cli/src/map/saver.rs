//! Command line of the ROS map savers.

use std::time::Duration;

use periplus_maps::{Distro, Words, read_words, usage};

use super::Save;

/// Exit code of `map_saver_cli` for invalid arguments.
const USAGE_EXIT_CODE: u8 = 255;

/// Default timeout of the ROS 2 map savers.
const DEFAULT_TIMEOUT: Duration = Duration::from_secs(2);

/// Parsed command line of a map saver.
#[derive(Clone, Debug, PartialEq)]
pub enum SaverCommand {
    /// Save a map.
    Save(Save),
    /// Print the usage, which is a success.
    Help(String),
    /// Usage error.
    Wrong {
        /// The error, and the usage.
        message: String,
        /// Exit code of the map saver.
        exit_code: u8,
    },
}

/// Parses the arguments of a distribution's map saver. `ros` holds those after `--ros-args`, of
/// which the remapping of the topic counts; `timeout` overrides the default.
#[must_use]
pub fn saver_command(
    words: &[String],
    ros: &[String],
    distro: Distro,
    timeout: Option<Duration>,
) -> SaverCommand {
    let program = if distro == Distro::Noetic { "map_saver" } else { "map_saver_cli" };
    match read_words(words, distro) {
        Ok(Words::Help) => SaverCommand::Help(format!(
            "Saves the map of a topic, with the arguments of {program}:\n{}  \
             --distro NAME  before these: distribution to follow (jazzy; humble, noetic)\n  \
             --timeout S    before these: timeout for the map [s] (2)",
            usage(distro)
        )),
        Ok(Words::Save { topic, wish }) => SaverCommand::Save(Save {
            topic: renamed(topic, ros),
            wish,
            distro,
            // The map saver of ROS 1 waits without a limit.
            timeout: timeout.or((distro != Distro::Noetic).then_some(DEFAULT_TIMEOUT)),
        }),
        Err(error) => SaverCommand::Wrong {
            message: format!("{error}\narguments of {program}:\n{}", usage(distro)),
            exit_code: USAGE_EXIT_CODE,
        },
    }
}

/// Topic after `--ros-args -r map:=/other`.
fn renamed(topic: String, ros: &[String]) -> String {
    let plain = topic.trim_start_matches('/');
    let rule = ros.iter().filter_map(|word| word.split_once(":=")).find(|(from, _)| {
        from.rsplit(':').next().is_some_and(|from| from.trim_start_matches('/') == plain)
    });
    rule.map_or(topic.clone(), |(_, to)| to.to_owned())
}
