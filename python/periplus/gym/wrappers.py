"""Wrappers whose observations come from localization, mapping and costmaps instead of the truth.

>>> from periplus.gym import NavigateEnv
>>> from periplus.gym.wrappers import CostmapObservation
>>> env = CostmapObservation(NavigateEnv(world="offices", robot={"lidar_beams": 90}), size=3.0, resolution=0.1)
>>> observation, info = env.reset(seed=1)
>>> observation["costmap"].shape, sorted(observation)
((30, 30), ['costmap', 'goal', 'ranges', 'velocity'])

All of them measure with the lidar of the environment, so ``"ranges"`` must be a part of its observation, and with its
odometry. That of :class:`~periplus.gym.NavigateEnv` is the motion of the robot with an error of ``odometry_noise``; that
of :class:`~periplus.gym.NavigateSimulationEnv` is the odometry that the robot publishes. Observations are dictionaries;
gymnasium's ``FlattenObservation`` makes one array of them. Wrappers can be put around each other.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from typing import Any, TypeAlias, Union

import gymnasium
import numpy as np
import numpy.typing as npt

from periplus import Amcl, Costmap, OccupancyGrid, Slam
from periplus.gym.environment import NavigateEnv
from periplus.gym.simulated import NavigateSimulationEnv

__all__ = ["AmclObservation", "CostmapObservation", "SlamObservation"]

Pose2: TypeAlias = tuple[float, float, float]
"""x [m], y [m], yaw [rad]."""
UNKNOWN = -1
"""Value of a cell of a map that was not seen."""
UNKNOWN_COST = 255
"""Value of a cell of a costmap that was not seen."""


def composed(a: Pose2, b: Pose2) -> Pose2:
    """The pose b, given in the frame of a, in the frame in which a is given."""
    cosine, sine = math.cos(a[2]), math.sin(a[2])
    return a[0] + cosine * b[0] - sine * b[1], a[1] + sine * b[0] + cosine * b[1], wrapped(a[2] + b[2])


def relative(a: Pose2, b: Pose2) -> Pose2:
    """The pose b in the frame of a."""
    cosine, sine = math.cos(a[2]), math.sin(a[2])
    x, y = b[0] - a[0], b[1] - a[1]
    return cosine * x + sine * y, cosine * y - sine * x, wrapped(b[2] - a[2])


def wrapped(angle: float) -> float:
    """The angle from -pi to pi [rad]."""
    return math.remainder(angle, math.tau)


def around_robot(
    cells: npt.NDArray[Any], resolution: float, origin: Pose2, pose: Pose2, size: float, outside: int
) -> npt.NDArray[Any]:
    """Square part of a grid around the robot, in its frame.

    Row 0 is ``size / 2`` ahead of the robot and column 0 ``size / 2`` to its left; each cell has the value of the nearest
    one of the grid, or ``outside`` beyond it.
    """
    count = max(round(size / resolution), 1)
    offsets = ((count - 1) / 2.0 - np.arange(count)) * resolution
    ahead, left = offsets[:, None], offsets[None, :]
    in_grid = relative(origin, pose)
    cosine, sine = math.cos(in_grid[2]), math.sin(in_grid[2])
    columns = np.floor((in_grid[0] + cosine * ahead - sine * left) / resolution).astype(np.int64)
    rows = np.floor((in_grid[1] + sine * ahead + cosine * left) / resolution).astype(np.int64)
    is_inside = (rows >= 0) & (rows < cells.shape[0]) & (columns >= 0) & (columns < cells.shape[1])
    found = np.full((count, count), outside, cells.dtype)
    found[is_inside] = cells[rows[is_inside], columns[is_inside]]
    return found


class Odometry:
    """Pose of the robot in a frame that begins at its start and drifts."""

    def __init__(self) -> None:
        self.odom_from_base: Pose2 = (0.0, 0.0, 0.0)

    def reset(self, seed: int) -> None:
        """Begins an episode."""
        raise NotImplementedError

    def measure(self) -> None:
        """Updates the pose after a step."""
        raise NotImplementedError


class NoisyMotion(Odometry):
    """Odometry of a kinematic robot: its motion, each part with an error in proportion."""

    def __init__(self, env: NavigateEnv, noise: float) -> None:
        super().__init__()
        self._env, self._noise = env, noise
        self._random = np.random.default_rng(0)
        self._truth: Pose2 = (0.0, 0.0, 0.0)

    def reset(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._truth, self.odom_from_base = self._env.pose, (0.0, 0.0, 0.0)

    def measure(self) -> None:
        truth = self._env.pose
        factors = 1.0 + self._noise * self._random.standard_normal(3)
        x, y, yaw = (part * float(factor) for part, factor in zip(relative(self._truth, truth), factors))
        self.odom_from_base = composed(self.odom_from_base, (x, y, yaw))
        self._truth = truth


class PublishedOdometry(Odometry):
    """Odometry that a simulated robot publishes, at the time of its last scan."""

    def __init__(self, env: NavigateSimulationEnv, topic: str | None) -> None:
        super().__init__()
        self._env = env
        self._first: Pose2 | None = None
        self._messages: deque[tuple[float, Pose2]] = deque(maxlen=64)
        types = {name: kind for name, kind in env.simulation.topics.items() if kind.endswith("Odometry")}
        if topic is None:
            if len(types) != 1:
                raise ValueError(f"name the topic of the odometry, `odom_topic`; there are: {', '.join(types) or 'none'}")
            (topic,) = types
        self._topic = topic
        self._subscription = env.simulation.subscribe(topic, self._heard)

    def reset(self, seed: int) -> None:
        self._first = None
        self.measure()

    def measure(self) -> None:
        if not self._messages:
            raise RuntimeError(f"the robot has published no odometry on {self._topic}")
        time_s = self._env.scan_time
        times = [time for time, _ in self._messages]
        after = next((index for index, time in enumerate(times) if time >= time_s), len(times) - 1)
        before = max(after - 1, 0)
        (t0, from_pose), (t1, to_pose) = self._messages[before], self._messages[after]
        fraction = min(max((time_s - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 1.0
        x, y, yaw = (fraction * part for part in relative(from_pose, to_pose))
        pose = composed(from_pose, (x, y, yaw))
        self._first = pose if self._first is None else self._first
        self.odom_from_base = relative(self._first, pose)

    def _heard(self, message: Any) -> None:
        stamp, pose = message.header.stamp, message.pose.pose
        time_s = stamp.sec + 1e-9 * stamp.nanosec
        if self._messages and time_s < self._messages[-1][0]:
            # The simulation was reset.
            self._messages.clear()
        turn = pose.orientation
        yaw = math.atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y**2 + turn.z**2))
        self._messages.append((time_s, (pose.position.x, pose.position.y, yaw)))


class LidarWrapper(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Environment whose observations are dictionaries with further parts, computed from scans and odometry."""

    def __init__(
        self,
        env: gymnasium.Env[Any, Any],
        odometry_noise: float = 0.02,
        odom_topic: str | None = None,
    ) -> None:
        super().__init__(env)
        base = env.unwrapped
        if not isinstance(base, (NavigateEnv, NavigateSimulationEnv)):
            raise TypeError(f"{type(self).__name__} is for the environments of periplus.gym, not {type(base).__name__}")
        if "ranges" not in base.observation_parts:
            raise ValueError(f'{type(self).__name__} needs "ranges" in the observation of the environment')
        self._base = base
        self._odometry: Odometry
        if isinstance(base, NavigateEnv):
            self._odometry = NoisyMotion(base, odometry_noise)
        else:
            self._odometry = PublishedOdometry(base, odom_topic)
        self._steps = 0
        parts = dict(self._parts_of_space())
        parts.update(self.further_spaces())
        self.observation_space = gymnasium.spaces.Dict(parts)

    def further_spaces(self) -> Mapping[str, gymnasium.Space[Any]]:
        """Spaces of the parts that are added or replaced."""
        raise NotImplementedError

    def begin(self) -> None:
        """Begins an episode."""
        raise NotImplementedError

    def measured(self, odom_from_base: Pose2, time_s: float) -> Mapping[str, npt.NDArray[Any]]:
        """Parts that are added or replaced, after a scan at this pose of the odometry."""
        raise NotImplementedError

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Starts an episode."""
        observation, info = self.env.reset(seed=seed, options=options)
        self._steps = 0
        self._odometry.reset(int(self._base.np_random.integers(2**31)))
        self.begin()
        return self._extended(observation), info

    def step(self, action: Any) -> tuple[dict[str, Any], Any, bool, bool, dict[str, Any]]:
        """Drives for one step period."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        self._steps += 1
        self._odometry.measure()
        return self._extended(observation), reward, terminated, truncated, info

    def goal_seen_from(self, pose: Pose2, goal: tuple[float, float]) -> npt.NDArray[np.float32]:
        """The part ``"goal"`` for a pose and a goal in one frame."""
        x, y, _ = relative(pose, (goal[0], goal[1], 0.0))
        distance, bearing = math.hypot(x, y), math.atan2(y, x)
        if self._base.is_normalized:
            distance = min(distance / 10.0, 1.0)
        return np.array([distance, math.cos(bearing), math.sin(bearing)], np.float32)

    def _parts_of_space(self) -> Mapping[str, gymnasium.Space[Any]]:
        space = self.env.observation_space
        if isinstance(space, gymnasium.spaces.Dict):
            return space.spaces
        if not isinstance(space, gymnasium.spaces.Box) or space.shape != self._base.observation_space.shape:
            raise TypeError(f"{type(self).__name__} goes around the environment itself, before other wrappers")
        parts = self._base.observation_parts.items()
        return {name: gymnasium.spaces.Box(space.low[part], space.high[part]) for name, part in parts}

    def _extended(self, observation: Any) -> dict[str, Any]:
        if not isinstance(observation, dict):
            observation = {name: observation[part] for name, part in self._base.observation_parts.items()}
        time_s = self._steps * self._base.step_period
        return {**observation, **self.measured(self._odometry.odom_from_base, time_s)}


def pose_box() -> gymnasium.spaces.Box:
    """Space of a pose: x, y [m], cosine and sine of the yaw."""
    high = np.array([1e6, 1e6, 1.0, 1.0], np.float32)
    return gymnasium.spaces.Box(-high, high)


def pose_array(pose: Pose2) -> npt.NDArray[np.float32]:
    """A pose as part of an observation."""
    return np.array([pose[0], pose[1], math.cos(pose[2]), math.sin(pose[2])], np.float32)


class AmclObservation(LidarWrapper):
    """Pose of the robot from AMCL in a map, in the observation.

    Adds ``"estimated_pose"``: x, y [m], cosine and sine of the yaw in the map; and ``"pose_deviation"``: standard
    deviations of x, y [m] and yaw [rad]. ``"goal"`` is that seen from the estimate. AMCL begins at the true start.

    Parameters
    ----------
    env : gymnasium.Env
        :class:`NavigateEnv` or :class:`NavigateSimulationEnv`, or one of these wrappers around it.
    grid : OccupancyGrid, optional
        Map; that of the obstacles of the world if left out.
    odometry_noise : float
        Standard deviation of each measured motion as a fraction of it; for :class:`NavigateEnv`.
    odom_topic : str, optional
        Topic of the odometry; for :class:`NavigateSimulationEnv` (default: the only one there is).
    **parameters
        Parameters of :class:`periplus.Amcl`.

    >>> from periplus.gym import NavigateEnv
    >>> from periplus.gym.wrappers import AmclObservation
    >>> env = AmclObservation(NavigateEnv(world="rooms", robot={"lidar_beams": 90}))
    >>> observation, info = env.reset(seed=1)
    >>> observation["estimated_pose"].shape, observation["pose_deviation"].shape
    ((4,), (3,))
    """

    def __init__(
        self,
        env: gymnasium.Env[Any, Any],
        grid: OccupancyGrid | None = None,
        odometry_noise: float = 0.02,
        odom_topic: str | None = None,
        **parameters: Any,
    ) -> None:
        self._grid, self._parameters = grid, parameters
        self._amcl: Amcl | None = None
        super().__init__(env, odometry_noise, odom_topic)

    def further_spaces(self) -> Mapping[str, gymnasium.Space[Any]]:
        return {"estimated_pose": pose_box(), "pose_deviation": gymnasium.spaces.Box(0.0, 1e6, (3,), np.float32)}

    def begin(self) -> None:
        # The worlds of the episodes can differ.
        grid = self._grid if self._grid is not None else self._base.map()
        self._amcl = Amcl(grid, scanner=self._base.laser_scanner, **self._parameters)
        self._amcl.set_initial_pose(self._base.pose)

    def measured(self, odom_from_base: Pose2, time_s: float) -> Mapping[str, npt.NDArray[Any]]:
        assert self._amcl is not None
        estimate = self._amcl.update(self._base.ranges(), odom_from_base, time_s=time_s)
        pose, covariance = estimate.pose, estimate.pose_covariance
        # Lost: the last known pose is no estimate. The deviation says so.
        map_from_base = (0.0, 0.0, 0.0) if pose is None else (pose.x, pose.y, pose.yaw)
        deviation = np.full(3, 1e6) if covariance is None else np.sqrt(np.diag(covariance)[[0, 1, -1]])
        return {
            "estimated_pose": pose_array(map_from_base),
            "pose_deviation": np.minimum(deviation, 1e6).astype(np.float32),
            "goal": self.goal_seen_from(map_from_base, self._base.goal),
        }


class SlamObservation(LidarWrapper):
    """Map and pose from SLAM in the observation.

    Adds ``"map"``: occupancy in percent around the robot and in its frame, -1 where nothing was seen, int8, shape
    (size / resolution, size / resolution), row 0 ahead, column 0 to the left; and ``"estimated_pose"``: x, y [m], cosine and
    sine of the yaw in the map, which begins at the start. ``"goal"`` is that seen from the estimate.

    Parameters
    ----------
    env : gymnasium.Env
        :class:`NavigateEnv` or :class:`NavigateSimulationEnv`, or one of these wrappers around it.
    size : float
        Side of the part of the map [m].
    odometry_noise, odom_topic
        As those of :class:`AmclObservation`.
    **parameters
        Parameters of :class:`periplus.Slam`; ``resolution`` is that of the map (default 0.05 m).
    """

    def __init__(
        self,
        env: gymnasium.Env[Any, Any],
        size: float = 6.0,
        odometry_noise: float = 0.02,
        odom_topic: str | None = None,
        **parameters: Any,
    ) -> None:
        self._size = size
        self._parameters = {"resolution": 0.05, **parameters}
        self._start: Pose2 = (0.0, 0.0, 0.0)
        self._slam: Slam | None = None
        self._grid: OccupancyGrid | None = None
        super().__init__(env, odometry_noise, odom_topic)

    def further_spaces(self) -> Mapping[str, gymnasium.Space[Any]]:
        count = max(round(self._size / float(self._parameters["resolution"])), 1)
        return {"map": gymnasium.spaces.Box(-1, 100, (count, count), np.int8), "estimated_pose": pose_box()}

    def begin(self) -> None:
        scanner = self._base.laser_scanner
        self._parameters.setdefault("max_laser_range", scanner.range_max)
        self._slam, self._grid = Slam(scanner=scanner, **self._parameters), None
        self._start = self._base.pose

    def measured(self, odom_from_base: Pose2, time_s: float) -> Mapping[str, npt.NDArray[Any]]:
        assert self._slam is not None
        update = self._slam.process(self._base.ranges(), odom_from_base, time_s=time_s)
        if self._grid is None or update.outcome == "inserted":
            self._grid = self._slam.map()
        estimate = self._slam.map_from_base
        pose = estimate.x, estimate.y, estimate.yaw
        x, y, _ = relative(self._start, (*self._base.goal, 0.0))
        grid = self._grid
        return {
            "map": around_robot(grid.cells, grid.resolution_m, grid.origin, pose, self._size, UNKNOWN),
            "estimated_pose": pose_array(pose),
            "goal": self.goal_seen_from(pose, (x, y)),
        }


class CostmapObservation(LidarWrapper):
    """Local costmap of the robot in the observation.

    Adds ``"costmap"``: costs from 0 to 254 around the robot and in its frame, 255 where nothing was seen, uint8, shape
    (size / resolution, size / resolution), row 0 ahead, column 0 to the left. Obstacles are marked and cleared by the lidar
    and inflated, as in Nav2's local costmap.

    Parameters
    ----------
    env : gymnasium.Env
        :class:`NavigateEnv` or :class:`NavigateSimulationEnv`, or one of these wrappers around it.
    size : float
        Side of the costmap [m].
    resolution : float
        Side of a cell [m].
    inflation_radius : float
        Distance from obstacles within which costs are raised [m].
    odometry_noise, odom_topic
        As those of :class:`AmclObservation`.
    **parameters
        Further parameters of :class:`periplus.Costmap`; its obstacle layer must be ``obstacle_layer`` with the source
        ``scan``.
    """

    def __init__(
        self,
        env: gymnasium.Env[Any, Any],
        size: float = 3.0,
        resolution: float = 0.05,
        inflation_radius: float = 0.5,
        odometry_noise: float = 0.02,
        odom_topic: str | None = None,
        **parameters: Any,
    ) -> None:
        self._size, self._resolution = size, resolution
        self._inflation_radius, self._parameters = inflation_radius, parameters
        self._costmap: Costmap | None = None
        super().__init__(env, odometry_noise, odom_topic)

    def further_spaces(self) -> Mapping[str, gymnasium.Space[Any]]:
        count = max(round(self._size / self._resolution), 1)
        return {"costmap": gymnasium.spaces.Box(0, 255, (count, count), np.uint8)}

    def begin(self) -> None:
        # The window contains the square of the robot at any heading.
        side = math.ceil(self._size * math.sqrt(2.0))
        reach = self._base.laser_scanner.range_max
        footprint = self._base.footprint
        outline: dict[str, Any]
        if isinstance(footprint, float):
            outline = {"robot_radius": footprint}
        else:
            outline = {"footprint": str(footprint.tolist())}
        settings = {
            "rolling_window": True,
            "width": side,
            "height": side,
            "resolution": self._resolution,
            **outline,
            "plugins": ["obstacle_layer", "inflation_layer"],
            "obstacle_layer": {
                "plugin": "nav2_costmap_2d::ObstacleLayer",
                "observation_sources": "scan",
                "scan": {
                    "data_type": "LaserScan",
                    "max_obstacle_height": 10.0,
                    "clearing": True,
                    "inf_is_valid": True,
                    "obstacle_max_range": reach,
                    "raytrace_max_range": reach,
                },
            },
            "inflation_layer": {
                "plugin": "nav2_costmap_2d::InflationLayer",
                "inflation_radius": self._inflation_radius,
                "cost_scaling_factor": 3.0,
            },
            **self._parameters,
        }
        self._costmap = Costmap(settings)

    def measured(self, odom_from_base: Pose2, time_s: float) -> Mapping[str, npt.NDArray[Any]]:
        assert self._costmap is not None
        scanner, (x, y, yaw) = self._base.laser_scanner, odom_from_base
        mount = scanner.base_from_laser
        laser = composed(odom_from_base, (mount.x, mount.y, mount.yaw))
        self._costmap.observe_scan(
            "obstacle_layer", "scan", self._base.ranges(), scanner.angle_min, scanner.angle_increment, scanner.range_min,
            scanner.range_max, (laser[0], laser[1], mount.z, 0.0, 0.0, laser[2]), time_s,
        )  # fmt: skip
        self._costmap.update(time_s, (x, y, yaw))
        costs = self._costmap.costs
        origin = (*self._costmap.origin, 0.0)
        return {"costmap": around_robot(costs, self._resolution, origin, odom_from_base, self._size, UNKNOWN_COST)}
