"""Many navigation environments: gymnasium's ``VectorEnv``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector.utils import batch_space

from periplus.gym.picture import Painter, checked_render_mode
from periplus.gym.robots import Robot
from periplus.gym.settings import Action, NavigationArguments, Spaces, World


class NavigateVectorEnv(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """Environments of ``periplus/Navigate-v0`` on one scene, stepped by native threads.

    ``gymnasium.make_vec("periplus/Navigate-v0", num_envs=N, vectorization_mode="vector_entry_point", ...)``

    Takes the arguments of :class:`NavigateEnv`, and

    Parameters
    ----------
    num_envs : int
        Number of environments.
    threads : int
        Number of threads; 0 for all cores. Results do not depend on it.
    copy : bool
        Each step returns a new array of observations. Otherwise all steps write into one array, which the next step
        overwrites.

    The autoreset mode is ``NEXT_STEP``: the step after the end of an episode ignores the action, resets the
    environment, and returns reward 0 and both flags False. ``reset(seed=s)`` gives environment ``i`` the seed
    ``s + i``: it then is the environment of ``gymnasium.make`` with that seed, number by number.

    >>> from periplus.gym import NavigateVectorEnv
    >>> envs = NavigateVectorEnv(4, world="caves", threads=2)
    >>> observations, infos = envs.reset(seed=7)
    >>> observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
    >>> observations.shape, terminated.tolist()
    ((4, 365), [False, False, False, False])
    """

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]
        "render_modes": ["rgb_array"],
        "render_fps": 10,
        "autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
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
        threads: int = 0,
        copy: bool = True,
        render_mode: str | None = None,
    ) -> None:
        arguments = NavigationArguments(
            world, world_seeds, robot, observation, action, reward, task, normalize, dict_observation,
            max_episode_steps, threads,
        )  # fmt: skip
        self.render_mode = checked_render_mode(render_mode)
        self.num_envs = num_envs
        self._batch = arguments.batch(num_envs, resets_in_next_step=True)
        self._spaces = Spaces.of(self._batch, arguments)
        self.single_observation_space = self._spaces.observation
        self.single_action_space = self._spaces.action
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._copies = copy
        self._has_seed = False
        # A partial reset keeps the observations of the other environments.
        self._observations = np.zeros((num_envs, self._spaces.size), np.float32)
        self._painter = Painter(self._batch)

    @property
    def observation_parts(self) -> dict[str, slice]:
        """Index range of each part of the observation in the array of all parts."""
        return dict(self._spaces.parts)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Starts an episode in all environments, or in those of ``options["reset_mask"]``.

        A seed for all gives environment ``i`` the seed ``seed + i``; a list has one for each. Without a seed the next
        episodes of the present seeds follow.
        """
        mask = self._mask(options)
        seeds: list[int] | None = None
        if seed is None and not self._has_seed:
            seeds = self.np_random.integers(2**63, size=self.num_envs).tolist()
        elif isinstance(seed, (int, np.integer)):
            super().reset(seed=int(seed))
            seeds = [int(seed) + index for index in range(self.num_envs)]
        elif seed is not None:
            if len(seed) != self.num_envs:
                raise ValueError(f"`seed` has {len(seed)} entries for {self.num_envs} environments")
            drawn = self.np_random.integers(2**63, size=self.num_envs).tolist()
            seeds = [drawn[index] if one is None else int(one) for index, one in enumerate(seed)]
        self._has_seed = True
        options = options or {}
        observations = self._next_array()
        self._batch.reset(
            observations,
            seeds,
            None if mask is None else mask.tolist(),
            self._rows(options, "starts", 3),
            self._rows(options, "goals", 2),
        )
        self._observations = observations
        return self._spaces.observed(observations), self._infos(mask)

    def step(self, actions: Any) -> tuple[Any, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """Drives all robots for one step period; environments whose episode has ended are reset."""
        observations = np.empty_like(self._observations) if self._copies else self._observations
        rewards = np.empty(self.num_envs)
        terminated = np.empty(self.num_envs, np.bool_)
        truncated = np.empty(self.num_envs, np.bool_)
        commanded = self._spaces.commanded(actions, self.num_envs)
        self._batch.step(commanded, observations, rewards, terminated, truncated)
        self._observations = observations
        return self._spaces.observed(observations), rewards, terminated, truncated, self._infos(None)

    def reward_terms(self) -> dict[str, npt.NDArray[np.float64]]:
        """Terms of the last rewards by name, each multiplied by its weight, shape (num_envs,)."""
        return dict(zip(self._batch.reward_term_names, self._batch.reward_terms().T))

    def poses(self) -> npt.NDArray[np.float64]:
        """Poses of the robots in their worlds: x [m], y [m], yaw [rad], shape (num_envs, 3). The truth."""
        return self._batch.poses()

    def goals(self) -> npt.NDArray[np.float64]:
        """Goals in the worlds [m], shape (num_envs, 2)."""
        return self._batch.goals()

    def shortest_path_lengths(self) -> npt.NDArray[np.float64]:
        """Lengths of the shortest paths from starts to goals through free cells [m], shape (num_envs,)."""
        return self._batch.shortest_paths()

    def render(self) -> tuple[npt.NDArray[np.uint8], ...] | None:
        """Pictures from above, one for each environment, in the render mode ``"rgb_array"``."""
        if self.render_mode is None:
            return None
        return tuple(self._painter.paint(index, [index]) for index in range(self.num_envs))

    def _next_array(self) -> npt.NDArray[np.float32]:
        return self._observations.copy() if self._copies else self._observations

    def _infos(self, mask: npt.NDArray[np.bool_] | None) -> dict[str, Any]:
        infos: dict[str, Any] = {}
        for name, values in self._batch.info().items():
            chosen = np.ones(self.num_envs, np.bool_) if mask is None else mask.copy()
            # As of the environments one by one: those that were not reset have no info.
            infos[name] = values if mask is None else np.where(mask, values, np.zeros_like(values))
            infos[f"_{name}"] = chosen
        return infos

    def _mask(self, options: dict[str, Any] | None) -> npt.NDArray[np.bool_] | None:
        if not options or options.get("reset_mask") is None:
            return None
        mask = np.asarray(options["reset_mask"])
        if mask.shape != (self.num_envs,) or mask.dtype != np.bool_ or not mask.any():
            raise ValueError(f'`options["reset_mask"]` must be {self.num_envs} bools, at least one of them True')
        return mask

    def _rows(self, options: dict[str, Any], name: str, columns: int) -> list[Any] | None:
        if options.get(name) is None:
            return None
        rows = np.asarray(options[name], np.float64)
        if rows.shape != (self.num_envs, columns):
            raise ValueError(f'`options["{name}"]` must have the shape ({self.num_envs}, {columns}), not {rows.shape}')
        return [tuple(row) for row in rows.tolist()]
