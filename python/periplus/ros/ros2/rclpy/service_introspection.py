"""Events that services publish about their calls."""

from rclpy._rclpy_pybind11 import ServiceIntrospectionState

__all__ = ["ServiceIntrospectionState"]
