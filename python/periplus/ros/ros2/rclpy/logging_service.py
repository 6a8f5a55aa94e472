"""Services for the levels of loggers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.logging import get_logger_level, set_logger_level
from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from rclpy.node import Node

TOPIC_SEPARATOR_STRING = "/"


class LoggingService:
    """Services `get_logger_levels` and `set_logger_levels` of a node."""

    def __init__(self, node: Node) -> None:
        from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

        prefix = node.get_name() + TOPIC_SEPARATOR_STRING
        for service_type, name, callback in (
            (GetLoggerLevels, "get_logger_levels", self._get),
            (SetLoggerLevels, "set_logger_levels", self._set),
        ):
            node.create_service(service_type, prefix + name, callback, qos_profile=qos_profile_services_default)

    def _get(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import LoggerLevel

        response.levels = [LoggerLevel(name=name, level=int(get_logger_level(name))) for name in request.names]
        return response

    def _set(self, request: Any, response: Any) -> Any:
        from rcl_interfaces.msg import SetLoggerLevelsResult

        results = []
        for level in request.levels:
            try:
                set_logger_level(level.name, LoggingSeverity(level.level))
                results.append(SetLoggerLevelsResult(successful=True))
            except ValueError as error:
                results.append(SetLoggerLevelsResult(successful=False, reason=str(error)))
        response.results = results
        return response
