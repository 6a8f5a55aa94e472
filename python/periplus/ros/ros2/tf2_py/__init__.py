"""Transforms between frames over time, on the buffer of Periplus, with the exceptions of tf2."""

from tf2_py._core import BufferCore as BufferCore
from tf2_py._errors import (
    ConnectivityException as ConnectivityException,
    ExtrapolationException as ExtrapolationException,
    InvalidArgumentException as InvalidArgumentException,
    LookupException as LookupException,
    TimeoutException as TimeoutException,
    TransformException as TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]
