"""Parameters that other nodes change while a node runs."""

from __future__ import annotations

from typing import Any

import rospy


class DynamicReconfigureParameterException(Exception):
    """A parameter that cannot be set."""


class DynamicReconfigureCallbackException(Exception):
    """A callback has failed."""


def find_reconfigure_services() -> list[str]:
    """Names of the nodes that can be reconfigured."""
    ending = "/set_parameters"
    graph = rospy.core.state.graph
    return sorted(
        name[: -len(ending)]
        for name, types in graph.services()
        if name.endswith(ending) and "dynamic_reconfigure/srv/Reconfigure" in types
    )


def get_parameter_names(descr: Any) -> list[str]:
    """Names of the parameters of a description."""
    return list(descr.defaults)


__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureParameterException",
    "find_reconfigure_services",
    "get_parameter_names",
]
