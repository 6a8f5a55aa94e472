"""Encodings of image messages."""

from __future__ import annotations

import re

DEPTHS = ("8U", "8S", "16U", "16S", "32S", "32F", "64F")
DTYPES = {"8U": "uint8", "8S": "int8", "16U": "uint16", "16S": "int16", "32S": "int32", "32F": "float32", "64F": "float64"}

# Colour formats with their channels.
_COLORS = {"mono": 1, "rgb": 3, "bgr": 3, "rgba": 4, "bgra": 4}
BAYER = ("bayer_rggb", "bayer_bggr", "bayer_gbrg", "bayer_grbg")
# Names of the two pixels in two bytes each: U Y V Y, and Y U Y V.
YUV422 = {"yuv422": "uyvy", "uyvy": "uyvy", "yuv422_yuy2": "yuyv", "yuyv": "yuyv"}

_NUMBERS = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)C?(\d+)?")


class EncodingError(ValueError):
    """Encoding that is not known, or a conversion that is not possible."""


def split(encoding: str) -> tuple[str | None, str, int]:
    """Colour format (None for plain numbers), depth and number of channels of an encoding."""
    if encoding in YUV422:
        return "yuv422", "8U", 2
    for bits in ("8", "16"):
        if encoding.endswith(bits):
            name = encoding[: -len(bits)]
            if name in _COLORS:
                return name, bits + "U", _COLORS[name]
            if name in BAYER:
                return name, bits + "U", 1
    match = _NUMBERS.fullmatch(encoding)
    if match is None:
        raise EncodingError(f"Unrecognized image encoding [{encoding}]")
    return None, match.group(1), int(match.group(2) or 1)


def cv_type(encoding: str) -> int:
    """Number of OpenCV for the type of an encoding, such as 16 for `bgr8`."""
    _, depth, channels = split(encoding)
    return DEPTHS.index(depth) + ((channels - 1) << 3)


def cv_name(number: int) -> str:
    """Name of a type of OpenCV, such as `8UC3` for 16."""
    return f"{DEPTHS[number & 7]}C{(number >> 3) + 1}"
