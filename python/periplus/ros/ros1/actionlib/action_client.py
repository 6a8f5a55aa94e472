"""Client of an action with any number of goals at a time."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable
from typing import Any

import rospy
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray
from rospy import core, rostime
from rospy.timer import _sleep_until

from actionlib.exceptions import ActionException
from actionlib.goal_id_generator import GoalIDGenerator


class CommState:
    """States of a goal as its client sees them."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8

    _NAMES = (
        "WAITING_FOR_GOAL_ACK PENDING ACTIVE WAITING_FOR_RESULT WAITING_FOR_CANCEL_ACK RECALLING PREEMPTING DONE LOST"
    ).split()

    @classmethod
    def to_string(cls, value: int) -> str:
        return cls._NAMES[value]


class TerminalState:
    """States in which a goal ends."""

    RECALLED = GoalStatus.RECALLED
    REJECTED = GoalStatus.REJECTED
    PREEMPTED = GoalStatus.PREEMPTED
    ABORTED = GoalStatus.ABORTED
    SUCCEEDED = GoalStatus.SUCCEEDED
    LOST = GoalStatus.LOST

    @classmethod
    def to_string(cls, value: int) -> str:
        return next(name for name, one in vars(cls).items() if one == value and name.isupper())


_ENDS = frozenset(
    (
        GoalStatus.RECALLED,
        GoalStatus.REJECTED,
        GoalStatus.PREEMPTED,
        GoalStatus.ABORTED,
        GoalStatus.SUCCEEDED,
        GoalStatus.LOST,
    )
)
_STATES = {
    GoalStatus.PENDING: CommState.PENDING,
    GoalStatus.ACTIVE: CommState.ACTIVE,
    GoalStatus.PREEMPTING: CommState.PREEMPTING,
    GoalStatus.RECALLING: CommState.RECALLING,
}
#: Order in which a goal goes through its states; it never goes back.
_ORDER = {
    CommState.WAITING_FOR_GOAL_ACK: 0,
    CommState.PENDING: 1,
    CommState.ACTIVE: 2,
    CommState.WAITING_FOR_CANCEL_ACK: 3,
    CommState.RECALLING: 4,
    CommState.PREEMPTING: 5,
    CommState.WAITING_FOR_RESULT: 6,
    CommState.DONE: 7,
    CommState.LOST: 7,
}


class CommStateMachine:
    """State of one goal."""

    def __init__(
        self,
        action_goal: Any,
        transition_cb: Callable[[Any], Any] | None,
        feedback_cb: Callable[..., Any] | None,
        send_goal_fn: Callable[[Any], Any],
        send_cancel_fn: Callable[[Any], Any],
    ) -> None:
        self.action_goal = action_goal
        self.transition_cb = transition_cb
        self.feedback_cb = feedback_cb
        self.send_goal_fn = send_goal_fn
        self.send_cancel_fn = send_cancel_fn
        self.state = CommState.WAITING_FOR_GOAL_ACK
        self.latest_goal_status = GoalStatus(status=GoalStatus.PENDING)
        self.latest_result: Any = None
        self.mutex = threading.RLock()

    @property
    def goal_id(self) -> str:
        return str(self.action_goal.goal_id.id)

    def set_state(self, state: int) -> None:
        """Goes to a state."""
        self.state = state

    def transition_to(self, state: int) -> None:
        """Goes to a state and calls the callback."""
        self.state = state
        core.state.graph.wake()
        if self.transition_cb is not None:
            self.transition_cb(ClientGoalHandle(self))

    def update_status(self, status_array: Any) -> None:
        """Takes the status that the server has published."""
        with self.mutex:
            if self.state in (CommState.DONE, CommState.LOST):
                return
            mine = next((one for one in status_array.status_list if one.goal_id.id == self.goal_id), None)
            if mine is None:
                if self.state not in (CommState.WAITING_FOR_GOAL_ACK, CommState.WAITING_FOR_RESULT):
                    self.mark_as_lost()
                return
            self.latest_goal_status = mine
            if mine.status in _ENDS:
                self._advance(CommState.WAITING_FOR_RESULT)
            elif mine.status in _STATES:
                self._advance(_STATES[mine.status])

    def _advance(self, state: int) -> None:
        before = self.state
        if _ORDER[state] <= _ORDER[before]:
            return
        passed = []
        if before == CommState.WAITING_FOR_GOAL_ACK and state > CommState.PENDING:
            passed.append(CommState.PENDING)
        if state in (CommState.WAITING_FOR_RESULT, CommState.PREEMPTING) and _ORDER[before] < _ORDER[CommState.ACTIVE]:
            if self.latest_goal_status.status not in (GoalStatus.REJECTED, GoalStatus.RECALLED):
                passed.append(CommState.ACTIVE)
        for one in (*passed, state):
            self.transition_to(one)

    def update_result(self, action_result: Any) -> None:
        """Takes the result."""
        if action_result.status.goal_id.id != self.goal_id:
            return
        with self.mutex:
            if self.state in (CommState.DONE, CommState.LOST):
                return
            self.latest_goal_status = action_result.status
            self.latest_result = action_result
            self._advance(CommState.WAITING_FOR_RESULT)
            self.transition_to(CommState.DONE)

    def update_feedback(self, action_feedback: Any) -> None:
        """Takes feedback."""
        if action_feedback.status.goal_id.id != self.goal_id:
            return
        if self.feedback_cb is not None and self.state != CommState.DONE:
            self.feedback_cb(ClientGoalHandle(self), action_feedback.feedback)

    def mark_as_lost(self) -> None:
        """Ends the goal: the server does not know it."""
        self.latest_goal_status.status = GoalStatus.LOST
        self.transition_to(CommState.DONE)


class ClientGoalHandle:
    """One goal of a client."""

    def __init__(self, comm_state_machine: Any) -> None:
        self.comm_state_machine = comm_state_machine

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and other.comm_state_machine is self.comm_state_machine

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return id(self.comm_state_machine)

    def cancel(self) -> None:
        """Asks the server to cancel the goal."""
        machine = self.comm_state_machine
        with machine.mutex:
            machine.send_cancel_fn(GoalID(rospy.Time(0), machine.goal_id))
            if _ORDER[machine.state] < _ORDER[CommState.WAITING_FOR_CANCEL_ACK]:
                machine.transition_to(CommState.WAITING_FOR_CANCEL_ACK)

    def get_comm_state(self) -> int:
        """State of the goal, of `CommState`."""
        return int(self.comm_state_machine.state) if self.comm_state_machine else CommState.LOST

    def get_goal_status(self) -> int:
        """Status that the server has published last, of `GoalStatus`."""
        if not self.comm_state_machine:
            return int(GoalStatus.PENDING)
        return int(self.comm_state_machine.latest_goal_status.status)

    def get_goal_status_text(self) -> str:
        """Text that came with the status."""
        return str(self.comm_state_machine.latest_goal_status.text) if self.comm_state_machine else ""

    def get_result(self) -> Any:
        """Result, or None."""
        machine = self.comm_state_machine
        return machine.latest_result.result if machine and machine.latest_result else None

    def get_terminal_state(self) -> int:
        """State in which the goal has ended."""
        machine = self.comm_state_machine
        if not machine:
            return int(GoalStatus.LOST)
        status = int(machine.latest_goal_status.status)
        if machine.state != CommState.DONE:
            rospy.logwarn("Asking for the terminal state when we're in [%s]", CommState.to_string(machine.state))
        return status if status in _ENDS else int(GoalStatus.LOST)


class ActionClient:
    """Sends goals and hears of them.

    Args:
        ns: Name of the action.
        ActionSpec: Action class, such as `FibonacciAction`.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:  # noqa: N803
        self.ns = ns
        self.last_status_msg: Any = None
        try:
            action = ActionSpec()
            self.ActionSpec = ActionSpec
            self.ActionGoal = type(action.action_goal)
            self.ActionResult = type(action.action_result)
            self.ActionFeedback = type(action.action_feedback)
        except AttributeError:
            raise ActionException(f"Type is not an action spec: {ActionSpec}") from None
        size = rospy.get_param("actionlib_client_pub_queue_size", 10)
        size = size if isinstance(size, int) and size >= 0 else 10
        self._machines: list[Any] = []
        self._lock = threading.RLock()
        self._generator = GoalIDGenerator()
        self.pub_goal = rospy.Publisher(rospy.remap_name(ns) + "/goal", self.ActionGoal, queue_size=size)
        self.pub_cancel = rospy.Publisher(rospy.remap_name(ns) + "/cancel", GoalID, queue_size=size)
        self.status_sub = rospy.Subscriber(rospy.remap_name(ns) + "/status", GoalStatusArray, self._status_cb)
        self.result_sub = rospy.Subscriber(rospy.remap_name(ns) + "/result", self.ActionResult, self._result_cb)
        self.feedback_sub = rospy.Subscriber(rospy.remap_name(ns) + "/feedback", self.ActionFeedback, self._feedback_cb)

    def send_goal(
        self,
        goal: Any,
        transition_cb: Callable[[Any], Any] | None = None,
        feedback_cb: Callable[..., Any] | None = None,
    ) -> Any:
        """Sends a goal; returns its handle. Who drops the handle hears no more of the goal."""
        message = self.ActionGoal()
        message.header.stamp = rospy.Time.now()
        message.goal_id = self._generator.generate_ID()
        message.goal = goal
        machine = CommStateMachine(message, transition_cb, feedback_cb, self.pub_goal.publish, self.pub_cancel.publish)
        with self._lock:
            self._machines.append(weakref.ref(machine))
        self.pub_goal.publish(message)
        return ClientGoalHandle(machine)

    def _alive(self) -> list[Any]:
        with self._lock:
            found = [(ref, ref()) for ref in self._machines]
            self._machines = [ref for ref, machine in found if machine is not None]
            return [machine for _, machine in found if machine is not None]

    def cancel_all_goals(self) -> None:
        """Cancels all goals of the server, those of other clients too."""
        self.pub_cancel.publish(GoalID(rospy.Time(0), ""))

    def cancel_goals_at_and_before_time(self, time: Any) -> None:
        """Cancels all goals of the server up to a time."""
        self.pub_cancel.publish(GoalID(time, ""))

    def wait_for_server(self, timeout: Any = None) -> bool:
        """Waits until the server is there; False at the timeout (`Duration`, zero for none) or at shutdown."""
        return _wait(self._is_server_there, timeout)

    def _is_server_there(self) -> bool:
        return (
            self.last_status_msg is not None
            and self.pub_goal.get_num_connections() > 0
            and self.pub_cancel.get_num_connections() > 0
            and self.result_sub.get_num_connections() > 0
            and self.feedback_sub.get_num_connections() > 0
        )

    def stop(self) -> None:
        """Ends the client."""
        for one in (self.pub_goal, self.pub_cancel, self.status_sub, self.result_sub, self.feedback_sub):
            one.unregister()

    def _status_cb(self, msg: Any) -> None:
        self.last_status_msg = msg
        for machine in self._alive():
            machine.update_status(msg)
        core.state.graph.wake()

    def _result_cb(self, msg: Any) -> None:
        for machine in self._alive():
            machine.update_result(msg)

    def _feedback_cb(self, msg: Any) -> None:
        for machine in self._alive():
            machine.update_feedback(msg)


def _wait(done: Callable[[], bool], timeout: Any) -> bool:
    """Waits by the time of the node; False at the timeout or at shutdown."""
    nanoseconds = 0
    if timeout is not None:
        nanoseconds = timeout.to_nsec() if hasattr(timeout, "to_nsec") else int(timeout * 1e9)
    try:
        if nanoseconds <= 0:
            return core.wait_events(done)
        begin = rostime.now_ns()
        _sleep_until(begin + nanoseconds, begin, done)
    except rospy.ROSInterruptException:
        if not core.is_shutdown_requested():
            raise
    return done()
