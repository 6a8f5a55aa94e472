"""Actions of other nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rclpy.node import Node

NamesAndTypes = list[tuple[str, list[str]]]

_FEEDBACK = "/_action/feedback"
_SUFFIX = "_FeedbackMessage"


def _actions(topics: NamesAndTypes) -> NamesAndTypes:
    """The actions that feedback topics belong to."""
    return [
        (name[: -len(_FEEDBACK)], [one[: -len(_SUFFIX)] if one.endswith(_SUFFIX) else one for one in types])
        for name, types in topics
        if name.endswith(_FEEDBACK)
    ]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """All actions with their types."""
    return _actions(node.get_topic_names_and_types())


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Actions that a node offers."""
    return _actions(node.get_publisher_names_and_types_by_node(remote_node_name, remote_node_namespace))


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Actions that a node uses."""
    return _actions(node.get_subscriber_names_and_types_by_node(remote_node_name, remote_node_namespace))


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
