"""The native graph, at one place."""

from __future__ import annotations

import os
from typing import Any


def open_graph(arguments: list[str]) -> Any:
    """Joins the network, or the simulation that started this process."""
    from periplus.ros import _waiting

    if os.environ.get("PERIPLUS_FAKE_ROS") == "1":
        from fake_ros import RosGraph
    else:
        from periplus._native import RosGraph
    return RosGraph(arguments, link=_waiting.link())
