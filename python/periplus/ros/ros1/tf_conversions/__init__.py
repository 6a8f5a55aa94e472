"""Poses between messages, transforms and the frames of KDL."""

from tf_conversions.posemath import fromMatrix, fromMsg, fromTf, toMatrix, toMsg, toTf

__all__ = ["fromMatrix", "fromMsg", "fromTf", "toMatrix", "toMsg", "toTf", "transformations"]

from tf import transformations
