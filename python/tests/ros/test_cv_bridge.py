"""Images as numpy arrays."""

import sys

import numpy as np
import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

from cv_bridge import CvBridge, CvBridgeError  # noqa: E402
from sensor_msgs.msg import Image  # noqa: E402

PIXELS = np.arange(2 * 3 * 3, dtype=np.uint8).reshape(2, 3, 3) * 13


@pytest.mark.parametrize("encoding", ["bgr8", "rgb8", "8UC3"])
def test_round_trip(encoding: str) -> None:
    message = CvBridge().cv2_to_imgmsg(PIXELS, encoding)
    assert (message.height, message.width, message.step, message.encoding) == (2, 3, 9, encoding)
    assert np.array_equal(CvBridge().imgmsg_to_cv2(message), PIXELS)


def test_passthrough_names_the_type() -> None:
    assert CvBridge().cv2_to_imgmsg(PIXELS).encoding == "8UC3"
    assert CvBridge().cv2_to_imgmsg(np.zeros((2, 2), np.float32)).encoding == "32FC1"


@pytest.mark.parametrize(
    ("source", "target", "expected"),
    [
        ("rgb8", "bgr8", PIXELS[..., ::-1]),
        ("bgr8", "rgba8", np.dstack((PIXELS[..., ::-1], np.full((2, 3), 255, np.uint8)))),
        ("rgb8", "rgb16", PIXELS.astype(np.uint16) * 257),
        ("rgb8", "8UC3", PIXELS),
    ],
)
def test_conversions(source: str, target: str, expected: np.ndarray) -> None:
    message = CvBridge().cv2_to_imgmsg(PIXELS, source)
    made = CvBridge().imgmsg_to_cv2(message, target)
    assert made.dtype == expected.dtype and np.array_equal(made, expected)


def test_gray_has_the_weights_of_opencv() -> None:
    red = np.zeros((1, 1, 3), np.uint8)
    red[..., 0] = 255
    assert CvBridge().imgmsg_to_cv2(CvBridge().cv2_to_imgmsg(red, "rgb8"), "mono8")[0, 0] == 76


def test_rows_with_padding() -> None:
    message = Image(height=2, width=2, step=4, encoding="mono8", data=bytes([1, 2, 9, 9, 3, 4, 9, 9]))
    assert CvBridge().imgmsg_to_cv2(message).tolist() == [[1, 2], [3, 4]]


def test_big_endian_depth() -> None:
    message = Image(height=1, width=2, step=4, encoding="16UC1", is_bigendian=1, data=bytes([1, 0, 0, 2]))
    assert CvBridge().imgmsg_to_cv2(message).tolist() == [[256, 2]]


def test_bayer_of_one_color_is_that_color() -> None:
    flat = np.full((4, 4), 50, np.uint8)
    made = CvBridge().imgmsg_to_cv2(CvBridge().cv2_to_imgmsg(flat, "bayer_rggb8"), "bgr8")
    assert made.shape == (4, 4, 3) and np.all(made == 50)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda b: b.cv2_to_imgmsg(PIXELS, "mono8"), "encoding specified as mono8, but image has incompatible type 8UC3"),
        (lambda b: b.imgmsg_to_cv2(b.cv2_to_imgmsg(PIXELS), "bgr8"), "is not a color format"),
        (lambda b: b.imgmsg_to_cv2(Image(height=2, width=2, step=2, encoding="mono8", data=b"a")), "needs 4 bytes, not 1"),
        (lambda b: b.imgmsg_to_cv2(Image(encoding="nope")), "Unrecognized image encoding"),
    ],
)
def test_what_does_not_fit_is_refused(make, text: str) -> None:
    with pytest.raises(CvBridgeError, match=text.replace("[", r"\[")):
        make(CvBridge())


@pytest.mark.parametrize("shape", [(5, 4, 3), (5, 4, 4), (5, 4)])
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_png_without_opencv(shape: tuple[int, ...], dtype: type, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cv2", None)
    pixels = np.random.default_rng(1).integers(0, np.iinfo(dtype).max, shape, dtype=dtype)
    message = CvBridge().cv2_to_compressed_imgmsg(pixels, "png")
    made = CvBridge().compressed_imgmsg_to_cv2(message)
    assert np.array_equal(made, pixels[..., :3] if len(shape) == 3 else pixels)
