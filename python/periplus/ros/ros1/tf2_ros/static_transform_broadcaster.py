"""StaticTransformBroadcaster, under the module name of tf2_ros."""

from tf2_ros.broadcasters import StaticTransformBroadcaster

__all__ = ["StaticTransformBroadcaster"]
