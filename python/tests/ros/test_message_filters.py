"""Synchronization of messages by their stamps."""

import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

import message_filters  # noqa: E402
from rclpy.time import Time  # noqa: E402
from sensor_msgs.msg import Image  # noqa: E402
from std_msgs.msg import String  # noqa: E402


def image(time_s: float) -> Image:
    made = Image()
    made.header.stamp = Time(nanoseconds=round(time_s * 1e9)).to_msg()
    return made


def seconds(message: Image) -> float:
    return message.header.stamp.sec + message.header.stamp.nanosec * 1e-9


@pytest.mark.parametrize(("difference", "count"), [(0.05, 1), (0.1, 0), (0.2, 0)])
def test_slop_is_a_strict_limit(difference: float, count: int) -> None:
    a, b = message_filters.SimpleFilter(), message_filters.SimpleFilter()
    made = message_filters.ApproximateTimeSynchronizer([a, b], 10, 0.1)
    pairs = []
    made.registerCallback(lambda x, y: pairs.append((x, y)))
    a.signalMessage(image(1.0))
    b.signalMessage(image(1.0 + difference))
    assert len(pairs) == count


def test_nearest_message_is_taken_and_used_once() -> None:
    a, b = message_filters.SimpleFilter(), message_filters.SimpleFilter()
    made = message_filters.ApproximateTimeSynchronizer([a, b], 10, 0.5)
    pairs = []
    made.registerCallback(lambda x, y: pairs.append((seconds(x), seconds(y))))
    for time_s in (1.0, 1.2, 1.4):
        a.signalMessage(image(time_s))
    b.signalMessage(image(1.25))
    b.signalMessage(image(1.26))
    assert pairs == [(1.2, 1.25), (1.4, 1.26)]


def test_messages_without_a_header() -> None:
    a, b = message_filters.SimpleFilter(), message_filters.SimpleFilter()
    pairs = []
    strict = message_filters.ApproximateTimeSynchronizer([a, b], 10, 5.0)
    strict.registerCallback(lambda *pair: pairs.append(pair))
    a.signalMessage(String())
    b.signalMessage(String())
    assert not pairs
    lenient = message_filters.ApproximateTimeSynchronizer([a, b], 10, 5.0, allow_headerless=True)
    lenient.registerCallback(lambda *pair: pairs.append(pair))
    a.signalMessage(String())
    b.signalMessage(String())
    assert len(pairs) == 1


def test_cache() -> None:
    source = message_filters.SimpleFilter()
    cache = message_filters.Cache(source, 3)
    for time_s in (1, 3, 2, 4):
        source.signalMessage(image(time_s))
    assert [seconds(one) for one in cache.getInterval(Time.from_msg(image(2).header.stamp), Time.from_msg(image(3).header.stamp))] == [2, 3]
    assert seconds(cache.getElemBeforeTime(Time.from_msg(image(3.5).header.stamp))) == 3
    assert seconds(cache.getElemAfterTime(Time.from_msg(image(3.5).header.stamp))) == 4
    assert cache.getLastestTime().nanoseconds == 4_000_000_000


def test_chain() -> None:
    source, cache = message_filters.SimpleFilter(), message_filters.Cache(cache_size=2)
    chain = message_filters.Chain(source, cache)
    received = []
    chain.registerCallback(received.append)
    source.signalMessage(image(1))
    assert len(received) == 1 and chain.getFilter(1) is cache
