"""Compressed images. PNG needs no other module, other formats need OpenCV or Pillow."""

from __future__ import annotations

import struct
import zlib
from typing import Any

import numpy as np

from cv_bridge._encodings import EncodingError

_PNG = b"\x89PNG\r\n\x1a\n"
_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}
_NO_READER = "needs OpenCV or Pillow: pip install opencv-python-headless, or pip install pillow"


def decode(data: bytes) -> tuple[Any, str]:
    """Pixels of a compressed image and their encoding."""
    try:
        import cv2
    except ImportError:
        pass
    else:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
        if image is None:
            raise EncodingError("the data are not an image that OpenCV can read")
        return image, _encoding(image, "bgr")
    if data.startswith(_PNG):
        try:
            image = _decode_png(data)
        except (struct.error, zlib.error, ValueError, KeyError) as error:
            raise EncodingError(f"the PNG image is damaged: {error}") from None
        return image, _encoding(image, "rgb")
    try:
        from io import BytesIO

        from PIL import Image, UnidentifiedImageError
    except ImportError:
        raise EncodingError(f"this image format {_NO_READER}") from None
    try:
        picture = Image.open(BytesIO(data))
        pixels = np.asarray(picture if picture.mode in ("L", "RGB", "RGBA", "I;16") else picture.convert("RGB"))
    except (UnidentifiedImageError, OSError) as error:
        raise EncodingError(f"the data are not an image: {error}") from None
    return pixels, _encoding(pixels, "rgb")


def encode(image: Any, form: str) -> bytes:
    """Compressed form of an image of the encodings mono, bgr or bgra."""
    form = form.lower().removeprefix(".")
    try:
        import cv2
    except ImportError:
        pass
    else:
        done, data = cv2.imencode("." + form, image)
        if not done:
            raise EncodingError(f"OpenCV cannot write {form}")
        return bytes(data.tobytes())
    if form == "png":
        return _encode_png(_to_rgb(image))
    try:
        from io import BytesIO

        from PIL import Image
    except ImportError:
        raise EncodingError(f"writing {form} {_NO_READER}; png needs neither") from None
    out = BytesIO()
    pixels = _to_rgb(image)
    if form in ("jpg", "jpeg", "jpe") and pixels.ndim == 3:
        pixels = pixels[..., :3]
    Image.fromarray(pixels).save(out, {"jpg": "JPEG", "jpeg": "JPEG", "jpe": "JPEG", "tif": "TIFF"}.get(form, form.upper()))
    return out.getvalue()


def _to_rgb(image: Any) -> Any:
    if image.ndim == 2 or image.shape[2] == 1:
        return np.ascontiguousarray(image.reshape(image.shape[:2]))
    return np.ascontiguousarray(image[..., [2, 1, 0, 3][: image.shape[2]]])


def _encoding(image: Any, color: str) -> str:
    bits = 8 * image.dtype.itemsize
    if image.ndim == 2:
        return f"mono{bits}"
    return f"{color}a{bits}" if image.shape[2] == 4 else f"{color}{bits}"


def _chunks(data: bytes) -> Any:
    position = len(_PNG)
    while position + 8 <= len(data):
        length, kind = struct.unpack(">I4s", data[position : position + 8])
        yield kind, data[position + 8 : position + 8 + length]
        position += 12 + length


def _decode_png(data: bytes) -> Any:
    packed, palette = b"", None
    width = height = bits = color = interlace = 0
    for kind, body in _chunks(data):
        if kind == b"IHDR":
            width, height, bits, color, _, _, interlace = struct.unpack(">IIBBBBB", body[:13])
        elif kind == b"PLTE":
            palette = np.frombuffer(body, np.uint8).reshape(-1, 3)
        elif kind == b"IDAT":
            packed += body
    if interlace or bits not in (8, 16) or (color != 3 and color not in _CHANNELS):
        raise ValueError("interlaced images and less than 8 bits are read by OpenCV or Pillow only")
    channels = 1 if color == 3 else _CHANNELS[color]
    pixel = channels * bits // 8
    raw = zlib.decompress(packed)
    rows = np.frombuffer(raw, np.uint8, height * (width * pixel + 1)).reshape(height, -1)
    out = np.zeros((height, width * pixel), np.uint8)
    above = np.zeros(width * pixel, np.uint8)
    for index in range(height):
        out[index] = above = _unfilter(int(rows[index, 0]), rows[index, 1:], above, pixel)
    image = out.reshape(height, width, channels) if bits == 8 else out.view(">u2").reshape(height, width, channels)
    image = image.astype(np.uint8 if bits == 8 else np.uint16)
    if color == 3:
        if palette is None:
            raise ValueError("the palette is missing")
        return palette[image[..., 0]]
    if channels == 2:
        return np.ascontiguousarray(image[..., 0])
    return image[..., 0] if channels == 1 else image


def _unfilter(kind: int, row: Any, above: Any, pixel: int) -> Any:
    if kind == 0:
        return row
    if kind == 2:
        return row + above
    if kind == 1:
        return np.cumsum(row.reshape(-1, pixel), axis=0, dtype=np.uint8).reshape(-1)
    line, up = bytearray(row.tobytes()), above.tobytes()
    for index in range(len(line)):
        left = line[index - pixel] if index >= pixel else 0
        if kind == 3:
            line[index] = (line[index] + (left + up[index]) // 2) & 255
            continue
        corner = up[index - pixel] if index >= pixel else 0
        estimate = left + up[index] - corner
        distances = (abs(estimate - left), abs(estimate - up[index]), abs(estimate - corner))
        line[index] = (line[index] + (left, up[index], corner)[distances.index(min(distances))]) & 255
    return np.frombuffer(bytes(line), np.uint8)


def _encode_png(image: Any) -> bytes:
    height, width = image.shape[:2]
    channels = 1 if image.ndim == 2 else image.shape[2]
    if image.dtype not in (np.uint8, np.uint16):
        raise EncodingError(f"png holds uint8 or uint16, not {image.dtype}")
    bits = 8 * image.dtype.itemsize
    body = image.astype(">u2").tobytes() if bits == 16 else image.tobytes()
    rows = np.frombuffer(body, np.uint8).reshape(height, -1)
    raw = np.concatenate((np.zeros((height, 1), np.uint8), rows), axis=1).tobytes()

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 2: 4, 3: 2, 4: 6}[channels], 0, 0, 0)
    return _PNG + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 3)) + chunk(b"IEND", b"")
