"""Conversion of images between colour formats."""

from __future__ import annotations

from typing import Any

import numpy as np

from cv_bridge._encodings import BAYER, DTYPES, YUV422, EncodingError, split

# Weights of red, green and blue in the brightness, of 2^15, as in OpenCV.
_GRAY = (9798, 19235, 3735)

_ORDERS = {"rgb": (0, 1, 2), "bgr": (2, 1, 0), "rgba": (0, 1, 2), "bgra": (2, 1, 0)}


def convert(image: Any, source: str, target: str) -> Any:
    """Image with another encoding."""
    if source == target:
        return image
    color, depth, channels = split(source)
    new_color, new_depth, new_channels = split(target)
    if color is None or new_color is None:
        return _same_format(image, source, target, channels == new_channels, color, new_color)
    if color != new_color:
        if new_color in BAYER or new_color == "yuv422":
            raise EncodingError(f"Unsupported conversion from [{source}] to [{target}]")
        if color in BAYER:
            image, color = _demosaic(image, color), "rgb"
        elif color == "yuv422":
            image, color = _from_yuv(image, YUV422[source]), "rgb"
        image = _recolor(image, color, new_color)
    return image if depth == new_depth else _rescale(image, depth, new_depth)


def _same_format(image: Any, source: str, target: str, same: bool, color: str | None, new_color: str | None) -> Any:
    if color is None and new_color is not None:
        raise EncodingError(f"[{source}] is not a color format. but [{target}] is. The conversion does not make sense")
    if not same:
        if color is None:
            raise EncodingError(f"[{source}] and [{target}] do not have the same number of channel")
        raise EncodingError(
            f"[{source}] is a color format but [{target}] is not so they must have the same OpenCV type, CV_8UC3, CV16UC1 ...."
        )
    depth, new_depth = split(source)[1], split(target)[1]
    return image if depth == new_depth else image.astype(DTYPES[new_depth])


def _recolor(image: Any, color: str, target: str) -> Any:
    if color == target:
        return image
    if color == "mono":
        made = np.empty((*image.shape[:2], len(target)), image.dtype)
        made[..., :3] = image.reshape(image.shape[:2])[..., None]
    elif target == "mono":
        order = _ORDERS[color]
        total = sum(image[..., order[one]].astype(np.uint32) * _GRAY[one] for one in range(3))
        return ((total + (1 << 14)) >> 15).astype(image.dtype)
    else:
        order = (0, 1, 2) if _ORDERS[color] == _ORDERS[target] else (2, 1, 0)
        made = np.empty((*image.shape[:2], len(target)), image.dtype)
        for channel in range(3):
            made[..., channel] = image[..., order[channel]]
        if len(color) == 4 and len(target) == 4:
            made[..., 3] = image[..., 3]
            return made
    if len(target) == 4:
        made[..., 3] = np.iinfo(image.dtype).max
    return made


def _rescale(image: Any, depth: str, new_depth: str) -> Any:
    if depth == "8U":
        return image.astype(np.uint16) * np.uint16(257)
    return np.rint(image * (255.0 / 65535.0)).astype(DTYPES[new_depth])


def _demosaic(image: Any, pattern: str) -> Any:
    """Colours of a Bayer image: missing ones are the mean of their neighbours."""
    letters = pattern.removeprefix("bayer_")
    image = image.reshape(image.shape[:2])
    made = np.empty((*image.shape, 3), image.dtype)
    for channel, letter in enumerate("rgb"):
        values = np.zeros(image.shape, np.float32)
        known = np.zeros(image.shape, np.float32)
        for index, one in enumerate(letters):
            if one == letter:
                window = (slice(index // 2, None, 2), slice(index % 2, None, 2))
                values[window], known[window] = image[window], 1.0
        filled = _blur(values) / np.maximum(_blur(known), 1e-6)
        made[..., channel] = np.where(known > 0, values, np.rint(filled)).astype(image.dtype)
    return made


def _blur(values: Any) -> Any:
    padded = np.pad(values, 1, mode="reflect" if min(values.shape) > 1 else "edge")
    rows = padded[:-2] + 2 * padded[1:-1] + padded[2:]
    return rows[:, :-2] + 2 * rows[:, 1:-1] + rows[:, 2:]


def _from_yuv(image: Any, order: str) -> Any:
    pairs = image.reshape(image.shape[0], -1, 4).astype(np.float32)
    u, v = pairs[..., order.index("u")] - 128.0, pairs[..., order.index("v")] - 128.0
    made = np.empty((image.shape[0], pairs.shape[1] * 2, 3), np.uint8)
    first = order.index("y")
    for index, position in enumerate((first, first + 2)):
        y = 1.164 * np.maximum(pairs[..., position] - 16.0, 0.0)
        rgb = np.stack((y + 1.596 * v, y - 0.391 * u - 0.813 * v, y + 2.018 * u), axis=-1)
        made[:, index::2] = np.clip(np.rint(rgb), 0, 255)
    return made
