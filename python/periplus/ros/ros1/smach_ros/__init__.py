"""States of SMACH that use actions and services."""

from smach_ros._states import (
    ConditionState,
    IntrospectionServer,
    MonitorState,
    ServiceState,
    SimpleActionState,
    set_preempt_handler,
)

__all__ = [
    "ConditionState",
    "IntrospectionServer",
    "MonitorState",
    "ServiceState",
    "SimpleActionState",
    "set_preempt_handler",
]
