"""The native core of the ROS modules."""

from typing import TYPE_CHECKING

from periplus._native import RosArgumentsError, RosGraph, RosNameError, ros_split_arguments

if TYPE_CHECKING:
    from periplus._native import RosClient, RosNode, RosPublisher, RosServer, RosSubscription

__all__ = [
    "RosArgumentsError",
    "RosClient",
    "RosGraph",
    "RosNameError",
    "RosNode",
    "RosPublisher",
    "RosServer",
    "RosSubscription",
    "ros_split_arguments",
]
