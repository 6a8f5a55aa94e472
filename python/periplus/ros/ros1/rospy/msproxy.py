"""Answers of a ROS master, from the graph."""

from __future__ import annotations

from typing import Any

from rospy import core
from rospy._params import service as parameters


class MasterProxy:
    """Object of `rospy.get_master()`."""

    target = "http://localhost:11311"

    def getSystemState(self) -> tuple[int, str, list[Any]]:  # noqa: N802
        """Publishers, subscribers and services by name."""
        graph = core.state.graph
        publishers, subscribers = [], []
        for name, _ in graph.topics():
            for found, is_publisher in ((publishers, True), (subscribers, False)):
                nodes = [_full_name(one) for one in graph.endpoints(name, is_publisher)]
                if nodes:
                    found.append([name, nodes])
        services = [[name, []] for name, _ in graph.services()]
        return 1, "current system state", [publishers, subscribers, services]

    def getPublishedTopics(self, subgraph: str = "") -> tuple[int, str, list[Any]]:  # noqa: N802
        from rospy.client import get_published_topics

        return 1, "current topics", get_published_topics(subgraph or "/")

    def getTopicTypes(self) -> tuple[int, str, list[Any]]:  # noqa: N802
        from periplus.ros._genpy_types import type_in_ros1

        return 1, "current system state", [[name, type_in_ros1(types[0])] for name, types in core.state.graph.topics()]

    def lookupNode(self, node_name: str) -> tuple[int, str, str]:  # noqa: N802
        nodes = [f"{namespace.rstrip('/')}/{name}" for name, namespace in core.state.graph.nodes()]
        if node_name in nodes:
            return 1, "node api", f"rosrpc:/{node_name}"
        return -1, f"unknown node [{node_name}]", ""

    def lookupService(self, service: str) -> tuple[int, str, str]:  # noqa: N802
        if any(name == service for name, _ in core.state.graph.services()):
            return 1, "rosrpc URI", f"rosrpc:/{service}"
        return -1, "no provider", ""

    def getParam(self, key: str) -> tuple[int, str, Any]:  # noqa: N802
        try:
            return 1, f"Parameter [{key}]", parameters.get(key)
        except KeyError:
            return -1, f"Parameter [{key}] is not set", 0

    def setParam(self, key: str, value: Any) -> tuple[int, str, int]:  # noqa: N802
        parameters.set(key, value)
        return 1, f"parameter {key} set", 0

    def hasParam(self, key: str) -> tuple[int, str, bool]:  # noqa: N802
        return 1, key, parameters.has(key)

    def getParamNames(self) -> tuple[int, str, list[str]]:  # noqa: N802
        return 1, "Parameter names", parameters.names()

    def getPid(self) -> tuple[int, str, int]:  # noqa: N802
        import os

        return 1, "", os.getpid()

    def getUri(self) -> tuple[int, str, str]:  # noqa: N802
        return 1, "", self.target

    def __contains__(self, key: str) -> bool:
        return parameters.has(key)

    def __getitem__(self, key: str) -> Any:
        return parameters.get(key)

    def __setitem__(self, key: str, value: Any) -> None:
        parameters.set(key, value)


def _full_name(endpoint: dict[str, Any]) -> str:
    return f"{endpoint['node_namespace'].rstrip('/')}/{endpoint['node_name']}"
