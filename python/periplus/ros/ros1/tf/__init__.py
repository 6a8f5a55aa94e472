"""Transforms of ROS 1 programs (tf, the first generation), over the buffer of tf2."""

from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
)
from tf2_py import TransformException as Exception  # noqa: A004

from tf import broadcaster, listener, transformations
from tf.broadcaster import TransformBroadcaster
from tf.listener import Transformer, TransformerROS, TransformListener

TransformException = Exception

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "broadcaster",
    "listener",
    "transformations",
]
