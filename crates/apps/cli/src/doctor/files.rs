//! Static checks of files, before anything runs.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::NodeSettings;
use periplus_loader::FileFormat;
use periplus_ros2cli::doctor::{SystemObserver, examine};
use periplus_ros2cli::{Failure, Seen};
use periplus_session::check::examine_parameters;
use periplus_sim::{AssetFiles, Options, Simulation, compose};

use super::{DoctorOptions, tell};
use crate::error::CliError;
use crate::options::split;
use crate::terminal;

/// Simulated duration for which a world is observed \[s\].
const SPAN_S: u64 = 2;

/// Period of reading received messages \[ns\].
const POLL_PERIOD_NS: i64 = 50_000_000;

/// Name of the doctor's own node.
const DOCTOR_NODE: &str = "_periplus_doctor";

pub(super) fn run(options: &DoctorOptions) -> Result<ExitCode, CliError> {
    let (mut files, arguments) = split(&options.words);
    files.extend(options.robots.others.iter().map(std::path::PathBuf::from));
    let is_launch = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        [".launch", ".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml"]
            .iter()
            .any(|end| name.ends_with(end))
            || name.ends_with("_launch.py")
    };
    let is_yaml = |path: &Path| {
        let end = path.extension().unwrap_or_default();
        !is_launch(path) && (end == "yaml" || end == "yml")
    };
    let is_world = |path: &Path| !is_yaml(path) && !is_launch(path);
    let mut found = Vec::new();
    let mut what: Vec<String> = Vec::new();
    for path in files.iter().filter(|path| is_yaml(path)) {
        match examine_parameters(path) {
            Ok(findings) => found.extend(findings),
            Err(why) => {
                return Err(CliError::failed(why));
            }
        }
        what.push(path.display().to_string());
    }
    for path in files.iter().filter(|path| is_launch(path)) {
        let search = &options.search.resource_path;
        found.push(crate::launch::examine(path, arguments.clone(), search));
        what.push(path.display().to_string());
    }
    let worlds: Vec<_> = files.iter().filter(|path| is_world(path)).collect();
    match worlds.as_slice() {
        [] => {}
        [world] => {
            match simulated(world, arguments, options) {
                Ok(findings) => found.extend(findings),
                Err(why) => {
                    return Err(CliError::failed(why));
                }
            }
            what.push(world.display().to_string());
        }
        _ => {
            return Err(CliError::usage("give one world; add robots with --robot"));
        }
    }
    tell(&found, &what.join(", "), options.common.json)
}

/// Simulates a world and observes its topics.
fn simulated(
    world: &Path,
    arguments: Vec<(String, String)>,
    options: &DoctorOptions,
) -> Result<Vec<(Diagnostics, SourceMap)>, String> {
    let search = &options.search.resource_path;
    let mut composition = terminal::with_setting(search, arguments, |setting| {
        compose(world, &options.robots.placements, setting)
    });
    let threads = terminal::processors();
    let settings = Options { threads, ..Options::default() };
    let mut simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), settings);
    if let Some(missing) = composition.missing() {
        return Err(format!("{} has nothing to simulate", missing.display()));
    }
    let graph = simulation.graph().clone();
    let node =
        graph.node(NodeSettings::new(DOCTOR_NODE).bare()).map_err(|error| error.to_string())?;
    let look = || Seen::of_graph(&graph, |name| name.ends_with(DOCTOR_NODE));
    let told = |failure: Failure| failure.to_string();
    let mut ears = SystemObserver::open(&node, &look()).map_err(told)?;
    let span_ns = i64::try_from(SPAN_S).unwrap_or(0) * 1_000_000_000;
    while simulation.time_ns() < span_ns {
        let until_ns = simulation.time_ns() + POLL_PERIOD_NS;
        simulation.step_until(until_ns).map_err(|diverged| diverged.to_string())?;
        ears.hear();
    }
    let mut observation = ears.observation(look(), BTreeMap::new(), Duration::from_secs(SPAN_S));
    let is_robot = |language: FileFormat| matches!(language, FileFormat::Urdf | FileFormat::Xacro);
    observation.is_alone = composition.files.first().is_some_and(|file| is_robot(file.language));
    let mut found: Vec<_> =
        composition.files.into_iter().map(|file| (file.diagnostics, file.sources)).collect();
    found.push((simulation.take_findings(), SourceMap::new()));
    found.push((examine(&observation), SourceMap::new()));
    Ok(found)
}
