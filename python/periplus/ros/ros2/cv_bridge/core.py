"""Conversion between image messages and arrays in the layout of OpenCV."""

from __future__ import annotations

import sys
from array import array
from typing import Any

import numpy as np
from sensor_msgs.msg import CompressedImage, Image

from cv_bridge import _files
from cv_bridge._colors import convert
from cv_bridge._encodings import DEPTHS, DTYPES, EncodingError, cv_name, cv_type, split


class CvBridgeError(TypeError):
    """Image that cannot be converted."""


class CvBridge:
    """Converts image messages to arrays and back."""

    def __init__(self) -> None:
        self.cvtype_to_name = {
            depth + ((channels - 1) << 3): cv_name(depth + ((channels - 1) << 3))
            for depth in range(len(DEPTHS))
            for channels in (1, 2, 3, 4)
        }
        self.numpy_type_to_cvtype = {dtype: depth for depth, dtype in DTYPES.items()}


    # ---- types

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """Name of the type of OpenCV, such as `8UC3`."""
        try:
            return f"{self.numpy_type_to_cvtype[np.dtype(dtype).name]}C{n_channels}"
        except KeyError:
            known = ", ".join(DTYPES.values())
            raise CvBridgeError(f"images hold {known}, not {np.dtype(dtype).name}: convert with .astype(...)") from None

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Type of numpy and number of channels of a type of OpenCV."""
        return DTYPES[DEPTHS[cvtype & 7]], (cvtype >> 3) + 1

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Number of the type of OpenCV of an encoding."""
        try:
            return cv_type(encoding)
        except EncodingError as error:
            raise CvBridgeError(str(error)) from None

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Type of numpy and number of channels of an encoding."""
        return self.cvtype2_to_dtype_with_channels(self.encoding_to_cvtype2(encoding))

    # ---- images

    def imgmsg_to_cv2(self, img_msg: Any, desired_encoding: str = "passthrough") -> Any:
        """Pixels of an image message. With `passthrough` they are those of the message, not a copy."""
        dtype_name, channels = self.encoding_to_dtype_with_channels(img_msg.encoding)
        dtype = np.dtype(dtype_name).newbyteorder(">" if img_msg.is_bigendian else "<")
        height, width, step = img_msg.height, img_msg.width, img_msg.step
        data = img_msg.data
        if isinstance(data, list):
            data = np.asarray(data, np.uint8)
        row = width * channels * dtype.itemsize
        if step < row:
            raise CvBridgeError(
                f"an image of {width} pixels with encoding {img_msg.encoding} needs rows (step) of {row} bytes, not {step}"
            )
        if len(data) < height * step:
            raise CvBridgeError(f"an image of {height} rows of {step} bytes needs {height * step} bytes, not {len(data)}")
        pixel = channels * dtype.itemsize
        if channels == 1:
            image: Any = np.ndarray((height, width), dtype, data, strides=(step, pixel))
        else:
            image = np.ndarray((height, width, channels), dtype, data, strides=(step, pixel, dtype.itemsize))
        if bool(img_msg.is_bigendian) != (sys.byteorder == "big"):
            image = image.byteswap().view(image.dtype.newbyteorder())
        if desired_encoding == "passthrough":
            return image
        try:
            made = convert(image, img_msg.encoding, desired_encoding)
        except EncodingError as error:
            raise CvBridgeError(str(error)) from None
        return np.ascontiguousarray(made) if made is not image else made.copy()

    def cv2_to_imgmsg(self, cvim: Any, encoding: str = "passthrough", header: Any = None) -> Image:
        """Message of an image; `passthrough` names the encoding by the type, such as `8UC3`."""
        image = self._array(cvim)
        channels = image.shape[2] if image.ndim > 2 else 1
        name = self.dtype_with_channels_to_cvtype2(image.dtype, channels)
        if encoding == "passthrough":
            encoding = name
        elif cv_name(self.encoding_to_cvtype2(encoding)) != name:
            raise CvBridgeError(f"encoding specified as {encoding}, but image has incompatible type {name}")
        message = Image(height=image.shape[0], width=image.shape[1], encoding=encoding)
        if header is not None:
            message.header = header
        message.is_bigendian = int(image.dtype.byteorder == ">" or (image.dtype.byteorder == "=" and sys.byteorder == "big"))
        data = array("B")
        data.frombytes(image.tobytes())
        message.data = data
        message.step = len(data) // image.shape[0] if image.shape[0] else 0
        return message

    def _array(self, image: Any) -> Any:
        if not isinstance(image, (np.ndarray, np.generic)):
            raise TypeError("Your input type is not a numpy array")
        if image.ndim not in (2, 3):
            raise CvBridgeError(f"an image has 2 or 3 dimensions, not {image.ndim}")
        return image

    # ---- compressed images

    def compressed_imgmsg_to_cv2(self, cmprs_img_msg: Any, desired_encoding: str = "passthrough") -> Any:
        """Pixels of a compressed image message; `passthrough` gives blue, green, red."""
        try:
            image, encoding = _files.decode(bytes(cmprs_img_msg.data))
            color, depth, channels = split(encoding)
            if desired_encoding == "passthrough":
                bits = depth.removesuffix("U")
                desired_encoding = encoding if channels == 1 else f"bgr{bits}"
            return np.ascontiguousarray(convert(image, encoding, desired_encoding))
        except EncodingError as error:
            raise CvBridgeError(str(error)) from None

    def cv2_to_compressed_imgmsg(self, cvim: Any, dst_format: str = "jpg", header: Any = None) -> CompressedImage:
        """Compressed message of an image of grey, or of blue, green and red."""
        image = self._array(cvim)
        message = CompressedImage(format=dst_format)
        if header is not None:
            message.header = header
        try:
            message.data = _files.encode(image, dst_format)
        except EncodingError as error:
            raise CvBridgeError(str(error)) from None
        return message
