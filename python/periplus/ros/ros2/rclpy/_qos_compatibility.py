"""Compatibility of two QoS profiles, with the texts of the original."""

from __future__ import annotations

from rclpy._rclpy_pybind11 import QoSCompatibility
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

_LEFT_OPEN = ("SYSTEM_DEFAULT", "UNKNOWN")


def check(publisher: QoSProfile, subscription: QoSProfile) -> tuple[QoSCompatibility, str]:
    """Outcome of a connection, and the reasons."""
    errors = _errors(publisher, subscription)
    if errors:
        return QoSCompatibility.ERROR, "".join(f"ERROR: {text};" for text in errors)
    warnings = _warnings(publisher, subscription)
    if warnings:
        return QoSCompatibility.WARNING, "".join(f"WARNING: {text};" for text in warnings)
    return QoSCompatibility.OK, ""


def _errors(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    found = []
    if (
        publisher.reliability == ReliabilityPolicy.BEST_EFFORT
        and subscription.reliability == ReliabilityPolicy.RELIABLE
    ):
        found.append("Best effort publisher and reliable subscription")
    if (
        publisher.durability == DurabilityPolicy.VOLATILE
        and subscription.durability == DurabilityPolicy.TRANSIENT_LOCAL
    ):
        found.append("Volatile publisher and transient local subscription")
    offered, asked = publisher.deadline.nanoseconds, subscription.deadline.nanoseconds
    if asked and not offered:
        found.append("Subscription has a deadline, but publisher does not")
    elif asked and asked < offered:
        found.append("Subscription deadline is less than publisher deadline")
    if (
        publisher.liveliness == LivelinessPolicy.AUTOMATIC
        and subscription.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
    ):
        found.append("Publisher's liveliness is automatic and subscription's is manual by topic")
    offered = publisher.liveliness_lease_duration.nanoseconds
    asked = subscription.liveliness_lease_duration.nanoseconds
    if asked and not offered:
        found.append("Subscription has a liveliness lease duration, but publisher does not")
    elif asked and asked < offered:
        found.append("Subscription liveliness lease duration is less than publisher")
    return found


def _warnings(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    found = []
    offered, asked = publisher.reliability.name, subscription.reliability.name
    if offered in _LEFT_OPEN and asked in _LEFT_OPEN:
        found.append(f"Publisher reliability is {offered.lower()} and subscription reliability is {asked.lower()}")
    elif offered in _LEFT_OPEN and asked == "RELIABLE":
        found.append(f"Reliable subscription, but publisher is {offered.lower()}")
    elif asked in _LEFT_OPEN and offered == "BEST_EFFORT":
        found.append(f"Best effort publisher, but subscription is {asked.lower()}")
    offered, asked = publisher.durability.name, subscription.durability.name
    if offered in _LEFT_OPEN and asked in _LEFT_OPEN:
        found.append(f"Publisher durabilty is {offered.lower()} and subscription durability is {asked.lower()}")
    elif offered in _LEFT_OPEN and asked == "TRANSIENT_LOCAL":
        found.append(f"Transient local subscription, but publisher is {offered.lower()}")
    elif asked in _LEFT_OPEN and offered == "VOLATILE":
        found.append(f"Volatile publisher, but subscription is {asked.lower()}")
    offered, asked = publisher.liveliness.name, subscription.liveliness.name
    if offered in _LEFT_OPEN and asked in _LEFT_OPEN:
        found.append(f"Publisher liveliness is {offered.lower()} and subscription liveliness is {asked.lower()}")
    elif offered in _LEFT_OPEN and asked == "MANUAL_BY_TOPIC":
        found.append(f"Subscription's liveliness is manual by topic, but publisher's is {offered.lower()}")
    elif asked in _LEFT_OPEN and offered == "AUTOMATIC":
        found.append(f"Publisher's liveliness is automatic, but subscription's is {asked.lower()}")
    return found
