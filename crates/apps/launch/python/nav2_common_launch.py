"""Substitutions of Nav2's launch files."""
from launch.condition import described as condition_described
from launch.substitution import Substitution
from launch.substitutions import _Of
from launch_ros.actions import Node as launch_ros_Node
from periplus_launch import conversation
from periplus_launch.objects import pairs, text


class RewrittenYaml(_Of):
    def __init__(self, source_file, param_rewrites=None, root_key=None, key_rewrites=None,
                 value_rewrites=None, convert_types=False):
        super().__init__(
            "rewritten_yaml",
            file=text(source_file),
            rewrites=pairs(param_rewrites),
            key_rewrites=pairs(key_rewrites),
            value_rewrites=pairs(value_rewrites),
            root=text(root_key),
            convert=bool(convert_types),
        )

    @property
    def name(self):
        return self._details["file"]


class ReplaceString(_Of):
    def __init__(self, source_file, replacements, condition=None):
        super().__init__(
            "replaced_text",
            file=text(source_file),
            replacements=pairs(replacements),
            condition=None if condition is None else condition_described(condition),
        )


class HasNodeParams(_Of):
    def __init__(self, source_file, node_name):
        super().__init__("has_node_parameters", file=text(source_file), node=text(node_name))


class LaunchConfigAsBool(_Of):
    def __init__(self, name):
        super().__init__("truth", name=text(name))


class ParseMultiRobotPose(Substitution):
    """Robots and their poses: `robots:="name={x: 1.0, y: 2.0, yaw: 0.0}; ..."`."""

    def __init__(self, target_argument="robots"):
        self._argument = target_argument

    def perform(self, context):
        return context.launch_configurations.get(self._argument, "")

    def value(self):
        import launch

        said = self.perform(launch._context())
        poses = {}
        for entry in filter(None, (entry.strip() for entry in said.split(";"))):
            name, _, pose = entry.partition("=")
            given = conversation.ask("yaml", text=pose.strip()) or {}
            keys = ("x", "y", "z", "roll", "pitch", "yaw")
            poses[name.strip()] = {key: float(given.get(key, 0.0)) for key in keys}
        return poses



class Node(launch_ros_Node):
    """A node, as files of before Foxy name it."""
