"""The action that includes the launch file of `ros_gz_bridge`."""
from ros_gz_sim.actions import _OfFile


class RosGzBridge(_OfFile):
    """Runs a bridge between Gazebo and ROS."""

    def __init__(self, *, bridge_name, config_file, **others):
        arguments = {name: value for name, value in others.items() if name != "condition"}
        arguments.update(bridge_name=bridge_name, config_file=config_file)
        super().__init__("ros_gz_bridge", "ros_gz_bridge.launch.py", arguments, **others)
