"""Services by name."""

from __future__ import annotations

from typing import Any

import genpy
import rospy
from rospy import core


class ROSServiceException(Exception):
    """A service that cannot be asked for."""


def get_service_list(node: str | None = None, namespace: str | None = None, include_nodes: bool = False) -> list[str]:
    """Names of the services, of one node if given."""
    core.require_init()
    graph = core.state.graph
    if node is None:
        found = [name for name, _ in graph.services()]
    else:
        space, _, name = node.rpartition("/")
        found = [one for one, _ in graph.node_services(name, space or "/", True)]
    prefix = (namespace or "/").rstrip("/") + "/"
    return sorted(one for one in found if one.startswith(prefix))


def get_service_type(service_name: str) -> str | None:
    """Type of a service, or None."""
    core.require_init()
    name = rospy.resolve_name(service_name)
    for one, types in core.state.graph.services():
        if one == name and types:
            package, _, short = types[0].split("/")
            return f"{package}/{short}"
    return None


def get_service_class_by_name(service_name: str) -> Any:
    """Class of a service. Raises `ROSServiceException` without it."""
    type_name = get_service_type(service_name)
    if type_name is None:
        raise ROSServiceException(f"Service [{service_name}] is not available.")
    found = genpy.get_service_class(type_name)
    if found is None:
        raise ROSServiceException(f"Unable to load type [{type_name}].")
    return found


def call_service(service_name: str, service_args: Any, service_class: Any = None) -> tuple[Any, Any]:
    """Calls a service with a list of the fields of its request; returns request and response."""
    cls = service_class or get_service_class_by_name(service_name)
    request = cls._request_class()
    genpy.fill_message_args(request, service_args)
    return request, rospy.ServiceProxy(service_name, cls)(request)
