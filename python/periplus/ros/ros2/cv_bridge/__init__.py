"""Image messages as numpy arrays. OpenCV is used where it is installed, and is not needed."""

from cv_bridge.core import CvBridge as CvBridge, CvBridgeError as CvBridgeError
from cv_bridge._encodings import cv_type as getCvType  # noqa: N812

__all__ = ["CvBridge", "CvBridgeError", "getCvType"]
