//! `periplus sim`.

mod gazebo;
pub(crate) mod progress;
mod recording;
mod report;
mod robots;
pub(crate) mod ros2;
pub(crate) mod stack;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use clap::{Args, ValueEnum};
use periplus_diagnostics::SourceMap;
use periplus_graph::Arguments;
use periplus_os::Stopwatch;
use periplus_sim::{
    AssetFiles, Composition, Driver, Options, PhysicsMode, Quirks, Run, Services, Simulation,
    SimulationRecorder, TopicFilter, compose, compute_topics,
};

use crate::arguments;
use crate::costmap::{CostmapOptions, Costmaps};
use crate::demo::browser;
use crate::error::CliError;
use crate::localize::{BesideOptions, Localization};
use crate::mapping::{Mapping, MappingOptions};
use crate::options::{SearchOptions, split};
use crate::page::{About, Page, PageOptions};
use crate::stop;
use crate::terminal;

use gazebo::{Gazebo, GzReach, GzTypes};
use ros2::{Reach, Ros2};
use stack::RobotProfile;

pub(crate) use recording::RecordingWatch;
pub(crate) use report::Report;
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
    /// Duration of the run in simulated seconds [default: until Ctrl-C]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: Option<f64>,
    /// Record published topics to a bag: FILE.mcap, or a folder in the format of `ros2 bag`
    #[arg(long, value_name = "FILE.mcap|FOLDER")]
    record: Option<std::path::PathBuf>,
    /// Record only topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    topics: Option<regex::Regex>,
    /// Do not record topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    exclude: Option<regex::Regex>,
    /// Simulate sensors of topics that match this regular expression even without subscribers, to
    /// measure their cost
    #[arg(long, value_name = "REGEX")]
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
    /// Number of threads for rays; results do not depend on it
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
    /// Run the usual nodes beside the robot: an EKF of odometry and IMU if the robot publishes no
    /// odometry transform, SLAM (or localization with `--localize MAP.yaml`), and both costmaps.
    /// Topics and frames are those of the robot
    #[arg(long)]
    stack: bool,
    #[command(flatten)]
    costmaps: CostmapOptions,
    #[command(flatten)]
    localization: BesideOptions,
    #[command(flatten)]
    mapping: MappingOptions,
    #[command(flatten)]
    page: PageOptions,
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
enum Dynamics {
    /// Physics with bodies, joints, contacts and friction
    Rigid,
    /// Robots move exactly as commanded, without collisions
    Kinematic,
}

/// Real-time factor: simulated seconds per second of wall time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Factor {
    /// As fast as possible.
    Max,
    /// Fixed factor.
    Of(f64),
}

pub(crate) fn run(options: &SimOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let start = Stopwatch::start();
    let to_nodes = arguments::read(options.ros_words(ros))?;
    let (mut files, arguments) = split(&options.words);
    // `--robot FILE WORLD`: a word that is no argument of the robot is the world.
    files.extend(options.robots.others.iter().map(PathBuf::from));
    let [world] = files.as_slice() else {
        return Err(CliError::Usage(match files.as_slice() {
            [] => "no world given; add robots with --robot; see `periplus sim --help`".to_owned(),
            several => {
                let names: Vec<_> = several.iter().map(|it| it.display().to_string()).collect();
                let several = names.join(", ");
                format!(
                    "expected one world, got {}: {several}; give each robot a separate --robot",
                    names.len()
                )
            }
        }));
    };
    if let Err(why) = options.can_run() {
        return Err(CliError::usage(why));
    }
    let (mut driver, findings) = match &options.cmd {
        Some(path) => Driver::read(path),
        None => Default::default(),
    };
    let mut err = anstream::stderr().lock();
    terminal::diagnostics(&mut err, &findings.diagnostics, &findings.sources)?;
    drop(err);
    if findings.diagnostics.has_errors() {
        return Err(CliError::failed("the script has errors"));
    }
    let search = &options.search.resource_path;
    let mut composition = terminal::with_setting(search, arguments, |setting| {
        compose(world, &options.robots.placements, setting)
    });
    let mut simulation = Simulation::new(
        &mut composition,
        Arc::new(AssetFiles::default()),
        options.simulation(to_nodes),
    );
    let whole = tell_findings(&composition, options.quiet)?;
    if let Some(missing) = composition.missing() {
        return Err(CliError::failed(format!("{} has nothing to simulate", missing.display())));
    }
    let profile = options.profile(&mut simulation).map_err(CliError::failed)?;
    let profile = profile.as_ref();
    let recorder = match options.record.as_deref() {
        None => None,
        Some(path) => match SimulationRecorder::start(&simulation, path, options.wanted()) {
            Ok(recorder) => Some(recorder),
            Err(error) => {
                return Err(CliError::failed(format!(
                    "cannot record to {}: {error}",
                    path.display()
                )));
            }
        },
    };
    if let Some(heard) = options.hear.clone() {
        compute_topics(&simulation, Box::new(move |name| heard.is_match(name)));
    }
    let mut services = Services::new(&simulation, terminal::search(search)).map_err(|error| {
        CliError::failed(format!("cannot offer the services of the world: {error}"))
    })?;
    match driver.join(&simulation) {
        Ok(warnings) => {
            terminal::diagnostics(&mut anstream::stderr().lock(), &warnings, &SourceMap::new())?;
        }
        Err(error) => {
            return Err(CliError::failed(format!("cannot run the script: {error}")));
        }
    }
    let filter = profile.filter(|profile| profile.needs_filter());
    let filter = filter.map(|profile| profile.filter(simulation.graph())).transpose();
    let _filter = filter
        .map_err(|error| CliError::failed(format!("the odometry filter cannot run: {error}")))?;
    let own = profile.filter(|_| options.stack).map(RobotProfile::costmaps);
    let costmaps = Costmaps::join(simulation.graph(), &options.costmaps, own.as_deref())?;
    let localization = Localization::join(simulation.graph(), &options.localization, profile)?;
    let factor = options.factor(&composition);
    let is_mapping = options.stack && localization.is_none();
    let usual = (is_mapping, profile);
    let mapping = Mapping::join(simulation.graph(), &options.mapping, factor.is_some(), usual)?;
    // All nodes exist now.
    if !options.quiet {
        let unused = simulation.graph().unused_arguments();
        terminal::diagnostics(&mut anstream::stderr().lock(), &unused, &SourceMap::new())?;
    }
    let mut ros2 = Ros2::join(&simulation, options.ros2, factor.is_some(), options.quiet)?;
    let gazebo =
        Gazebo::join(&simulation, &mut services, options.gz, options.gz_types, options.quiet)?;
    if options.page.page.is_some() {
        let around = composition.files.iter().filter_map(|file| file.path.parent());
        if let Err(error) = services.show(&simulation, around.map(Into::into).collect()) {
            return Err(CliError::failed(format!("the world cannot be shown: {error}")));
        }
    }
    let about = options.about(&composition);
    let page = Page::join(simulation.graph(), &options.page, about).map_err(CliError::failed)?;
    if let Some(page) = &page {
        let url = page.url();
        if !options.quiet {
            terminal::say(&format!("page: {url}"));
        }
        if !options.no_browser && !browser::open(&url) && !options.quiet {
            terminal::say("no browser could be started; open the page yourself");
        }
    }
    let stop = stop::on_signal();
    let run = Run {
        end_ns: options.duration.map(|seconds| (seconds * 1e9).round() as i64),
        factor,
        stop: &stop,
        paused: false,
    };
    let start_up = start.elapsed();
    let mut line = progress::ProgressLine::new(options.duration, options.quiet || options.json);
    let mut watch = RecordingWatch::default();
    let stopwatch = Stopwatch::start();
    let outcome = run.go(&mut simulation, &mut services, &mut driver, &mut |progress| {
        line.show(progress);
        watch.look(recorder.as_ref(), progress, &|write| line.aside(write));
        if ros2.is_due(progress.wall) {
            line.aside(|| ros2.tell());
            if let (Some(page), Some(remote)) = (&page, ros2.remote()) {
                page.set_remote(&remote);
            }
        }
    });
    let wall = stopwatch.elapsed();
    drop(page);
    line.clear();
    if let Some(gazebo) = gazebo {
        gazebo.tell()?;
    }
    ros2.tell()?;
    if !options.quiet {
        let mut err = anstream::stderr().lock();
        for findings in [simulation.take_findings(), services.take_findings()] {
            terminal::diagnostics(&mut err, &findings, &SourceMap::new())?;
        }
    }
    let finished = recorder.map(|recorder| recorder.finish(&mut simulation)).transpose();
    let is_recorded = finished.is_ok();
    // A broken bag does not affect the map and the report.
    let recording = finished.unwrap_or_else(|error| {
        terminal::complain(&format!("the bag is incomplete: {error}"));
        None
    });
    let report = Report { simulation: &simulation, start_up, wall, recording: recording.as_ref() };
    if options.json {
        writeln!(io::stdout().lock(), "{:#}", report.to_json())?;
    } else if !options.quiet {
        report.tell(&mut anstream::stderr().lock())?;
    }
    if !options.quiet {
        costmaps.tell(&mut anstream::stderr().lock())?;
        if let Some(localization) = &localization {
            localization.tell(&mut anstream::stderr().lock())?;
        }
        if let Some(mapping) = &mapping {
            mapping.tell(&mut anstream::stderr().lock())?;
        }
    }
    match mapping.as_ref().map_or(Ok(None), Mapping::write) {
        Ok(Some(folder)) if !options.quiet => {
            terminal::say(&format!("map: {}", folder.display()));
        }
        Ok(_) => {}
        Err(why) => {
            return Err(CliError::failed(why));
        }
    }
    // Without a duration, a signal is the regular end of a run.
    let cut_short = stop.load(Ordering::Relaxed) && options.duration.is_some();
    // Findings name each of them.
    if let Some(diverged) = simulation.diverged().first().filter(|_| outcome.is_ok()) {
        return Err(CliError::failed(format!("{diverged}; its model was removed")));
    }
    match outcome {
        Ok(()) if !is_recorded => Ok(ExitCode::FAILURE),
        Ok(()) if whole && cut_short => Ok(ExitCode::from(terminal::INTERRUPTED)),
        Ok(()) if whole => Ok(ExitCode::SUCCESS),
        Ok(()) => Err(CliError::failed("parts of the files have errors and were left out")),
        Err(diverged) => Err(CliError::failed(diverged)),
    }
}

impl SimOptions {
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
    fn can_run(&self) -> Result<(), String> {
        if let Some(path) =
            self.record.as_ref().filter(|path| path.extension() == Some("bag".as_ref()))
        {
            let mcap = path.with_extension("mcap");
            return Err(format!(
                "recordings are MCAP, not ROS 1 bags: write `--record {0}`, then \
                 `periplus bag convert {0} {1}`",
                mcap.display(),
                path.display()
            ));
        }
        if self.stack && self.robots.placements.len() > 1 {
            return Err(
                "--stack supports one robot; start the nodes of several robots with a launch file"
                    .into(),
            );
        }
        Ok(())
    }

    /// Topics and frames of the robot, if nodes beside it need them.
    fn profile(&self, simulation: &mut Simulation) -> Result<Option<RobotProfile>, String> {
        let is_wanted = self.stack || self.mapping.is_wanted() || self.localization.is_wanted();
        // For several robots the topics are set by the user.
        if !is_wanted || self.robots.placements.len() > 1 {
            return Ok(None);
        }
        let profile = RobotProfile::of(simulation)?;
        if profile.scan.is_none() && self.stack {
            return Err(
                "no sensor of this robot publishes laser scans, which mapping, localization and \
                        costmaps need; give the robot a lidar"
                    .into(),
            );
        }
        if !self.quiet && profile.needs_filter() {
            let (odom, base) = (profile.odom(), profile.base());
            let inputs: Vec<&str> = [&profile.odometry, &profile.imu]
                .into_iter()
                .flatten()
                .map(String::as_str)
                .collect();
            terminal::say(&format!(
                "the robot publishes no transform from {base} to {odom}: the EKF of \
                 robot_localization publishes it, from {}",
                inputs.join(" and ")
            ));
        }
        if !self.quiet && self.stack {
            let named = |topic: &Option<String>| topic.clone().unwrap_or_else(|| "none".to_owned());
            terminal::say(&format!(
                "stack: scans on {}, odometry on {}, IMU on {}, frames {} and {}, radius {:.2} m",
                named(&profile.scan),
                named(&profile.odometry),
                named(&profile.imu),
                profile.odom(),
                profile.base(),
                profile.radius_m
            ));
        }
        Ok(Some(profile))
    }

    fn simulation(&self, arguments: Arguments) -> Options {
        Options {
            seed: self.seed,
            mode: match self.dynamics {
                Dynamics::Rigid => PhysicsMode::Rigid,
                Dynamics::Kinematic => PhysicsMode::Kinematic,
            },
            step_s: self.step,
            threads: self.threads.unwrap_or_else(terminal::processors),
            quirks: if self.gz_quirks { Quirks::GAZEBO } else { Quirks::default() },
            rolling_scans: self.rolling_scans,
            arguments,
            ..Options::default()
        }
    }

    /// As fast as possible if there is a duration, otherwise at the rate of the world.
    fn factor(&self, composition: &Composition) -> Option<f64> {
        match (self.rtf, self.duration) {
            (Some(Factor::Of(factor)), _) => Some(factor),
            (Some(Factor::Max), _) | (None, Some(_)) => None,
            (None, None) => composition.real_time_factor(),
        }
    }

    /// Context of the page.
    fn about(&self, composition: &Composition) -> About {
        About {
            world: Some(composition.world.name.clone()),
            files: composition.files.iter().map(|file| file.path.clone()).collect(),
            resource_path: self.search.resource_path.clone(),
            view: None,
            fixed_frame: None,
        }
    }

    fn wanted(&self) -> TopicFilter {
        let (topics, exclude) = (self.topics.clone(), self.exclude.clone());
        Box::new(move |name| {
            topics.as_ref().is_none_or(|topics| topics.is_match(name))
                && !exclude.as_ref().is_some_and(|exclude| exclude.is_match(name))
        })
    }
}

/// Prints the findings of the files. Returns false when a requested part is missing.
pub(crate) fn tell_findings(composition: &Composition, quiet: bool) -> io::Result<bool> {
    let mut err = anstream::stderr().lock();
    let mut whole = true;
    for loaded in &composition.files {
        whole &= !loaded.diagnostics.has_errors();
        if !quiet || loaded.diagnostics.has_errors() {
            terminal::findings(&mut err, loaded)?;
        }
    }
    Ok(whole)
}

pub(crate) fn positive(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".into()),
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

pub(crate) fn factor(word: &str) -> Result<Factor, String> {
    if word == "max" {
        return Ok(Factor::Max);
    }
    positive(word).map(Factor::Of).map_err(|_| "expected a number above 0, or `max`".into())
}
