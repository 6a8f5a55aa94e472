"""Actions: answers of callbacks, states, cancelling, results."""

from collections.abc import Iterator
from typing import Any

import pytest
from rclpy_nodes import Nodes, nodes

from action_msgs.srv import CancelGoal  # noqa: E402
from example_interfaces.action import Fibonacci  # noqa: E402
from rclpy._rclpy_pybind11 import RCLError  # noqa: E402
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse, get_action_names_and_types  # noqa: E402


@pytest.fixture
def ros() -> Iterator[Nodes]:
    with nodes() as made:
        yield made


def client_of(ros: Nodes, node: Any) -> ActionClient:
    client = ActionClient(node, Fibonacci, "fib")
    ros.until(client.server_is_ready)
    return client


def succeed(handle: Any) -> Any:
    handle.succeed()
    return Fibonacci.Result(sequence=[handle.request.order])


def test_answers_of_the_goal_callback(ros: Nodes, capfd: pytest.CaptureFixture[str]) -> None:
    node = ros.make("n")
    answers = {1: GoalResponse.ACCEPT, 2: GoalResponse.REJECT, 3: "yes"}
    ActionServer(node, Fibonacci, "fib", succeed, goal_callback=lambda goal: answers[goal.order])
    client = client_of(ros, node)
    accepted = [ros.result(client.send_goal_async(Fibonacci.Goal(order=order))).accepted for order in (1, 2, 3)]
    assert accepted == [True, False, False]
    assert "[n.action_server]: Goal request callback did not return a GoalResponse type. Rejecting goal." in capfd.readouterr().err


def test_wrong_transitions_are_refused(ros: Nodes) -> None:
    node, texts = ros.make("n"), []

    def execute(handle: Any) -> Any:
        for wrong in (handle.canceled, handle.execute):
            with pytest.raises(RCLError) as caught:
                wrong()
            texts.append(str(caught.value).rpartition("transition ")[2])
        return succeed(handle)

    ActionServer(node, Fibonacci, "fib", execute)
    client = client_of(ros, node)
    handle = ros.result(client.send_goal_async(Fibonacci.Goal(order=3)))
    response = ros.result(handle.get_result_async())
    assert (response.status, list(response.result.sequence)) == (4, [3])
    assert texts == ["from state EXECUTING with event CANCELED", "from state EXECUTING with event EXECUTE"]


def test_cancel_codes(ros: Nodes) -> None:
    node = ros.make("n")
    ActionServer(node, Fibonacci, "fib", succeed)
    client = client_of(ros, node)
    handle = ros.result(client.send_goal_async(Fibonacci.Goal()))
    ros.result(handle.get_result_async())
    assert ros.result(handle.cancel_goal_async()).return_code == CancelGoal.Response.ERROR_GOAL_TERMINATED
    handle.goal_id.uuid[0] ^= 1
    assert ros.result(handle.cancel_goal_async()).return_code == CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID
    assert ros.result(handle.get_result_async()).status == 0


def test_a_coroutine_can_be_cancelled_while_it_waits(ros: Nodes) -> None:
    from rclpy.task import Future

    node = ros.make("n")
    gate = Future()

    async def execute(handle: Any) -> Any:
        await gate
        handle.canceled() if handle.is_cancel_requested else handle.succeed()
        return Fibonacci.Result()

    ActionServer(node, Fibonacci, "fib", execute, cancel_callback=lambda handle: CancelResponse.ACCEPT)
    client = client_of(ros, node)
    handle = ros.result(client.send_goal_async(Fibonacci.Goal()))
    assert len(ros.result(handle.cancel_goal_async()).goals_canceling) == 1
    gate.set_result(None)
    assert ros.result(handle.get_result_async()).status == 5


def test_a_missing_result_names_the_action(ros: Nodes) -> None:
    node = ros.make("n")
    ActionServer(node, Fibonacci, "fib", lambda handle: handle.succeed())
    client = client_of(ros, node)
    with pytest.raises(TypeError, match="execute callback of the action /fib returned NoneType: it must return a Fibonacci.Result"):
        ros.result(ros.result(client.send_goal_async(Fibonacci.Goal())).get_result_async())


def test_names_of_actions(ros: Nodes) -> None:
    node = ros.make("n", namespace="/robot")
    ActionServer(node, Fibonacci, "fib", succeed)
    assert get_action_names_and_types(node) == [("/robot/fib", ["example_interfaces/action/Fibonacci"])]


def test_results_are_forgotten_after_their_timeout(ros: Nodes) -> None:
    import time

    node = ros.make("n")
    ActionServer(node, Fibonacci, "fib", succeed, result_timeout=0.05)
    client = client_of(ros, node)
    handle = ros.result(client.send_goal_async(Fibonacci.Goal()))
    ros.result(handle.get_result_async())
    time.sleep(0.1)
    assert ros.result(handle.get_result_async()).status == 0
