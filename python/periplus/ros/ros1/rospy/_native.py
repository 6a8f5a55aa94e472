"""The native graph, at one place."""

from __future__ import annotations

from typing import Any


def open_graph(arguments: list[str]) -> Any:
    """Joins the network, or the simulation that started this process."""
    from periplus._native import RosGraph
    from periplus.ros import _waiting

    return RosGraph(arguments, link=_waiting.link())
