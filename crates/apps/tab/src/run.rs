//! Sessions from files: a world and robots, as `periplus sim` runs them.
#![expect(clippy::disallowed_methods, reason = "a tab is an edge: its files are in memory")]

use std::path::{Path, PathBuf};

use periplus_bags::Compression;
use periplus_geometry::{Pose, Rpy};
use periplus_loader::LoadContext;
use periplus_os::{Stopwatch, fs};
use periplus_session::demo::DemoTask;
use periplus_session::nodes::{
    CostmapRequest, CostmapSource, EstimatorSelection, MappingRequest, MappingSource,
};
use periplus_session::{
    PageContext, RecordingRequest, RunError, SessionBuilder, read_arguments, terminal,
};
use periplus_sim::{
    Composition, Driver, Options, PhysicsMode, PlacementPose, Quirks, RobotPlacement, STEP_RANGE_S,
    Search, compose, compose_plain,
};

use crate::opened::{OpenedSession, make_folder};
use crate::options::{RecordOptions, RobotOptions, RunDynamics, RunOptions, pairs};
use crate::tab::TabError;

/// Extensions of worlds that are named without a path.
const WORLD_EXTENSIONS: [&str; 2] = ["sdf", "world"];

/// Starts the session.
pub(crate) fn open(options: &RunOptions) -> Result<OpenedSession, TabError> {
    let start = Stopwatch::start();
    let folder = Folder(options.folder.clone().unwrap_or_else(|| PathBuf::from("/")));
    let search = Search {
        folders: folder.all(&options.resource_path),
        working_folder: folder.0.clone(),
        ..Search::default()
    };
    let composition = composed(options, &folder, &search)?;
    let context = (!options.headless).then(|| PageContext {
        world_out: options.world_out.as_deref().map(|path| folder.at(path)),
        view: options.view.as_deref().map(|path| folder.at(path)),
        fixed_frame: options.fixed_frame.clone(),
        ..PageContext::of(&composition, &search.folders)
    });
    let factor = options
        .is_paced
        .then(|| options.real_time_factor.or_else(|| composition.real_time_factor()))
        .flatten();
    let selection = selection(options, &folder)?;
    let robot_count = options.robots.len();
    let record = options.record.as_ref();
    let recording = record.map(|record| recording(record, &folder)).transpose()?;
    let session = SessionBuilder::new(composition, simulation(options, &folder)?, start)
        .factor(factor)
        .search(search)
        .recording(recording)
        .recording_truth(record.is_some_and(|record| record.truth))
        .command(record.and_then(|record| record.command.clone()))
        .driver(driver(options, &folder)?)
        .estimators(selection.request(robot_count))
        .build()?;
    let task = DemoTask::join(session.graph(), false, false, None).map_err(RunError::from)?;
    Ok(OpenedSession { session, task, context })
}

/// Base folder of relative paths.
struct Folder(PathBuf);

impl Folder {
    fn at(&self, path: &Path) -> PathBuf {
        self.0.join(path)
    }

    fn all(&self, paths: &[PathBuf]) -> Vec<PathBuf> {
        paths.iter().map(|path| self.at(path)).collect()
    }
}

fn composed(
    options: &RunOptions,
    folder: &Folder,
    search: &Search,
) -> Result<Composition, TabError> {
    let robots: Result<Vec<_>, _> =
        options.robots.iter().map(|robot| placement(robot, folder)).collect();
    let robots = robots?;
    let world = options.world.as_deref().map(|world| world_file(world, folder)).transpose()?;
    if world.is_none() && robots.is_empty() {
        return Err(TabError::Refused(
            "there is nothing to simulate: give `world`, `robots`, or both".to_owned(),
        ));
    }
    let arguments = pairs(&options.arguments);
    Ok(search.with_context(true, |context| {
        let context = LoadContext { arguments, ..context.clone() };
        match world {
            Some(world) => compose(&world, &robots, &context),
            None => compose_plain(&robots, &context),
        }
    }))
}

/// File of a world. A name without a path and extension is that of a file in `worlds`.
fn world_file(world: &Path, folder: &Folder) -> Result<PathBuf, TabError> {
    let is_name = world.components().count() == 1 && world.extension().is_none();
    if !is_name || fs::exists(&folder.at(world)) {
        return Ok(folder.at(world));
    }
    let worlds = folder.at(Path::new("worlds"));
    let named = WORLD_EXTENSIONS.map(|extension| worlds.join(world).with_extension(extension));
    if let Some(file) = named.into_iter().find(|file| fs::is_file(file)) {
        return Ok(file);
    }
    let there: Vec<String> = fs::read_dir(&worlds)
        .map(|entries| {
            let paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
            let is_world = |path: &PathBuf| {
                WORLD_EXTENSIONS.iter().any(|it| path.extension().is_some_and(|has| has == *it))
            };
            let names = paths.filter(is_world).filter_map(|path| {
                path.file_stem().map(|stem| stem.to_string_lossy().into_owned())
            });
            names.collect()
        })
        .unwrap_or_default();
    let known = if there.is_empty() {
        format!("there are no worlds in {}", worlds.display())
    } else {
        format!("there are {}", there.join(", "))
    };
    Err(TabError::Refused(format!(
        "there is no world `{}`: {known}; give the path of a file for another one",
        world.display()
    )))
}

fn placement(robot: &RobotOptions, folder: &Folder) -> Result<RobotPlacement, TabError> {
    let pose = match robot.pose.as_deref() {
        None => PlacementPose::AsWritten,
        Some(&[x, y]) => PlacementPose::OnGround([x, y, 0.0]),
        Some(&[x, y, yaw]) => PlacementPose::OnGround([x, y, yaw]),
        Some(&[x, y, z, roll, pitch, yaw]) => {
            PlacementPose::At(Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw }))
        }
        Some(other) => {
            return Err(TabError::Refused(format!(
                "the pose of {} has {} numbers; give x, y, yaw or x, y, z, roll, pitch, yaw",
                robot.file.display(),
                other.len()
            )));
        }
    };
    Ok(RobotPlacement {
        file: folder.at(&robot.file),
        arguments: pairs(&robot.arguments),
        name: robot.name.clone(),
        namespace: robot.namespace.clone(),
        pose,
    })
}

fn simulation(options: &RunOptions, folder: &Folder) -> Result<Options, TabError> {
    if let Some(step_s) = options.step_s {
        let [shortest_s, longest_s] = STEP_RANGE_S;
        if !(shortest_s..=longest_s).contains(&step_s) {
            return Err(TabError::Refused(format!(
                "`step_s` is {step_s}; give {shortest_s} to {longest_s} s"
            )));
        }
    }
    let words = |flag: &str, values: Vec<String>| -> Vec<String> {
        values.into_iter().flat_map(|value| [flag.to_owned(), value]).collect()
    };
    let files = folder.all(&options.params_files);
    let files = files.iter().map(|path| path.to_string_lossy().into_owned()).collect();
    let words = [
        words("--params-file", files),
        words("--param", options.parameters.clone()),
        words("--remap", options.remaps.clone()),
    ]
    .concat();
    Ok(Options {
        seed: options.seed,
        mode: match options.dynamics {
            RunDynamics::Rigid => PhysicsMode::Rigid,
            RunDynamics::Kinematic => PhysicsMode::Kinematic,
        },
        step_s: options.step_s,
        quirks: if options.gz_quirks { Quirks::GAZEBO } else { Quirks::default() },
        rolling_scans: options.rolling_scans,
        arguments: read_arguments(&words)?,
        ..Options::default()
    })
}

fn driver(options: &RunOptions, folder: &Folder) -> Result<Driver, TabError> {
    let Some(path) = &options.cmd else { return Ok(Driver::default()) };
    let (driver, findings) = Driver::read(&folder.at(path));
    terminal::diagnostics(&mut terminal::messages(), &findings.diagnostics, &findings.sources)
        .map_err(RunError::Output)?;
    if findings.diagnostics.has_errors() {
        return Err(TabError::Refused(format!("the script {} has errors", path.display())));
    }
    Ok(driver)
}

fn selection(options: &RunOptions, folder: &Folder) -> Result<EstimatorSelection, TabError> {
    let mapping = options.slam.clone().unwrap_or_default();
    let program = mapping.node.map(|name| name.parse()).transpose().map_err(TabError::Refused)?;
    let out = mapping.out.as_deref().map(|out| folder.at(out));
    Ok(EstimatorSelection {
        has_stack: options.stack,
        navigation: options
            .navigation
            .as_ref()
            .map(|navigation| navigation.params_file.as_deref().map(|path| folder.at(path))),
        costmaps: options.costmap.as_deref().map(|path| CostmapRequest {
            source: CostmapSource::File(folder.at(path), None),
            cells: Vec::new(),
            images: None,
        }),
        localization: folder.all(&options.localize),
        is_mapping_requested: options.slam.is_some(),
        mapping: MappingRequest {
            source: MappingSource::File(
                mapping.params_file.as_deref().map(|path| folder.at(path)),
                program,
            ),
            out,
        },
    })
}

fn recording(record: &RecordOptions, folder: &Folder) -> Result<RecordingRequest, TabError> {
    let path = folder.at(&record.file);
    if path.extension().is_some_and(|extension| extension == "bag") {
        return Err(TabError::Refused(format!(
            "recordings are MCAP, not ROS 1 bags: name it {}, and convert it with `periplus bag convert`",
            path.with_extension("mcap").display()
        )));
    }
    make_folder(path.parent().unwrap_or(Path::new("/")))?;
    let topics = record.topics.clone();
    Ok(RecordingRequest {
        compression: Compression::None,
        ..RecordingRequest::new(path, move |name| {
            topics.as_ref().is_none_or(|topics| topics.iter().any(|topic| topic == name))
        })
    })
}
