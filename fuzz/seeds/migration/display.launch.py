"""sam_bot on RViz: simulated in a world, or its description alone.

With `simulate:=True` (the default) Gazebo Classic runs `world`, the robot stands in it, and a filter of
wheels and IMU says where it is. With `simulate:=False` only the description is shown, with its joints at
rest, or by sliders with `gui:=True`.
"""
import os

import launch
import launch_ros
from launch.actions import DeclareLaunchArgument, ExecuteProcess, GroupAction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    share = launch_ros.substitutions.FindPackageShare(package="sam_bot").find("sam_bot")
    worlds = launch_ros.substitutions.FindPackageShare(package="periplus_worlds").find(
        "periplus_worlds"
    )
    simulate = LaunchConfiguration("simulate")
    gui = LaunchConfiguration("gui")
    use_sim_time = {"use_sim_time": LaunchConfiguration("use_sim_time")}
    description = {"robot_description": Command(["xacro ", LaunchConfiguration("model")])}

    arguments = [
        DeclareLaunchArgument(
            name="model",
            default_value=os.path.join(share, "urdf", "sam_bot.urdf.xacro"),
            description="The robot's description",
        ),
        DeclareLaunchArgument(
            name="world",
            default_value=os.path.join(worlds, "cube_and_sphere.sdf"),
            description="The world it stands in",
        ),
        DeclareLaunchArgument(
            name="rvizconfig",
            default_value=os.path.join(share, "rviz", "sam_bot.rviz"),
            description="What RViz shows",
        ),
        DeclareLaunchArgument(
            name="simulate", default_value="True", description="Run Gazebo, or show it at rest"
        ),
        DeclareLaunchArgument(
            name="gui", default_value="False", description="Sliders for joints that are at rest"
        ),
        DeclareLaunchArgument(
            name="use_sim_time", default_value=simulate, description="Time is the simulation's"
        ),
    ]
    robot_state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        parameters=[description, use_sim_time],
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        name="rviz2",
        output="screen",
        arguments=["-d", LaunchConfiguration("rvizconfig")],
        parameters=[use_sim_time],
    )
    at_rest = GroupAction(
        condition=UnlessCondition(simulate),
        actions=[
            Node(
                package="joint_state_publisher",
                executable="joint_state_publisher",
                condition=UnlessCondition(gui),
            ),
            Node(
                package="joint_state_publisher_gui",
                executable="joint_state_publisher_gui",
                condition=IfCondition(gui),
            ),
        ],
    )
    simulated = GroupAction(
        condition=IfCondition(simulate),
        actions=[
            ExecuteProcess(
                cmd=[
                    "gazebo",
                    "--verbose",
                    "-s",
                    "libgazebo_ros_init.so",
                    "-s",
                    "libgazebo_ros_factory.so",
                    LaunchConfiguration("world"),
                ],
                output="screen",
            ),
            Node(
                package="gazebo_ros",
                executable="spawn_entity.py",
                arguments=["-entity", "sam_bot", "-topic", "robot_description", "-z", "0.15"],
                output="screen",
            ),
            Node(
                package="robot_localization",
                executable="ekf_node",
                name="ekf_filter_node",
                output="screen",
                parameters=[os.path.join(share, "config", "ekf.yaml"), use_sim_time],
            ),
        ],
    )
    return launch.LaunchDescription([*arguments, robot_state_publisher, at_rest, simulated, rviz])
