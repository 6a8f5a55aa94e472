"""TransformBroadcaster, under the module name of tf2_ros."""

from tf2_ros.broadcasters import TransformBroadcaster

__all__ = ["TransformBroadcaster"]
