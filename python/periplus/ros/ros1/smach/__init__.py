"""Hierarchical state machines."""

from smach._concurrence import Concurrence
from smach._core import (
    CBState,
    Container,
    InvalidConstructionError,
    InvalidStateError,
    InvalidTransitionError,
    InvalidUserCodeError,
    Remapper,
    State,
    UserData,
    cb_interface,
    has_smach_interface,
)
from smach._log import (
    get_shutdown_check,
    is_shutdown,
    logdebug,
    logerr,
    loginfo,
    logwarn,
    set_loggers,
    set_shutdown_check,
)
from smach._machines import Iterator, Sequence, StateMachine

__all__ = [
    "CBState",
    "Concurrence",
    "Container",
    "InvalidConstructionError",
    "InvalidStateError",
    "InvalidTransitionError",
    "InvalidUserCodeError",
    "Iterator",
    "Remapper",
    "Sequence",
    "State",
    "StateMachine",
    "UserData",
    "cb_interface",
    "get_shutdown_check",
    "has_smach_interface",
    "is_shutdown",
    "logdebug",
    "logerr",
    "loginfo",
    "logwarn",
    "set_loggers",
    "set_shutdown_check",
]
