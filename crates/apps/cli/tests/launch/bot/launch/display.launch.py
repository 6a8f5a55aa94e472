"""A robot in a simulator, with everything that the first tier of symbols has."""
import os

import launch
import launch_ros
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    share = launch_ros.substitutions.FindPackageShare(package="launch_bot").find("launch_bot")
    model = os.path.join(share, "config", "bot.urdf.xacro")
    description = Command(["xacro ", LaunchConfiguration("model"), " length:=2"])
    use_sim_time = {"use_sim_time": LaunchConfiguration("use_sim_time")}
    return launch.LaunchDescription([
        DeclareLaunchArgument(name="gui", default_value="True", description="With sliders"),
        DeclareLaunchArgument(name="model", default_value=model, description="The robot"),
        DeclareLaunchArgument(name="use_sim_time", default_value="True"),
        ExecuteProcess(
            cmd=["gazebo", "--verbose", "-s", "libgazebo_ros_init.so", "a.world"], output="screen"
        ),
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[{"robot_description": description}, use_sim_time],
        ),
        launch_ros.actions.Node(
            package="joint_state_publisher",
            executable="joint_state_publisher",
            name="joint_state_publisher",
            parameters=[{"robot_description": description}],
            condition=UnlessCondition(LaunchConfiguration("gui")),
        ),
        Node(
            package="joint_state_publisher_gui",
            executable="joint_state_publisher_gui",
            condition=launch.conditions.IfCondition(LaunchConfiguration("gui")),
        ),
        Node(
            package="gazebo_ros",
            executable="spawn_entity.py",
            arguments=["-entity", "bot", "-topic", "robot_description"],
            output="screen",
        ),
        Node(
            package="robot_localization",
            executable="ekf_node",
            name="ekf_filter_node",
            output="screen",
            parameters=[os.path.join(share, "config", "ekf.yaml"), use_sim_time],
            remappings=[("odometry/filtered", "odom")],
            condition=IfCondition("1"),
        ),
    ])
