//! Texts of new files, from the templates in `crates/apps/cli/templates`.

use std::path::PathBuf;

use super::{Sensor, Simulator};

const ROBOT: &str = include_str!("../../templates/robot.urdf.xacro");
const WORLD: &str = include_str!("../../templates/world.sdf");
/// Systems of a world for Gazebo Harmonic; Gazebo Classic has them built in.
const SYSTEMS: &str = include_str!("../../templates/systems.part.sdf");
const LAUNCH: &str = include_str!("../../templates/package/simulation.launch.py");

/// Files of a package that differ only in names: path and text.
const PACKAGE: [(&str, &str); 7] = [
    ("package.xml", include_str!("../../templates/package/package.xml")),
    ("CMakeLists.txt", include_str!("../../templates/package/CMakeLists.txt")),
    ("README.md", include_str!("../../templates/package/README.md")),
    ("config/ekf.yaml", include_str!("../../templates/package/ekf.yaml")),
    ("config/slam.yaml", include_str!("../../templates/package/slam.yaml")),
    ("config/nav2_params.yaml", include_str!("../../templates/package/nav2_params.yaml")),
    ("rviz/@NAME@.rviz", include_str!("../../templates/package/robot.rviz")),
];

/// Parts of a package that depend on the simulator.
struct Dialect {
    /// `<exec_depend>` lines of package.xml.
    depends: &'static str,
    /// Launch actions that start the simulation.
    launch: &'static str,
    name: &'static str,
    bridge_row: &'static str,
}

const GZ: Dialect = Dialect {
    depends: "  <exec_depend>ros_gz_bridge</exec_depend>\n  <exec_depend>ros_gz_sim</exec_depend>\n",
    launch: include_str!("../../templates/package/simulator_gz.launch.part"),
    name: "Gazebo Harmonic",
    bridge_row: ", the bridge to Gazebo",
};

const CLASSIC: Dialect = Dialect {
    depends: "  <exec_depend>gazebo_plugins</exec_depend>\n  <exec_depend>gazebo_ros</exec_depend>\n",
    launch: include_str!("../../templates/package/simulator_classic.launch.part"),
    name: "Gazebo Classic 11",
    bridge_row: "",
};

/// Bridge configuration of ROS 2 and Gazebo Harmonic.
const BRIDGE: &str = include_str!("../../templates/package/bridge.yaml");

/// File to write.
pub(super) struct NewFile {
    /// Path relative to the output folder.
    pub(super) path: PathBuf,
    pub(super) text: String,
}

impl NewFile {
    fn new(path: &str, text: String) -> Self {
        Self { path: path.into(), text }
    }
}

/// Xacro file of a robot.
pub(super) fn robot(name: &str, simulator: Simulator, without: &[Sensor]) -> NewFile {
    let has = |sensor: Sensor| if without.contains(&sensor) { "false" } else { "true" };
    let text = ROBOT
        .replace("@NAME@", name)
        .replace("@SIM@", simulator.word())
        .replace("@LIDAR@", has(Sensor::Lidar))
        .replace("@IMU@", has(Sensor::Imu))
        .replace("@CAMERA@", has(Sensor::Camera));
    NewFile::new(&format!("{name}.urdf.xacro"), text)
}

/// World file.
pub(super) fn world(name: &str, simulator: Simulator) -> NewFile {
    let systems = match simulator {
        Simulator::Gz => SYSTEMS,
        Simulator::Classic => "",
    };
    let text = WORLD.replace("@NAME@", name).replace("@SYSTEMS@", systems);
    NewFile::new(&format!("{name}.sdf"), text)
}

/// All files of a package, in its folder.
pub(super) fn package(name: &str, simulator: Simulator, without: &[Sensor]) -> Vec<NewFile> {
    let dialect = match simulator {
        Simulator::Gz => GZ,
        Simulator::Classic => CLASSIC,
    };
    let filled = |text: &str| {
        text.replace("@SIMULATOR@\n", dialect.launch)
            .replace("@DEPENDS@", dialect.depends)
            .replace("@SIMULATOR_NAME@", dialect.name)
            .replace("@BRIDGE_ROW@", dialect.bridge_row)
            .replace("@SIM@", simulator.word())
            .replace("@NAME@", name)
    };
    let mut files: Vec<NewFile> =
        PACKAGE.iter().map(|(path, text)| NewFile::new(&filled(path), filled(text))).collect();
    files.push(NewFile::new("launch/simulation.launch.py", filled(LAUNCH)));
    if simulator == Simulator::Gz {
        files.push(NewFile::new("config/bridge.yaml", filled(BRIDGE)));
    }
    let robot = robot(name, simulator, without);
    files.push(NewFile::new(&format!("urdf/{}", robot.path.display()), robot.text));
    files.push(NewFile::new("worlds/room.sdf", world("room", simulator).text));
    for file in &mut files {
        file.path = PathBuf::from(name).join(&file.path);
    }
    files
}
