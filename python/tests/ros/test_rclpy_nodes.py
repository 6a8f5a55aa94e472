"""Nodes: names, arguments, parameters, publishers, and the texts of errors."""

from collections.abc import Iterator

import pytest
from rclpy_nodes import Nodes, nodes

from rclpy.exceptions import (  # noqa: E402
    InvalidHandle,
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidServiceNameException,
    InvalidTopicNameException,
    NotInitializedException,
)
from rclpy.parameter import Parameter  # noqa: E402
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy  # noqa: E402
from std_msgs.msg import String  # noqa: E402
from std_srvs.srv import SetBool  # noqa: E402


@pytest.fixture
def ros() -> Iterator[Nodes]:
    with nodes() as made:
        yield made


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("1abc", "node name must not start with a number:\n  '1abc'\n   ^"),
        ("with space", "node name must not contain characters other than alphanumerics or '_':\n  'with space'\n       ^"),
        ("", "node name must not be empty:\n  ''\n   ^"),
    ],
)
def test_bad_node_name_has_a_caret(ros: Nodes, name: str, text: str) -> None:
    with pytest.raises(InvalidNodeNameException) as caught:
        ros.make(name)
    assert str(caught.value) == f"Invalid node name: {text}"


def test_bad_namespace_has_a_caret(ros: Nodes) -> None:
    with pytest.raises(InvalidNamespaceException) as caught:
        ros.make("n", namespace="/a//b")
    assert str(caught.value) == "Invalid namespace: namespace must not contain repeated '/':\n  '/a//b'\n      ^"


@pytest.mark.parametrize(
    ("topic", "text"),
    [
        ("1st", "topic name token must not start with a number:\n  '1st'\n   ^"),
        ("x~y", "topic name must not have tilde '~' unless it is the first character:\n  'x~y'\n    ^"),
        ("a{", "topic name must not have unmatched (unbalanced) curly braces '{}':\n  'a{'\n    ^"),
        ("{1a}", "substitution name must not start with a number:\n  '{1a}'\n    ^"),
        ("a//b", "topic name must not contain repeated '/':\n  '/a//b'\n      ^"),
    ],
)
def test_bad_topic_and_service_names(ros: Nodes, topic: str, text: str) -> None:
    node = ros.make("n")
    with pytest.raises(InvalidTopicNameException) as caught:
        node.create_publisher(String, topic, 1)
    assert str(caught.value) == f"Invalid topic name: {text}"
    with pytest.raises(InvalidServiceNameException):
        node.create_client(SetBool, topic)


def test_unknown_substitution(ros: Nodes) -> None:
    with pytest.raises(ValueError, match=r"topic name '\{bad\}/x' is invalid: unknown substitution: \{bad\}"):
        ros.make("n").create_publisher(String, "{bad}/x", 1)


def test_names_are_expanded_and_remapped() -> None:
    with nodes("-r", "scan:=/front/scan", "-r", "~/x:=y") as ros:
        node = ros.make("n", namespace="ns")
        assert node.resolve_topic_name("scan") == "/front/scan"
        assert node.resolve_topic_name("scan", only_expand=True) == "/ns/scan"
        assert node.resolve_topic_name("~/z") == "/ns/n/z"
        assert node.create_publisher(String, "~/x", 1).topic_name == "/ns/y"


def test_overrides_of_arguments_by_node() -> None:
    with nodes("-p", "a:=1", "-p", "n:b:=2.5", "-p", "m:b:=3.5") as ros:
        node = ros.make("n", parameter_overrides=[Parameter("c", value="mine")])
        assert [node.declare_parameter(name, value).value for name, value in (("a", 0), ("b", 0.0), ("c", ""))] == [1, 2.5, "mine"]


def test_missing_init_is_named() -> None:
    import rclpy
    from rclpy.node import Node

    with pytest.raises(NotInitializedException, match=r"rclpy.init\(\) has not been called. msg:cannot create node"):
        Node("n", context=rclpy.Context())


def test_wrong_types_are_refused_at_publish(ros: Nodes) -> None:
    publisher = ros.make("n").create_publisher(String, "t", 1)
    for wrong in (5, "text", SetBool.Request(), String):
        with pytest.raises(TypeError, match="Expected <class 'std_msgs.msg._string.String'>, got"):
            publisher.publish(wrong)
    with pytest.raises(TypeError, match="data"):
        publisher.publish(String(data=5))


def test_class_of_another_kind_is_refused(ros: Nodes) -> None:
    node = ros.make("n")
    with pytest.raises(RuntimeError, match="this might be a service or action"):
        node.create_publisher(SetBool, "t", 1)
    with pytest.raises(RuntimeError, match="this might be a message or action"):
        node.create_client(String, "t")
    with pytest.raises(AttributeError, match="Pass the class"):
        node.create_publisher("std_msgs/String", "t", 1)


@pytest.mark.parametrize(("qos", "error"), [(-1, ValueError), ("x", TypeError), (None, TypeError), (1.5, TypeError)])
def test_wrong_qos_is_refused(ros: Nodes, qos: object, error: type) -> None:
    with pytest.raises(error):
        ros.make("n").create_publisher(String, "t", qos)


def test_zero_depth_warns_with_the_line_of_the_program(ros: Nodes) -> None:
    node = ros.make("n")
    with pytest.warns(UserWarning, match="A zero depth with KEEP_LAST") as caught:
        node.create_publisher(String, "t", 0)
    assert caught[0].filename == __file__


def test_late_subscription_gets_a_latched_message(ros: Nodes) -> None:
    node, got = ros.make("n"), []
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(String, "t", qos).publish(String(data="kept"))
    node.create_subscription(String, "t", got.append, qos)
    ros.until(lambda: got)
    assert got[0].data == "kept"


def test_incompatible_qos_is_logged(ros: Nodes, capfd: pytest.CaptureFixture[str]) -> None:
    node = ros.make("n")
    node.create_publisher(String, "t", QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))
    node.create_subscription(String, "t", print, 1)
    text = ""
    for _ in range(50):
        ros.executor.spin_once(timeout_sec=0.05)
        text += capfd.readouterr().err
        if "requesting" in text and "offering" in text:
            break
    assert "New publisher discovered on topic 't', offering incompatible QoS. No messages will be received from it. Last incompatible policy: RELIABILITY" in text
    assert "New subscription discovered on topic 't', requesting incompatible QoS. No messages will be sent to it." in text


def test_a_node_of_a_program_may_use_common_names(ros: Nodes) -> None:
    from rclpy.node import Node

    class Mine(Node):
        def __init__(self, **options: object) -> None:
            super().__init__("mine", **options)  # type: ignore[arg-type]
            self._graph = self._executor = self._native = self._events = self._state = None
            self._destroyed = self._full_name = "mine"

        def _check(self) -> None: ...
        def _set(self) -> None: ...
        def _add(self) -> None: ...
        def _full(self) -> None: ...

    node = ros.make("mine", lambda name, **options: Mine(**options))
    node.create_publisher(String, "t", 1).publish(String())
    node.declare_parameter("a", 1)
    assert node.set_parameters([Parameter("a", value=2)])[0].successful


def test_destroyed_objects_say_so(ros: Nodes) -> None:
    node = ros.make("n")
    timer = node.create_timer(1.0, print)
    node.destroy_timer(timer)
    with pytest.raises(InvalidHandle):
        timer.cancel()
    node.destroy_node()
    node.destroy_node()
    with pytest.raises(InvalidHandle):
        node.get_name()


def test_parameters_of_another_node(ros: Nodes) -> None:
    from rclpy.parameter_client import AsyncParameterClient

    ros.make("owner").declare_parameters("", [("speed", 1.5), ("names", ["a"])])
    client = AsyncParameterClient(ros.make("asker"), "owner")
    assert client.wait_for_services(10.0)
    assert ros.result(client.get_parameters(["speed"])).values[0].double_value == 1.5
    results = ros.result(client.set_parameters([Parameter("speed", value=2.0), Parameter("speed", value="x"), Parameter("no", value=1)])).results
    assert [result.successful for result in results] == [True, False, False]
    assert results[1].reason == "Wrong parameter type, expected 'Type.DOUBLE' got 'Type.STRING'"
    assert ros.result(client.list_parameters()).result.names == ["use_sim_time", "start_type_description_service", "speed", "names"]


def test_parameter_events_reach_their_handler(ros: Nodes) -> None:
    from rclpy.parameter_event_handler import ParameterEventHandler

    owner, got = ros.make("owner"), []
    handler = ParameterEventHandler(ros.make("watcher"))
    handler.add_parameter_callback("a", "owner", lambda parameter: got.append(parameter.value))
    owner.declare_parameter("a", 1)
    owner.set_parameters([Parameter("a", value=2)])
    ros.until(lambda: len(got) == 2)
    assert got == [1, 2]


def test_qos_may_come_from_parameters() -> None:
    from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions

    with nodes("-p", "qos_overrides./t.publisher.depth:=7", "-p", "qos_overrides./u.publisher.reliability:=maybe") as ros:
        node = ros.make("n")
        options = QoSOverridingOptions.with_default_policies()
        assert node.create_publisher(String, "t", 1, qos_overriding_options=options).qos_profile.depth == 7
        with pytest.raises(InvalidQosOverridesError, match="reliable, best_effort"):
            node.create_publisher(String, "u", 1, qos_overriding_options=options)


def test_a_managed_node_refuses_what_is_not_possible(ros: Nodes, capfd: pytest.CaptureFixture[str]) -> None:
    from rclpy._rclpy_pybind11 import RCLError
    from rclpy.lifecycle import LifecycleNode

    node = ros.make("managed", LifecycleNode)
    with pytest.raises(RCLError, match="Transition is not registered"):
        node.trigger_activate()
    assert node.trigger_configure().name == "SUCCESS"
    assert node._state_machine.current_state == (2, "inactive")
    node.on_activate = lambda state: None
    with pytest.raises(AttributeError, match="on_activate of the node /managed must return a TransitionCallbackReturn"):
        node.trigger_activate()


def test_a_missed_deadline_reaches_both_sides(ros: Nodes) -> None:
    from rclpy.duration import Duration
    from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks

    node, missed = ros.make("n"), []
    qos = QoSProfile(depth=1, deadline=Duration(seconds=0.05))
    publisher = node.create_publisher(
        String, "t", qos, event_callbacks=PublisherEventCallbacks(deadline=lambda event: missed.append("offered"))
    )
    node.create_subscription(
        String, "t", lambda message: None, qos,
        event_callbacks=SubscriptionEventCallbacks(deadline=lambda event: missed.append("requested")),
    )  # fmt: skip
    publisher.publish(String())
    ros.until(lambda: {"offered", "requested"} <= set(missed))


def test_matched_peers_are_counted(ros: Nodes) -> None:
    from rclpy.event_handler import PublisherEventCallbacks

    node, counts = ros.make("n"), []
    node.create_publisher(
        String, "t", 1, event_callbacks=PublisherEventCallbacks(matched=lambda event: counts.append(event.current_count))
    )
    subscription = node.create_subscription(String, "t", print, 1)
    ros.until(lambda: counts == [1])
    node.destroy_subscription(subscription)
    ros.until(lambda: counts == [1, 0])
