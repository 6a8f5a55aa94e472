"""Answers of a master, from the graph."""

from __future__ import annotations

from typing import Any

from rospy._params import service as parameters
from rospy.client import myargv
from rospy.core import require_init
from rospy.msproxy import MasterProxy

__all__ = ["Master", "MasterError", "MasterException", "is_online", "myargv"]


class MasterException(Exception):
    """The graph cannot be asked."""


class MasterError(MasterException):
    """The graph does not have what was asked for."""


class MasterFailure(MasterException):
    """The graph has failed."""


class Master:
    """The functions of a master, with the values of their answers alone."""

    def __init__(self, caller_id: str = "", master_uri: str | None = None) -> None:
        self.caller_id = caller_id
        self.master_uri = master_uri or "http://localhost:11311"
        self._proxy = MasterProxy()

    def is_online(self) -> bool:
        return True

    def getParam(self, key: str) -> Any:  # noqa: N802
        try:
            return parameters.get(key)
        except KeyError:
            raise MasterError(f"Parameter [{key}] is not set") from None

    def hasParam(self, key: str) -> bool:  # noqa: N802
        return parameters.has(key)

    def setParam(self, key: str, value: Any) -> None:  # noqa: N802
        parameters.set(key, value)

    def __getattr__(self, name: str) -> Any:
        function = getattr(self._proxy, name)

        def call(*args: Any) -> Any:
            require_init()
            code, text, value = function(*args)
            if code != 1:
                raise MasterError(text)
            return value

        return call


def is_online(master_uri: str | None = None) -> bool:
    """True: the graph needs no master."""
    return True
