//! `periplus sim`.

pub(crate) mod fleet;
pub(crate) mod people;
mod robots;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use periplus_graph::Arguments;
use periplus_loader::LoadContext;
use periplus_os::Stopwatch;
use periplus_session::nodes::EstimatorSelection;
use periplus_session::{
    GazeboSettings, NoTask, PageContext, RunSettings, SessionBuilder, SimulationSession, stop,
};
use periplus_sim::{Composition, Driver, Options, PhysicsMode, Quirks, TopicFilter, compose};

use crate::arguments;
use crate::costmap::CostmapOptions;
use crate::error::CliError;
use crate::localize::BesideOptions;
use crate::mapping::MappingOptions;
use crate::options::SearchOptions;
use crate::page::PageOptions;
use crate::run_options::{
    Factor, GzReach, GzTypes, Reach, Ros1Options, TopicSelection, exit_code, factor, positive,
};
use crate::terminal;

pub(crate) use robots::Robots;

/// Simulate robots in a world: physics, sensors, topics, and a recording
///
/// The world is an SDF file or a saved world; a robot file alone is put on a plane under a sun.
/// Runs as fast as possible with `--duration`, otherwise at the world's real-time factor until
/// Ctrl-C. The same files, options and seed give the same bag, byte for byte.
#[derive(Debug, Args)]
pub(crate) struct SimOptions {
    /// World, and `name:=value` for its xacro
    #[arg(value_name = "WORLD|NAME:=VALUE")]
    words: Vec<String>,
    #[command(flatten)]
    robots: Robots,
    /// Number of copies of the robot, spread over the free floor around its pose; each has its
    /// name with a number as name and namespace
    #[arg(long = "robots", value_name = "COUNT", value_parser = robot_count)]
    robot_count: Option<usize>,
    /// People that walk on the free floor, avoid robots and each other, and are seen by all sensors: their number, or a
    /// file with goals, groups, doors and their model
    #[arg(long, value_name = "COUNT|FILE.yaml")]
    people: Option<String>,
    /// Attach the slotcars of the world to Open-RMF: publish their states as this fleet
    #[arg(long, value_name = "FLEET")]
    open_rmf: Option<String>,
    /// Duration of the run in simulated seconds [default: until Ctrl-C]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: Option<f64>,
    /// Record published topics to a bag: FILE.mcap, or a folder in the format of `ros2 bag`
    #[arg(long, value_name = "FILE.mcap|FOLDER")]
    record: Option<std::path::PathBuf>,
    #[command(flatten)]
    recorded: TopicSelection,
    /// Simulate sensors of topics that match this regular expression even without subscribers, to
    /// measure their cost
    #[arg(long, value_name = "REGEX")]
    compute: Option<regex::Regex>,
    /// Old name of `--compute`
    #[arg(long, value_name = "REGEX", hide = true, conflicts_with = "compute")]
    hear: Option<regex::Regex>,
    /// Drive by a script (YAML) or by the velocity commands of a bag
    #[arg(long, value_name = "FILE")]
    cmd: Option<std::path::PathBuf>,
    /// Seed of all noise
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    /// Motion model: rigid bodies, or motion exactly as commanded on a flat floor
    #[arg(long, value_enum, default_value_t = Dynamics::Rigid)]
    dynamics: Dynamics,
    /// Real-time factor, or `max` for full speed
    #[arg(long, value_name = "FACTOR|max", value_parser = factor)]
    rtf: Option<Factor>,
    /// Simulation step [s] [default: that of the world]
    #[arg(long, value_name = "SECONDS", value_parser = step)]
    step: Option<f64>,
    /// Number of threads, for rays and for the nodes of several robots; results do not depend on it
    #[arg(long, value_name = "NUMBER")]
    threads: Option<usize>,
    /// Reproduce quirks of Gazebo, such as periods of whole milliseconds
    #[arg(long)]
    gz_quirks: bool,
    /// Simulate the beams of a lidar one after the other while the robot moves, as real scanners do
    #[arg(long)]
    rolling_scans: bool,
    /// Remap a topic, service or node: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    remaps: Vec<String>,
    /// Visibility of the run on ROS 2: topics, services and nodes [default: at real time `loopback`
    /// or ROS_AUTOMATIC_DISCOVERY_RANGE, at full speed `off`]
    #[arg(long, value_enum, value_name = "off|loopback|network|zenoh")]
    ros2: Option<Reach>,
    #[command(flatten)]
    ros1: Ros1Options,
    /// Publish the run on Gazebo Transport: topics, and the services of the world; `--gz=network`
    /// beyond this machine
    #[arg(
        long,
        value_enum,
        value_name = "loopback|network",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "loopback"
    )]
    gz: Option<GzReach>,
    /// Names of message types on Gazebo Transport: those since Garden, or those of Fortress and of
    /// Debian's `ign`
    #[arg(long, value_enum, value_name = "gz|ignition", default_value_t = GzTypes::Gz)]
    gz_types: GzTypes,
    /// Parameter for all nodes that have it, or for one: `name:=value`, `node:name:=value`
    #[arg(long = "param", short = 'p', value_name = "[NODE:]NAME:=VALUE")]
    parameters: Vec<String>,
    /// Parameter file of ROS 2; later files win. `--ros-args` is understood too
    #[arg(long, value_name = "FILE")]
    params_file: Vec<String>,
    /// Run the usual nodes beside each robot: an EKF of odometry and IMU if the robot publishes no
    /// odometry transform, SLAM (or localization with `--localize MAP.yaml`), and both costmaps.
    /// Topics and frames are those of the robot
    #[arg(long)]
    stack: bool,
    /// Run the servers of Nav2 beside each robot, with a parameter file of Nav2 [default: parameters for the robot],
    /// and SLAM (or localization with `--localize MAP.yaml`). Goals come from the page, from RViz, or from
    /// clients of `navigate_to_pose`
    #[arg(long, value_name = "FILE.yaml", num_args = 0..=1, conflicts_with = "costmap")]
    navigation: Option<Option<PathBuf>>,
    #[command(flatten)]
    costmaps: CostmapOptions,
    #[command(flatten)]
    localization: BesideOptions,
    #[command(flatten)]
    mapping: MappingOptions,
    #[command(flatten)]
    page: PageOptions,
    /// File to which the page may write the world with its changes: WORLD itself, of which only changed models are edited, or
    /// another file
    #[arg(long, value_name = "FILE.sdf", requires = "page")]
    world_out: Option<PathBuf>,
    /// Do not open a browser
    #[arg(long, requires = "page")]
    no_browser: bool,
    /// Print a report as JSON
    #[arg(long)]
    json: bool,
    /// Print only errors
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    search: SearchOptions,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Dynamics {
    /// Physics with bodies, joints, contacts and friction
    Rigid,
    /// Robots move exactly as commanded, without collisions
    Kinematic,
}

impl From<Dynamics> for PhysicsMode {
    fn from(dynamics: Dynamics) -> Self {
        match dynamics {
            Dynamics::Rigid => Self::Rigid,
            Dynamics::Kinematic => Self::Kinematic,
        }
    }
}

/// Runs a simulation; `recorded` is the command for its recording.
pub(crate) fn run(
    options: &SimOptions,
    ros: Vec<String>,
    recorded: String,
) -> Result<ExitCode, CliError> {
    let start = Stopwatch::start();
    let to_nodes = arguments::read(options.ros_words(ros))?;
    if options.hear.is_some() {
        terminal::say(
            "`--hear` is deprecated: use `--compute`; the next release has only that option",
        );
    }
    let (world, arguments) = options.robots.world(&options.words, "sim")?;
    options.check()?;
    let driver = options.driver()?;
    let people = options.people.as_deref().map(people::read).transpose()?;
    let search = terminal::search(&options.search.resource_path);
    let composition = search.with_context(true, |context| {
        let context = LoadContext { arguments: arguments.clone(), ..context.clone() };
        compose(&world, &options.robots.placements, &context)
    });
    let composition = options.spread(composition, || {
        search.with_context(true, |context| {
            let context = LoadContext { arguments: arguments.clone(), ..context.clone() };
            compose(&world, &options.robots.placements, &context)
        })
    })?;
    let factor = Factor::of_run(options.rtf, options.duration, &composition);
    let page = options.page.of_run(
        PageContext {
            world_out: options.world_out.clone(),
            ..PageContext::of(&composition, &options.search.resource_path)
        },
        options.quiet,
        !options.no_browser,
    );
    let mut session = SessionBuilder::new(composition, options.simulation(to_nodes), start)
        .quiet(options.quiet)
        .progress(!options.quiet && !options.json)
        .factor(factor)
        .search(search)
        .recording(options.recorded.recording(options.record.as_deref()))
        .recording_truth(options.recorded.records_truth())
        .command(Some(recorded))
        .computed(options.computed())
        .driver(driver)
        .people(people)
        .open_rmf(options.open_rmf.clone())
        .estimators(options.selection().request(options.number_of_robots()))
        .ros2(options.ros2.map(Into::into))
        .ros1(options.ros1.reach())
        .gazebo(options.gazebo())
        .page(page)
        .build()?;
    let stop = stop::on_signal();
    let settings = RunSettings { duration_s: options.duration, stop: &stop, is_paused: false };
    session.run(settings, &mut NoTask);
    session.finish()?;
    options.report(&session)?;
    session.write_maps(options.quiet)?;
    match exit_code(session.end()) {
        Ok(_) if !session.is_whole() => {
            Err(CliError::failed("parts of the files have errors and were left out"))
        }
        end => end,
    }
}

/// Reads a velocity script and prints its findings.
pub(crate) fn read_driver(path: &Path) -> Result<Driver, CliError> {
    let (driver, findings) = Driver::read(path);
    let mut err = anstream::stderr().lock();
    terminal::diagnostics(&mut err, &findings.diagnostics, &findings.sources)?;
    let has_errors = findings.diagnostics.has_errors();
    if has_errors { Err(CliError::failed("the script has errors")) } else { Ok(driver) }
}

/// Parses a number of robots.
pub(crate) fn robot_count(word: &str) -> Result<usize, String> {
    match word.parse() {
        Ok(count @ 1..=10_000) => Ok(count),
        _ => Err("expected a number of robots from 1 to 10000".into()),
    }
}

impl SimOptions {
    fn number_of_robots(&self) -> usize {
        self.robot_count.unwrap_or(self.robots.placements.len())
    }

    /// Adds the copies of the robot. `probe` reads the files again, to look for free poses.
    fn spread(
        &self,
        mut composition: Composition,
        probe: impl FnOnce() -> Composition,
    ) -> Result<Composition, CliError> {
        let Some(count) = self.robot_count else { return Ok(composition) };
        if self.robots.placements.len() != 1 {
            return Err(CliError::usage("`--robots` needs exactly one `--robot`"));
        }
        if !composition.has_errors() {
            composition.spread_last(&fleet::places(probe(), count)?);
        }
        Ok(composition)
    }

    /// Arguments of nodes in the form of `--ros-args`, own options first.
    fn ros_words(&self, ros: Vec<String>) -> Vec<String> {
        let own = [
            ("--params-file", &self.params_file),
            ("--param", &self.parameters),
            ("--remap", &self.remaps),
        ];
        let own = own.into_iter().flat_map(|(flag, values)| {
            values.iter().flat_map(move |value| [flag.to_owned(), value.clone()])
        });
        own.chain(ros).collect()
    }

    /// Checks combinations of options.
    fn check(&self) -> Result<(), CliError> {
        if let Some(path) =
            self.record.as_ref().filter(|path| path.extension() == Some("bag".as_ref()))
        {
            let mcap = path.with_extension("mcap");
            return Err(CliError::Usage(format!(
                "recordings are MCAP, not ROS 1 bags: write `--record {0}`, then \
                 `periplus bag convert {0} {1}`",
                mcap.display(),
                path.display()
            )));
        }
        let selection = self.selection();
        if self.mapping.needs_mapping() && !selection.runs_mapping() {
            return Err(CliError::failed("`--slam-node` and `--slam-out` require `--slam`"));
        }
        Ok(())
    }

    /// Reads the velocity script and prints its findings.
    fn driver(&self) -> Result<Driver, CliError> {
        self.cmd.as_deref().map_or_else(|| Ok(Driver::default()), read_driver)
    }

    fn simulation(&self, arguments: Arguments) -> Options {
        Options {
            seed: self.seed,
            mode: self.dynamics.into(),
            step_s: self.step,
            threads: self.threads.unwrap_or_else(terminal::processors),
            quirks: if self.gz_quirks { Quirks::GAZEBO } else { Quirks::default() },
            rolling_scans: self.rolling_scans,
            arguments,
            ..Options::default()
        }
    }

    fn computed(&self) -> Option<TopicFilter> {
        let topics = self.compute.clone().or_else(|| self.hear.clone())?;
        Some(Box::new(move |name| topics.is_match(name)))
    }

    /// Requested estimator nodes.
    fn selection(&self) -> EstimatorSelection {
        EstimatorSelection {
            has_stack: self.stack,
            navigation: self.navigation.clone(),
            costmaps: self.costmaps.request(),
            localization: self.localization.files(),
            is_mapping_requested: self.mapping.is_wanted(),
            mapping: self.mapping.request(),
        }
    }

    fn gazebo(&self) -> Option<GazeboSettings> {
        Some(GazeboSettings { reach: self.gz?.into(), dialect: self.gz_types.into() })
    }

    /// Prints the reports of the run and of its nodes.
    fn report(&self, session: &SimulationSession) -> Result<(), CliError> {
        let report = session.report();
        if self.json {
            writeln!(io::stdout().lock(), "{:#}", report.to_json())?;
        } else if !self.quiet {
            report.write_text(&mut anstream::stderr().lock())?;
        }
        if !self.quiet {
            session.write_estimator_reports(&mut anstream::stderr().lock())?;
        }
        Ok(())
    }
}

/// Parses a physics step \[s\].
fn step(word: &str) -> Result<f64, String> {
    let [shortest_s, longest_s] = periplus_sim::STEP_RANGE_S;
    match word.parse::<f64>() {
        Ok(step_s) if (shortest_s..=longest_s).contains(&step_s) => Ok(step_s),
        _ => Err(format!("expected a number from {shortest_s} to {longest_s}")),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::SimOptions;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        options: SimOptions,
    }

    /// True if the camera is simulated without subscribers.
    fn computes_camera(words: &[&str]) -> bool {
        let line = ["sim", "world.sdf"].iter().chain(words);
        let line = Line::try_parse_from(line).unwrap_or_else(|error| panic!("{error}"));
        line.options.computed().is_some_and(|topics| topics("/camera/image_raw"))
    }

    #[test]
    fn the_old_name_of_compute_still_works() {
        assert!(computes_camera(&["--compute", "camera"]));
        assert!(computes_camera(&["--hear", "camera"]));
        assert!(!computes_camera(&["--compute", "scan"]));
        assert!(!computes_camera(&[]));
    }
}
