"""Conversion of colours, and types of encodings."""

from cv_bridge._colors import convert as cvtColor2  # noqa: F401, N812
from cv_bridge._encodings import cv_type as getCvType  # noqa: F401, N812
