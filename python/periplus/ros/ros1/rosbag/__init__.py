"""Recordings of ROS 1, and those of ROS 2 through the same interface."""

from rosbag.bag import (
    Bag,
    BagMessage,
    BagMessageWithConnectionHeader,
    Compression,
    ROSBagEncryptException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)

__all__ = [
    "Bag",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "ROSBagEncryptException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
]
