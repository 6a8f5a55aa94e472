"""Server of the parameters of a node."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import Any

import rospy

from dynamic_reconfigure.encoding import Config_, decode_config, encode_config, encode_description, extract_params
from dynamic_reconfigure.msg import Config, ConfigDescription
from dynamic_reconfigure.srv import Reconfigure


class Server:
    """Lets other nodes change the parameters of this one.

    Args:
        type: Configuration module, such as `my_package.cfg.MyConfig`.
        callback: Function of the configuration and the level of what has changed; returns the configuration.
        namespace: Namespace of the parameters (default that of the node's private ones).
    """

    def __init__(self, type: Any, callback: Callable[[Any, int], Any], namespace: str = "") -> None:  # noqa: A002
        self.mutex = threading.RLock()
        self.namespace = namespace
        self.type = type
        self.config = Config_(copy.deepcopy(type.defaults))
        self.config["groups"] = copy.deepcopy(type.config_description)
        self.description = encode_description(type)
        self.callback = callback
        self._copy_from_parameter_server()
        self.config = self._clamp(self.config)
        self.descr_topic = rospy.Publisher(
            self._name("parameter_descriptions"), ConfigDescription, latch=True, queue_size=10
        )
        self.descr_topic.publish(self.description)
        self.update_topic = rospy.Publisher(self._name("parameter_updates"), Config, latch=True, queue_size=10)
        self._change_config(self.config, type.all_level)
        self.set_service = rospy.Service(self._name("set_parameters"), Reconfigure, self._set_callback)

    def _name(self, suffix: str) -> str:
        return "~" + (self.namespace + "/" if self.namespace else "") + suffix

    def update_configuration(self, changes: dict[str, Any]) -> Any:
        """Changes parameters."""
        with self.mutex:
            new = Config_(copy.deepcopy(dict(self.config)))
            new.update(changes)
            new = self._clamp(new)
            return self._change_config(new, self._level(self.config, new))

    def _copy_from_parameter_server(self) -> None:
        for one in extract_params(self.type.config_description):
            value = rospy.get_param(self._name(one["name"]), self.config[one["name"]])
            self.config[one["name"]] = value

    def _copy_to_parameter_server(self) -> None:
        for one in extract_params(self.type.config_description):
            value = self.config[one["name"]]
            if rospy.get_param(self._name(one["name"]), None) != value:
                rospy.set_param(self._name(one["name"]), value)

    def _change_config(self, config: Any, level: int) -> Any:
        self.config = self.callback(config, level)
        if self.config is None:
            raise TypeError("Reconfigure callback should return a possibly updated configuration.")
        self._copy_to_parameter_server()
        self.update_topic.publish(encode_config(self.config))
        return self.config

    def _level(self, before: Any, after: Any) -> int:
        level = 0
        for one in extract_params(self.type.config_description):
            if after[one["name"]] != before[one["name"]]:
                level |= one["level"]
        return level

    def _clamp(self, config: Any) -> Any:
        kinds = {"bool": bool, "int": int, "double": float, "str": str}
        for one in extract_params(self.type.config_description):
            key = one["name"]
            value = kinds[one["type"]](config[key])
            if one["type"] in ("int", "double"):
                value = min(max(value, self.type.min[key]), self.type.max[key])
            config[key] = value
        return config

    def _set_callback(self, request: Any) -> Any:
        return encode_config(self.update_configuration(decode_config(request.config)))
