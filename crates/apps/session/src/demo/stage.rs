//! World and robot of the demo, embedded in the program.

use std::path::{Path, PathBuf};

use periplus_diagnostics::Diagnostics;
use periplus_loader::LoadContext;
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_params::{ParamValue, ParamValues};
use periplus_resources::{MemoryHost, Resolver};
use periplus_sim::{Composition, PlacementPose, RobotPlacement, compose};

/// Name of the world.
pub const WORLD_NAME: &str = "demo_room";

/// Parameters of the costmaps.
pub(super) const COSTMAPS: &str = include_str!("costmaps.yaml");

const WORLD: &str = "/periplus/worlds/demo_room.sdf";
const ROBOT: &str = "/periplus/robots/sam_bot/urdf/sam_bot.urdf.xacro";

macro_rules! own {
    ($path:literal) => {
        (concat!("/periplus/", $path), include_str!(concat!("../../../../../", $path)))
    };
}

const FILES: [(&str, &str); 9] = [
    own!("worlds/demo_room.sdf"),
    own!("robots/sam_bot/package.xml"),
    own!("robots/sam_bot/urdf/chassis.xacro"),
    own!("robots/sam_bot/urdf/depth_camera.xacro"),
    own!("robots/sam_bot/urdf/drive.xacro"),
    own!("robots/sam_bot/urdf/imu.xacro"),
    own!("robots/sam_bot/urdf/inertials.xacro"),
    own!("robots/sam_bot/urdf/lidar.xacro"),
    own!("robots/sam_bot/urdf/sam_bot.urdf.xacro"),
];

/// World with the robot.
#[must_use]
pub fn composition() -> Composition {
    let host =
        FILES.iter().fold(MemoryHost::new(), |host, (path, text)| host.with_file(path, *text));
    let resolver = Resolver::new(&host, &[]);
    let setting = LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder: PathBuf::from("/periplus"),
        arguments: Vec::new(),
        open_meshes: false,
    };
    // Exact wheels, and no filter that would publish the pose.
    let arguments = [("drive_wheel_separation", "0.36"), ("publish_odom_tf", "true")];
    let robot = RobotPlacement {
        file: PathBuf::from(ROBOT),
        arguments: arguments.map(|(name, value)| (name.to_owned(), value.to_owned())).into(),
        pose: PlacementPose::OnGround([0.0; 3]),
        ..RobotPlacement::default()
    };
    compose(Path::new(WORLD), &[robot], &setting)
}

/// Mapping with the parameters of `slam_toolbox`, publishing a map each second.
pub(super) fn mapping() -> (Program, ParamValues) {
    let program = Program::Async;
    let mut values = program.table().check([], None, &mut Diagnostics::new());
    for (name, value) in [
        ("map_update_interval", 1.0),
        ("max_laser_range", 3.5),
        ("minimum_travel_distance", 0.2),
        ("minimum_travel_heading", 0.3),
    ] {
        values.set(name, ParamValue::Number(value));
    }
    (program, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_it_can_be_simulated() {
        let composition = composition();
        for file in &composition.files {
            assert!(!file.diagnostics.has_errors(), "{:?}", file.diagnostics);
        }
        let names: Vec<&str> = composition.members.iter().map(|it| it.name.as_str()).collect();
        assert!(names.contains(&"sam_bot") && names.contains(&"cube"), "{names:?}");
        assert_eq!(composition.world.name, WORLD_NAME);
        let (_, values) = mapping();
        assert_eq!(values.number("map_update_interval"), Some(1.0));
    }
}
