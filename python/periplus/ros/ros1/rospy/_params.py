"""The parameter tree of ROS 1 without a master: every node keeps it, changes go to all.

Values are the leaves of one tree of dicts. A change has a number, so that of two changes of one key all nodes keep the
later one. The values that a launch file sets come in a JSON file that the environment variable
PERIPLUS_ROS1_PARAMETERS names, or as JSON in PERIPLUS_ROS1_PARAMS: values by full name, or trees of them.
"""

from __future__ import annotations

import copy
import json
import os
import sys
from collections.abc import Callable
from typing import Any

from periplus.ros import _waiting

from rospy import core
from rospy._dispatch import Source
from rospy._reader import Reader, qos

FILE_VARIABLE = "PERIPLUS_ROS1_PARAMETERS"
TEXT_VARIABLE = "PERIPLUS_ROS1_PARAMS"
_TOPIC = "/_rosparam"
_TYPE = "std_msgs/msg/String"
#: Time after the start in which a missing value may still arrive from another node [ns].
_DISCOVERY_NS = 400_000_000


class ParameterTree:
    """Values by full name, with the number and the author of each change."""

    def __init__(self) -> None:
        #: Leaves: name -> (number, author, value). Deleted ones have the value None.
        self.leaves: dict[str, tuple[int, str, Any]] = {}
        self.number = 0

    def load_environment(self) -> None:
        """Takes the values of the launch file."""
        for variable in (TEXT_VARIABLE, FILE_VARIABLE):
            text = os.environ.get(variable)
            if not text:
                continue
            try:
                if variable == FILE_VARIABLE:
                    with open(text, encoding="utf-8") as file:
                        text = file.read()
                values = json.loads(text)
            except (OSError, ValueError) as error:
                sys.stderr.write(f"{variable} cannot be read ({error}); its parameters are missing\n")
                continue
            for name, value in _flat("", values):
                self.leaves.setdefault(name, (0, "", value))

    def set(self, name: str, value: Any, author: str) -> None:
        """Sets a value; a dict replaces the subtree."""
        self.number += 1
        self.delete(name, author, is_set=True)
        for key, one in _flat("" if name == "/" else name, value):
            # A value in place of a parent ends it.
            parent = key
            while (parent := parent.rpartition("/")[0]) != "":
                if parent in self.leaves and self.leaves[parent][2] is not None:
                    self.leaves[parent] = (self.number, author, None)
            self.leaves[key] = (self.number, author, one)

    def delete(self, name: str, author: str, *, is_set: bool = False) -> bool:
        """Deletes a value or a subtree; False if there is none."""
        if not is_set:
            self.number += 1
        found = False
        for key in self._below(name):
            self.leaves[key] = (self.number, author, None)
            found = True
        return found

    def _below(self, name: str) -> list[str]:
        prefix = name.rstrip("/") + "/"
        return [
            key for key, one in self.leaves.items() if one[2] is not None and (key == name or key.startswith(prefix))
        ]

    def get(self, name: str) -> Any:
        """Value or subtree. Raises `KeyError` without one."""
        leaf = self.leaves.get(name)
        if leaf is not None and leaf[2] is not None:
            return copy.deepcopy(leaf[2][0])
        prefix = name.rstrip("/") + "/"
        tree: dict[str, Any] = {}
        for key in self._below(name):
            parts = key[len(prefix) :].split("/")
            at = tree
            for part in parts[:-1]:
                at = at.setdefault(part, {})
            leaf = self.leaves[key]
            if parts[-1]:
                at[parts[-1]] = copy.deepcopy(leaf[2][0])
        if tree or name == "/":
            return tree
        raise KeyError(name)

    def names(self) -> list[str]:
        """Names of all values."""
        return sorted(key.removesuffix("/") for key, one in self.leaves.items() if one[2] is not None)

    def merge(self, leaves: dict[str, Any]) -> bool:
        """Takes changes of another node; True if any is later than the own ones."""
        changed = False
        for key, (number, author, value) in leaves.items():
            own = self.leaves.get(key)
            if own is None or (number, author) > own[:2]:
                self.leaves[key] = (number, author, value)
                changed = True
            self.number = max(self.number, number)
        return changed


def _flat(name: str, value: Any) -> list[tuple[str, list[Any]]]:
    """Leaves of a value. An empty dict is a leaf with a name that ends with a slash. Values are in lists of one."""
    if isinstance(value, dict):
        if not value:
            return [(name + "/", [{}])]
        found = []
        for key, one in value.items():
            full = f"{name}/{str(key).strip('/')}"
            found += _flat(full, one)
        return found
    return [(name, [value])]


class ParameterService(Source):
    """The tree of this node and its connection to those of the others."""

    def __init__(self) -> None:
        super().__init__()
        self.tree = ParameterTree()
        self._reader: Reader | None = None
        self._publisher: Any = None
        self._began_ns = 0
        self._publishers = 0
        self._message: Any = None

    def start(self) -> None:
        """Connects to the other nodes."""
        from std_msgs.msg import String

        self._message = String
        node = core.state.node
        self._began_ns = core.state.graph.steady_ns()
        self._publisher = node.publisher(_TOPIC, _TYPE, qos(1, durability="transient_local"))
        self._reader = Reader(_TOPIC, _TYPE, 100)
        if any(one[0] > 0 for one in self.tree.leaves.values()):
            self._publish()
        assert core.state.dispatcher is not None
        core.state.dispatcher.add(self)

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        self.receive()
        assert self._reader is not None
        self.wake_ns = self._reader.wake_ns
        return []

    def receive(self) -> None:
        """Takes the changes that have arrived."""
        if self._reader is None or core.state.is_shutdown:
            return
        with core.state.lock:
            for message, _ in self._reader.poll():
                try:
                    self.tree.merge(json.loads(message._data))
                except (ValueError, TypeError):
                    continue
            count = self._reader.publisher_count
            if count < self._publishers and any(one[0] > 0 for one in self.tree.leaves.values()):
                # A node has gone; what it set must reach those that come later.
                self._publish()
            self._publishers = count

    def _publish(self) -> None:
        changed = {key: one for key, one in self.tree.leaves.items() if one[0] > 0}
        self._publisher.publish(self._message(json.dumps(changed)))

    def set(self, name: str, value: Any) -> None:
        """Sets a value in all nodes."""
        self.receive()
        with core.state.lock:
            self.tree.set(name, _plain(value), core.get_name())
            if self._publisher is not None and not core.state.is_shutdown:
                self._publish()

    def delete(self, name: str) -> None:
        """Deletes a value in all nodes. Raises `KeyError` without one."""
        self._discover(lambda: self.has_now(name))
        with core.state.lock:
            if not self.tree.delete(name, core.get_name()):
                raise KeyError(name)
            if self._publisher is not None and not core.state.is_shutdown:
                self._publish()

    def has_now(self, name: str) -> bool:
        """True if the value is known at this moment."""
        self.receive()
        try:
            with core.state.lock:
                self.tree.get(name)
        except KeyError:
            return False
        return True

    def has(self, name: str) -> bool:
        """True if there is a value or a subtree."""
        _waiting.poll()
        return self._discover(lambda: self.has_now(name))

    def get(self, name: str) -> Any:
        """Value or subtree. Raises `KeyError` without one."""
        self.has(name)
        with core.state.lock:
            return self.tree.get(name)

    def names(self) -> list[str]:
        """Names of all values."""
        self._discover(lambda: False)
        with core.state.lock:
            return self.tree.names()

    def _discover(self, done: Callable[[], bool]) -> bool:
        """Waits for other nodes right after the start; later, and alone, answers at once."""
        if done():
            return True
        graph = core.state.graph
        if graph is None or self._reader is None or core.state.is_shutdown or graph.is_lockstep:
            return done()
        left = self._began_ns + _DISCOVERY_NS - _waiting.steady_ns(graph)
        if left <= 0:
            return done()
        return core.wait_events(done, left)


def _plain(value: Any) -> Any:
    """Value as JSON has it. Raises `TypeError` for one that a parameter cannot have."""
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise TypeError(f"a parameter cannot be a {type(value).__name__}: {value!r}")


service = ParameterService()
