"""Two robots with transforms of their own in one world, as in Nav2's bringup for several robots. The second navigates."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command
from launch_ros.actions import Node, PushRosNamespace

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..", "..")
KBOT = os.path.join(ROOT, "robots", "kbot", "urdf", "kbot.urdf.xacro")


def robot(name, y):
    own = [("/tf", "tf"), ("/tf_static", "tf_static")]
    return GroupAction([
        PushRosNamespace(name),
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[{"robot_description": Command(["xacro ", KBOT]), "use_sim_time": True}],
            remappings=own,
        ),
        Node(
            package="gazebo_ros",
            executable="spawn_entity.py",
            arguments=[
                "-entity", name, "-topic", "robot_description", "-robot_namespace", name,
                "-x", "0", "-y", str(y),
            ],
        ),
        Node(
            package="topic_tools",
            executable="relay",
            parameters=[{
                "input_topic": "cmd_vel",
                "output_topic": "base_controller/cmd_vel",
                "use_sim_time": True,
            }],
        ),
    ])


def generate_launch_description():
    navigation = os.path.join(
        get_package_share_directory("nav2_bringup"), "launch", "navigation_launch.py"
    )
    arguments = {
        "namespace": "r2",
        "use_sim_time": "true",
        "params_file": os.path.join(HERE, "two_robots.yaml"),
    }
    world = os.path.join(ROOT, "worlds", "closed_room.world")
    return LaunchDescription([
        ExecuteProcess(cmd=[
            "gazebo", "-s", "libgazebo_ros_init.so", "-s", "libgazebo_ros_factory.so", world,
        ]),
        robot("r1", 0.0),
        robot("r2", 1.0),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(navigation), launch_arguments=arguments.items()
        ),
    ])
