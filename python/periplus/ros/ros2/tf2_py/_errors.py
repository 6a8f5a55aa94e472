"""Exceptions of tf2."""

from __future__ import annotations

from periplus import _native


class TransformException(Exception):
    """Base of the exceptions of tf2."""


class ConnectivityException(TransformException):
    """Frames that are in different trees."""


class LookupException(TransformException):
    """Frame that does not exist."""


class ExtrapolationException(TransformException):
    """Time outside of the times that the buffer has."""


class InvalidArgumentException(TransformException):
    """Frame name or quaternion that is not valid."""


class TimeoutException(TransformException):
    """Time limit that has passed."""


_EXCEPTIONS: dict[type, type[TransformException]] = {
    _native.TransformLookupError: LookupException,
    _native.TransformConnectivityError: ConnectivityException,
    _native.TransformExtrapolationError: ExtrapolationException,
    _native.TransformArgumentError: InvalidArgumentException,
}


def exception_of(error: Exception) -> TransformException:
    """Exception of tf2 for one of the native buffer."""
    return _EXCEPTIONS.get(type(error), TransformException)(*error.args)
