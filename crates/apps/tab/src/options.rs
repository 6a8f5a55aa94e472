//! Options of a tab, as JSON.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

/// Session of a tab: `{"demo": {...}}` or `{"run": {...}}`.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "WrittenOptions")]
pub enum TabOptions {
    /// The demo.
    Demo(DemoOptions),
    /// A world and robots from files.
    Run(Box<RunOptions>),
}

impl Default for TabOptions {
    fn default() -> Self {
        Self::Demo(DemoOptions::default())
    }
}

/// Options as they are written.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WrittenOptions {
    demo: Option<DemoOptions>,
    run: Option<Box<RunOptions>>,
}

impl TryFrom<WrittenOptions> for TabOptions {
    type Error = &'static str;

    fn try_from(written: WrittenOptions) -> Result<Self, Self::Error> {
        match (written.demo, written.run) {
            (Some(_), Some(_)) => Err("a tab has one session: give `demo` or `run`, not both"),
            (_, Some(run)) => Ok(Self::Run(run)),
            (demo, None) => Ok(Self::Demo(demo.unwrap_or_default())),
        }
    }
}

/// Options of the demo, as those of `periplus demo`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DemoOptions {
    /// Seed of all noise.
    pub seed: u64,
    /// True to explore autonomously.
    pub explore: bool,
    /// True to run the servers of navigation, which drive to goals of the user; not together with `explore`.
    pub navigation: bool,
    /// True without the page and its topics.
    pub headless: bool,
    /// True if the caller steps in real time: maps are then computed in slices, without pauses.
    pub is_paced: bool,
    /// Duration of the run \[s\]; images are taken shortly before its end.
    pub duration_s: Option<f64>,
    /// Folder of map, bag and images, in memory; none are made without it.
    pub out: Option<PathBuf>,
}

/// Xacro arguments as the loader takes them.
pub(crate) fn pairs(arguments: &BTreeMap<String, String>) -> Vec<(String, String)> {
    arguments.iter().map(|(name, value)| (name.clone(), value.clone())).collect()
}

/// Options of a run, as those of `periplus sim`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RunOptions {
    /// Base folder of relative paths, and of worlds that are named without a path; `/` by default.
    pub folder: Option<PathBuf>,
    /// World or robot: a file, or the name of a world such as `house`. Without it the robots are on a plane.
    pub world: Option<PathBuf>,
    /// Xacro arguments of the world.
    pub arguments: BTreeMap<String, String>,
    /// Robots that are added.
    pub robots: Vec<RobotOptions>,
    /// Script (YAML) or recording (MCAP) whose velocity commands are played.
    pub cmd: Option<PathBuf>,
    /// Seed of all noise.
    pub seed: u64,
    /// Motion model.
    pub dynamics: RunDynamics,
    /// Simulation step \[s\]; by default that of the world.
    pub step_s: Option<f64>,
    /// True to reproduce quirks of Gazebo.
    pub gz_quirks: bool,
    /// True to simulate the beams of a lidar one after the other while the robot moves.
    pub rolling_scans: bool,
    /// Remaps as `from:=to`.
    pub remaps: Vec<String>,
    /// Parameters as `name:=value` or `node:name:=value`.
    pub parameters: Vec<String>,
    /// Parameter files of ROS 2; later files win.
    pub params_files: Vec<PathBuf>,
    /// True if the caller steps in real time: maps are then computed in slices, without pauses.
    pub is_paced: bool,
    /// Real-time factor of a paced run; by default that of the world.
    pub real_time_factor: Option<f64>,
    /// True to run the usual nodes beside the robot: filter, SLAM or localization, costmaps.
    pub stack: bool,
    /// The servers of Nav2.
    pub navigation: Option<NavigationOptions>,
    /// Parameter file of Nav2 whose costmaps run.
    pub costmap: Option<PathBuf>,
    /// YAML of a map, parameter file of `map_server` and `amcl`, or both.
    pub localize: Vec<PathBuf>,
    /// Mapping.
    pub slam: Option<MappingOptions>,
    /// Recording of the published topics.
    pub record: Option<RecordOptions>,
    /// File to which the page may write the changed world.
    pub world_out: Option<PathBuf>,
    /// RViz file that the page opens.
    pub view: Option<PathBuf>,
    /// Fixed frame of the page, in place of the one in the RViz file.
    pub fixed_frame: Option<String>,
    /// Folders searched for packages and models, besides those around the files.
    pub resource_path: Vec<PathBuf>,
    /// True without the page and its topics.
    pub headless: bool,
}

/// Motion model of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RunDynamics {
    /// Bodies, joints, contacts and friction.
    #[default]
    Rigid,
    /// Motion exactly as commanded, without collisions.
    Kinematic,
}

/// A robot of a run.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotOptions {
    /// File: URDF, xacro, or an SDF with one model.
    pub file: PathBuf,
    /// Xacro arguments.
    #[serde(default)]
    pub arguments: BTreeMap<String, String>,
    /// Name; by default that of the file.
    #[serde(default)]
    pub name: Option<String>,
    /// Namespace of the topics.
    #[serde(default)]
    pub namespace: Option<String>,
    /// x, y \[m\] and yaw \[rad\] on the floor, or x, y, z \[m\] and roll, pitch, yaw \[rad\].
    #[serde(default)]
    pub pose: Option<Vec<f64>>,
}

/// The servers of Nav2.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NavigationOptions {
    /// Parameter file; by default parameters for the robot.
    pub params_file: Option<PathBuf>,
}

/// Mapping beside the robot.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MappingOptions {
    /// Parameter file of `slam_toolbox` or `slam_gmapping`; by default default parameters.
    pub params_file: Option<PathBuf>,
    /// Node: async, sync, localization, lifelong or gmapping; by default the one of the parameter file.
    pub node: Option<String>,
    /// Folder of map and session, which are written when the page asks for them.
    pub out: Option<PathBuf>,
}

/// Recording of a run.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordOptions {
    /// MCAP file, or folder in the format of `ros2 bag`.
    pub file: PathBuf,
    /// True to record the true poses of all models, too.
    #[serde(default)]
    pub truth: bool,
    /// Names of topics to record; all without it.
    #[serde(default)]
    pub topics: Option<Vec<String>>,
    /// Command that the recording contains as the source of the run.
    #[serde(default)]
    pub command: Option<String>,
}
