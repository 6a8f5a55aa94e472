"""Publishers and subscriptions of a topic, as the network reports them."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

from rclpy.qos import HistoryPolicy, QoSPresetProfiles, QoSProfile
from rclpy.type_hash import TypeHash


class TopicEndpointTypeEnum(IntEnum):
    """Kind of an endpoint."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


class TopicEndpointInfo:
    """One publisher or subscription of a topic."""

    __slots__ = [
        "node_name",
        "node_namespace",
        "topic_type",
        "topic_type_hash",
        "endpoint_type",
        "endpoint_gid",
        "qos_profile",
    ]

    def __init__(self, **kwargs: Any) -> None:
        assert all(name in self.__slots__ for name in kwargs), (
            "Invalid arguments passed to constructor: " + ", ".join(kwargs)
        )
        #: Name of the node.
        self.node_name: str = kwargs.get("node_name", "")
        #: Namespace of the node.
        self.node_namespace: str = kwargs.get("node_namespace", "")
        #: Type of the topic, such as `std_msgs/msg/String`.
        self.topic_type: str = kwargs.get("topic_type", "")
        type_hash = kwargs.get("topic_type_hash", TypeHash())
        #: Hash of the type.
        self.topic_type_hash: TypeHash = TypeHash(**type_hash) if isinstance(type_hash, dict) else type_hash
        #: Kind of the endpoint.
        self.endpoint_type = TopicEndpointTypeEnum(kwargs.get("endpoint_type", TopicEndpointTypeEnum.INVALID))
        #: Identifier of the endpoint: 16 numbers.
        self.endpoint_gid: list[int] = list(kwargs.get("endpoint_gid", []))
        qos = kwargs.get("qos_profile", QoSPresetProfiles.UNKNOWN.value)
        #: Policies of the endpoint.
        self.qos_profile: QoSProfile = QoSProfile(**qos) if isinstance(qos, dict) else qos

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TopicEndpointInfo):
            return False
        return all(getattr(self, name) == getattr(other, name) for name in self.__slots__)

    def __str__(self) -> str:
        qos = self.qos_profile
        history = qos.history.name
        if qos.history == HistoryPolicy.KEEP_LAST:
            history += f" ({qos.depth})"
        gid = ".".join(format(byte, "02x") for byte in self.endpoint_gid)
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                f"Topic type hash: {self.topic_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {gid}",
                "QoS profile:",
                f"  Reliability: {qos.reliability.name}",
                f"  History (Depth): {history}",
                f"  Durability: {qos.durability.name}",
                f"  Lifespan: {qos.lifespan}",
                f"  Deadline: {qos.deadline}",
                f"  Liveliness: {qos.liveliness.name}",
                f"  Liveliness lease duration: {qos.liveliness_lease_duration}",
            ]
        )


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
