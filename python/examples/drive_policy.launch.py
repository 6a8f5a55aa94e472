"""Drives sam_bot to a goal with a policy, in the simulation.

    periplus launch drive_policy.launch.py policy:=policy.onnx goal:='[3.0, 1.0]' --duration 30

`world` and `model` are those of the launch file of sam_bot, which is included.
"""

import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.substitutions import FindPackageShare

HERE = os.path.dirname(os.path.abspath(__file__))


def generate_launch_description() -> LaunchDescription:
    share = FindPackageShare(package="sam_bot").find("sam_bot")
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "policy",
                default_value=os.path.join(HERE, "navigation_policy.onnx"),
                description="The policy, as train_navigation.py writes it",
            ),
            DeclareLaunchArgument("goal", default_value="[3.0, 1.0]", description="The goal, x and y from the start [m]"),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(os.path.join(share, "launch", "display.launch.py"))
            ),
            ExecuteProcess(
                cmd=[
                    "python3", os.path.join(HERE, "drive_policy.py"), "--ros-args",
                    "-p", ["policy:=", LaunchConfiguration("policy")],
                    "-p", ["goal:=", LaunchConfiguration("goal")],
                    "-p", "use_sim_time:=true",
                    "-r", "odom:=demo/odom",
                ],
                output="screen",
            ),
        ]
    )  # fmt: skip
