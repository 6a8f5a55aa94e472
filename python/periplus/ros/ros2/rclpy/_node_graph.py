"""Queries of a node about the ROS graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import InvalidHandle, NodeNameNonExistentError, RCLError
from rclpy.expand_topic_name import expand_topic_name
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash

if TYPE_CHECKING:
    from rclpy._native import RosGraph, RosNode

NamesAndTypes = list[tuple[str, list[str]]]


class NodeGraph:
    """The part of a node that asks about other nodes, topics and services."""

    _rcl_graph: RosGraph
    _rcl_native: RosNode
    _rcl_destroyed: bool
    context: Any

    def _rcl_use_graph(self) -> RosGraph:
        if self._rcl_destroyed:
            raise InvalidHandle
        return self._rcl_graph

    # ---- topics and services

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """All topics with their types."""
        return list(self._rcl_use_graph().topics())

    def get_service_names_and_types(self) -> NamesAndTypes:
        """All services with their types."""
        return list(self._rcl_use_graph().services())

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Topics that a node publishes."""
        self._rcl_check_exists(node_name, node_namespace, "publisher")
        return list(self._rcl_graph.node_topics(node_name, node_namespace, True))

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Topics that a node subscribes to."""
        self._rcl_check_exists(node_name, node_namespace, "subscriber")
        return list(self._rcl_graph.node_topics(node_name, node_namespace, False))

    def get_service_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Services of a node."""
        self._rcl_check_exists(node_name, node_namespace, "service")
        return list(self._rcl_graph.node_services(node_name, node_namespace, True))

    def get_client_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Services that a node calls."""
        self._rcl_check_exists(node_name, node_namespace, "client")
        return list(self._rcl_graph.node_services(node_name, node_namespace, False))

    def _rcl_check_exists(self, name: str, namespace: str, what: str) -> None:
        if (name, namespace or "/") not in self._rcl_use_graph().nodes():
            raise NodeNameNonExistentError(
                f"cannot get {what} names and types for nonexistent node: {namespace.rstrip('/')}/{name}"
            )

    # ---- nodes

    def get_node_names(self) -> list[str]:
        """Names of all nodes, without namespaces."""
        return [name for name, _ in self._rcl_use_graph().nodes()]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Names and namespaces of all nodes."""
        return [(name, namespace) for name, namespace in self._rcl_use_graph().nodes()]

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Names, namespaces and enclaves of all nodes."""
        return [(name, namespace, "/") for name, namespace in self._rcl_use_graph().nodes()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Full names of all nodes."""
        return [f"{namespace.rstrip('/')}/{name}" for name, namespace in self._rcl_use_graph().nodes()]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Blocks until there is a node with a full name, at most `timeout` [s]. Returns False without one."""
        from rclpy.client import wait_until

        wanted = "/" + fully_qualified_node_name.lstrip("/")
        return wait_until(self.context, lambda: wanted in self.get_fully_qualified_node_names(), timeout)

    # ---- counts

    def _rcl_expanded(self, name: str) -> str:
        return expand_topic_name(name, self._rcl_native.name, self._rcl_native.namespace)

    def count_publishers(self, topic_name: str) -> int:
        """Number of publishers of a topic."""
        return len(self._rcl_use_graph().endpoints(self._rcl_expanded(topic_name), True))

    def count_subscribers(self, topic_name: str) -> int:
        """Number of subscriptions of a topic."""
        return len(self._rcl_use_graph().endpoints(self._rcl_expanded(topic_name), False))

    def _rcl_count_services(self, service_name: str, servers: bool) -> int:
        graph, wanted = self._rcl_use_graph(), self._rcl_expanded(service_name)
        found = 0
        for name, namespace in graph.nodes():
            found += sum(service == wanted for service, _ in graph.node_services(name, namespace, servers))
        return found

    def count_services(self, service_name: str) -> int:
        """Number of servers of a service."""
        return self._rcl_count_services(service_name, True)

    def count_clients(self, service_name: str) -> int:
        """Number of clients of a service."""
        return self._rcl_count_services(service_name, False)

    def get_publishers_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Publishers of a topic with their nodes, types and policies."""
        return self._rcl_endpoints(topic_name, TopicEndpointTypeEnum.PUBLISHER)

    def get_subscriptions_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Subscriptions of a topic with their nodes, types and policies."""
        return self._rcl_endpoints(topic_name, TopicEndpointTypeEnum.SUBSCRIPTION)

    def _rcl_endpoints(self, topic_name: str, kind: TopicEndpointTypeEnum) -> list[TopicEndpointInfo]:
        from rclpy.qos import QoSProfile

        found = []
        is_publisher = kind is TopicEndpointTypeEnum.PUBLISHER
        topic = self.resolve_topic_name(topic_name)
        for endpoint in self._rcl_use_graph().endpoints(topic, is_publisher):
            found.append(
                TopicEndpointInfo(
                    node_name=endpoint["node_name"],
                    node_namespace=endpoint["node_namespace"],
                    topic_type=endpoint["topic_type"],
                    topic_type_hash=TypeHash._from_text(endpoint["topic_type_hash"]),
                    endpoint_type=kind,
                    endpoint_gid=endpoint["endpoint_gid"],
                    qos_profile=QoSProfile._from_native(endpoint["qos"]),
                )
            )
        return found

    # ---- names

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Full name of a topic, remapped unless `only_expand`. Raises `RCLError` for an invalid name."""
        return self._rcl_resolve(topic, False, only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Full name of a service, remapped unless `only_expand`. Raises `RCLError` for an invalid name."""
        return self._rcl_resolve(service, True, only_expand)

    def _rcl_resolve(self, name: str, is_service: bool, only_expand: bool) -> str:
        from rclpy._names import expand, full_topic_problem, topic_problem
        from rclpy._native import RosNameError

        if self._rcl_destroyed:
            raise InvalidHandle
        problem = topic_problem(name)
        if problem is not None:
            raise RCLError(f"failed to resolve name: {problem[0]}")
        try:
            full = expand(name, self._rcl_native.name, self._rcl_native.namespace)
            problem = full_topic_problem(full)
            if problem is None:
                return self._rcl_native.resolve(name, service=is_service, remap=not only_expand)
        except (RosNameError, ValueError) as error:
            raise RCLError(f"failed to resolve name: {error}") from None
        raise RCLError(f"failed to resolve name: {problem[0]}")


