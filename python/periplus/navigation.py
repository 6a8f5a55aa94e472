"""Navigation beside a simulated robot, with plugins that are classes of Python.

A plugin is a class with the methods of :class:`Planner`, :class:`Controller`, :class:`Behavior` or :class:`TreeNode`.
The servers call it in the thread that steps the simulation, so a run stays deterministic if the plugin is. All that a
plugin knows are its arguments: it cannot use the simulation while it is called.

>>> from periplus import Simulation, World
>>> from periplus.navigation import Navigation, Planner
>>> class Direct(Planner):
...     def plan(self, costmap, start, goal):
...         return [start, goal]
>>> sim = Simulation(World.demo(), physics="kinematic")
>>> navigation = Navigation(sim, slam=False, planners={"GridBased": Direct})
>>> navigation.go_to((0.5, 0.0, 0.0)).reached
True
"""

from __future__ import annotations

import enum
from collections.abc import Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Optional, TypeAlias, Union

from periplus import _native

_native.load_numpy()

from periplus._native import CostmapView, GoalOutcome, Navigation  # noqa: E402

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = [
    "Behavior",
    "Controller",
    "CostmapView",
    "GoalOutcome",
    "Navigation",
    "NoValidControl",
    "NoValidPath",
    "Planner",
    "Port",
    "Status",
    "TreeNode",
]


class Status(str, enum.Enum):
    """Status of a behavior or tree node.

    >>> from periplus.navigation import Status
    >>> Status("RUNNING") is Status.RUNNING
    True
    """

    RUNNING = "RUNNING"
    """Not finished."""
    SUCCESS = "SUCCESS"
    """Finished with success."""
    FAILURE = "FAILURE"
    """Finished with failure."""
    SKIPPED = "SKIPPED"
    """Not executed; for tree nodes only."""


class NoValidPath(Exception):
    """Raised by a planner that finds no path: error code ``NO_VALID_PATH``. Other exceptions are ``UNKNOWN``."""


class NoValidControl(Exception):
    """Raised by a controller without a valid velocity in this cycle: the server waits for ``failure_tolerance``, and
    then ends the goal with ``NO_VALID_CONTROL``. Other exceptions end it at once with ``UNKNOWN``."""


PlanarPose: TypeAlias = tuple[float, float, float]
"""Pose on the floor: x, y [m] and yaw [rad]."""

Velocity: TypeAlias = tuple[float, float, float]
"""Velocity in the base frame: vx, vy [m/s] and wz [rad/s]."""

BehaviorResult: TypeAlias = Union[Status, tuple[Status, Union[Velocity, str]]]
"""Result of a cycle of a behavior."""


class Plugin:
    """Base of plugins: its name and its parameters.

    ``name`` is the group of its parameters, such as ``"GridBased"``; ``parameters`` has the values of that group, with
    dots in the names of nested ones. A list of numbers is a list, another list a text with its values.
    """

    name: str = ""
    parameters: dict[str, Any] = {}

    def configure(self, name: str, parameters: dict[str, Any]) -> None:
        """Take the name and the parameters, once, before anything else is called."""
        self.name = name
        self.parameters = parameters


class Planner(Plugin):
    """A global planner.

    >>> from periplus.navigation import NoValidPath, Planner
    >>> class StraightLine(Planner):
    ...     def plan(self, costmap, start, goal):
    ...         if costmap.cost_at([goal])[0] >= 253:
    ...             raise NoValidPath("the goal is occupied")
    ...         return [start, goal]
    """

    def plan(self, costmap: CostmapView, start: PlanarPose, goal: PlanarPose) -> npt.ArrayLike:
        """Return a path: an array of shape (N, 3) with x, y [m] and yaw [rad] in the frame of the global costmap, from
        ``start`` to ``goal``. Raise ``NoValidPath`` if there is none."""
        raise NotImplementedError


class Controller(Plugin):
    """A controller: follows a path within the local costmap.

    >>> from periplus.navigation import Controller
    >>> class Forward(Controller):
    ...     def compute(self, costmap, pose, velocity, path, goal):
    ...         return (0.2, 0.0, 0.0)
    """

    def compute(
        self,
        costmap: CostmapView,
        pose: PlanarPose,
        velocity: Velocity,
        path: npt.NDArray[np.float64],
        goal: PlanarPose,
    ) -> Velocity:
        """Return the velocity of a cycle in the base frame: (vx, vy, wz) [m/s, m/s, rad/s].

        ``pose``, ``goal`` and ``path`` (shape (N, 3), the part ahead of the robot within the costmap) are in the frame
        of the local costmap; ``velocity`` is the measured one. Raise ``NoValidControl`` if no velocity is safe."""
        raise NotImplementedError

    def set_plan(self, path: npt.NDArray[np.float64]) -> None:
        """Take a new path: shape (N, 3), in its own frame."""

    def set_speed_limit(self, limit: float, is_percentage: bool) -> None:
        """Limit the speed to a percentage of the maximum, or to metres a second; 0 removes the limit."""

    def reset(self) -> None:
        """Forget the state of the motion, as between two goals."""


class Behavior(Plugin):
    """A behavior, which serves an action under its name in ``behavior_plugins``. The tree node of the action calls it:
    ``<Spin server_name="wiggle" spin_dist="1.0"/>``.

    >>> from periplus.navigation import Behavior, Status
    >>> class Wiggle(Behavior):
    ...     action = "Spin"
    ...     def on_cycle(self, elapsed_s, pose):
    ...         if elapsed_s > 2.0:
    ...             return Status.SUCCESS
    ...         return (Status.RUNNING, (0.0, 0.0, 0.5 if elapsed_s < 1.0 else -0.5))
    """

    action: ClassVar[Literal["Spin", "BackUp", "DriveOnHeading", "Wait"]]
    """Action of ``nav2_msgs`` that it serves."""

    def on_run(self, goal: dict[str, Any]) -> None:
        """Start a goal. Its fields are those of the action: ``target_yaw`` [rad]; ``target`` [m] and ``speed`` [m/s];
        ``time`` [s]; ``time_allowance`` [s]."""

    def on_cycle(
        self, elapsed_s: float, pose: PlanarPose
    ) -> Union[BehaviorResult, Generator[npt.ArrayLike, bool, BehaviorResult]]:
        """Execute a cycle, ``elapsed_s`` after the start, with the robot at ``pose`` in the local frame of the server.

        Returns ``(Status.RUNNING, (vx, vy, wz))``, ``Status.SUCCESS`` or ``(Status.FAILURE, text)``. A generator may
        ask whether the robot touches no obstacle at poses of shape (N, 3): ``is_free = yield poses``."""
        raise NotImplementedError

    def on_end(self) -> None:
        """End a goal, also a canceled one."""


@dataclass(frozen=True)
class Port:
    """Port of a tree node.

    ``type`` is its type in C++, such as ``"double"``, ``"int"``, ``"bool"``, ``"string"`` or
    ``"geometry_msgs/PoseStamped"``; empty for any. ``default`` is the text of an input that XML leaves out.

    >>> from periplus.navigation import Port
    >>> Port("level", "double", default="0.2").direction
    'input'
    """

    name: str
    type: str = ""
    direction: Literal["input", "output", "inout"] = "input"
    default: Optional[str] = None


class TreeNode:
    """A node of behavior trees. The name of the class is that of its element in XML.

    >>> from periplus.navigation import Port, Status, TreeNode
    >>> class IsCharged(TreeNode):
    ...     kind = "condition"
    ...     ports = (Port("level", "double", default="0.2"),)
    ...     def tick(self, time_s, ports):
    ...         return Status.SUCCESS if ports["level"] > 0.1 else Status.FAILURE
    """

    kind: ClassVar[Literal["action", "condition", "control", "decorator"]] = "action"
    """Kind of the node."""
    ports: ClassVar[tuple[Port, ...]] = ()
    """Its ports."""

    def tick(
        self, time_s: float, ports: dict[str, Any]
    ) -> Union[Status, Generator[int, Status, Status]]:
        """Execute the node at a time of the simulation.

        ``ports`` has the values of the inputs that have one: bool, int, float, str, or messages of ``periplus.msgs``
        (``PoseStamped``, ``Path``, ``Goals``). Set those of the outputs in it. A control node or decorator is a
        generator that ticks its children: ``status = yield 0`` ticks the first and gets its status."""
        raise NotImplementedError

    def halt(self) -> None:
        """Stop a running node and forget its state."""
