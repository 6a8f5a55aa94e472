"""Executors, callback groups, tasks and futures."""

import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest
from rclpy_nodes import Nodes, nodes

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup  # noqa: E402
from rclpy.executors import Executor, ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor  # noqa: E402
from rclpy.task import Future, Task  # noqa: E402


@pytest.fixture
def ros() -> Iterator[Nodes]:
    with nodes() as made:
        yield made


def test_spin_once_runs_one_callback_and_keeps_the_others(ros: Nodes) -> None:
    node, calls = ros.make("n"), []
    for index in range(3):
        node.create_timer(0.01, lambda index=index: calls.append(index))
    time.sleep(0.03)
    ros.executor.spin_once(timeout_sec=0)
    assert calls == [0]
    ros.executor.spin_once(timeout_sec=0)
    ros.executor.spin_once(timeout_sec=0)
    assert calls == [0, 1, 2]


def test_newest_task_runs_first(ros: Nodes) -> None:
    calls: list[int] = []
    tasks = [ros.executor.create_task(calls.append, index) for index in range(3)]
    ros.until(lambda: all(task.done() for task in tasks))
    assert calls == [2, 1, 0]


def test_coroutine_goes_on_when_the_awaited_future_is_done(ros: Nodes) -> None:
    future = Future(executor=ros.executor)

    async def wait() -> Any:
        return await future

    task = ros.executor.create_task(wait())
    ros.executor.spin_once(timeout_sec=0.1)
    assert not task.done()
    future.set_result(9)
    assert ros.result(task) == 9


def test_foreign_awaitable_is_polled(ros: Nodes) -> None:
    class Later:
        def __await__(self) -> Iterator[None]:
            for _ in range(5):
                yield

    async def wait() -> int:
        await Later()
        return 3

    assert ros.result(ros.executor.create_task(wait())) == 3


def test_error_of_a_task_leaves_spin_and_stays_in_the_task(ros: Nodes) -> None:
    def fail() -> None:
        raise ValueError("broken")

    task = ros.executor.create_task(fail)
    with pytest.raises(ValueError, match="broken"):
        ros.executor.spin_once(timeout_sec=1)
    with pytest.raises(ValueError, match="broken"):
        task.result()


def test_error_of_a_callback_names_node_and_topic(ros: Nodes) -> None:
    from std_msgs.msg import String

    node = ros.make("listener", namespace="/here")
    publisher = node.create_publisher(String, "chatter", 1)
    node.create_subscription(String, "chatter", lambda message: 1 / 0, 1)
    publisher.publish(String())
    with pytest.raises(ZeroDivisionError) as caught:
        ros.until(lambda: False)
    assert "subscription /here/chatter of node /here/listener" in caught.value.__notes__[0]  # type: ignore[attr-defined]


def test_done_callbacks_of_a_response_run_as_tasks(ros: Nodes) -> None:
    from std_srvs.srv import Trigger

    node, order = ros.make("n"), []
    node.create_service(Trigger, "s", lambda request, response: response)
    client = node.create_client(Trigger, "s")
    assert client.wait_for_service(10.0)
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda done: order.append("callback"))
    ros.until(lambda: future.done())
    order.append("done")
    ros.until(lambda: len(order) == 2)
    assert order == ["done", "callback"]


def test_threads_run_callbacks_of_a_reentrant_group_together(ros: Nodes) -> None:
    executor = MultiThreadedExecutor(2, context=ros.context)
    node, group = ros.make("n"), ReentrantCallbackGroup()
    executor.add_node(node)
    both = threading.Barrier(2)
    met = []
    for _ in range(2):
        node.create_timer(0.01, lambda: met.append(both.wait(10.0)), callback_group=group)
    end = time.monotonic() + 10
    while len(met) < 2 and time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)
    assert sorted(met[:2]) == [0, 1]
    for timer in list(node.timers):
        timer.cancel()
    both.abort()
    assert executor.shutdown(5.0)


def test_threads_run_an_exclusive_group_one_at_a_time(ros: Nodes) -> None:
    executor = MultiThreadedExecutor(3, context=ros.context)
    node, group = ros.make("n"), MutuallyExclusiveCallbackGroup()
    executor.add_node(node)
    inside, most, calls = [0], [0], [0]

    def work() -> None:
        inside[0] += 1
        most[0] = max(most[0], inside[0])
        time.sleep(0.005)
        inside[0] -= 1
        calls[0] += 1

    for _ in range(3):
        node.create_timer(0.001, work, callback_group=group)
    end = time.monotonic() + 10
    while calls[0] < 20 and time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown(5.0)
    assert (calls[0] >= 20, most[0]) == (True, 1)


def test_error_in_a_thread_surfaces_at_a_later_spin_once(ros: Nodes) -> None:
    executor = MultiThreadedExecutor(2, context=ros.context)
    executor.create_task(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        for _ in range(50):
            executor.spin_once(timeout_sec=0.1)
    executor.shutdown()


def test_shutdown_of_the_context_ends_a_wait(ros: Nodes) -> None:
    ros.make("n")
    threading.Timer(0.1, ros.context.shutdown).start()
    with pytest.raises(ExternalShutdownException):
        ros.executor.spin()


def test_a_node_goes_back_to_its_executor_after_a_nested_spin(ros: Nodes) -> None:
    import rclpy

    node = ros.make("n")
    other = SingleThreadedExecutor(context=ros.context)
    rclpy.spin_once(node, executor=other, timeout_sec=0)
    assert node.executor is ros.executor
    assert node in ros.executor.get_nodes()


def test_an_executor_of_ones_own_chooses_what_runs(ros: Nodes) -> None:
    class OnlySubscriptions(Executor):
        def can_execute(self, entity: Any) -> bool:
            return super().can_execute(entity) and hasattr(entity, "topic")

        def spin_once(self, timeout_sec: float | None = None) -> None:
            handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
            handler()
            if handler.exception() is not None:
                raise handler.exception()

    from std_msgs.msg import String

    node, calls = ros.make("n"), []
    executor = OnlySubscriptions(context=ros.context)
    executor.add_node(node)
    node.create_timer(0.001, lambda: calls.append("timer"))
    node.create_subscription(String, "t", lambda message: calls.append("message"), 1)
    publisher = node.create_publisher(String, "t", 1)
    publisher.publish(String())
    executor.spin_once(timeout_sec=10)
    assert calls == ["message"]


def test_blocking_call_from_another_thread(ros: Nodes) -> None:
    from std_srvs.srv import Trigger

    node = ros.make("n")
    node.create_service(Trigger, "s", lambda request, response: (setattr(response, "message", "hi"), response)[1])
    client = node.create_client(Trigger, "s")
    assert client.wait_for_service(10.0)
    assert client.call(Trigger.Request(), timeout_sec=0.05) is None
    answers: list[Any] = []
    thread = threading.Thread(target=lambda: answers.append(client.call(Trigger.Request())))
    thread.start()
    ros.until(lambda: answers)
    thread.join()
    assert answers[0].message == "hi"


def test_rate_follows_the_timer_and_ends_with_it(ros: Nodes) -> None:
    node = ros.make("n")
    rate = node.create_rate(100.0)
    slept: list[float] = []

    def loop() -> None:
        for _ in range(5):
            rate.sleep()
            slept.append(time.monotonic())

    thread = threading.Thread(target=loop)
    thread.start()
    ros.until(lambda: len(slept) == 5)
    thread.join()
    assert slept[-1] - slept[0] > 0.03
    assert node.destroy_rate(rate)
    with pytest.raises(RuntimeError, match="has been destroyed"):
        rate.sleep()


def test_task_called_by_hand() -> None:
    async def seven() -> int:
        return 7

    task = Task(seven)
    task()
    assert (task.done(), task.result()) == (True, 7)
    with pytest.raises(TypeError, match="not callable"):
        Task(5)
