"""Arguments that all environments share: worlds, robot, task, reward, and the spaces that follow from them."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias, Union

import gymnasium
import numpy as np
import numpy.typing as npt

from periplus import LaserScanner, OccupancyGrid, _native

_native.load_numpy()

from periplus._native import NavigationBatch, environment_parameters, generated_world_sdf  # noqa: E402

from periplus.gym.robots import Robot, robot_values  # noqa: E402

World: TypeAlias = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A file, the kind of a generated world, or the parameters of a generated world."""
Action: TypeAlias = Union[Literal["continuous", "discrete"], Sequence[Sequence[float]]]
"""Kind of the actions, or the velocities of each discrete action as fractions of the limits."""
Floats: TypeAlias = npt.NDArray[np.float32]

WORLD_KINDS = ("rooms", "offices", "maze", "cylinders", "caves")
"""Kinds of generated worlds."""

DISCRETE_ACTIONS = {
    2: ((1.0, 0.0), (0.0, 0.5), (0.0, -0.5), (-1.0, 1.0), (-1.0, -1.0)),
    3: ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)),
}
"""Velocities of ``action="discrete"`` as fractions of the limits, by the number of velocities of the drive. Of a
differential drive: straight on, slower with a curve to the left or right, turns at the minimum speed."""


def parameters(name: Literal["robot", "task", "reward", "world"]) -> list[dict[str, Any]]:
    """Parameters of the robot, the task, the reward or the generator of worlds: name, unit, default and text of each.

    >>> from periplus.gym import parameters
    >>> [row["name"] for row in parameters("reward")][:4]
    ['progress', 'goal', 'collision', 'time']
    >>> next(row["default"] for row in parameters("robot") if row["name"] == "lidar_beams")
    360
    """
    return environment_parameters(name)


def world_sdf(kind: str = "rooms", seed: int = 0, **values: Any) -> str:
    """SDF of a generated world, for the ordinary simulation, Gazebo and editors.

    Parameters
    ----------
    kind : {"rooms", "offices", "maze", "cylinders", "caves"}
        Kind of the world.
    seed : int
        Seed; the environments generate the same world with it.
    **values
        Further parameters of the generator; ``parameters("world")`` lists them.

    >>> import pathlib, tempfile
    >>> from periplus import World
    >>> from periplus.gym import world_sdf
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "caves.sdf"
    >>> _ = file.write_text(world_sdf("caves", seed=3, clutter=0.2))
    >>> isinstance(World.load(file), World)
    True
    """
    return generated_world_sdf({"kind": kind, "seed": seed, **values})


def sources_of(world: World | Sequence[World], seeds: Sequence[int] | None) -> list[Any]:
    """Worlds as the native module takes them: paths, and dictionaries of generators."""
    if isinstance(world, (str, os.PathLike, Mapping)):
        worlds: list[World] = [world]
    else:
        worlds = list(world)
    sources: list[Any] = []
    for one in worlds:
        if isinstance(one, str) and one in WORLD_KINDS:
            one = {"kind": one}
        if isinstance(one, Mapping):
            sources.extend({**one, "seed": seed} for seed in (seeds if seeds is not None else [one.get("seed", 0)]))
        elif isinstance(one, str) and os.sep not in one and "." not in one:
            raise ValueError(f"{one!r} is neither a file nor a kind of world; kinds are {', '.join(WORLD_KINDS)}")
        else:
            sources.append(os.fspath(one))
    if seeds is not None and not any(isinstance(source, dict) for source in sources):
        raise ValueError("`world_seeds` is for generated worlds; the world is a file")
    return sources


def sector_minimums(ranges: npt.ArrayLike, count: int) -> npt.NDArray[Any]:
    """Minimum range of the beams in each sector of the lidar: the part ``"sectors"`` of an observation.

    ``ranges`` has the shape (..., beams), the result (..., count). Sector k has the beams from ``k * beams // count``
    to before ``(k + 1) * beams // count``.

    >>> from periplus.gym import sector_minimums
    >>> sector_minimums([3.0, 1.0, 2.0, 5.0, 4.0], 2).tolist()
    [1.0, 2.0]
    """
    array = np.asarray(ranges)
    beams = array.shape[-1]
    if not 0 < count <= beams:
        raise ValueError(f"`count` must be from 1 to the number of beams, {beams}, not {count}")
    starts = np.arange(count) * beams // count
    found: npt.NDArray[Any] = np.minimum.reduceat(array, starts, axis=-1)
    return found


@dataclass
class NavigationArguments:
    """Arguments of an environment."""

    world: World | Sequence[World] = "rooms"
    world_seeds: Sequence[int] | None = None
    robot: Robot | None = None
    observation: Sequence[str] = ("ranges", "goal", "velocity")
    action: Action = "continuous"
    reward: Mapping[str, float] | None = None
    task: Mapping[str, Any] | None = None
    normalize: bool = False
    dict_observation: bool = False
    max_episode_steps: int | None = None
    threads: int = 0

    def __post_init__(self) -> None:
        # Parameters of the robot that differ from the defaults.
        self.given = robot_values(self.robot)

    def robot_values(self) -> dict[str, Any]:
        """All parameters of the robot by name."""
        return {**{row["name"]: row["default"] for row in environment_parameters("robot")}, **self.given}

    def laser_scanner(self) -> LaserScanner:
        """Geometry of the lidar."""
        robot = self.robot_values()
        first, last, beams = robot["lidar_min_angle"], robot["lidar_max_angle"], robot["lidar_beams"]
        # Of a full turn the last beam is before the first.
        steps = beams if last - first > math.tau - 1e-6 else max(beams - 1, 1)
        mount = robot["lidar_x"], robot["lidar_y"], robot["lidar_height"], 0.0, 0.0, robot["lidar_yaw"]
        return LaserScanner(
            first,
            (last - first) / steps,
            range_min=robot["lidar_min_range"],
            range_max=robot["lidar_max_range"],
            base_from_laser=mount,
        )

    def batch(self, count: int, *, agents: int = 1, resets_in_next_step: bool) -> NavigationBatch:
        """The native environments."""
        if isinstance(self.observation, str):
            raise TypeError(f"`observation` must be a list of names: [{self.observation!r}]")
        task = dict(self.task or {})
        task["observation"] = list(self.observation)
        task["normalize"] = self.normalize
        if self.max_episode_steps is not None:
            task["max_steps"] = self.max_episode_steps
        return NavigationBatch(
            sources_of(self.world, self.world_seeds),
            count,
            robot=self.given,
            task=task,
            reward=dict(self.reward or {}),
            agents=agents,
            threads=self.threads,
            resets_in_next_step=resets_in_next_step,
        )


def grid_of(batch: NavigationBatch, environment: int, resolution: float) -> OccupancyGrid:
    """Map of the obstacles of an environment; the inside of obstacles is unknown."""
    _, (x, y), width_m = batch.picture(environment, 1)
    width = max(math.ceil(width_m / resolution), 1)
    picture, _, _ = batch.picture(environment, width)
    is_solid = np.pad(picture[::-1] > 0, 1, constant_values=True)
    neighbours = [is_solid[1 + i : is_solid.shape[0] - 1 + i, 1 + j : is_solid.shape[1] - 1 + j] for i, j in NEIGHBOURS]
    is_inside = np.logical_and.reduce(neighbours)
    cells = np.where(is_inside, -1, np.where(is_solid[1:-1, 1:-1], 100, 0)).astype(np.int8)
    return OccupancyGrid(cells, width_m / width, (x, y, 0.0))


NEIGHBOURS = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
"""Offsets of the cells around a cell, and its own."""


@dataclass
class Spaces:
    """Spaces of one agent, and the conversions between them and the arrays of the native module."""

    observation: gymnasium.Space[Any]
    action: gymnasium.Space[Any]
    parts: dict[str, slice]
    size: int
    is_dict: bool
    table: Floats | None = field(default=None)

    @classmethod
    def of(cls, batch: NavigationBatch, arguments: NavigationArguments) -> Spaces:
        """Spaces of a batch."""
        parts: dict[str, slice] = {}
        boxes: dict[str, gymnasium.Space[Any]] = {}
        lows, highs = [], []
        for name, start, low, high in batch.layout:
            parts[name] = slice(start, start + len(low))
            boxes[name] = gymnasium.spaces.Box(low, high, dtype=np.float32)
            lows.append(low)
            highs.append(high)
        observation: gymnasium.Space[Any]
        if arguments.dict_observation:
            observation = gymnasium.spaces.Dict(boxes)
        else:
            observation = gymnasium.spaces.Box(np.concatenate(lows), np.concatenate(highs), dtype=np.float32)
        size = batch.action_size
        action: gymnasium.Space[Any]
        table = None
        if arguments.action == "continuous":
            action = gymnasium.spaces.Box(-1.0, 1.0, (size,), np.float32)
        else:
            words = DISCRETE_ACTIONS[size] if arguments.action == "discrete" else arguments.action
            if isinstance(words, str):
                raise ValueError(f'`action` must be "continuous", "discrete" or a table, not {words!r}')
            table = np.asarray(words, np.float32)
            if table.ndim != 2 or table.shape[1] != size or len(table) == 0:
                raise ValueError(f"`action` must be a table of the shape (actions, {size}), not {table.shape}")
            action = gymnasium.spaces.Discrete(len(table))
        return cls(observation, action, parts, batch.observation_size, arguments.dict_observation, table)

    def observed(self, flat: Floats) -> Any:
        """An observation, or a batch of them, from its array."""
        if self.is_dict:
            return {name: flat[..., part] for name, part in self.parts.items()}
        return flat

    def commanded(self, action: Any, rows: int) -> Floats:
        """Actions as the native module takes them."""
        if self.table is None:
            return np.ascontiguousarray(action, np.float32).reshape(rows, -1)
        index = np.asarray(action).reshape(rows)
        if index.dtype.kind not in "iu" or (index < 0).any() or (index >= len(self.table)).any():
            raise ValueError(f"an action must be an integer from 0 to {len(self.table) - 1}, not {action!r}")
        chosen: Floats = self.table[index]
        return chosen
