"""Replacement of `moveit_configs_utils`: the parameters of MoveIt from the files of a package."""
import re
from dataclasses import dataclass, field
from pathlib import Path

from ament_index_python.packages import get_package_share_path
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitution import Substitution
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_param_builder import (
    ParameterBuilder,
    ParameterBuilderFileNotFoundError,
    load_xacro,
    load_yaml,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


class Xacro(Substitution):
    """An expanded file, with arguments that are known when it is needed."""

    def __init__(self, file_path, *, mappings=None):
        self.file_path = normalize_to_list_of_substitutions(file_path)
        self.mappings = mappings or {}

    def perform(self, context):
        def text(value):
            return perform_substitutions(context, normalize_to_list_of_substitutions(value))

        mappings = {text(name): text(value) for name, value in self.mappings.items()}
        return load_xacro(Path(text(self.file_path)), mappings)


@dataclass
class MoveItConfigs:
    """Parameters by what they are for."""

    package_path: object = None
    robot_description: dict = field(default_factory=dict)
    robot_description_semantic: dict = field(default_factory=dict)
    robot_description_kinematics: dict = field(default_factory=dict)
    planning_pipelines: dict = field(default_factory=dict)
    trajectory_execution: dict = field(default_factory=dict)
    planning_scene_monitor: dict = field(default_factory=dict)
    sensors_3d: dict = field(default_factory=dict)
    move_group_capabilities: dict = field(
        default_factory=lambda: {"capabilities": "", "disable_capabilities": ""}
    )
    joint_limits: dict = field(default_factory=dict)
    moveit_cpp: dict = field(default_factory=dict)
    pilz_cartesian_limits: dict = field(default_factory=dict)

    def to_dict(self):
        merged = {}
        for part in (
            self.robot_description, self.robot_description_semantic,
            self.robot_description_kinematics, self.planning_pipelines,
            self.trajectory_execution, self.planning_scene_monitor, self.sensors_3d,
            self.joint_limits, self.moveit_cpp,
        ):
            merged.update(part)
        for name, limits in self.pilz_cartesian_limits.items():
            merged[name] = {**merged.get(name, {}), **limits}
        return merged


_MONITOR = {
    "publish_planning_scene": True,
    "publish_geometry_updates": True,
    "publish_state_updates": True,
    "publish_transforms_updates": True,
    "publish_robot_description": False,
    "publish_robot_description_semantic": False,
}


class MoveItConfigsBuilder(ParameterBuilder):
    """Gathers the parameters of MoveIt; each step gives the builder itself."""

    def __init__(self, robot_name, robot_description="robot_description", package_name=None):
        super().__init__(package_name or f"{robot_name}_moveit_config")
        self._robot, self._key = robot_name, robot_description
        self._made = MoveItConfigs(package_path=self._package_path)
        self._urdf, self._arguments = None, None
        self._srdf = self._config(f"{robot_name}.srdf")
        own = self._config(f"{robot_name}.urdf.xacro")
        if own.exists():
            self._urdf = own
        assistant = self._package_path / ".setup_assistant"
        if assistant.exists():
            self._read(load_yaml(assistant).get("moveit_setup_assistant_config", {}))
        if self._urdf is None:
            self._urdf = self._config(f"{robot_name}.urdf")

    def _read(self, config):
        urdf = config.get("urdf", config.get("URDF"))
        if urdf:
            if self._urdf is None:
                self._urdf = get_package_share_path(urdf["package"]) / urdf["relative_path"]
            words = (urdf.get("xacro_args") or "").split()
            self._arguments = dict(word.split(":=", 1) for word in words) or None
        srdf = config.get("srdf", config.get("SRDF"))
        if srdf:
            self._srdf = self._package_path / srdf["relative_path"]

    def _config(self, name):
        return self._package_path / "config" / name

    def _file(self, given, usual):
        return self._package_path / given if given else usual

    def _description(self, file, mappings):
        values = [*(mappings or {}).keys(), *(mappings or {}).values()]
        if all(isinstance(value, str) for value in values):
            return load_xacro(file, mappings=mappings)
        return ParameterValue(Xacro(str(file), mappings=mappings), value_type=str)

    def robot_description(self, file_path=None, mappings=None):
        file = self._file(file_path, self._urdf)
        try:
            text = self._description(file, mappings or self._arguments)
        except ParameterBuilderFileNotFoundError:
            # It comes from the topic then.
            return self
        self._made.robot_description = {self._key: text}
        return self

    def robot_description_semantic(self, file_path=None, mappings=None):
        text = self._description(self._file(file_path, self._srdf), mappings)
        self._made.robot_description_semantic = {f"{self._key}_semantic": text}
        return self

    def _of(self, file_path, usual):
        return load_yaml(self._file(file_path, self._config(usual)))

    def robot_description_kinematics(self, file_path=None):
        values = self._of(file_path, "kinematics.yaml")
        self._made.robot_description_kinematics = {f"{self._key}_kinematics": values}
        return self

    def joint_limits(self, file_path=None):
        values = self._of(file_path, "joint_limits.yaml")
        self._made.joint_limits = {f"{self._key}_planning": values}
        return self

    def moveit_cpp(self, file_path=None):
        self._made.moveit_cpp = self._of(file_path, "moveit_cpp.yaml")
        return self

    def pilz_cartesian_limits(self, file_path=None):
        values = self._of(file_path, "pilz_cartesian_limits.yaml")
        self._made.pilz_cartesian_limits = {f"{self._key}_planning": values}
        return self

    def _matching(self, ending):
        folder = self._package_path / "config"
        if not folder.is_dir():
            return []
        found = (re.fullmatch(f"(.*)_{ending}.yaml", each.name) for each in folder.iterdir())
        return sorted(match[1] for match in found if match)

    def trajectory_execution(self, file_path=None, moveit_manage_controllers=True):
        made = {"moveit_manage_controllers": moveit_manage_controllers}
        if file_path is None:
            names = self._matching("controllers")
            usual = [name for name in ("moveit", "moveit2", self._robot) if name in names]
            chosen = names if len(names) == 1 else usual
            if names and not chosen:
                raise RuntimeError(f"several files of controllers: {', '.join(names)}")
            file = self._config(f"{chosen[0]}_controllers.yaml") if chosen else None
        else:
            file = self._package_path / file_path
        if file is not None:
            made.update(load_yaml(file))
        self._made.trajectory_execution = made
        return self

    def planning_scene_monitor(self, **given):
        self._made.planning_scene_monitor = {**_MONITOR, **given}
        return self

    def sensors_3d(self, file_path=None):
        file = self._file(file_path, self._config("sensors_3d.yaml"))
        if file.exists():
            values = load_yaml(file)
            if any(values.get("sensors") or []):
                self._made.sensors_3d = values
        return self

    def planning_pipelines(self, default_planning_pipeline=None, pipelines=None, load_all=True):
        names = list(pipelines or self._matching("planning")) or ["ompl"]
        default = default_planning_pipeline or ("ompl" if "ompl" in names else names[0])
        if default not in names:
            raise RuntimeError(f"`{default}` is none of the pipelines {', '.join(names)}")
        made = {"planning_pipelines": names, "default_planning_pipeline": default}
        for name in names:
            file = self._config(f"{name}_planning.yaml")
            # Those of MoveIt's own are known to MoveIt.
            made[name] = load_yaml(file) if file.exists() else {}
        self._made.planning_pipelines = made
        return self

    def to_moveit_configs(self):
        made = self._made
        made.robot_description or self.robot_description()
        made.robot_description_semantic or self.robot_description_semantic()
        made.robot_description_kinematics or self.robot_description_kinematics()
        made.planning_pipelines or self.planning_pipelines()
        made.trajectory_execution or self.trajectory_execution()
        made.planning_scene_monitor or self.planning_scene_monitor()
        made.sensors_3d or self.sensors_3d()
        made.joint_limits or self.joint_limits()
        if "pilz_industrial_motion_planner" in made.planning_pipelines:
            made.pilz_cartesian_limits or self.pilz_cartesian_limits()
        return made

    def to_dict(self, include_moveit_configs=True):
        if include_moveit_configs:
            self._parameters.update(self.to_moveit_configs().to_dict())
        return self._parameters


class DeclareBooleanLaunchArg(DeclareLaunchArgument):
    """An argument that is true or false."""

    def __init__(self, name, *, default_value=False, description=None, **others):
        super().__init__(
            name, default_value=str(default_value), description=description,
            choices=["true", "false", "True", "False"], **others,
        )


def add_debuggable_node(ld, package, executable, condition_name="debug", commands_file=None,
                        extra_debug_args=None, **others):
    """Adds a node, and one under gdb in its place when a configuration says so."""
    debug = LaunchConfiguration(condition_name)
    ld.add_action(
        Node(package=package, executable=executable, condition=UnlessCondition(debug), **others)
    )
    words = [*others.pop("arguments", []), *(extra_debug_args or [])]
    commands = f"-x {commands_file} " if commands_file else ""
    ld.add_action(
        Node(
            package=package, executable=executable, condition=IfCondition(debug),
            prefix=[f"gdb {commands}--ex run --args"], arguments=words, **others,
        )
    )


def _description():
    from launch import LaunchDescription

    return LaunchDescription()


def generate_rsp_launch(moveit_config):
    made = _description()
    made.add_action(DeclareLaunchArgument("publish_frequency", default_value="15.0"))
    made.add_action(
        Node(
            package="robot_state_publisher", executable="robot_state_publisher",
            respawn=True, output="screen",
            parameters=[
                moveit_config.robot_description,
                {"publish_frequency": LaunchConfiguration("publish_frequency")},
            ],
        )
    )
    return made


def generate_moveit_rviz_launch(moveit_config):
    made = _description()
    made.add_action(DeclareBooleanLaunchArg("debug", default_value=False))
    config = str(moveit_config.package_path / "config/moveit.rviz")
    made.add_action(DeclareLaunchArgument("rviz_config", default_value=config))
    add_debuggable_node(
        made, package="rviz2", executable="rviz2", output="log", respawn=False,
        arguments=["-d", LaunchConfiguration("rviz_config")],
        parameters=[
            moveit_config.planning_pipelines, moveit_config.robot_description_kinematics,
            moveit_config.joint_limits,
        ],
    )
    return made


def generate_setup_assistant_launch(moveit_config):
    made = _description()
    made.add_action(DeclareBooleanLaunchArg("debug", default_value=False))
    add_debuggable_node(
        made, package="moveit_setup_assistant", executable="moveit_setup_assistant",
        arguments=[["--config_pkg=", str(moveit_config.package_path)]],
    )
    return made


def generate_static_virtual_joint_tfs_launch(moveit_config):
    from xml.dom import minidom

    made = _description()
    text = moveit_config.robot_description_semantic.get("robot_description_semantic", "<robot/>")
    if isinstance(text, str):
        for number, joint in enumerate(
            minidom.parseString(text).getElementsByTagName("virtual_joint")
        ):
            frames = [joint.getAttribute("parent_frame"), joint.getAttribute("child_link")]
            made.add_action(
                Node(
                    package="tf2_ros", executable="static_transform_publisher",
                    name=f"static_transform_publisher{number}", output="log",
                    arguments=["--frame-id", frames[0], "--child-frame-id", frames[1]],
                )
            )
    return made


def generate_spawn_controllers_launch(moveit_config):
    made = _description()
    manager = moveit_config.trajectory_execution.get("moveit_simple_controller_manager", {})
    for name in [*manager.get("controller_names", []), "joint_state_broadcaster"]:
        made.add_action(
            Node(package="controller_manager", executable="spawner", arguments=[name], output="screen")
        )
    return made


def generate_warehouse_db_launch(moveit_config):
    made = _description()
    path = str(moveit_config.package_path / "default_warehouse_mongo_db")
    made.add_action(DeclareLaunchArgument("moveit_warehouse_database_path", default_value=path))
    made.add_action(DeclareBooleanLaunchArg("reset", default_value=False))
    parameters = [{"database_path": LaunchConfiguration("moveit_warehouse_database_path")}]
    made.add_action(
        Node(
            package="warehouse_ros_mongo", executable="mongo_wrapper_ros.py",
            parameters=parameters,
        )
    )
    made.add_action(
        Node(
            package="moveit_ros_warehouse", executable="moveit_init_demo_warehouse",
            output="screen", condition=IfCondition(LaunchConfiguration("reset")),
        )
    )
    return made


def generate_move_group_launch(moveit_config):
    made = _description()
    for name, value in (
        ("debug", False), ("allow_trajectory_execution", True),
        ("publish_monitored_planning_scene", True), ("monitor_dynamics", False),
    ):
        made.add_action(DeclareBooleanLaunchArg(name, default_value=value))
    for name in ("capabilities", "disable_capabilities"):
        value = moveit_config.move_group_capabilities[name]
        made.add_action(DeclareLaunchArgument(name, default_value=value))
    monitored = LaunchConfiguration("publish_monitored_planning_scene")
    configuration = {
        "publish_robot_description_semantic": True,
        "allow_trajectory_execution": LaunchConfiguration("allow_trajectory_execution"),
        "capabilities": ParameterValue(LaunchConfiguration("capabilities"), value_type=str),
        "disable_capabilities": ParameterValue(
            LaunchConfiguration("disable_capabilities"), value_type=str
        ),
        "publish_planning_scene": monitored,
        "publish_geometry_updates": monitored,
        "publish_state_updates": monitored,
        "publish_transforms_updates": monitored,
        "monitor_dynamics": False,
    }
    add_debuggable_node(
        made, package="moveit_ros_move_group", executable="move_group", output="screen",
        parameters=[moveit_config.to_dict(), configuration], extra_debug_args=["--debug"],
        additional_env={"DISPLAY": ":0"},
    )
    return made


def generate_demo_launch(moveit_config, launch_package_path=None):
    made = _description()
    made.add_action(DeclareBooleanLaunchArg("db", default_value=False))
    made.add_action(DeclareBooleanLaunchArg("debug", default_value=False))
    made.add_action(DeclareBooleanLaunchArg("use_rviz", default_value=True))
    for generate in (
        generate_static_virtual_joint_tfs_launch, generate_rsp_launch, generate_move_group_launch,
        generate_moveit_rviz_launch,
    ):
        for entity in generate(moveit_config).entities:
            made.add_action(entity)
    controllers = str(moveit_config.package_path / "config/ros2_controllers.yaml")
    made.add_action(
        Node(
            package="controller_manager", executable="ros2_control_node",
            parameters=[controllers],
            remappings=[("/controller_manager/robot_description", "/robot_description")],
        )
    )
    for entity in generate_spawn_controllers_launch(moveit_config).entities:
        made.add_action(entity)
    return made
