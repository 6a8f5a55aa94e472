"""Modules that hold nothing of their own: their names come from another module."""

# Submodules of a package, whose names are those of the package.
SUBMODULES = {
    "ament_index_python": "cli constants search_paths resources",
    "launch": """
        invalid_launch_file_error launch_context launch_description launch_description_entity
        launch_description_source launch_introspector launch_service some_actions_type
        some_entities_type some_substitutions_type
    """,
    "launch.actions": """
        append_environment_variable declare_launch_argument emit_event execute_local
        execute_process for_loop group_action include_launch_description log log_info
        opaque_coroutine opaque_function pop_environment pop_launch_configurations
        push_environment push_launch_configurations register_event_handler reset_environment
        reset_launch_configurations set_environment_variable set_launch_configuration
        shutdown_action timer_action unregister_event_handler unset_environment_variable
        unset_launch_configuration
    """,
    "launch.conditions": """
        evaluate_condition_expression_impl if_condition invalid_condition_expression_error
        launch_configuration_equals launch_configuration_not_equals unless_condition
    """,
    "launch.descriptions": "executable",
    "launch.event_handlers": """
        event_named on_action_event_base on_execution_complete on_include_launch_description
        on_process_exit on_process_io on_process_start on_shutdown
    """,
    "launch.events": "execution_complete include_launch_description matchers shutdown timer_event",
    "launch.events.process": """
        process_exited process_io process_matchers process_started process_stderr process_stdin
        process_stdout process_targeted_event running_process_event shutdown_process
        signal_process
    """,
    "launch.frontend": "entity expose parse_substitution parser type_utils",
    "launch.launch_description_sources": """
        any_launch_description_source any_launch_file_utilities frontend_launch_description_source
        frontend_launch_file_utilities python_launch_description_source
        python_launch_file_utilities
    """,
    "launch.logging": "handlers",
    "launch.substitutions": """
        anon_name boolean_substitution command environment_variable equals_substitution
        file_content find_executable for_loop_var if_else_substitution launch_configuration
        launch_log_dir local_substitution not_equals_substitution path_join_substitution
        path_substitution python_expression string_join_substitution substitution_failure
        text_substitution this_launch_file this_launch_file_dir
    """,
    "launch.utilities": """
        class_tools_impl ensure_argument_type_impl normalize_to_list_of_entities_impl
        normalize_to_list_of_substitutions_impl perform_substitutions_impl signal_management
        type_utils typing_file_path visit_all_entities_and_collect_futures_impl
    """,
    "launch_pal": """
        arg_utils calibration_utils composition_utils include_utils logging_utils pal_parameters
        param_utils robot_arguments robot_utils actions conditions substitutions
    """,
    "launch_param_builder": "launch_param_builder utils",
    "launch_ros": "parameters_type remap_rule_type ros_adapters",
    "launch_ros.actions": """
        composable_node_container lifecycle_node lifecycle_transition load_composable_nodes node
        push_ros_namespace ros_timer set_parameter set_parameters_from_file set_remap
        set_ros_log_dir set_use_sim_time
    """,
    "launch_ros.descriptions": "composable_lifecycle_node composable_node",
    "launch_ros.event_handlers": "on_state_transition",
    "launch_ros.events": "matchers",
    "launch_ros.events.lifecycle": "change_state lifecycle_node_matchers state_transition",
    "launch_ros.events.matchers": "matches_node_name",
    "launch_ros.substitutions": "executable_in_package find_package parameter",
    "launch_ros.utilities": """
        evaluate_parameters namespace_utils normalize_parameters normalize_remap_rule
        plugin_support to_parameters_list track_node_names
    """,
    "launch_testing": """
        actions asserts decorator event_handlers io_handler legacy loader markers parametrize
        proc_info_handler ready_aggregator ready_to_test_action_timeout test_result test_runner
        tools util
    """,
    "launch_testing.actions": "gtest pytest ready test",
    "launch_testing_ros": "actions data_republisher message_pump test_runner tools wait_for_topics",
    "moveit_configs_utils": "launches launch_utils moveit_configs_builder substitutions",
    "nav2_common.launch": """
        has_node_params launch_config_as_bool parse_multirobot_pose replace_string rewritten_yaml
    """,
    "ros_gz_bridge.actions": "ros_gz_bridge",
    "ros_gz_sim.actions": "gz_spawn_model gzserver",
    "xacro": "color xmlutils",
}

# Modules by the module that has their names.
SAME_AS = {
    "launch_ros.events.matchers": "launch_ros.events.lifecycle",
    "launch_xml": "launch.launch_description_sources",
    "launch_xml.entity": "launch.frontend",
    "launch_xml.parser": "launch.frontend",
    "launch_xml.launch_description_sources": "launch.launch_description_sources",
    "launch_xml.launch_description_sources.xml_launch_description_source":
        "launch.launch_description_sources",
    "launch_yaml": "launch.launch_description_sources",
    "launch_yaml.entity": "launch.frontend",
    "launch_yaml.parser": "launch.frontend",
    "launch_yaml.launch_description_sources": "launch.launch_description_sources",
    "launch_yaml.launch_description_sources.yaml_launch_description_source":
        "launch.launch_description_sources",
}

# Packages that give way to one of the same name in the workspace or on the machine.
LAST = {
    "controller_manager",
    "launch_pal",
    "launch_param_builder",
    "lifecycle_msgs",
    "moveit_configs_utils",
    "osrf_pycommon",
    "pytest",
    "rclpy",
    "ros_gz_bridge",
    "ros_gz_sim",
    "yaml",
}


# Packages of messages are named so, and hold these modules.
_MESSAGES = ("_msgs", "_interfaces", "_srvs")


def is_absent(name):
    """True for a module of ROS that a launch file may import and only nodes can use."""
    top, *inner = name.split(".")
    if top == "rclpy":
        return len(inner) <= 1
    if name == "controller_manager.test_utils":
        return True
    is_part = not inner or inner in (["msg"], ["srv"], ["action"])
    return top.endswith(_MESSAGES) and is_part


def provider(name):
    """The module that has the names of a module; none when it is not one of these."""
    if name in SAME_AS:
        return SAME_AS[name]
    parent, _, own = name.rpartition(".")
    return parent if own and own in SUBMODULES.get(parent, "").split() else None


def is_package(name, sources):
    return name in SUBMODULES or any(
        other.startswith(name + ".") for others in (sources, SAME_AS) for other in others
    )
