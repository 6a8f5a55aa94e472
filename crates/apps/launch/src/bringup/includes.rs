//! Built-in replacements for launch files of missing packages.
//!
//! Sources of names and defaults: `gazebo_ros/launch` (noetic, ros2), `ros_gz_sim/launch` (jazzy),
//! `slam_toolbox/launch`, `nav2_bringup/launch` (humble to main).

use std::collections::BTreeMap;

use crate::{Identity, PlanNode, PlanParameters, Process, What};
use serde_json::json;

use crate::bringup::parts::{truth, values};
use crate::bringup::world::{self, WorldRequest};

/// Replacement of a launch file.
pub(crate) enum Replacement {
    /// Simulation.
    World(WorldRequest),
    /// Steps.
    Steps(Vec<What>),
}

/// Launch files with a replacement, by package.
pub const REPLACED_LAUNCH_FILES: [(&str, &[&str]); 5] = [
    (
        "gazebo_ros",
        &["empty_world.launch", "gazebo.launch.py", "gzclient.launch.py", "gzserver.launch.py"],
    ),
    (
        "nav2_bringup",
        &[
            "bringup_launch.py",
            "localization_launch.py",
            "navigation_launch.py",
            "rviz_launch.py",
            "slam_launch.py",
        ],
    ),
    ("ros_gz_bridge", &["ros_gz_bridge.launch.py"]),
    ("ros_gz_sim", &["gz_server.launch.py", "gz_sim.launch.py", "gz_spawn_model.launch.py"]),
    (
        "slam_toolbox",
        &[
            "lifelong_launch.py",
            "localization_launch.py",
            "offline_launch.py",
            "online_async_launch.py",
            "online_sync_launch.py",
        ],
    ),
];

/// Returns true if a launch file of a missing package has a replacement.
#[must_use]
pub fn has_replacement(package: &str, file: &str) -> bool {
    replacement(&format!("package://{package}/launch/{file}"), &BTreeMap::new()).is_some()
}

/// Replacement of a file; `None` if it is unknown.
pub(crate) fn replacement(file: &str, given: &BTreeMap<String, String>) -> Option<Replacement> {
    let (package, path) = file.strip_prefix("package://")?.split_once('/')?;
    let name = path.rsplit('/').next().unwrap_or(path);
    let arguments = Arguments(given);
    Some(match (package, name) {
        ("gazebo_ros", "gzclient.launch.py") => {
            Replacement::Steps(vec![node("gazebo_ros", "gzclient")])
        }
        ("gazebo_ros", "gazebo.launch.py" | "gzserver.launch.py") => {
            Replacement::World(gazebo(&arguments, "world", "pause"))
        }
        ("gazebo_ros", "empty_world.launch") => {
            Replacement::World(gazebo(&arguments, "world_name", "paused"))
        }
        // `rubble_world.launch` and similar files show the world of that name.
        ("gazebo_ros", name) if name.ends_with("_world.launch") => {
            let world = name.trim_end_matches("_world.launch");
            let wish = gazebo(&arguments, "world_name", "paused");
            Replacement::World(WorldRequest { file: Some(format!("worlds/{world}.world")), ..wish })
        }
        ("ros_gz_sim", "gz_sim.launch.py") => Replacement::World(gz(&arguments, "gz_args")),
        ("ros_ign_gazebo" | "ros_gz_sim", "ign_gazebo.launch.py") => {
            Replacement::World(gz(&arguments, "ign_args"))
        }
        ("ros_gz_sim", "gz_server.launch.py" | "ros_gz_sim.launch.py") => {
            let file = arguments.get("world_sdf_file").filter(|file| !file.is_empty());
            Replacement::World(WorldRequest {
                file: file.map(str::to_owned),
                ..WorldRequest::default()
            })
        }
        ("ros_gz_sim", "gz_spawn_model.launch.py" | "ros_gz_spawn_model.launch.py") => {
            Replacement::Steps(vec![spawn(&arguments)])
        }
        ("ros_gz_bridge", "ros_gz_bridge.launch.py") => {
            Replacement::Steps(vec![bridge(&arguments)])
        }
        ("slam_toolbox", name) => Replacement::Steps(vec![slam(slam_program(name)?, &arguments)]),
        ("nav2_bringup", "navigation_launch.py") => Replacement::Steps(navigation(&arguments)),
        ("nav2_bringup", "localization_launch.py") => Replacement::Steps(localization(&arguments)),
        ("nav2_bringup", "slam_launch.py") => Replacement::Steps(mapping(&arguments)),
        ("nav2_bringup", "bringup_launch.py") => {
            let mut steps = if arguments.is("slam", false) {
                mapping(&arguments)
            } else {
                localization(&arguments)
            };
            steps.extend(navigation(&arguments));
            Replacement::Steps(steps)
        }
        ("nav2_bringup", "rviz_launch.py") => Replacement::Steps(vec![node("rviz2", "rviz2")]),
        _ => return None,
    })
}

/// Given arguments.
struct Arguments<'a>(&'a BTreeMap<String, String>);

impl Arguments<'_> {
    fn get(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    fn is(&self, name: &str, usual: bool) -> bool {
        self.get(name).map_or(usual, |text| truth(text) == json!(true))
    }
}

fn gazebo(arguments: &Arguments<'_>, world: &str, paused: &str) -> WorldRequest {
    let extra = arguments.get("extra_gazebo_args").unwrap_or_default();
    let extra: Vec<String> = extra.split_whitespace().map(str::to_owned).collect();
    let seed = arguments.get("seed").and_then(|seed| seed.parse().ok());
    WorldRequest {
        file: arguments.get(world).filter(|file| !file.is_empty()).map(str::to_owned),
        is_paused: arguments.is(paused, false),
        seed: seed.or(world::classic(&extra).seed),
        has_window: arguments.is("gui", true),
        ..WorldRequest::default()
    }
}

fn gz(arguments: &Arguments<'_>, name: &str) -> WorldRequest {
    let line = arguments.get(name).unwrap_or_default();
    let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
    world::gz(&words)
}

fn node(package: &str, executable: &str) -> What {
    What::Node(Box::new(PlanNode {
        package: Some(package.to_owned()),
        executable: executable.to_owned(),
        ..PlanNode::default()
    }))
}

/// Named node with parameters.
fn named(package: &str, executable: &str, name: &str, around: &CommonSettings) -> What {
    let identity = Identity {
        name: Some(name.to_owned()),
        namespace: around.namespace.clone(),
        parameters: around.parameters.clone(),
        remaps: around.remaps.clone(),
    };
    What::Node(Box::new(PlanNode {
        package: Some(package.to_owned()),
        executable: executable.to_owned(),
        identity,
        ..PlanNode::default()
    }))
}

/// Settings of all nodes of a file.
#[derive(Clone, Debug, Default)]
struct CommonSettings {
    namespace: Option<String>,
    parameters: Vec<PlanParameters>,
    remaps: Vec<(String, String)>,
}

impl CommonSettings {
    fn of_nav2(arguments: &Arguments<'_>) -> Self {
        let mut parameters = Vec::new();
        parameters
            .extend(arguments.get("params_file").map(|file| PlanParameters::File(file.into())));
        if let Some(time) = arguments.get("use_sim_time") {
            parameters.push(values(&json!({ "use_sim_time": truth(time) })));
        }
        let namespace =
            arguments.get("namespace").filter(|name| !name.trim_matches('/').is_empty());
        let remaps = ["tf", "tf_static"].map(|name| (format!("/{name}"), name.to_owned()));
        Self {
            namespace: namespace.map(|name| format!("/{}", name.trim_matches('/'))),
            parameters,
            // Robots with namespaces have separate transforms.
            remaps: if namespace.is_some() { remaps.to_vec() } else { Vec::new() },
        }
    }

    fn with(&self, value: &serde_json::Value) -> Self {
        let mut with = self.clone();
        with.parameters.push(values(value));
        with
    }
}

/// Lifecycle manager of these nodes.
fn manager(name: &str, nodes: &[&str], arguments: &Arguments<'_>, around: &CommonSettings) -> What {
    let autostart = arguments.is("autostart", true);
    let around = around.with(&json!({ "autostart": autostart, "node_names": nodes }));
    named("nav2_lifecycle_manager", "lifecycle_manager", name, &around)
}

fn navigation(arguments: &Arguments<'_>) -> Vec<What> {
    const NODES: [(&str, &str); 7] = [
        ("nav2_controller", "controller_server"),
        ("nav2_smoother", "smoother_server"),
        ("nav2_planner", "planner_server"),
        ("nav2_behaviors", "behavior_server"),
        ("nav2_velocity_smoother", "velocity_smoother"),
        ("nav2_bt_navigator", "bt_navigator"),
        ("nav2_waypoint_follower", "waypoint_follower"),
    ];
    let around = CommonSettings::of_nav2(arguments);
    let mut steps: Vec<What> =
        NODES.iter().map(|(package, name)| named(package, name, name, &around)).collect();
    let names = NODES.map(|(_, name)| name);
    steps.push(manager("lifecycle_manager_navigation", &names, arguments, &around));
    steps
}

fn localization(arguments: &Arguments<'_>) -> Vec<What> {
    let around = CommonSettings::of_nav2(arguments);
    let map = arguments.get("map").filter(|map| !map.is_empty());
    let with_map = match map {
        Some(map) => around.with(&json!({ "yaml_filename": map })),
        None => around.clone(),
    };
    vec![
        named("nav2_map_server", "map_server", "map_server", &with_map),
        named("nav2_amcl", "amcl", "amcl", &around),
        manager("lifecycle_manager_localization", &["map_server", "amcl"], arguments, &around),
    ]
}

fn mapping(arguments: &Arguments<'_>) -> Vec<What> {
    let around = CommonSettings::of_nav2(arguments);
    vec![
        named("nav2_map_server", "map_saver_server", "map_saver", &around),
        manager("lifecycle_manager_slam", &["map_saver"], arguments, &around),
        named("slam_toolbox", "sync_slam_toolbox_node", "slam_toolbox", &around),
    ]
}

fn slam_program(name: &str) -> Option<&'static str> {
    Some(match name.strip_suffix("_launch.py")? {
        "online_async" => "async_slam_toolbox_node",
        "online_sync" | "offline" => "sync_slam_toolbox_node",
        "localization" => "localization_slam_toolbox_node",
        "lifelong" => "lifelong_slam_toolbox_node",
        _ => return None,
    })
}

fn slam(program: &str, arguments: &Arguments<'_>) -> What {
    let mut around = CommonSettings {
        parameters: vec![values(&json!({ "use_sim_time": arguments.is("use_sim_time", true) }))],
        ..CommonSettings::default()
    };
    if let Some(file) = arguments.get("slam_params_file").or(arguments.get("params_file")) {
        around.parameters.insert(0, PlanParameters::File(file.to_owned()));
    }
    named("slam_toolbox", program, "slam_toolbox", &around)
}

/// `create`, with the arguments of the file.
fn spawn(arguments: &Arguments<'_>) -> What {
    let names = [
        ("world", "world"),
        ("file", "file"),
        ("topic", "topic"),
        ("entity_name", "name"),
        ("model_string", "string"),
        ("x", "x"),
        ("y", "y"),
        ("z", "z"),
        ("roll", "R"),
        ("pitch", "P"),
        ("yaw", "Y"),
    ];
    let mut command = vec!["ros2".to_owned(), "run".into(), "ros_gz_sim".into(), "create".into()];
    for (name, word) in names {
        if let Some(value) = arguments.get(name).filter(|value| !value.is_empty()) {
            command.extend([format!("-{word}"), value.to_owned()]);
        }
    }
    What::Process(Process { command, ..Process::default() })
}

fn bridge(arguments: &Arguments<'_>) -> What {
    let file = arguments.get("config_file").unwrap_or_default();
    let around = CommonSettings {
        parameters: vec![values(&json!({ "config_file": file }))],
        ..CommonSettings::default()
    };
    let name = arguments.get("bridge_name").unwrap_or("ros_gz_bridge");
    named("ros_gz_bridge", "parameter_bridge", name, &around)
}

#[cfg(test)]
mod tests {
    use super::{REPLACED_LAUNCH_FILES, has_replacement};

    #[test]
    fn something_stands_for_each_file_of_the_list() {
        for (package, files) in REPLACED_LAUNCH_FILES {
            assert!(files.is_sorted(), "{package}");
            for file in files {
                assert!(has_replacement(package, file), "{package} {file}");
            }
        }
        assert!(!has_replacement("nav2_bringup", "tb3_simulation_launch.py"));
    }
}
