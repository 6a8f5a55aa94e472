"""TransformListener, under the module name of tf2_ros."""

from tf2_ros.listener import TransformListener

__all__ = ["TransformListener"]
