"""Descriptions that start spawners of controllers."""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node


def _spawner(arguments):
    return Node(package="controller_manager", executable="spawner", arguments=arguments, output="screen")


def generate_controllers_spawner_launch_description(
    controller_names, controller_params_files=None, extra_spawner_args=(), **_others
):
    manager, unload = "controller_manager_name", "unload_on_kill"
    arguments = [*controller_names, "--controller-manager", LaunchConfiguration(manager)]
    for file in filter(None, controller_params_files or []):
        arguments += ["--param-file", file]
    truth = ["'--unload-on-kill' if 'true' == '", LaunchConfiguration(unload), "' else ''"]
    arguments += [PythonExpression(truth), *extra_spawner_args]
    return LaunchDescription([
        DeclareLaunchArgument(
            manager, default_value="controller_manager", description="Controller manager node name"
        ),
        DeclareLaunchArgument(
            unload, default_value="false", description="Unload the controllers at the end"
        ),
        _spawner(arguments),
    ])


def _files(given):
    return given if isinstance(given, list) else [given] if given else []


def generate_controllers_spawner_launch_description_from_dict(
    controller_info_dict, extra_spawner_args=(), **_others
):
    files = [file for given in controller_info_dict.values() for file in _files(given)]
    return generate_controllers_spawner_launch_description(
        list(controller_info_dict), files, extra_spawner_args
    )


def generate_load_controller_launch_description(
    controller_name, controller_params_file=None, extra_spawner_args=(), **_others
):
    return generate_controllers_spawner_launch_description(
        [controller_name], _files(controller_params_file), extra_spawner_args
    )


def generate_spawner_launch_description(controller_info_dict, extra_spawner_args=(), **_others):
    arguments = []
    for name, info in controller_info_dict.items():
        arguments += ["--controller", name]
        for file in _files(info.get("param_file")):
            arguments += ["--param-file", file]
        arguments += ["--load-only"] if info.get("load_only") else []
        arguments += ["--inactive"] if info.get("inactive") else []
        if "ros_args" in info:
            arguments += ["--controller-ros-args", info["ros_args"]]
    return LaunchDescription([_spawner([*arguments, *extra_spawner_args])])
