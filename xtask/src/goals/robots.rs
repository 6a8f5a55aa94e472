//! Robots of the drives, and the parameters that they drive with.

use std::path::{Path, PathBuf};

use super::write;
use crate::step::{Failed, root};

/// A robot.
pub(super) struct Robot {
    pub(super) name: &'static str,
    file: File,
    /// Folders of the shared data with packages of the robot.
    packages: &'static [&'static str],
    pub(super) parameters: Parameters,
    /// Options of `periplus navigate`.
    options: &'static [&'static str],
    /// Courses in which the robot fits.
    pub(super) courses: &'static [&'static str],
}

/// Description of a robot.
enum File {
    /// File of the project.
    Own(&'static str),
    /// File of the shared data.
    Shared(&'static str),
    /// File of the shared data without a lidar, and the lidar that it gets.
    SharedWithLidar(&'static str, Lidar),
}

/// A lidar around `base_link`.
struct Lidar {
    /// Height above it \[m\].
    z_m: f64,
}

/// Parameters of navigation.
pub(super) enum Parameters {
    /// Nav2's `nav2_params.yaml` of Jazzy as it is.
    Stock,
    /// The same with the footprint of the robot instead of its radius, which MPPI considers: Nav2 asks for both with
    /// robots that are not round.
    StockWithFootprint(&'static str),
    /// The defaults of `periplus navigate`.
    Default,
}

impl Parameters {
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Stock => "stock",
            Self::StockWithFootprint(_) => "stock+shape",
            Self::Default => "default",
        }
    }
}

/// A robot whose files are written.
pub(super) struct PreparedRobot {
    pub(super) file: PathBuf,
    pub(super) packages: Vec<PathBuf>,
    pub(super) parameters: Option<PathBuf>,
    pub(super) options: &'static [&'static str],
}

impl Robot {
    /// Writes what the robot needs to a folder.
    pub(super) fn prepare(&self, shared: &Path, folder: &Path) -> Result<PreparedRobot, Failed> {
        let file = match &self.file {
            File::Own(file) => root().join(file),
            File::Shared(file) => shared.join(file),
            File::SharedWithLidar(file, lidar) => {
                let path = folder.join(format!("{}.urdf.xacro", self.name));
                write(&path, &lidar.added_to(&shared.join(file), self.name))?;
                path
            }
        };
        let stock = shared.join("nav/bringup/nav2_params_jazzy.yaml");
        let parameters = match self.parameters {
            Parameters::Stock => Some(stock),
            Parameters::StockWithFootprint(footprint) => {
                let text = std::fs::read_to_string(&stock)
                    .map_err(|error| Failed(format!("{}: {error}", stock.display())))?;
                let path = folder.join(format!("{}.yaml", self.name));
                let shape = format!("footprint: \"{footprint}\"");
                let text = text.replace("robot_radius: 0.22", &shape);
                write(
                    &path,
                    &text.replace("consider_footprint: false", "consider_footprint: true"),
                )?;
                Some(path)
            }
            Parameters::Default => None,
        };
        let packages = self.packages.iter().map(|folder| shared.join(folder)).collect();
        Ok(PreparedRobot { file, packages, parameters, options: self.options })
    }
}

impl Lidar {
    /// A robot that includes another one and has this lidar.
    fn added_to(&self, file: &Path, name: &str) -> String {
        let Self { z_m } = self;
        format!(
            "<robot name=\"{name}\" xmlns:xacro=\"http://ros.org/wiki/xacro\">
  <xacro:include filename=\"{}\"/>
  <link name=\"lidar\">
    <inertial><mass value=\"0.1\"/><inertia ixx=\"1e-4\" ixy=\"0\" ixz=\"0\" iyy=\"1e-4\" iyz=\"0\" izz=\"1e-4\"/></inertial>
  </link>
  <joint name=\"lidar_joint\" type=\"fixed\">
    <parent link=\"base_link\"/><child link=\"lidar\"/><origin xyz=\"0 0 {z_m}\"/>
  </joint>
  <gazebo reference=\"lidar\">
    <sensor name=\"lidar\" type=\"gpu_lidar\">
      <topic>scan</topic><gz_frame_id>lidar</gz_frame_id><update_rate>10</update_rate>
      <lidar>
        <scan><horizontal><samples>540</samples><resolution>1</resolution>
          <min_angle>-3.1416</min_angle><max_angle>3.1416</max_angle></horizontal></scan>
        <range><min>0.1</min><max>12</max><resolution>0.01</resolution></range>
        <noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>
      </lidar>
    </sensor>
  </gazebo>
</robot>
",
            file.display()
        )
    }
}

pub(super) const ALL: [Robot; 4] = [
    Robot {
        name: "sam_bot",
        file: File::Own("robots/sam_bot/urdf/sam_bot.urdf.xacro"),
        packages: &[],
        parameters: Parameters::StockWithFootprint(
            "[[0.21, 0.195], [0.21, -0.195], [-0.21, -0.195], [-0.21, 0.195]]",
        ),
        options: &[],
        courses: &["house", "sandbox", "demo room"],
    },
    Robot {
        name: "waffle",
        file: File::Shared(
            "corpus/nav2_minimal_turtlebot_simulation/nav2_minimal_tb3_sim/urdf/gz_waffle.sdf.xacro",
        ),
        packages: &["corpus/nav2_minimal_turtlebot_simulation"],
        parameters: Parameters::Stock,
        options: &[],
        courses: &["house", "sandbox", "demo room"],
    },
    Robot {
        name: "mecanum",
        file: File::SharedWithLidar(
            "corpus/MOGI-ROS_Week-3-4/bme_gazebo_basics/urdf/mogi_bot_mecanum.urdf",
            Lidar { z_m: 0.15 },
        ),
        packages: &["corpus/MOGI-ROS_Week-3-4"],
        parameters: Parameters::Default,
        options: &["--base=omni"],
        courses: &["house"],
    },
    Robot {
        name: "car",
        file: File::Own("xtask/src/goals/car.urdf.xacro"),
        packages: &[],
        parameters: Parameters::Default,
        options: &["--base=ackermann", "--min-turning-radius=0.5"],
        courses: &["house", "demo room"],
    },
];
