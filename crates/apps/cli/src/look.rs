//! `periplus look`.

mod aim;
mod message;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use periplus_images::{Layout, write_png};
use periplus_loader::LoadContext;
use periplus_sim::{
    AssetFiles, BoundingBox, Composition, Options, PhotoRequest, SensedGeometry, Simulation,
    compose,
};
use serde_json::json;

use crate::error::CliError;
use crate::options::SearchOptions;
use crate::sim::Robots;
use crate::{paths, terminal};
use aim::View;

/// Largest time of a picture \[s\].
const MAX_TIME_S: f64 = 3600.0;

/// Render a picture of a robot or a world, or what a sensor of the robot sees
///
/// The picture shows the whole world or robot, or one `--model`, from a `--view`, or from a point
/// with `--from`. With `--topic` it is the next image or scan that a sensor publishes. Sensors,
/// physics and controllers run for `--time` seconds before. It needs no GPU and no window. Exit
/// code 1: nothing to see, or a file has errors.
#[derive(Debug, Args)]
pub(crate) struct LookOptions {
    /// World or robot, and `name:=value` for its xacro
    #[arg(value_name = "FILE|NAME:=VALUE")]
    words: Vec<String>,
    #[command(flatten)]
    robots: Robots,
    /// PNG file to write
    #[arg(long, short, value_name = "FILE.png")]
    output: PathBuf,
    /// Model that fills the picture [default: all models]
    #[arg(long, value_name = "NAME", conflicts_with = "from")]
    model: Option<String>,
    /// Direction of view
    #[arg(long, value_enum, default_value_t = View::Corner, conflicts_with = "from")]
    view: View,
    /// Position of the camera in the world [m]
    #[arg(long, value_name = "X,Y,Z", value_parser = aim::point, allow_hyphen_values = true)]
    from: Option<aim::Point>,
    /// Point in the centre of the picture [m] [default: the centre of the models]
    #[arg(long, value_name = "X,Y,Z", value_parser = aim::point, allow_hyphen_values = true, requires = "from")]
    to: Option<aim::Point>,
    /// Image or scan topic of a sensor, in place of a view
    #[arg(long, value_name = "TOPIC", conflicts_with_all = ["from", "view", "model", "size", "collisions"])]
    topic: Option<String>,
    /// Simulated time of the picture [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, value_parser = time)]
    time: f64,
    /// Width and height [px]
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "960x540", value_parser = size)]
    size: Size,
    /// Show collisions instead of visuals
    #[arg(long)]
    collisions: bool,
    /// Seed of all noise
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    /// Print position of the camera, bounds and models as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    search: SearchOptions,
}

/// Size of a picture \[px\].
#[derive(Clone, Copy, Debug)]
struct Size {
    width_px: u32,
    height_px: u32,
}

pub(crate) fn run(options: &LookOptions) -> Result<ExitCode, CliError> {
    let (world, arguments) = options.robots.world(&options.words, "look")?;
    let search = terminal::search(&options.search.resource_path);
    let mut composition = search.with_context(true, |context| {
        let context = LoadContext { arguments, ..context.clone() };
        compose(&world, &options.robots.placements, &context)
    });
    let settings =
        Options { seed: options.seed, threads: terminal::processors(), ..Options::default() };
    let mut simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), settings);
    print_findings(&composition)?;
    if let Some(missing) = composition.missing() {
        return Err(CliError::failed(format!("nothing to see of {}", missing.display())));
    }
    let report = match &options.topic {
        Some(topic) => {
            let picture = message::next(&mut simulation, topic, options.time)?;
            paths::write(&options.output, &picture.png)?;
            json!({ "topic": topic, "type": picture.type_name, "time_s": picture.time_s })
        }
        None => options.photo(&mut simulation, &composition)?,
    };
    if options.json {
        let mut report = report;
        report["file"] = json!(options.output);
        writeln!(io::stdout().lock(), "{report:#}")?;
    } else {
        terminal::say(&format!("the picture is in {}", options.output.display()));
    }
    if composition.has_errors() {
        return Err(CliError::failed("parts of the files have errors and are not in the picture"));
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints the findings of all files to stderr.
fn print_findings(composition: &Composition) -> Result<(), CliError> {
    let mut err = anstream::stderr().lock();
    for file in &composition.files {
        terminal::findings(&mut err, file)?;
    }
    Ok(())
}

impl LookOptions {
    /// Renders a view and returns its report.
    fn photo(
        &self,
        simulation: &mut Simulation,
        composition: &Composition,
    ) -> Result<serde_json::Value, CliError> {
        run_until(simulation, self.time)?;
        let geometry =
            if self.collisions { SensedGeometry::Collision } else { SensedGeometry::Visual };
        let Size { width_px, height_px } = self.size;
        let bounds = self.bounds(simulation, composition, geometry)?;
        let aspect = f64::from(height_px) / f64::from(width_px);
        let world_from_camera = match self.from {
            Some(from) => {
                let to_m = self.to.map_or(bounds.centre_m(), |to| to.0);
                aim::at(from.0, to_m).ok_or_else(|| {
                    CliError::usage("`--from` is the point that the picture shows: move the camera away from it")
                })?
            }
            None => aim::whole(&bounds, self.view, aspect),
        };
        let photo = simulation
            .photo(&PhotoRequest {
                world_from_camera,
                horizontal_fov_rad: aim::HORIZONTAL_FOV_RAD,
                width_px,
                height_px,
                geometry,
            })
            .map_err(CliError::usage)?;
        paths::write(
            &self.output,
            &write_png(photo.width_px, photo.height_px, Layout::Rgb, &photo.rgb),
        )?;
        Ok(json!({
            "camera_m": world_from_camera.translation.to_array(),
            "low_m": bounds.low_m.to_array(),
            "high_m": bounds.high_m.to_array(),
            "models": names(simulation),
            "time_s": self.time,
        }))
    }

    /// Bounds of what the picture shows: of the model, or of everything.
    fn bounds(
        &self,
        simulation: &mut Simulation,
        composition: &Composition,
        geometry: SensedGeometry,
    ) -> Result<BoundingBox, CliError> {
        // The plane under a robot is not what was asked for; it has no bounds either.
        if let Some(found) = simulation.bounding_box(geometry, self.model.as_deref()) {
            return Ok(found);
        }
        let names = names(simulation);
        Err(match &self.model {
            Some(model) if !names.contains(model) => CliError::usage(format!(
                "no model `{model}` in {}; it has {}",
                first_file(composition).display(),
                if names.is_empty() { "none".to_owned() } else { names.join(", ") }
            )),
            _ => CliError::failed(format!(
                "nothing to see: no {} with a size in {}",
                if self.collisions { "collision" } else { "visual" },
                first_file(composition).display()
            )),
        })
    }
}

fn names(simulation: &Simulation) -> Vec<String> {
    simulation.models().map(ToOwned::to_owned).collect()
}

fn first_file(composition: &Composition) -> &Path {
    composition.files.first().map_or(Path::new(""), |file| &file.path)
}

/// Runs the simulation until a time \[s\].
fn run_until(simulation: &mut Simulation, time_s: f64) -> Result<(), CliError> {
    simulation.step_until((time_s * 1e9).round() as i64).map_err(CliError::failed)
}

fn time(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(time_s) if (0.0..=MAX_TIME_S).contains(&time_s) => Ok(time_s),
        _ => Err(format!("expected a time from 0 to {MAX_TIME_S} s")),
    }
}

fn size(word: &str) -> Result<Size, String> {
    let sides = word.split_once('x').map(|(width, height)| (width.parse(), height.parse()));
    match sides {
        Some((Ok(width_px @ 1..), Ok(height_px @ 1..))) => Ok(Size { width_px, height_px }),
        _ => Err("expected WIDTHxHEIGHT in pixels, such as 960x540".to_owned()),
    }
}
