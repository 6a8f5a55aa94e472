"""The services of a node's parameters."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameters

if TYPE_CHECKING:
    from rclpy.node import Node

TOPIC_SEPARATOR_STRING = "/"


class ParameterService:
    """Six services of a node: describe, get, get types, list, set, set atomically."""

    def __init__(self, node: Node) -> None:
        from rcl_interfaces import srv

        self._node_ref = weakref.ref(node)
        for service_type, name, callback in (
            (srv.DescribeParameters, "describe_parameters", self._describe),
            (srv.GetParameters, "get_parameters", self._get),
            (srv.GetParameterTypes, "get_parameter_types", self._get_types),
            (srv.ListParameters, "list_parameters", self._list),
            (srv.SetParameters, "set_parameters", self._set),
            (srv.SetParametersAtomically, "set_parameters_atomically", self._set_atomically),
        ):
            full = node.get_name() + TOPIC_SEPARATOR_STRING + name
            node.create_service(service_type, full, callback, qos_profile=qos_profile_parameters)

    def _node(self) -> Node:
        node = self._node_ref()
        if node is None:
            raise ReferenceError("the node of the parameter services is gone")
        return node

    def _describe(self, request: Any, response: Any) -> Any:
        try:
            response.descriptors = self._node().describe_parameters(list(request.names))
        except ParameterNotDeclaredException:
            response.descriptors = []
        return response

    def _get(self, request: Any, response: Any) -> Any:
        node = self._node()
        try:
            response.values = [node.get_parameter(name).get_parameter_value() for name in request.names]
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            response.values = []
        return response

    def _get_types(self, request: Any, response: Any) -> Any:
        try:
            types = self._node().get_parameter_types(list(request.names))
            response.types = [getattr(one, "value", one) for one in types]
        except ParameterNotDeclaredException:
            response.types = []
        return response

    def _list(self, request: Any, response: Any) -> Any:
        response.result = self._node().list_parameters(list(request.prefixes), int(request.depth))
        return response

    def _set(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import SetParametersResult

        node = self._node()
        results = []
        for message in request.parameters:
            try:
                results += node.set_parameters([Parameter.from_parameter_msg(message)])
            except ParameterNotDeclaredException as error:
                results.append(SetParametersResult(successful=False, reason=str(error)))
        response.results = results
        return response

    def _set_atomically(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import SetParametersResult

        parameters = [Parameter.from_parameter_msg(message) for message in request.parameters]
        try:
            response.result = self._node().set_parameters_atomically(parameters)
        except ParameterNotDeclaredException as error:
            response.result = SetParametersResult(successful=False, reason=str(error))
        return response
