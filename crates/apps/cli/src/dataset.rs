//! `periplus dataset`.

mod capture;
mod classes;
mod coco;
mod kitti;
mod matrix;
mod semantic_kitti;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use periplus_loader::LoadContext;
use periplus_os::Machine;
use periplus_resources::{EntryKind, Host as _};
use periplus_sim::{AssetFiles, Options, PhysicsMode, Simulation, compose};
use serde_json::json;

use crate::error::CliError;
use crate::options::SearchOptions;
use crate::run_options::positive;
use crate::sim::{Dynamics, Robots, read_driver};
use crate::{paths, terminal};
use capture::Capture;
use classes::{ClassName, class_name};

/// Write a labelled dataset of images and point clouds from a simulation
///
/// Images and clouds are those of a camera and a lidar of the robot, with their noise. Labels come from the models with
/// Gazebo's label plugin (`gz-sim-label-system`), and from actors with it. Formats: `coco` has images, boxes and masks of
/// objects; `kitti` has images, clouds, calibration and 3D boxes as the KITTI object benchmark; `lidar` has clouds with a
/// label for each point and poses, as SemanticKITTI. The same files, options and seed give the same dataset.
#[derive(Debug, Args)]
pub(crate) struct DatasetOptions {
    /// World, and `name:=value` for its xacro
    #[arg(value_name = "WORLD|NAME:=VALUE")]
    words: Vec<String>,
    #[command(flatten)]
    robots: Robots,
    /// Duration of the run in simulated seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: f64,
    /// Folder to write; it must be empty or new
    #[arg(long, short, value_name = "FOLDER")]
    out: PathBuf,
    /// Format of the dataset
    #[arg(long, value_enum)]
    format: DatasetFormat,
    /// Frames per simulated second
    #[arg(long, value_name = "HZ", default_value_t = 2.0, value_parser = positive)]
    rate: f64,
    /// Name of the camera sensor [default: the first camera of the robot]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Name of the lidar sensor [default: the first lidar of the robot]
    #[arg(long, value_name = "NAME")]
    lidar: Option<String>,
    /// Name of the class of a label [default: the name of its first model without a number]
    #[arg(long = "class", value_name = "LABEL=NAME", value_parser = class_name)]
    classes: Vec<ClassName>,
    /// Drive by a script (YAML) or by the velocity commands of a bag
    #[arg(long, value_name = "FILE")]
    cmd: Option<PathBuf>,
    /// Seed of all noise
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    /// Motion model: rigid bodies, or motion exactly as commanded on a flat floor
    #[arg(long, value_enum, default_value_t = Dynamics::Rigid)]
    dynamics: Dynamics,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    search: SearchOptions,
}

/// Layout of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DatasetFormat {
    /// Images with boxes and masks, `annotations/instances.json`
    Coco,
    /// Images, clouds, calibration and labels of the KITTI object benchmark
    Kitti,
    /// Clouds with a label for each point, in the layout of SemanticKITTI
    Lidar,
}

impl DatasetFormat {
    fn name(self) -> &'static str {
        match self {
            Self::Coco => "coco",
            Self::Kitti => "kitti",
            Self::Lidar => "lidar",
        }
    }
}

pub(crate) fn run(options: &DatasetOptions) -> Result<ExitCode, CliError> {
    let (world, arguments) = options.robots.world(&options.words, "dataset")?;
    options.check_folder()?;
    let mut driver = options.cmd.as_deref().map(read_driver).transpose()?.unwrap_or_default();
    let search = terminal::search(&options.search.resource_path);
    let mut composition = search.with_context(true, |context| {
        let context = LoadContext { arguments, ..context.clone() };
        compose(&world, &options.robots.placements, &context)
    });
    let settings = Options {
        seed: options.seed,
        mode: match options.dynamics {
            Dynamics::Rigid => PhysicsMode::Rigid,
            Dynamics::Kinematic => PhysicsMode::Kinematic,
        },
        threads: terminal::processors(),
        ..Options::default()
    };
    let mut simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), settings);
    let mut err = anstream::stderr().lock();
    for file in &composition.files {
        terminal::findings(&mut err, file)?;
    }
    if let Some(missing) = composition.missing() {
        return Err(CliError::failed(format!("nothing to record of {}", missing.display())));
    }
    let warnings = driver.join(&simulation).map_err(CliError::failed)?;
    terminal::diagnostics(&mut err, &warnings, &periplus_diagnostics::SourceMap::new())?;
    drop(err);
    let mut capture = Capture::new(options, &mut simulation)?;
    if capture.classes().is_empty() {
        terminal::say(
            "warning: no model of this world has a label, so that the dataset has none: add \
             `<plugin filename=\"gz-sim-label-system\" name=\"gz::sim::systems::Label\"><label>1</label></plugin>` \
             to models or actors",
        );
    }
    let is_complete = capture.run(&mut simulation, &mut driver, options.duration, options.rate)?;
    let report = capture.finish()?;
    if options.json {
        writeln!(io::stdout().lock(), "{report:#}")?;
    } else {
        terminal::say(&format!(
            "{} frames with {} labelled objects are in {}",
            report["frames"],
            report["objects"],
            options.out.display()
        ));
    }
    if composition.has_errors() {
        return Err(CliError::failed("parts of the files have errors and are not in the dataset"));
    }
    Ok(if is_complete { ExitCode::SUCCESS } else { ExitCode::from(terminal::INTERRUPTED) })
}

impl DatasetOptions {
    /// Checks that no file of another dataset is mixed with this one.
    fn check_folder(&self) -> Result<(), CliError> {
        let is_used = match Machine.kind(&self.out) {
            None => false,
            Some(EntryKind::File) => true,
            Some(_) => !Machine.list(&self.out).is_empty(),
        };
        if is_used {
            return Err(CliError::usage(format!(
                "{} is not empty: give a new folder to `--out`",
                self.out.display()
            )));
        }
        paths::make_folder(&self.out)?;
        Ok(())
    }

    /// Report of a dataset.
    fn report(&self, capture: &Capture<'_>) -> serde_json::Value {
        let classes = capture.classes().iter();
        let classes = classes.map(|(id, name)| json!({ "id": id, "name": name }));
        json!({
            "format": self.format.name(),
            "folder": self.out,
            "frames": capture.frame_count(),
            "objects": capture.object_count(),
            "points": capture.point_count(),
            "camera": capture.camera_name(),
            "lidar": capture.lidar_name(),
            "classes": classes.collect::<Vec<_>>(),
        })
    }
}
