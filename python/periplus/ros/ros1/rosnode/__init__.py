"""Nodes by name."""

from __future__ import annotations

from rospy import core


class ROSNodeException(Exception):
    """A node that cannot be asked for."""


def get_node_names(namespace: str | None = None) -> list[str]:
    """Full names of the nodes."""
    core.require_init()
    prefix = (namespace or "/").rstrip("/") + "/"
    names = {f"{space.rstrip('/')}/{name}" for name, space in core.state.graph.nodes()}
    return sorted(one for one in names if one.startswith(prefix))


def rosnode_ping(node_name: str, max_count: int | None = None, verbose: bool = False, skip_cache: bool = False) -> bool:
    """True if the graph has the node."""
    return node_name in get_node_names()


def rosnode_ping_all(verbose: bool = False) -> tuple[list[str], list[str]]:
    """Nodes that are there, and none that are not."""
    return get_node_names(), []
