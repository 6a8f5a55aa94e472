"""@NAME@ in its room, with a filter of wheels and IMU, a map or localization, and RViz.

    ... launch @NAME@ simulation.launch.py                              draws a map while it drives
    ... launch @NAME@ simulation.launch.py slam:=false map:=/path/to/room.yaml   localizes on a map
    ... launch @NAME@ simulation.launch.py nav:=true                    Nav2 with its costmaps as well

where `...` is `periplus` or `ros2`. Drive it with `periplus teleop` or `ros2 run teleop_twist_keyboard
teleop_twist_keyboard`; save the map with `periplus map save -f room` or `ros2 run nav2_map_server
map_saver_cli -f room`.
"""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def include(package, name, condition=None, **arguments):
    """Another package's launch file, with arguments of it."""
    path = os.path.join(get_package_share_directory(package), "launch", name)
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path),
        launch_arguments=arguments.items(),
        condition=condition,
    )


def generate_launch_description():
    share = get_package_share_directory("@NAME@")
    config = os.path.join(share, "config")
    world = LaunchConfiguration("world")
    slam = LaunchConfiguration("slam")
    simulated = {"use_sim_time": True}

    arguments = [
        DeclareLaunchArgument(
            "model",
            default_value=os.path.join(share, "urdf", "@NAME@.urdf.xacro"),
            description="The robot's file",
        ),
        DeclareLaunchArgument(
            "world",
            default_value=os.path.join(share, "worlds", "room.sdf"),
            description="The world it stands in",
        ),
        DeclareLaunchArgument(
            "slam", default_value="true", description="true: draw a map; false: localize on `map`"
        ),
        DeclareLaunchArgument(
            "map", default_value="", description="The YAML of the map to localize on"
        ),
        DeclareLaunchArgument(
            "nav", default_value="false", description="true: start Nav2 with its costmaps"
        ),
        DeclareLaunchArgument("rviz", default_value="true", description="true: open RViz"),
    ]

    # The filter below publishes odom -> base_footprint, so the wheels do not.
    description = Command(
        ["xacro ", LaunchConfiguration("model"), " sim:=@SIM@ publish_odom_tf:=false"]
    )
    robot_state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        parameters=[{"robot_description": ParameterValue(description, value_type=str)}, simulated],
    )
@SIMULATOR@
    ekf = Node(
        package="robot_localization",
        executable="ekf_node",
        name="ekf_filter_node",
        output="screen",
        parameters=[os.path.join(config, "ekf.yaml")],
    )
    mapping = include(
        "slam_toolbox",
        "online_async_launch.py",
        condition=IfCondition(slam),
        use_sim_time="true",
        slam_params_file=os.path.join(config, "slam.yaml"),
    )
    localization = include(
        "nav2_bringup",
        "localization_launch.py",
        condition=UnlessCondition(slam),
        use_sim_time="true",
        map=LaunchConfiguration("map"),
        params_file=os.path.join(config, "nav2_params.yaml"),
    )
    navigation = include(
        "nav2_bringup",
        "navigation_launch.py",
        condition=IfCondition(LaunchConfiguration("nav")),
        use_sim_time="true",
        params_file=os.path.join(config, "nav2_params.yaml"),
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", os.path.join(share, "rviz", "@NAME@.rviz")],
        parameters=[simulated],
        condition=IfCondition(LaunchConfiguration("rviz")),
    )
    return LaunchDescription(
        [
            *arguments,
            robot_state_publisher,
            *simulation,
            ekf,
            mapping,
            localization,
            navigation,
            rviz,
        ]
    )
