"""Exceptions of rospy."""

from __future__ import annotations

from genpy import SerializationError


class ROSException(Exception):
    """Base of the exceptions of rospy."""

    @property
    def message(self) -> str:
        """Text of the exception, as Python 2 had it."""
        return str(self)


class ROSSerializationException(ROSException, SerializationError):
    """A message cannot be serialized."""


class ROSInitException(ROSException):
    """A function needs `init_node()` first."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """A sleep or a wait was ended by the shutdown of the node."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """The clock went back during a sleep."""

    def __init__(self, time: object = None) -> None:
        self.time = time
        super().__init__("ROS time moved backwards")


class ROSInternalException(Exception):
    """Fault inside rospy."""


class TransportException(ROSInternalException):
    """Fault of a connection."""


class TransportTerminated(TransportException):
    """A connection was closed."""


class TransportInitError(TransportException):
    """A connection cannot be made."""


class ParameterInvalid(ROSException):
    """A parameter has a value that does not fit."""


class UnknownParameterException(ROSException, KeyError):
    """A parameter is not set."""


class ServiceException(ROSException):
    """A service cannot be called, or its server failed."""
