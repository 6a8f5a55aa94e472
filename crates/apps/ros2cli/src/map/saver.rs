//! The command line of the map savers of ROS, from its words to an exit code.

use std::time::Duration;

use periplus_maps::{Distro, Words, read_words, usage};

use super::Save;

/// Exit code of `map_saver_cli` for words that make no sense.
const WRONG_WORDS_EXIT_CODE: u8 = 255;

/// Time that the savers of ROS 2 wait for a map.
const USUAL_TIMEOUT: Duration = Duration::from_secs(2);

/// What the words behind a map saver ask for.
#[derive(Clone, Debug, PartialEq)]
pub enum SaverCommand {
    /// To save a map.
    Save(Save),
    /// To print the words that there are, which is a success.
    Help(String),
    /// Nothing: the words make no sense.
    Wrong {
        /// What is wrong, and the words that there are.
        message: String,
        /// The code with which the saver ends.
        exit_code: u8,
    },
}

/// Reads the words behind a map saver of a distribution. `ros` holds those behind `--ros-args`, of
/// which the renaming of the topic counts; `timeout` is the time to wait for the map, if it is given.
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
            "Saves the map of a topic, with the words of {program}:\n{}  \
             --distro NAME  in front of these: as whose saver (jazzy; humble, noetic)\n  \
             --timeout S    in front of these: wait so long for the map (2)",
            usage(distro)
        )),
        Ok(Words::Save { topic, wish }) => SaverCommand::Save(Save {
            topic: renamed(topic, ros),
            wish,
            distro,
            // The saver of ROS 1 waits as long as it takes.
            timeout: timeout.or((distro != Distro::Noetic).then_some(USUAL_TIMEOUT)),
        }),
        Err(error) => SaverCommand::Wrong {
            message: format!("{error}\n{program} knows these words:\n{}", usage(distro)),
            exit_code: WRONG_WORDS_EXIT_CODE,
        },
    }
}

/// The topic after `--ros-args -r map:=/other`.
fn renamed(topic: String, ros: &[String]) -> String {
    let plain = topic.trim_start_matches('/');
    let rule = ros.iter().filter_map(|word| word.split_once(":=")).find(|(from, _)| {
        from.rsplit(':').next().is_some_and(|from| from.trim_start_matches('/') == plain)
    });
    rule.map_or(topic.clone(), |(_, to)| to.to_owned())
}
