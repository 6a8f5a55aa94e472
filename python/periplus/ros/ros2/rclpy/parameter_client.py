"""Parameters of another node."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from rclpy.client import wait_until
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from rclpy.qos import QoSProfile, qos_profile_parameter_events, qos_profile_services_default
from rclpy.task import Future

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.client import Client
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.subscription import Subscription


class AsyncParameterClient:
    """Calls the parameter services of another node. Each method returns a future of the response."""

    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        from rcl_interfaces import srv

        self.remote_node_name = remote_node_name
        self.node = node

        def client(service_type: Any, name: str) -> Client:
            return node.create_client(
                service_type, f"{remote_node_name}/{name}", qos_profile=qos_profile, callback_group=callback_group
            )

        self._get_parameter_client = client(srv.GetParameters, "get_parameters")
        self._list_parameter_client = client(srv.ListParameters, "list_parameters")
        self._set_parameter_client = client(srv.SetParameters, "set_parameters")
        self._get_parameter_types_client = client(srv.GetParameterTypes, "get_parameter_types")
        self._describe_parameters_client = client(srv.DescribeParameters, "describe_parameters")
        self._set_parameters_atomically_client = client(srv.SetParametersAtomically, "set_parameters_atomically")

    def _clients(self) -> list[Client]:
        return [
            self._list_parameter_client,
            self._get_parameter_client,
            self._set_parameter_client,
            self._describe_parameters_client,
            self._get_parameter_types_client,
            self._set_parameters_atomically_client,
        ]

    def services_are_ready(self) -> bool:
        """True if the other node offers all of the services."""
        return all(client.service_is_ready() for client in self._clients())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Blocks until the services are there, at most `timeout_sec` (default: no limit). Returns False without them."""
        return wait_until(self.node.context, self.services_are_ready, timeout_sec)

    @staticmethod
    def _call(client: Client, request: Any, callback: Callable[[Future], Any] | None) -> Future:
        future = client.call_async(request)
        if callback is not None:
            future.add_done_callback(callback)
        return future

    def list_parameters(
        self,
        prefixes: list[str] | None = None,
        depth: int | None = None,
        callback: Callable[[Future], Any] | None = None,
    ) -> Future:
        """Names of parameters."""
        client = self._list_parameter_client
        request = client.srv_type.Request()
        if prefixes:
            request.prefixes = prefixes
        if depth:
            request.depth = depth
        return self._call(client, request, callback)

    def get_parameters(self, names: list[str], callback: Callable[[Future], Any] | None = None) -> Future:
        """Values of parameters."""
        client = self._get_parameter_client
        return self._call(client, client.srv_type.Request(names=names), callback)

    def set_parameters(
        self, parameters: Sequence[Any], callback: Callable[[Future], Any] | None = None
    ) -> Future:
        """Sets parameters one after another."""
        client = self._set_parameter_client
        return self._call(client, client.srv_type.Request(parameters=_messages(parameters)), callback)

    def describe_parameters(self, names: list[str], callback: Callable[[Future], Any] | None = None) -> Future:
        """Descriptors of parameters."""
        client = self._describe_parameters_client
        return self._call(client, client.srv_type.Request(names=names), callback)

    def get_parameter_types(self, names: list[str], callback: Callable[[Future], Any] | None = None) -> Future:
        """Types of parameters."""
        client = self._get_parameter_types_client
        return self._call(client, client.srv_type.Request(names=names), callback)

    def set_parameters_atomically(
        self, parameters: Sequence[Any], callback: Callable[[Future], Any] | None = None
    ) -> Future:
        """Sets all parameters or none."""
        client = self._set_parameters_atomically_client
        return self._call(client, client.srv_type.Request(parameters=_messages(parameters)), callback)

    def delete_parameters(self, names: list[str], callback: Callable[[Future], Any] | None = None) -> Future:
        """Removes parameters whose type may change."""
        return self.set_parameters([Parameter(name) for name in names], callback)

    def load_parameter_file(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Callable[[Future], Any] | None = None,
    ) -> Future:
        """Sets the parameters of a file."""
        return self.set_parameters(self._of_file(parameter_file, use_wildcard), callback)

    def load_parameter_file_atomically(
        self,
        parameter_file: str,
        use_wildcard: bool = False,
        callback: Callable[[Future], Any] | None = None,
    ) -> Future:
        """Sets all parameters of a file or none."""
        return self.set_parameters_atomically(self._of_file(parameter_file, use_wildcard), callback)

    def _of_file(self, parameter_file: str, use_wildcard: bool) -> list[Any]:
        name = self.remote_node_name
        nodes = [name.lstrip("/"), name]
        return list(parameter_dict_from_yaml_file(parameter_file, use_wildcard, target_nodes=nodes).values())

    def on_parameter_event(
        self,
        callback: Callable[[Any], Any],
        qos_profile: QoSProfile = qos_profile_parameter_events,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Subscribes to the changes of all parameters."""
        from rcl_interfaces.msg import ParameterEvent

        return self.node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )


def _messages(parameters: Sequence[Any]) -> list[Any]:
    return [one.to_parameter_msg() if isinstance(one, Parameter) else one for one in parameters]


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
