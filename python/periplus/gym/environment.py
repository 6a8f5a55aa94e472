"""One navigation environment: gymnasium's ``Env``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

from periplus.gym.picture import Painter, checked_render_mode
from periplus.gym.robots import Robot
from periplus.gym.settings import Action, NavigationArguments, Spaces, World
from periplus.gym.single import SingleEnv


class NavigateEnv(SingleEnv):
    """Robot with a lidar that drives to a goal: ``gymnasium.make("periplus/Navigate-v0")``.

    Parameters
    ----------
    world : path, str, dict, or a list of them
        A world (SDF), the YAML of a map, a kind of generated world (``"rooms"``, ``"offices"``, ``"maze"``,
        ``"cylinders"``, ``"caves"``), or a dict with the ``kind``, the ``seed`` and further parameters of one
        (``parameters("world")``). Of several worlds each episode draws one.
    world_seeds : sequence of int, optional
        Seeds of the generated worlds: one world for each.
    robot : path or dict, optional
        File of a robot (URDF, xacro, SDF), whose outline and planar lidar are used; or parameters of the robot: footprint,
        drive, limits, lidar (``parameters("robot")``), with the key ``"file"`` for those that are not given.
    observation : list of str
        Parts of an observation, in order. ``"ranges"`` of the lidar [m]; ``"sectors"``: the minimum range in each of
        ``lidar_sectors`` sectors (a parameter of the task) [m]; ``"goal"``: its distance [m], cosine and sine
        of its bearing; ``"velocity"``: forwards (and to the left, omnidirectional) [m/s] and turn rate [rad/s];
        ``"pose"``: x, y [m], cosine and sine of the yaw in the world (the truth); ``"previous_action"``.
    action : {"continuous", "discrete"} or table
        Continuous: -1 to 1 along each axis of the velocity, from the minimum to the maximum. Discrete: one of a table
        of such numbers.
    reward : dict, optional
        Weights of the terms of the reward (``parameters("reward")``); their sum is the reward of a step.
    task : dict, optional
        Further parameters of the task: step period, tolerance and distance of the goal (``parameters("task")``).
    normalize : bool
        Scales observations to -1..1.
    dict_observation : bool
        Observations are dictionaries by part; otherwise one array of all parts.
    max_episode_steps : int, optional
        Number of steps after which an episode is truncated (default 500).
    render_mode : {"rgb_array"}, optional
        Picture from above.

    ``reset(options={"start": (x, y, yaw), "goal": (x, y)})`` sets start or goal. Infos have ``is_success``,
    ``is_collision``, ``goal_distance_m``, ``clearance_m`` (at most the ``clearance_distance`` of the reward) and
    ``path_length_m``. After the end of an episode ``step`` raises ``RuntimeError``.

    >>> from periplus.gym import NavigateEnv
    >>> env = NavigateEnv(world="offices", observation=["ranges", "goal"], robot={"lidar_beams": 36})
    >>> observation, info = env.reset(seed=1)
    >>> observation.shape, info["is_success"]
    ((39,), False)
    >>> observation, reward, terminated, truncated, info = env.step([1.0, 0.0])
    >>> terminated, round(sum(env.reward_terms().values()) - reward, 9)
    (False, 0.0)
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 10}  # type: ignore[misc]

    def __init__(
        self,
        world: World | Sequence[World] = "rooms",
        world_seeds: Sequence[int] | None = None,
        robot: Robot | None = None,
        observation: Sequence[str] = ("ranges", "goal", "velocity"),
        action: Action = "continuous",
        reward: Mapping[str, float] | None = None,
        task: Mapping[str, Any] | None = None,
        normalize: bool = False,
        dict_observation: bool = False,
        max_episode_steps: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        arguments = NavigationArguments(
            world, world_seeds, robot, observation, action, reward, task, normalize, dict_observation,
            max_episode_steps, threads=1,
        )  # fmt: skip
        self.render_mode = checked_render_mode(render_mode)
        self._batch = arguments.batch(1, resets_in_next_step=False)
        self._spaces = Spaces.of(self._batch, arguments)
        self.observation_space = self._spaces.observation
        self.action_space = self._spaces.action
        self._reward = np.zeros(1)
        self._terminated = np.zeros(1, np.bool_)
        self._truncated = np.zeros(1, np.bool_)
        self._is_running = False
        self._has_seed = False
        self._painter = Painter(self._batch)
        self._scanner, self._normalizes = arguments.laser_scanner(), normalize
        self._observed: npt.NDArray[np.float32] | None = None

    @property
    def observation_parts(self) -> dict[str, slice]:
        """Index range of each part of the observation in the array of all parts."""
        return dict(self._spaces.parts)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Starts an episode. With a seed the first of that seed, otherwise the next one."""
        super().reset(seed=seed)
        if seed is None and not self._has_seed:
            seed = int(self.np_random.integers(2**63))
        self._has_seed = True
        start, goal = (options or {}).get("start"), (options or {}).get("goal")
        observed = np.empty((1, self._spaces.size), np.float32)
        self._batch.reset(
            observed,
            None if seed is None else [seed],
            starts=None if start is None else [tuple(start)],
            goals=None if goal is None else [tuple(goal)],
        )
        self._is_running = True
        self._observed = observed[0]
        return self._spaces.observed(observed[0]), self._batch.agent_info(0)

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Drives for one step period."""
        if not self._is_running:
            raise RuntimeError("the episode has ended, or never began: call reset()")
        observed = np.empty((1, self._spaces.size), np.float32)
        commanded = self._spaces.commanded(action, 1)
        self._batch.step(commanded, observed, self._reward, self._terminated, self._truncated)
        terminated, truncated = bool(self._terminated[0]), bool(self._truncated[0])
        self._is_running = not (terminated or truncated)
        self._observed = observed[0]
        info = self._batch.agent_info(0)
        return self._spaces.observed(observed[0]), float(self._reward[0]), terminated, truncated, info

    def reward_terms(self) -> dict[str, float]:
        """Terms of the last reward by name, each multiplied by its weight."""
        return dict(zip(self._batch.reward_term_names, self._batch.reward_terms()[0].tolist()))

    @property
    def pose(self) -> tuple[float, float, float]:
        """Pose of the robot in the world: x [m], y [m], yaw [rad]. The truth."""
        x, y, yaw = self._batch.poses()[0].tolist()
        return x, y, yaw

    @property
    def goal(self) -> tuple[float, float]:
        """Goal in the world: x, y [m]."""
        x, y = self._batch.goals()[0].tolist()
        return x, y

    def ranges(self) -> npt.NDArray[np.float32]:
        """Ranges of the last observation [m], infinite where nothing was hit; its parts must have ``"ranges"``."""
        if self._observed is None:
            raise RuntimeError("the environment has not been reset: call reset() first")
        scale = self._scanner.range_max if self._normalizes else 1.0
        ranges = self._observed[self._spaces.parts["ranges"]] * np.float32(scale)
        far = np.float32(self._scanner.range_max) * np.float32(1.0 - 1e-6)
        found: npt.NDArray[np.float32] = np.where(ranges < far, ranges, np.float32(np.inf))
        return found

    def shortest_path_length(self) -> float:
        """Length of the shortest path from start to goal through free cells [m]; NaN if there is none."""
        return float(self._batch.shortest_paths()[0])

    def obstacles(self) -> list[npt.NDArray[np.float64]]:
        """Obstacles: corners of polygons, shape (N, 2), and circles as x, y, radius, shape (3,) [m]."""
        return self._batch.obstacles(0)

    def render(self) -> npt.NDArray[np.uint8] | None:
        """Picture from above, uint8, shape (height, width, 3), in the render mode ``"rgb_array"``."""
        if self.render_mode is None:
            gymnasium.logger.warn('render() without a render mode; use make(..., render_mode="rgb_array")')
            return None
        return self._painter.paint(0, [0])
