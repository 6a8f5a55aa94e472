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

    def __init__(self, *, package, plugin=None, name=None, namespace=None, parameters=None,
                 remappings=None, extra_arguments=None, condition=None, node_plugin=None,
                 node_name=None, node_namespace=None, **_others):
        # Up to Foxy the names began with `node_`.
        plugin = plugin if plugin is not None else node_plugin
        name = name if name is not None else node_name
        namespace = namespace if namespace is not None else node_namespace
        if plugin is None:
            raise TypeError("ComposableNode: the argument `plugin` is missing")
        self._condition = condition
        self.package, self.node_plugin, self.node_name = package, plugin, name
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


class ComposableLifecycleNode(ComposableNode):
    """A component that is a lifecycle node."""

    def __init__(self, *, autostart=False, **others):
        super().__init__(**others)
