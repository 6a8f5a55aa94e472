//! Which world a plan simulates, from all the ways in which Gazebo is started.

use serde::Serialize;

use crate::bringup::environment::Environment;

/// A world that a plan asks for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct WorldWish {
    /// The step that asks for it.
    pub step: usize,
    /// The file as it is written; none is a plane in the sun.
    pub file: Option<String>,
    /// Whether it begins standing still.
    pub is_paused: bool,
    /// The seed of all noise, if one is given.
    pub seed: Option<u64>,
    /// Whether it is shown.
    pub has_window: bool,
    /// The environment in which it is started.
    pub environment: Environment,
    /// The folder in which it is started, if another than that of the launch.
    pub folder: Option<String>,
    /// The line of the launch file that starts it, `file:line`.
    pub written: Option<String>,
}

/// Options of Classic that have a value behind them, as `gazebo --help` lists them.
const CLASSIC_VALUES: [&str; 17] = [
    "-s",
    "--server-plugin",
    "-g",
    "--gui-plugin",
    "-e",
    "--physics",
    "-p",
    "--play",
    "--record_path",
    "--record_encoding",
    "--seed",
    "--iters",
    "--profile",
    "-o",
    "--params-file",
    "--gui-client-plugin",
    "--initial_sim_time",
];

/// Options of `gz sim` that have a value behind them, as `gz sim --help` lists them.
const GZ_VALUES: [&str; 20] = [
    "-v",
    "--verbose",
    "-z",
    "--iterations",
    "--seed",
    "--initial-sim-time",
    "--gui-config",
    "--physics-engine",
    "--render-engine",
    "--render-engine-gui",
    "--render-engine-server",
    "--render-engine-api-backend",
    "--render-engine-gui-api-backend",
    "--render-engine-server-api-backend",
    "--playback",
    "--record-path",
    "--record-topic",
    "--record-period",
    "--network-role",
    "--force-version",
];

/// What Gazebo Classic is asked for by its words: `gazebo`, `gzserver` and the programs of `gazebo_ros`.
pub(crate) fn classic(words: &[String]) -> WorldWish {
    let mut wish = WorldWish { has_window: true, ..WorldWish::default() };
    let mut words = words.iter();
    while let Some(word) = words.next() {
        if CLASSIC_VALUES.contains(&word.as_str()) {
            let value = words.next();
            if word == "--seed" {
                wish.seed = value.and_then(|value| value.parse().ok());
            }
        } else if matches!(word.as_str(), "-u" | "--pause") {
            wish.is_paused = true;
        } else if !word.starts_with('-') && !word.is_empty() {
            wish.file = Some(word.clone());
        }
    }
    wish
}

/// What today's Gazebo is asked for by the words behind `gz sim`.
pub(crate) fn gz(words: &[String]) -> WorldWish {
    // It begins standing still unless it is told to run.
    let mut wish = WorldWish { has_window: true, is_paused: true, ..WorldWish::default() };
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        if GZ_VALUES.contains(&word.as_str()) {
            // `-v` alone is a flag too.
            let is_value = |next: &&String| word != "-v" || next.parse::<u8>().is_ok();
            let value = words.next_if(|next| is_value(next));
            if word == "--seed" {
                wish.seed = value.and_then(|value| value.parse().ok());
            }
        } else if let Some(letters) = word.strip_prefix('-').filter(|rest| !rest.starts_with('-')) {
            // Several letters may stand together: `-rs`, `-v4`.
            wish.is_paused &= !letters.contains('r');
            wish.has_window &= !letters.contains('s');
        } else if !word.starts_with('-') && !word.is_empty() {
            wish.file = Some(word.clone());
        }
    }
    wish
}

/// The world of a command line; none when it starts no Gazebo.
pub(crate) fn of_command(words: &[String]) -> Option<WorldWish> {
    let (program, rest) = words.split_first()?;
    let name = program.rsplit('/').next().unwrap_or(program);
    match (name, rest.first().map(String::as_str)) {
        ("gz", Some("sim")) | ("ign", Some("gazebo")) => Some(gz(&rest[1..])),
        // Through ruby, as the launch files of ros_gz_sim start it.
        (name, _) if name.starts_with("ruby") => of_command(rest),
        ("gazebo", _) => Some(classic(rest)),
        ("gzserver", _) => Some(WorldWish { has_window: false, ..classic(rest) }),
        _ => None,
    }
}

/// Whether a command only shows what another one simulates.
pub(crate) fn is_window(words: &[String]) -> bool {
    let name = words.first().map(|program| program.rsplit('/').next().unwrap_or(program));
    let is_gui = |word: &String| word == "-g";
    match name {
        Some("gzclient") => true,
        Some("gz" | "ign") => words.iter().any(is_gui),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(line: &str) -> Option<(Option<String>, bool, bool)> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        of_command(&words).map(|wish| (wish.file, wish.is_paused, wish.has_window))
    }

    #[test]
    fn worlds_of_all_generations() {
        let file = |name: &str| Some(name.to_owned());
        let classic = "gazebo --verbose -s libgazebo_ros_init.so -s libgazebo_ros_factory.so a.sdf";
        assert_eq!(of(classic), Some((file("a.sdf"), false, true)));
        assert_eq!(
            of("gzserver -u -e ode worlds/empty.world"),
            Some((file("worlds/empty.world"), true, false))
        );
        assert_eq!(
            of("gz sim -r -v 4 a.sdf --force-version 8"),
            Some((file("a.sdf"), false, true))
        );
        assert_eq!(of("ign gazebo -rs -v4 a.sdf"), Some((file("a.sdf"), false, false)));
        assert_eq!(of("ruby /usr/bin/gz sim a.sdf"), Some((file("a.sdf"), true, true)));
        assert_eq!(of("gz sim"), Some((None, true, true)));
        assert_eq!(of("gz topic -l"), None);
    }
}
