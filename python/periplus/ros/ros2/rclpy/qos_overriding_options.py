"""QoS policies that parameters may replace."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPolicyKind,
    QoSProfile,
    QoSReliabilityPolicy,
)
from rclpy.subscription import Subscription

if TYPE_CHECKING:
    from rclpy.node import Node

_ENUMS: dict[QoSPolicyKind, Any] = {
    QoSPolicyKind.DURABILITY: QoSDurabilityPolicy,
    QoSPolicyKind.HISTORY: QoSHistoryPolicy,
    QoSPolicyKind.LIVELINESS: QoSLivelinessPolicy,
    QoSPolicyKind.RELIABILITY: QoSReliabilityPolicy,
}
_DURATIONS = (QoSPolicyKind.DEADLINE, QoSPolicyKind.LIFESPAN, QoSPolicyKind.LIVELINESS_LEASE_DURATION)


class InvalidQosOverridesError(Exception):
    """Parameters that make an invalid profile."""


class QoSOverridingOptions:
    """Policies of a publisher or subscription that parameters may replace.

    The parameters are called `qos_overrides.<topic>.<publisher|subscription>[_<entity_id>].<policy>`.
    """

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: Callable[[QoSProfile], Any] | None = None,
        entity_id: str | None = None,
    ) -> None:
        self._policy_kinds = policy_kinds
        self._callback = callback
        self._entity_id = entity_id

    @property
    def policy_kinds(self) -> Iterable[QoSPolicyKind]:
        """Policies that may be replaced."""
        return self._policy_kinds

    @property
    def callback(self) -> Callable[[QoSProfile], Any] | None:
        """Function that accepts the profile, or None."""
        return self._callback

    @property
    def entity_id(self) -> str | None:
        """Suffix that distinguishes several publishers or subscriptions of a topic."""
        return self._entity_id

    @classmethod
    def with_default_policies(
        cls, *, callback: Callable[[QoSProfile], Any] | None = None, entity_id: str | None = None
    ) -> QoSOverridingOptions:
        """Options for history, depth and reliability."""
        kinds = [QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY]
        return cls(kinds, callback=callback, entity_id=entity_id)


def copy_profile(qos: QoSProfile) -> QoSProfile:
    """Copy of a profile."""
    made = QoSProfile.__new__(QoSProfile)
    for name in QoSProfile.__slots__:
        setattr(made, name, getattr(qos, name))
    return made


def _get_allowed_policies(entity_type: Any) -> list[QoSPolicyKind]:
    allowed = list(QoSPolicyKind)
    allowed.remove(QoSPolicyKind.INVALID)
    if issubclass(entity_type, Subscription):
        allowed.remove(QoSPolicyKind.LIFESPAN)
    return allowed


def _declare_qos_parameters(
    entity_type: Any, node: Node | Any, topic_name: str, qos: QoSProfile, options: QoSOverridingOptions
) -> None:
    """Declares the parameters of an entity and puts their values into the profile."""
    kind = "publisher" if issubclass(entity_type, Publisher) else "subscription"
    suffix = f"_{options.entity_id}" if options.entity_id else ""
    name = f"qos_overrides.{topic_name}.{kind}{suffix}"
    from rcl_interfaces.msg import ParameterDescriptor

    allowed = _get_allowed_policies(entity_type)
    for policy in options.policy_kinds:
        if policy not in allowed:
            continue
        full = f"{name}.{policy.name.lower()}"
        descriptor = ParameterDescriptor(
            description=f"QoS policy {policy.name.lower()} of the {kind} of {topic_name}", read_only=True
        )
        try:
            parameter = node.declare_parameter(full, _get_qos_policy_parameter(qos, policy), descriptor)
        except ParameterAlreadyDeclaredException:
            parameter = node.get_parameter(full)
        _override_qos_policy_with_param(qos, policy, parameter)
    if options.callback is not None:
        result = options.callback(qos)
        if not result.successful:
            raise InvalidQosOverridesError(f"{topic_name}: {result.reason}")


def _get_qos_policy_parameter(qos: QoSProfile, policy: QoSPolicyKind) -> str | int | bool:
    value = getattr(qos, policy.name.lower())
    if policy in _ENUMS:
        name: str = value.short_key
        if name == "unknown":
            raise ValueError(f"the policy {policy.name} of the profile is unknown")
        return name
    if policy in _DURATIONS:
        nanoseconds: int = value.nanoseconds
        return nanoseconds
    plain: int | bool = value
    return plain


def _override_qos_policy_with_param(qos: QoSProfile, policy: QoSPolicyKind, param: Parameter) -> None:
    value = param.value
    if policy in _ENUMS:
        try:
            value = _ENUMS[policy].get_from_short_key(value)
        except KeyError:
            keys = ", ".join(_ENUMS[policy].short_keys())
            raise InvalidQosOverridesError(f"the value of {param.name} is {value!r}; it must be one of: {keys}") from None
    elif policy in _DURATIONS:
        value = Duration(nanoseconds=value)
    setattr(qos, policy.name.lower(), value)


def __getattr__(name: str) -> Any:
    if name == "QosCallbackResult":
        from rcl_interfaces.msg import SetParametersResult

        return SetParametersResult
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
