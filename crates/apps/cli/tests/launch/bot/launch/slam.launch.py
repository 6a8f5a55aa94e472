"""A managed node that configures and activates itself, with the second tier of symbols."""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, LogInfo, RegisterEventHandler
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import AndSubstitution, LaunchConfiguration, NotSubstitution
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    autostart = LaunchConfiguration("autostart")
    managed = LaunchConfiguration("use_lifecycle_manager")
    itself = IfCondition(AndSubstitution(autostart, NotSubstitution(managed)))
    node = LifecycleNode(
        parameters=[
            LaunchConfiguration("slam_params_file"),
            {"use_lifecycle_manager": managed, "use_sim_time": LaunchConfiguration("use_sim_time")},
        ],
        package="slam_toolbox",
        executable="async_slam_toolbox_node",
        name="slam_toolbox",
        output="screen",
        namespace="",
    )
    configure = EmitEvent(
        event=ChangeState(
            lifecycle_node_matcher=matches_action(node),
            transition_id=Transition.TRANSITION_CONFIGURE,
        ),
        condition=itself,
    )
    activate = RegisterEventHandler(
        OnStateTransition(
            target_lifecycle_node=node,
            start_state="configuring",
            goal_state="inactive",
            entities=[
                LogInfo(msg="slam is inactive: activating it"),
                EmitEvent(event=ChangeState(
                    lifecycle_node_matcher=matches_action(node),
                    transition_id=Transition.TRANSITION_ACTIVATE,
                )),
            ],
        ),
        condition=itself,
    )
    description = LaunchDescription()
    description.add_action(DeclareLaunchArgument("autostart", default_value="true"))
    description.add_action(DeclareLaunchArgument("use_lifecycle_manager", default_value="false"))
    description.add_action(DeclareLaunchArgument("use_sim_time", default_value="true"))
    description.add_action(DeclareLaunchArgument(
        "slam_params_file",
        default_value=os.path.join(get_package_share_directory("slam_toolbox"), "config", "a.yaml"),
    ))
    for action in (node, configure, activate):
        description.add_action(action)
    return description
