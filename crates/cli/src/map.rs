//! `periplus map`.

mod options;
mod serve;

use std::io;
use std::process::ExitCode;
use std::time::Duration;

use periplus_maps::{Distro, Options, Wish, Words, read_words, usage};
use periplus_verbs::map::{self, Convert, Diff, Save};

use crate::terminal::{complain, say};
use crate::verbs::{Common, with_session, without_network};

pub(crate) use options::MapCommand;
use options::{ConvertOptions, DiffOptions, SaveOptions};

/// The exit code of `map_saver_cli` for words that make no sense.
const WRONG_WORDS: u8 = 255;

pub(crate) fn run(command: &MapCommand, ros: Vec<String>) -> io::Result<ExitCode> {
    if !ros.is_empty() && !matches!(command, MapCommand::Serve(_) | MapCommand::Save(_)) {
        complain("`--ros-args` are for `periplus map serve` and `save`");
        return Ok(ExitCode::from(2));
    }
    let common = |json: bool| Common { json, ..Common::default() };
    match command {
        MapCommand::Save(options) => save(options, &ros),
        MapCommand::Serve(options) => serve::run(options, ros),
        MapCommand::Info(options) => without_network(&common(options.json), |session| {
            map::info(session, &options.path, options.distro)
        }),
        MapCommand::Convert(options) => without_network(&common(options.json), |session| {
            map::convert(session, &conversion(options))
        }),
        MapCommand::Diff(options) => without_network(&common(options.json), |session| {
            map::diff(session, &difference(options))
        }),
    }
}

/// The words are those of the savers of ROS, so these read them.
fn save(options: &SaveOptions, ros: &[String]) -> io::Result<ExitCode> {
    let program = if options.distro == Distro::Noetic { "map_saver" } else { "map_saver_cli" };
    let (topic, wish) = match read_words(&options.words, options.distro) {
        Ok(Words::Save { topic, wish }) => (topic, wish),
        Ok(Words::Help) => {
            say(&format!(
                "Saves the map of a topic, with the words of {program}:\n{}  \
                 --distro NAME  in front of these: as whose saver (jazzy; humble, noetic)\n  \
                 --timeout S    in front of these: wait so long for the map (2)",
                usage(options.distro)
            ));
            return Ok(ExitCode::SUCCESS);
        }
        Err(error) => {
            complain(&format!("{error}\n{program} knows these words:\n{}", usage(options.distro)));
            return Ok(ExitCode::from(WRONG_WORDS));
        }
    };
    let save = Save {
        topic: renamed(topic, ros),
        wish,
        distro: options.distro,
        // The saver of ROS 1 waits as long as it takes.
        timeout: match (options.timeout, options.distro) {
            (Some(seconds), _) => Some(Duration::from_secs_f64(seconds)),
            (None, Distro::Noetic) => None,
            (None, _) => Some(Duration::from_secs(2)),
        },
    };
    with_session(&Common::default(), |session| map::save(session, &save))
}

/// The topic after `--ros-args -r map:=/other`.
fn renamed(topic: String, ros: &[String]) -> String {
    let plain = topic.trim_start_matches('/');
    let rule = ros.iter().filter_map(|word| word.split_once(":=")).find(|(from, _)| {
        from.rsplit(':').next().is_some_and(|from| from.trim_start_matches('/') == plain)
    });
    rule.map_or(topic.clone(), |(_, to)| to.to_owned())
}

fn conversion(options: &ConvertOptions) -> Convert {
    Convert {
        path: options.path.clone(),
        from: options.from,
        wish: Wish {
            name: options.output.clone(),
            image_format: options.fmt.clone().unwrap_or_default(),
            mode: options.mode.clone().unwrap_or_default(),
            occupied_thresh: options.occ.unwrap_or_default(),
            free_thresh: options.free.unwrap_or_default(),
        },
        to: options.to,
    }
}

fn difference(options: &DiffOptions) -> Diff {
    Diff {
        first: options.first.clone(),
        other: options.other.clone(),
        distro: options.distro,
        options: Options {
            align: !options.no_align,
            window_m: options.window,
            window_rad: options.turn.to_radians(),
        },
        picture: options.picture.clone(),
    }
}
