//! Python modules that replace those of ROS during the evaluation of a launch file, from
//! `crates/apps/launch/python`. Modules that only re-export names are in the tables of
//! `crates/apps/launch/python/submodules.py`.

/// Program of the interpreter: `python3 -c BOOT`. Its first input line is a JSON object with
/// [`MODULES`] as `modules` and [`MAX_MEMORY_BYTES`] as `most_memory`; then it answers requests, line by
/// line.
pub const BOOT: &str = include_str!("../python/boot.py");

/// Memory limit of an interpreter \[bytes\]: launch files need about ten megabytes, and those that
/// load numerical libraries some hundred.
pub const MAX_MEMORY_BYTES: u64 = 4 << 30;

/// Modules by name.
pub const MODULES: [(&str, &str); 52] = [
    ("ament_index_python", include_str!("../python/ament_index_python.py")),
    ("ament_index_python.packages", include_str!("../python/ament_index_python_packages.py")),
    ("controller_manager", ""),
    (
        "controller_manager.launch_utils",
        include_str!("../python/controller_manager_launch_utils.py"),
    ),
    ("launch", include_str!("../python/launch.py")),
    ("launch.action", include_str!("../python/launch_action.py")),
    ("launch.actions", include_str!("../python/launch_actions.py")),
    ("launch.condition", include_str!("../python/launch_condition.py")),
    ("launch.conditions", include_str!("../python/launch_conditions.py")),
    ("launch.descriptions", include_str!("../python/launch_descriptions.py")),
    ("launch.event", include_str!("../python/launch_event.py")),
    ("launch.event_handler", include_str!("../python/launch_event_handler.py")),
    ("launch.event_handlers", include_str!("../python/launch_event_handlers.py")),
    ("launch.events", include_str!("../python/launch_events.py")),
    ("launch.events.process", include_str!("../python/launch_events_process.py")),
    ("launch.frontend", include_str!("../python/launch_frontend.py")),
    (
        "launch.launch_description_sources",
        include_str!("../python/launch_launch_description_sources.py"),
    ),
    ("launch.logging", include_str!("../python/launch_logging.py")),
    ("launch.substitution", include_str!("../python/launch_substitution.py")),
    ("launch.substitutions", include_str!("../python/launch_substitutions.py")),
    ("launch.utilities", include_str!("../python/launch_utilities.py")),
    ("launch_pal", include_str!("../python/launch_pal.py")),
    ("launch_param_builder", include_str!("../python/launch_param_builder.py")),
    ("launch_ros", include_str!("../python/launch_ros.py")),
    ("launch_ros.actions", include_str!("../python/launch_ros_actions.py")),
    ("launch_ros.descriptions", include_str!("../python/launch_ros_descriptions.py")),
    ("launch_ros.event_handlers", include_str!("../python/launch_ros_event_handlers.py")),
    ("launch_ros.events", include_str!("../python/launch_ros_events.py")),
    ("launch_ros.events.lifecycle", include_str!("../python/launch_ros_events_lifecycle.py")),
    (
        "launch_ros.parameter_descriptions",
        include_str!("../python/launch_ros_parameter_descriptions.py"),
    ),
    ("launch_ros.substitutions", include_str!("../python/launch_ros_substitutions.py")),
    ("launch_ros.utilities", include_str!("../python/launch_ros_utilities.py")),
    ("launch_testing", include_str!("../python/launch_testing.py")),
    ("launch_testing_ros", include_str!("../python/launch_testing_ros.py")),
    ("lifecycle_msgs", include_str!("../python/lifecycle_msgs.py")),
    ("lifecycle_msgs.msg", include_str!("../python/lifecycle_msgs_msg.py")),
    ("moveit_configs_utils", include_str!("../python/moveit_configs_utils.py")),
    ("nav2_common", ""),
    ("nav2_common.launch", include_str!("../python/nav2_common_launch.py")),
    ("osrf_pycommon", include_str!("../python/osrf_pycommon.py")),
    ("osrf_pycommon.process_utils", include_str!("../python/osrf_pycommon_process_utils.py")),
    ("periplus_launch", ""),
    ("periplus_launch.conversation", include_str!("../python/conversation.py")),
    ("periplus_launch.objects", include_str!("../python/objects.py")),
    ("periplus_launch.submodules", include_str!("../python/submodules.py")),
    ("pytest", include_str!("../python/pytest.py")),
    ("ros_gz_bridge", ""),
    ("ros_gz_bridge.actions", include_str!("../python/ros_gz_bridge_actions.py")),
    ("ros_gz_sim", ""),
    ("ros_gz_sim.actions", include_str!("../python/ros_gz_sim_actions.py")),
    ("xacro", include_str!("../python/xacro.py")),
    ("yaml", include_str!("../python/yaml.py")),
];
