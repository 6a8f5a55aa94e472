"""Replacement of `launch_pal`: how PAL's launch files include others and merge parameters."""
import re
import tempfile
from dataclasses import dataclass, fields

import ament_index_python
import yaml
from launch.action import Action
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
)
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitution import Substitution
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import PushRosNamespace
from launch_ros.descriptions import ComposableNode
from launch_ros.substitutions import FindPackageShare

ROS_PARAM_KEY = "ros__parameters"


def include_launch_py_description(pkg_name, paths, **kwargs):
    path = PathJoinSubstitution([FindPackageShare(pkg_name), *paths])
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(path), **kwargs)


def get_nested_launch_configurations(configuration_list):
    """The configurations, and those that their values ask for."""
    found = dict(configuration_list)
    waiting = list(configuration_list.values())
    while waiting:
        value = waiting.pop()
        if isinstance(value, LaunchConfiguration) and value not in configuration_list.values():
            found.setdefault(value.variable_name[0].text, value)
        for name in ("substitutions", "expression"):
            waiting.extend(getattr(value, name, None) or [])
    return found


def include_scoped_launch_py_description(
    pkg_name, paths, launch_arguments=None, env_vars=(), condition=None, namespace=None, **kwargs
):
    """Includes a file in a scope of its own, with nothing but what is given here."""
    configurations, declared = {}, []
    for name, value in (launch_arguments or {}).items():
        if isinstance(value, DeclareLaunchArgument):
            if value.name != name:
                declared.append(value)
            value = LaunchConfiguration(value.name)
        configurations[name] = value
    configurations = get_nested_launch_configurations(configurations)
    actions = [PushRosNamespace(namespace)] if namespace else []
    actions += [*env_vars, *declared]
    actions.append(
        include_launch_py_description(
            pkg_name, paths, launch_arguments=configurations.items(), **kwargs
        )
    )
    return GroupAction(
        actions, forwarding=False, condition=condition, launch_configurations=configurations
    )


def read_launch_argument(arg_name, context):
    return perform_substitutions(context, [LaunchConfiguration(arg_name)])


@dataclass(frozen=True, kw_only=True)
class LaunchArgumentsBase:
    """Base of dataclasses of launch arguments."""

    def add_to_launch_description(self, launch_description):
        for field in fields(self):
            launch_description.add_action(getattr(self, field.name))


class LaunchArgCreator:
    """Launch arguments from a file."""

    def __init__(self):
        self.launch_arguments = {}

    def from_yaml(self, yaml_file):
        with open(yaml_file, encoding="utf-8") as file:
            for name, details in yaml.safe_load(file).items():
                self.launch_arguments[name] = DeclareLaunchArgument(name, **details)

    def get_argument(self, arg_name):
        return self.launch_arguments[arg_name]


def parse_launch_args_from_yaml(yaml_file):
    made = LaunchArgCreator()
    made.from_yaml(yaml_file)
    return made


def _argument(name, default, description, choices=None):
    return DeclareLaunchArgument(
        name, default_value=default, description=description, choices=choices
    )


_TRUTHS = ["True", "False"]
_ROBOTS = [
    "pmb2", "tiago", "tiago_dual", "pmb3", "ari", "omni_base", "stockbot", "tiago_pro", "talos",
    "kangaroo",
]


class CommonArgs:
    """Arguments that many of PAL's launch files take."""

    use_sim_time = _argument("use_sim_time", "False", "Use simulation time.", _TRUTHS)
    namespace = _argument("namespace", "", "Namespace of the robot.")
    robot_name = _argument("robot_name", "pmb2", "Name of the robot.", _ROBOTS)
    navigation = _argument("navigation", "False", "Launch Nav2.", _TRUTHS)
    advanced_navigation = _argument(
        "advanced_navigation", "False", "Launch advanced navigation.", _TRUTHS
    )
    side = _argument("side", "", "Side of the controllers.")
    docking = _argument("docking", "False", "Launch docking.", _TRUTHS)
    moveit = _argument("moveit", "True", "Launch MoveIt 2.", _TRUTHS)
    slam = _argument("slam", "False", "Use SLAM.")
    world_name = _argument("world_name", "pal_office", "Name of the world.")
    gazebo_version = _argument(
        "gazebo_version", "classic", "Version of Gazebo.", ["gazebo", "classic"]
    )
    gzclient = _argument("gzclient", "True", "Launch the window of Gazebo.", _TRUTHS)
    rviz = _argument("rviz", "True", "Launch RViz.", _TRUTHS)
    map_name = _argument("map_name", "default_map", "Name of the map.")
    is_public_sim = _argument("is_public_sim", "False", "Public simulation.", _TRUTHS)
    use_sensor_manager = _argument("use_sensor_manager", "False", "Octomap in MoveIt.", _TRUTHS)
    tuck_arm = _argument("tuck_arm", "True", "Launch the node that tucks the arm.", _TRUTHS)
    x = _argument("x", "0.0", "X of the robot's pose.")
    y = _argument("y", "0.0", "Y of the robot's pose.")
    z = _argument("z", "0.0", "Z of the robot's pose.")
    roll = _argument("roll", "0.0", "Roll of the robot's pose.")
    pitch = _argument("pitch", "0.0", "Pitch of the robot's pose.")
    yaw = _argument("yaw", "0.0", "Yaw of the robot's pose.")
    sim_type = _argument("sim_type", "gazebo", "Simulator.")
    mj_control = _argument("mj_control", "position", "Control in MuJoCo.")


class _RobotArgs(type):
    """Gives an argument for every part of a robot."""

    def __getattr__(cls, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return DeclareLaunchArgument(name, description=f"{name} of the robot")


class RobotArgs(metaclass=_RobotArgs):
    """Arguments that name the parts of a robot."""


# Parts of PAL's robots: default and choices, by function and robot.
_PARTS = {
    "robot_name": {None: ("pmb2", _ROBOTS)},
    "wheel_model": {None: ("moog", ["nadia", "moog"])},
    "laser_model": {
        None: ("sick-571", ["no-laser", "sick-571", "sick-561", "sick-551", "hokuyo"]),
        "ari": ("ydlidar-tg15", ["no-laser", "sick-571", "ydlidar-tg15", "ydlidar-tg30"]),
    },
    "courier_rgbd_sensors": {None: ("False", _TRUTHS)},
    "arm": {None: ("tiago-arm", ["no-arm", "tiago-arm"])},
    "wrist_model": {None: ("wrist-2010", ["wrist-2010", "wrist-2017"])},
    "end_effector": {
        None: ("pal-gripper", ["pal-gripper", "pal-hey5", "custom", "no-end-effector",
                               "robotiq-2f-85", "robotiq-2f-140"]),
        "ari": ("no-hand", ["ari-hand", "no-hand", "no-end-effector"]),
    },
    "ft_sensor": {None: ("schunk-ft", ["schunk-ft", "no-ft-sensor"])},
    "camera_model": {
        None: ("orbbec-astra", ["no-camera", "orbbec-astra", "orbbec-astra-pro", "asus-xtion"]),
        "pmb3": ("realsense-d435", ["realsense-d435"]),
        "ari": ("raspi", ["raspi", "realsense-d435"]),
    },
    "robot_model": {None: ("v2", ["v1", "v2"])},
}


def _part(name):
    def of(robot=None, **_others):
        default, choices = _PARTS[name].get(robot, _PARTS[name][None])
        if name == "robot_name" and robot is not None:
            default = robot
        return _argument(name, default, f"{name} of the robot", choices)

    return of


for _name in _PARTS:
    globals()[f"get_{_name}"] = _part(_name)


def get_robot_name(default_robot_name="pmb2"):
    return _part("robot_name")(default_robot_name)


def _merge_dictionaries(dict1, dict2):
    """Puts into the second what only the first has."""
    for key, value in dict1.items():
        if isinstance(value, dict):
            _merge_dictionaries(value, dict2.setdefault(key, {}))
        else:
            dict2.setdefault(key, value)
    return dict2


def _written(tree):
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
        yaml.dump(tree, file)
    return file.name


def insert_ros_param_prefix(data, prefix):
    if not isinstance(data, dict):
        return data
    return {
        key: {prefix: value} if key == ROS_PARAM_KEY else insert_ros_param_prefix(value, prefix)
        for key, value in data.items()
    }


def merge_param_files(yaml_files):
    merged = {}
    for each in yaml_files:
        file, prefix = (each, None) if isinstance(each, str) else each
        with open(file, encoding="utf-8") as stream:
            tree = yaml.safe_load(stream)
        tree = insert_ros_param_prefix(tree, prefix) if prefix else tree
        merged = _merge_dictionaries(merged, tree)
    return _written(merged)


def substitute_variables(file_path, variables, ld=None):
    """A file with `${NAME}`, `${NAME|DEFAULT}` and `${find PACKAGE}` put in."""
    used = {}

    def put(match):
        name, default = match.group(1).strip(), match.group(2)
        if name.startswith("find "):
            value = ament_index_python.get_package_share_directory(name[5:].strip())
        else:
            value = variables.get(name)
        value = default if value is None else value
        if value is None:
            if ld is not None:
                ld.add_action(LogInfo(msg=f"{file_path}: unset variable `{name}`"))
            return ""
        used[match.group(0)] = value
        return str(value)

    with open(file_path, encoding="utf-8") as file:
        text = re.sub(r"\$\{([^}|]+)(?:\|([^}]*))?\}", put, file.read())
    return yaml.safe_load(text), used


def parse_parametric_yaml(source_files, param_rewrites, ld=None):
    merged = {}
    for file in source_files:
        merged.update(substitute_variables(file, param_rewrites, ld)[0])
    return _written(merged)


def generate_component_list(yaml_file, namespace=None):
    with open(yaml_file, encoding="utf-8") as file:
        components = (yaml.safe_load(file) or {}).get("components", {})
    return [
        ComposableNode(
            package=of["package"],
            plugin=f"{of['package']}::{of['type']}",
            name=name,
            namespace=namespace,
            parameters=[of[ROS_PARAM_KEY]],
        )
        for name, of in components.items()
    ]


class CheckPublicSim(Action):
    """Ends a launch of the public simulation that does not say that it is one."""

    def _deed(self):
        return {"do": "group", "actions": [], "is_scoped": False}


class _Validate(CheckPublicSim):
    def __init__(self, **_others):
        super().__init__()


ValidateLaunchArgs = ValidateXacroArgs = _Validate


class LoadFile(Substitution):
    """The content of a file."""

    def __init__(self, file_path):
        self.file_path = normalize_to_list_of_substitutions(file_path)

    def perform(self, context):
        with open(perform_substitutions(context, self.file_path), encoding="utf-8") as file:
            return file.read()


class ConcatSubstitution(Substitution):
    """Texts one after the other."""

    def __init__(self, *parts):
        self.parts = normalize_to_list_of_substitutions(list(parts))

    def perform(self, context):
        return perform_substitutions(context, self.parts)


class IfNodeRunning(IfCondition):
    """Returns False: no node runs when a plan is made."""

    _text_when_planned = "false"

    def __init__(self, node_name):
        super().__init__(self._text_when_planned)


class UnlessNodeRunning(IfNodeRunning):
    _text_when_planned = "true"
