"""Tests of nodes."""

from __future__ import annotations

from typing import Any

from rosunit import unitrun

__all__ = ["rosrun", "run", "unitrun"]


def rosrun(package: str, test_name: str, test: Any, sysargs: list[str] | None = None) -> None:
    """Runs a test case whose node uses the graph, and shuts the node down."""
    import rospy

    try:
        unitrun(package, test_name, test, sysargs)
    finally:
        rospy.signal_shutdown("test complete")


run = rosrun
