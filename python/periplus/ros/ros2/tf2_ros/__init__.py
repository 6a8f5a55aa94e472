"""Listening to, looking up and broadcasting transforms."""

from __future__ import annotations

from typing import Any

from tf2_py import *  # noqa: F403
from tf2_ros.buffer import Buffer as Buffer
from tf2_ros.buffer_interface import (
    BufferInterface as BufferInterface,
    ConvertRegistration as ConvertRegistration,
    NotImplementedException as NotImplementedException,
    Stamped as Stamped,
    TransformRegistration as TransformRegistration,
    TypeException as TypeException,
    convert as convert,
)
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster as StaticTransformBroadcaster
from tf2_ros.transform_broadcaster import TransformBroadcaster as TransformBroadcaster
from tf2_ros.transform_listener import TransformListener as TransformListener


def __getattr__(name: str) -> Any:
    # These import actions, which few programs need.
    if name == "BufferClient":
        from tf2_ros.buffer_client import BufferClient

        return BufferClient
    if name == "BufferServer":
        from tf2_ros.buffer_server import BufferServer

        return BufferServer
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
