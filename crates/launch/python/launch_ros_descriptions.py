"""Components, and parameters with a type."""
from launch_ros.parameter_descriptions import (  # noqa: F401
    Parameter,
    ParameterFile,
    ParameterValue,
    described,
)
from periplus_launch.objects import pairs, text


class ComposableNode:
    """A component that is loaded into a container."""

    def __init__(self, *, package, plugin, name=None, namespace=None, parameters=None,
                 remappings=None, extra_arguments=None, condition=None):
        self._condition = condition
        self._details = {
            "package": text(package),
            "plugin": text(plugin),
            "name": text(name),
            "namespace": text(namespace),
            "parameters": described(parameters),
            "remaps": pairs(remappings),
        }

    def _described(self):
        from launch.condition import described as condition_described

        condition = None if self._condition is None else condition_described(self._condition)
        return {**self._details, "condition": condition}
