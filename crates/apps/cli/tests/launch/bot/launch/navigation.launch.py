"""Navigation with and without composition: the third tier of symbols."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription, LaunchDescriptionEntity
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    ExecuteProcess,
    ForEach,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetEnvironmentVariable,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit, OnProcessStart, OnShutdown
from launch.events import Shutdown
from launch.actions import EmitEvent
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    EnvironmentVariable,
    EqualsSubstitution,
    FindExecutable,
    LaunchConfiguration,
    NotEqualsSubstitution,
    PathJoinSubstitution,
    PythonExpression,
    TextSubstitution,
)
from launch_ros.actions import (
    ComposableNodeContainer,
    LoadComposableNodes,
    Node,
    PushROSNamespace,
    SetParameter,
    SetRemap,
    SetUseSimTime,
)
from launch_ros.descriptions import ComposableNode, ParameterFile, ParameterValue
from nav2_common.launch import HasNodeParams, LaunchConfigAsBool, ReplaceString, RewrittenYaml


def robot_named(context: LaunchContext, prefix) -> list[LaunchDescriptionEntity]:
    name = prefix + LaunchConfiguration("robot").perform(context)
    context.launch_configurations["full_name"] = name
    return [LogInfo(msg=["the robot is ", name])]


def each(name: str, x: float):
    return [LogInfo(msg=f"{name} at {x}")]


def generate_launch_description():
    share = get_package_share_directory("launch_bot")
    params_file = LaunchConfiguration("params_file")
    composed = LaunchConfigAsBool("use_composition")
    replaced = ReplaceString(
        source_file=params_file,
        replacements={"<model>": ("nav2_amcl::", "Differential")},
        condition=IfCondition("true"),
    )
    params = ParameterFile(
        RewrittenYaml(
            source_file=replaced,
            root_key=LaunchConfiguration("namespace"),
            param_rewrites={"use_sim_time": "True"},
            convert_types=True,
        ),
        allow_substs=True,
    )
    amcl = Node(
        package="nav2_amcl",
        executable="amcl",
        name="amcl",
        respawn=True,
        respawn_delay=2.0,
        parameters=[params, {"scan": {"topic": "scan"}, "ids": [1, 2]}],
        arguments=["--ros-args", "--log-level", "info"],
        remappings=[("/tf", "tf")],
    )
    dump = ExecuteProcess(
        cmd=[FindExecutable(name="no_such_program"), " ", EnvironmentVariable("NOBODY_HAS_THIS", default_value="x")],
        shell=True,
        on_exit=EmitEvent(event=Shutdown(reason="it has ended")),
    )
    return LaunchDescription([
        SetEnvironmentVariable("RCUTILS_LOGGING_BUFFERED_STREAM", "1"),
        AppendEnvironmentVariable("BOT_PATH", os.path.join(share, "models")),
        AppendEnvironmentVariable("BOT_PATH", "more"),
        DeclareLaunchArgument("namespace", default_value="r1"),
        DeclareLaunchArgument("robot", default_value="bot", choices=["bot", "cat"]),
        DeclareLaunchArgument("use_composition", default_value="False"),
        DeclareLaunchArgument(
            "params_file", default_value=PathJoinSubstitution([share, "config", "nav.yaml"])
        ),
        OpaqueFunction(function=robot_named, args=["the_"]),
        GroupAction([
            PushROSNamespace(
                condition=IfCondition(NotEqualsSubstitution(LaunchConfiguration("namespace"), "")),
                namespace=LaunchConfiguration("namespace"),
            ),
            SetParameter("use_sim_time", True),
            SetUseSimTime(True),
            SetRemap("/scan", "scan"),
            amcl,
            LoadComposableNodes(
                target_container="nav_container",
                composable_node_descriptions=[
                    ComposableNode(
                        package="nav2_amcl",
                        plugin="nav2_amcl::AmclNode",
                        name="amcl",
                        parameters=[{"x": ParameterValue(TextSubstitution(text="7"), value_type=str)}],
                    ),
                ],
                condition=IfCondition(PythonExpression(["not ", composed])),
            ),
        ]),
        ComposableNodeContainer(
            name="nav_container", namespace="", package="rclcpp_components",
            executable="component_container_isolated",
        ),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([share, "/launch/slam.launch.py"]),
            launch_arguments={"autostart": "false", "use_sim_time": "false"}.items(),
            condition=IfCondition(EqualsSubstitution(LaunchConfiguration("full_name"), "the_bot")),
        ),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py")
            ),
            launch_arguments={"gz_args": ["-r -s ", "a.sdf"]}.items(),
        ),
        ForEach("name=a, x=1.5; name=b, x=2", function=each),
        LogInfo(msg="has parameters", condition=IfCondition(HasNodeParams(params_file, "amcl"))),
        dump,
        RegisterEventHandler(OnProcessStart(target_action=dump, on_start=[
            TimerAction(period=1.5, actions=[LogInfo(msg="a while after")]),
        ])),
        RegisterEventHandler(OnProcessExit(
            target_action=amcl, on_exit=lambda event, context: LogInfo(msg="amcl is gone"),
        )),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg="over")])),
    ])
