"""The service ~/get_type_description."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from rclpy.node import Node

START_TYPE_DESCRIPTION_SERVICE_PARAM = "start_type_description_service"
TOPIC_SEPARATOR_STRING = "/"


class TypeDescriptionService:
    """Service of a node that describes message types; a parameter of the node switches it off."""

    def __init__(self, node: Node) -> None:
        self._service: Any = None
        self._node = node
        if not node.has_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM):
            from rcl_interfaces.msg import ParameterDescriptor

            descriptor = ParameterDescriptor(
                description="If enabled, start the ~/get_type_description service.", read_only=True
            )
            node.declare_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM, True, descriptor)
        if node.get_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM).value:
            from type_description_interfaces.srv import GetTypeDescription

            self._service = node.create_service(
                GetTypeDescription,
                node.get_name() + TOPIC_SEPARATOR_STRING + "get_type_description",
                self._answer,
                qos_profile=qos_profile_services_default,
            )

    def _answer(self, request: Any, response: Any) -> Any:
        response.successful = False
        response.failure_reason = f"The description of {request.type_name} is not available from this node"
        return response

    def destroy(self) -> None:
        """Ends the service."""
        if self._service is not None:
            self._node.destroy_service(self._service)
            self._service = None


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
