//! `periplus new`: templates of a robot, a world or a package.

mod files;
mod names;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand, ValueEnum};
use periplus_os::Machine;
use periplus_resources::Host as _;

use crate::error::CliError;
use crate::{paths, terminal};
use files::NewFile;

/// Create a robot, a world or a package
///
/// The files are small, commented and complete: they pass `periplus check --strict`, `periplus sim`
/// and `periplus launch` run them, and they work unchanged in ROS 2 with Gazebo. Existing files are
/// never overwritten.
#[derive(Debug, Subcommand)]
pub(crate) enum NewCommand {
    Robot(RobotOptions),
    World(WorldOptions),
    Package(PackageOptions),
}

/// Write NAME.urdf.xacro: a robot with two driven wheels, a caster, a lidar, an IMU and a camera
///
/// Arguments of the file are `sim:=gz|classic`, `lidar:=`, `imu:=`, `camera:=` and
/// `publish_odom_tf:=true|false`; the options here set their defaults.
#[derive(Debug, Args)]
pub(crate) struct RobotOptions {
    /// Name of the robot and of the file
    #[arg(value_parser = names::name)]
    name: String,
    #[command(flatten)]
    parts: Parts,
    #[command(flatten)]
    place: Placement,
}

/// Write NAME.sdf: a room with walls, furniture, and a carton that can be pushed
#[derive(Debug, Args)]
pub(crate) struct WorldOptions {
    /// Name of the world and of the file
    #[arg(value_parser = names::name)]
    name: String,
    #[command(flatten)]
    place: Placement,
}

/// Write the folder NAME: a ROS 2 package with a robot, a room, a launch file and parameters
///
/// `periplus launch NAME simulation.launch.py` starts the simulation, the EKF, slam_toolbox or
/// localization, and RViz; so does `ros2 launch` after `colcon build`.
#[derive(Debug, Args)]
pub(crate) struct PackageOptions {
    /// Name of the package, its folder and its robot
    #[arg(value_parser = names::name)]
    name: String,
    #[command(flatten)]
    parts: Parts,
    #[command(flatten)]
    place: Placement,
}

/// Parts of a robot.
#[derive(Debug, Args)]
struct Parts {
    /// Omit a sensor; repeatable
    #[arg(long, value_enum, value_name = "SENSOR")]
    without: Vec<Sensor>,
}

/// Destination and simulator.
#[derive(Debug, Args)]
struct Placement {
    /// Simulator for the plugins, besides Periplus: Gazebo Harmonic or Gazebo Classic 11
    #[arg(long, value_enum, value_name = "gz|classic", default_value_t = Simulator::Gz)]
    sim: Simulator,
    /// Output folder [default: the working folder]
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Sensor {
    /// The lidar on /scan
    Lidar,
    /// The IMU on /imu
    Imu,
    /// The camera on /camera/image_raw
    Camera,
}

/// Simulator that the plugins of a file are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Simulator {
    /// Gazebo Harmonic
    Gz,
    /// Gazebo Classic 11
    Classic,
}

impl Simulator {
    const fn word(self) -> &'static str {
        match self {
            Self::Gz => "gz",
            Self::Classic => "classic",
        }
    }
}

pub(crate) fn run(command: &NewCommand) -> Result<ExitCode, CliError> {
    let (place, files, next) = match command {
        NewCommand::Robot(options) => {
            let name = &options.name;
            let files = vec![files::robot(name, options.place.sim, &options.parts.without)];
            let next = vec![
                format!("periplus check {name}.urdf.xacro"),
                format!("periplus sim {name}.urdf.xacro --page"),
                "periplus teleop          (in a second terminal)".to_owned(),
            ];
            (&options.place, files, next)
        }
        NewCommand::World(options) => {
            let name = &options.name;
            let next = vec![
                format!("periplus check {name}.sdf"),
                format!("periplus sim {name}.sdf --robot ROBOT.urdf.xacro --page"),
            ];
            (&options.place, vec![files::world(name, options.place.sim)], next)
        }
        NewCommand::Package(options) => {
            let name = &options.name;
            let files = files::package(name, options.place.sim, &options.parts.without);
            let next = vec![
                format!("periplus launch {name} simulation.launch.py"),
                "periplus teleop          (in a second terminal)".to_owned(),
                "periplus map save -f room   (in a third)".to_owned(),
            ];
            (&options.place, files, next)
        }
    };
    let folder = place.output.clone().unwrap_or_default();
    for path in write(&folder, &files)? {
        terminal::say(&format!("wrote {}", path.display()));
    }
    let at = if folder.as_os_str().is_empty() {
        String::new()
    } else {
        format!(", in {}", folder.display())
    };
    terminal::say(&format!("next{at}:"));
    for line in next {
        terminal::say(&format!("  {line}"));
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes all files, or none if one exists.
///
/// # Errors
/// A message when a file cannot be written.
fn write(folder: &Path, files: &[NewFile]) -> Result<Vec<PathBuf>, CliError> {
    // The folder of a package must be new, so that it contains no parts of another package.
    for file in files {
        let first = file
            .path
            .components()
            .next()
            .map_or(file.path.as_path(), |one| Path::new(one.as_os_str()));
        let path = folder.join(first);
        if Machine.kind(&path).is_some() {
            return Err(CliError::Failed(format!(
                "{} exists and is not overwritten: choose another name, or another folder with --output",
                path.display()
            )));
        }
    }
    let mut written = Vec::new();
    for file in files {
        let path = folder.join(&file.path);
        if let Some(parent) = path.parent() {
            paths::make_folder(parent)?;
        }
        paths::write(&path, file.text.as_bytes())?;
        written.push(path);
    }
    Ok(written)
}
