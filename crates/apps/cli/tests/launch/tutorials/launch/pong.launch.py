"""The third tutorial: a world of Gazebo's, its lidar on another topic of ROS, and a bridge file."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node


def generate_launch_description():
    world = os.path.join(get_package_share_directory("periplus_worlds"), "pong.sdf")
    share = get_package_share_directory("launch_tutorials")
    return LaunchDescription([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(
                get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py"
            )),
            launch_arguments={"gz_args": "-r " + world}.items(),
        ),
        Node(
            package="ros_gz_bridge",
            executable="parameter_bridge",
            arguments=[
                "/lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan",
                "--ros-args", "-r", "/lidar:=/laser_scan",
            ],
        ),
        Node(
            package="ros_gz_bridge",
            executable="parameter_bridge",
            parameters=[{"config_file": os.path.join(share, "launch", "bridge.yaml")}],
        ),
    ])
