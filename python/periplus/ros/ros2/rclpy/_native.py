"""The native core of the ROS modules."""

import os

if os.environ.get("PERIPLUS_FAKE_ROS"):  # development aid
    from fake_ros import RosArgumentsError, RosGraph, RosNameError, ros_split_arguments
else:
    from periplus._native import RosArgumentsError, RosGraph, RosNameError, ros_split_arguments

__all__ = ["RosArgumentsError", "RosGraph", "RosNameError", "ros_split_arguments"]
