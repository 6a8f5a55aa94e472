//! World of a plan, for all methods of starting Gazebo.

use serde::Serialize;

use crate::bringup::environment::Environment;

/// World requested by a plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct WorldRequest {
    /// Step that requests it.
    pub step: usize,
    /// File as written; `None` for an empty plane.
    pub file: Option<String>,
    /// True to start paused.
    pub is_paused: bool,
    /// Seed of all noise, if given.
    pub seed: Option<u64>,
    /// True to show a window.
    pub has_window: bool,
    /// Environment in which it is started.
    pub environment: Environment,
    /// Working folder, if not that of the launch.
    pub folder: Option<String>,
    /// Launch file line that starts it, `file:line`.
    pub written: Option<String>,
}

/// Options of Gazebo Classic with a value, from `gazebo --help`.
const CLASSIC_VALUE_OPTIONS: [&str; 17] = [
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

/// Options of `gz sim` with a value, from `gz sim --help`.
const GZ_VALUE_OPTIONS: [&str; 20] = [
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

/// World of a Gazebo Classic command line: `gazebo`, `gzserver` and the programs of `gazebo_ros`.
pub(crate) fn classic(words: &[String]) -> WorldRequest {
    let mut wish = WorldRequest { has_window: true, ..WorldRequest::default() };
    let mut words = words.iter();
    while let Some(word) = words.next() {
        if CLASSIC_VALUE_OPTIONS.contains(&word.as_str()) {
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

/// World of a `gz sim` command line.
pub(crate) fn gz(words: &[String]) -> WorldRequest {
    // It starts paused without `-r`.
    let mut wish = WorldRequest { has_window: true, is_paused: true, ..WorldRequest::default() };
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        if GZ_VALUE_OPTIONS.contains(&word.as_str()) {
            // `-v` without a value is a flag too.
            let is_value = |next: &&String| word != "-v" || next.parse::<u8>().is_ok();
            let value = words.next_if(|next| is_value(next));
            if word == "--seed" {
                wish.seed = value.and_then(|value| value.parse().ok());
            }
        } else if let Some(letters) = word.strip_prefix('-').filter(|rest| !rest.starts_with('-')) {
            // Short options may be combined: `-rs`, `-v4`.
            wish.is_paused &= !letters.contains('r');
            wish.has_window &= !letters.contains('s');
        } else if !word.starts_with('-') && !word.is_empty() {
            wish.file = Some(word.clone());
        }
    }
    wish
}

/// World of a command line; `None` if it starts no Gazebo.
pub(crate) fn of_command(words: &[String]) -> Option<WorldRequest> {
    let (program, rest) = words.split_first()?;
    let name = program.rsplit('/').next().unwrap_or(program);
    match (name, rest.first().map(String::as_str)) {
        ("gz", Some("sim")) | ("ign", Some("gazebo")) => Some(gz(&rest[1..])),
        // Started through ruby, as in the launch files of ros_gz_sim.
        (name, _) if name.starts_with("ruby") => of_command(rest),
        ("gazebo", _) => Some(classic(rest)),
        ("gzserver", _) => Some(WorldRequest { has_window: false, ..classic(rest) }),
        _ => None,
    }
}

/// Returns true if a command only opens a window on another simulation.
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
