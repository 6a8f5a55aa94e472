"""Client of the parameters of another node."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import rospy
from rospy import core

from dynamic_reconfigure import DynamicReconfigureCallbackException, DynamicReconfigureParameterException
from dynamic_reconfigure.encoding import decode_config, decode_description, encode_config
from dynamic_reconfigure.msg import Config, ConfigDescription
from dynamic_reconfigure.srv import Reconfigure

__all__ = ["Client", "DynamicReconfigureCallbackException", "DynamicReconfigureParameterException"]


class Client:
    """Changes the parameters of a node.

    Args:
        name: Name of the node.
        timeout: Time to wait for it [s]; None for ever.
        config_callback: Function of the configuration, called at each change.
        description_callback: Function of the description.
        group_callback: Ignored.
    """

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: Callable[[Any], Any] | None = None,
        description_callback: Callable[[Any], Any] | None = None,
        group_callback: Any = None,
    ) -> None:
        self.name = name
        self.config: Any = None
        self.description: Any = None
        self.group_description: Any = None
        self._lock = threading.RLock()
        self._config_callback = config_callback
        self._description_callback = description_callback
        self._set_service = rospy.ServiceProxy(f"{name}/set_parameters", Reconfigure)
        self._descriptions = rospy.Subscriber(
            f"{name}/parameter_descriptions", ConfigDescription, self._descriptions_msg
        )
        self._updates = rospy.Subscriber(f"{name}/parameter_updates", Config, self._updates_msg)
        self._wait(timeout)

    def _wait(self, timeout: float | None) -> None:
        try:
            rospy.wait_for_service(f"{self.name}/set_parameters", timeout)
        except rospy.ROSInterruptException:
            raise
        except rospy.ROSException:
            raise rospy.ROSException(
                f"timeout exceeded while waiting for service {rospy.resolve_name(self.name)}/set_parameters"
            ) from None

    def get_configuration(self, timeout: float | None = None) -> Any:
        """Newest configuration; None if there is none within the timeout [s]."""
        return self._get(lambda: self.config, timeout)

    def get_parameter_descriptions(self, timeout: float | None = None) -> Any:
        """Description of the parameters; None if there is none within the timeout [s]."""
        return self._get(lambda: self.description, timeout)

    def get_group_descriptions(self, timeout: float | None = None) -> Any:
        """Groups of the parameters."""
        return self._get(lambda: self.group_description, timeout)

    @staticmethod
    def _get(value: Callable[[], Any], timeout: float | None) -> Any:
        nanoseconds = None if timeout is None or timeout == 0.0 else int(timeout * 1e9)
        core.wait_events(lambda: value() is not None, nanoseconds)
        return value()

    def update_configuration(self, changes: dict[str, Any]) -> Any:
        """Changes parameters; returns the configuration that the node has made of them.

        Raises:
            DynamicReconfigureParameterException: A parameter does not exist.
            DynamicReconfigureCallbackException: The service has failed.
        """
        changes = dict(changes)
        description = self.get_parameter_descriptions(5.0)
        if description is not None:
            kinds = {one["name"]: one["type"] for one in description}
            for key, value in changes.items():
                if key == "groups":
                    continue
                if key not in kinds:
                    raise DynamicReconfigureParameterException(
                        f"don't know parameter: {key}. The parameters of {self.name}: {', '.join(sorted(kinds))}"
                    )
                changes[key] = _converted(key, kinds[key], value)
        try:
            message = self._set_service(encode_config(changes)).config
        except rospy.ServiceException as error:
            raise DynamicReconfigureCallbackException("service call failed") from error
        config = decode_config(message)
        with self._lock:
            self.config = config
        if self._config_callback is not None:
            self._config_callback(config)
        return config

    def get_config_callback(self) -> Any:
        return self._config_callback

    def set_config_callback(self, value: Any) -> None:
        self._config_callback = value
        if self.config is not None and value is not None:
            value(self.config)

    config_callback = property(get_config_callback, set_config_callback)

    def close(self) -> None:
        """Ends the subscriptions."""
        self._updates.unregister()
        self._descriptions.unregister()

    def _updates_msg(self, msg: Any) -> None:
        with self._lock:
            self.config = decode_config(msg)
        core.state.graph.wake()
        if self._config_callback is not None:
            self._config_callback(self.config)

    def _descriptions_msg(self, msg: Any) -> None:
        with self._lock:
            self.group_description = msg.groups
            self.description = decode_description(msg)
        core.state.graph.wake()
        if self._description_callback is not None:
            self._description_callback(self.description)


def _converted(key: str, kind: str, value: Any) -> Any:
    """Value in the type of its parameter."""
    try:
        if kind == "bool":
            return value.lower() in ("true", "1", "yes", "on") if isinstance(value, str) else bool(value)
        return {"int": int, "double": float, "str": str}[kind](value)
    except (ValueError, TypeError):
        raise DynamicReconfigureParameterException(
            f"can't set parameter '{key}' of {kind}: {value!r} is not of this type"
        ) from None
