//! The modules in Python that stand in for those of ROS while a launch file is evaluated, in
//! `crates/launch/python`.

/// What the interpreter runs: `python3 -c BOOT`. Its first line is [`MODULES`] as a JSON object; then it
/// answers requests, line by line.
pub const BOOT: &str = include_str!("../python/boot.py");

/// Modules by name.
pub const MODULES: [(&str, &str); 44] = [
    ("ament_index_python", include_str!("../python/ament_index_python.py")),
    ("ament_index_python.packages", include_str!("../python/ament_index_python_packages.py")),
    ("launch", include_str!("../python/launch.py")),
    ("launch.action", include_str!("../python/launch_action.py")),
    ("launch.actions", include_str!("../python/launch_actions.py")),
    ("launch.condition", include_str!("../python/launch_condition.py")),
    ("launch.conditions", include_str!("../python/launch_conditions.py")),
    ("launch.event", include_str!("../python/launch_event.py")),
    ("launch.event_handler", include_str!("../python/launch_event_handler.py")),
    ("launch.event_handlers", include_str!("../python/launch_event_handlers.py")),
    (
        "launch.event_handlers.on_process_exit",
        include_str!("../python/launch_event_handlers_on_process_exit.py"),
    ),
    (
        "launch.event_handlers.on_process_start",
        include_str!("../python/launch_event_handlers_on_process_start.py"),
    ),
    (
        "launch.event_handlers.on_shutdown",
        include_str!("../python/launch_event_handlers_on_shutdown.py"),
    ),
    ("launch.events", include_str!("../python/launch_events.py")),
    ("launch.events.matchers", include_str!("../python/launch_events_matchers.py")),
    ("launch.events.process", include_str!("../python/launch_events_process.py")),
    ("launch.frontend", include_str!("../python/launch_frontend.py")),
    (
        "launch.launch_description_sources",
        include_str!("../python/launch_launch_description_sources.py"),
    ),
    ("launch.logging", include_str!("../python/launch_logging.py")),
    ("launch.some_types", include_str!("../python/launch_some_types.py")),
    ("launch.substitution", include_str!("../python/launch_substitution.py")),
    ("launch.substitutions", include_str!("../python/launch_substitutions.py")),
    ("launch.utilities", include_str!("../python/launch_utilities.py")),
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
    ("lifecycle_msgs", include_str!("../python/lifecycle_msgs.py")),
    ("lifecycle_msgs.msg", include_str!("../python/lifecycle_msgs_msg.py")),
    ("nav2_common", include_str!("../python/nav2_common.py")),
    ("nav2_common.launch", include_str!("../python/nav2_common_launch.py")),
    (
        "nav2_common.launch.has_node_params",
        include_str!("../python/nav2_common_launch_has_node_params.py"),
    ),
    (
        "nav2_common.launch.launch_config_as_bool",
        include_str!("../python/nav2_common_launch_launch_config_as_bool.py"),
    ),
    (
        "nav2_common.launch.parse_multirobot_pose",
        include_str!("../python/nav2_common_launch_parse_multirobot_pose.py"),
    ),
    (
        "nav2_common.launch.replace_string",
        include_str!("../python/nav2_common_launch_replace_string.py"),
    ),
    (
        "nav2_common.launch.rewritten_yaml",
        include_str!("../python/nav2_common_launch_rewritten_yaml.py"),
    ),
    ("periplus_launch", ""),
    ("periplus_launch.conversation", include_str!("../python/conversation.py")),
    ("periplus_launch.objects", include_str!("../python/objects.py")),
];
