"""Actions of ROS."""
from launch.action import Action
from launch.actions import SetROSLogDir, described_running  # noqa: F401
from launch_ros.parameter_descriptions import described, given
from periplus_launch import objects
from periplus_launch.objects import pairs, text


class Node(Action):
    """Starts a program that is a node."""

    _is_lifecycle = False

    def __init__(self, *, executable=None, package=None, name=None, namespace=None, exec_name=None,
                 parameters=None, remappings=None, ros_arguments=None, arguments=None,
                 condition=None, node_name=None, node_namespace=None, node_executable=None,
                 **running):
        super().__init__(condition=condition)
        # Up to Foxy the names began with `node_`.
        executable = executable if executable is not None else node_executable
        name = name if name is not None else node_name
        namespace = namespace if namespace is not None else node_namespace
        if executable is None:
            raise TypeError(f"{type(self).__name__}: the argument `executable` is missing")
        self.node_executable, self.node_package, self.node_name = executable, package, name
        self._details = {
            "package": text(package),
            "executable": text(executable),
            "name": text(name),
            "namespace": text(namespace),
            "parameters": described(parameters),
            "remaps": pairs(remappings),
            "arguments": [text(word) for word in arguments or []],
            "ros_arguments": [text(word) for word in ros_arguments or []],
            "is_lifecycle": self._is_lifecycle,
        }
        self._running = running
        self._components = []

    def _deed(self):
        return {
            "do": "node",
            **self._details,
            "components": [component._described() for component in self._components],
            "running": described_running(self._running),
        }


class LifecycleNode(Node):
    _is_lifecycle = True

    def __init__(self, *, name=None, namespace="", autostart=False, **others):
        if name is None and others.get("node_name") is None:
            raise TypeError("LifecycleNode: the argument `name` is missing")
        namespace = others.pop("node_namespace", None) or namespace
        super().__init__(name=name, namespace=namespace, **others)
        self._details["autostart"] = text(
            str(autostart) if isinstance(autostart, bool) else autostart
        )


class ComposableNodeContainer(Node):
    def __init__(self, *, name=None, namespace="", composable_node_descriptions=None, **others):
        if name is None and others.get("node_name") is None:
            raise TypeError("ComposableNodeContainer: the argument `name` is missing")
        namespace = others.pop("node_namespace", None) or namespace
        super().__init__(name=name, namespace=namespace, **others)
        self._components = list(composable_node_descriptions or [])


class LoadComposableNodes(Action):
    def __init__(self, *, composable_node_descriptions, target_container, condition=None, **_others):
        super().__init__(condition=condition)
        self._components, self._container = composable_node_descriptions, target_container

    def _deed(self):
        container = self._container
        if isinstance(container, Action):
            container = {"action": objects.keep(container)}
        else:
            container = {"name": text(container)}
        components = [component._described() for component in self._components]
        return {"do": "load", "container": container, "components": components}


class PushRosNamespace(Action):
    def __init__(self, namespace, **others):
        super().__init__(**others)
        self._namespace = namespace

    def _deed(self):
        return {"do": "push_namespace", "namespace": text(self._namespace)}


PushROSNamespace = PushRosNamespace


class SetParameter(Action):
    def __init__(self, name, value, **others):
        super().__init__(**others)
        self._name, self._value = name, value

    def _deed(self):
        return {"do": "set_parameter", "name": text(self._name), "value": given(self._value)}


class SetUseSimTime(SetParameter):
    def __init__(self, value, **others):
        super().__init__("use_sim_time", value, **others)


class SetParametersFromFile(Action):
    def __init__(self, filename, node_name=None, **others):
        super().__init__(**others)
        self._file, self._node = filename, node_name

    def _deed(self):
        return {"do": "set_parameters_from_file", "file": text(self._file), "node": text(self._node)}


class SetRemap(Action):
    def __init__(self, src, dst, **others):
        super().__init__(**others)
        self._from, self._to = src, dst

    def _deed(self):
        return {"do": "set_remap", "from": text(self._from), "to": text(self._to)}


class RosTimer(Action):
    def __init__(self, *, period, actions, **others):
        super().__init__(condition=others.get("condition"))
        self._period, self._actions = period, actions

    def _deed(self):
        from launch.actions import TimerAction

        return TimerAction(period=self._period, actions=self._actions)._deed()


ROSTimer = RosTimer


class LifecycleTransition(Action):
    """Leads lifecycle nodes through transitions."""

    def __init__(self, *, lifecycle_node_names, transition_ids, **others):
        super().__init__(**others)
        self._names = lifecycle_node_names

    def _deed(self):
        return {"do": "left", "what": "a LifecycleTransition by names of nodes"}
