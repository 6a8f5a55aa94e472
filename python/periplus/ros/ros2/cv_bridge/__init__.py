"""Image messages as numpy arrays. OpenCV is used where it is installed, and is not needed."""

from cv_bridge.core import CvBridge as CvBridge, CvBridgeError as CvBridgeError
from cv_bridge.boost.cv_bridge_boost import getCvType as getCvType

__all__ = ["CvBridge", "CvBridgeError"]
