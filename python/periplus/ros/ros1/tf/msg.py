"""Messages of tf: `tfMessage` is `tf2_msgs/TFMessage`."""

from tf2_msgs.msg import TFMessage as tfMessage  # noqa: N813

__all__ = ["tfMessage"]
