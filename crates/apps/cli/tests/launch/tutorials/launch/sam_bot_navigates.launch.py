"""The second tutorial's three terminals in one: the robot, the map, the costmaps and their voxels."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node


def include(package, name, **arguments):
    path = os.path.join(get_package_share_directory(package), "launch", name)
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), launch_arguments=arguments.items()
    )


def generate_launch_description():
    params = os.path.join(get_package_share_directory("sam_bot"), "config", "nav2_params.yaml")
    fixed = Node(
        package="tf2_ros",
        executable="static_transform_publisher",
        arguments=["--x", "1", "--frame-id", "map", "--child-frame-id", "table"],
    )
    return LaunchDescription([
        include("sam_bot", "display.launch.py"),
        include("slam_toolbox", "online_async_launch.py"),
        include("nav2_bringup", "navigation_launch.py", params_file=params, use_sim_time="true"),
        Node(
            package="nav2_costmap_2d",
            executable="nav2_costmap_2d_markers",
            arguments=[
                "voxel_grid:=/local_costmap/voxel_grid",
                "visualization_marker:=/my_marker",
            ],
        ),
        fixed,
    ])
