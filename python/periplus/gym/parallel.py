"""Several robots in one world: PettingZoo's parallel API."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from periplus.gym.picture import Painter, checked_render_mode
from periplus.gym.requirements import require
from periplus.gym.robots import Robot
from periplus.gym.settings import Action, NavigationArguments, Spaces, World

require("pettingzoo", "environments with several robots need PettingZoo: pip install pettingzoo")

from pettingzoo import ParallelEnv  # noqa: E402


class NavigateParallelEnv(ParallelEnv[str, Any, Any]):  # type: ignore[misc]
    """Robots that drive to their goals in one world, see each other with their lidars and can collide.

    Takes the arguments of :class:`NavigateEnv`, and ``agents``, the number of robots. A robot leaves ``agents`` when it
    has reached its goal, has collided or the episode is cut off. A robot at its goal is removed from the world; one
    that has collided stays in it.

    >>> from periplus.gym import NavigateParallelEnv
    >>> env = NavigateParallelEnv(agents=3, world="rooms")
    >>> observations, infos = env.reset(seed=1)
    >>> sorted(observations)
    ['robot_0', 'robot_1', 'robot_2']
    >>> observations, rewards, ends, cuts, infos = env.step({agent: [1.0, 0.0] for agent in env.agents})
    >>> observations["robot_0"].shape
    (365,)
    """

    metadata: ClassVar[dict[str, Any]] = {
        "render_modes": ["rgb_array"],
        "render_fps": 10,
        "name": "periplus_navigate_v0",
        "is_parallelizable": True,
    }

    def __init__(
        self,
        agents: int = 2,
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
        self.possible_agents = [f"robot_{index}" for index in range(agents)]
        self.agents: list[str] = []
        self._batch = arguments.batch(1, agents=agents, resets_in_next_step=False)
        self._spaces = {agent: Spaces.of(self._batch, arguments) for agent in self.possible_agents}
        self.observation_spaces = {agent: spaces.observation for agent, spaces in self._spaces.items()}
        self.action_spaces = {agent: spaces.action for agent, spaces in self._spaces.items()}
        self._has_seed = False
        self._painter = Painter(self._batch)

    def observation_space(self, agent: str) -> Any:
        """Space of the observations of an agent."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """Space of the actions of an agent."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Starts an episode. With a seed the first of that seed, otherwise the next one.

        ``options["starts"]`` and ``options["goals"]`` have a pose and a point for each robot.
        """
        if seed is None and not self._has_seed:
            seed = int(np.random.default_rng().integers(2**63))
        self._has_seed = True
        options = options or {}
        observations = self._array()
        rows = [None if options.get(name) is None else [tuple(row) for row in options[name]] for name in ("starts", "goals")]
        self._batch.reset(observations, None if seed is None else [seed], None, rows[0], rows[1])
        self.agents = list(self.possible_agents)
        return self._by_agent(observations), self._infos()

    def step(
        self, actions: Mapping[str, Any]
    ) -> tuple[dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, Any]]:
        """Drives all robots for one step period."""
        if not self.agents:
            raise RuntimeError("the episode has ended, or never began: call reset()")
        missing = [agent for agent in self.agents if agent not in actions]
        if missing:
            raise ValueError(f"no action for {', '.join(missing)}")
        count = len(self.possible_agents)
        commanded = np.zeros((count, self._batch.action_size), np.float32)
        for index, agent in enumerate(self.possible_agents):
            if agent in self.agents:
                commanded[index] = self._spaces[agent].commanded(actions[agent], 1)
        observations, rewards = self._array(), np.zeros(count)
        ends, cuts = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
        self._batch.step(commanded, observations, rewards, ends, cuts)
        present = {agent: self.possible_agents.index(agent) for agent in self.agents}
        results = (
            self._by_agent(observations),
            {agent: float(rewards[index]) for agent, index in present.items()},
            {agent: bool(ends[index]) for agent, index in present.items()},
            {agent: bool(cuts[index]) for agent, index in present.items()},
            self._infos(),
        )
        self.agents = [agent for agent, index in present.items() if not (ends[index] or cuts[index])]
        return results

    def render(self) -> npt.NDArray[np.uint8] | None:
        """Picture from above, uint8, shape (height, width, 3), in the render mode ``"rgb_array"``."""
        if self.render_mode is None:
            return None
        return self._painter.paint(0, range(len(self.possible_agents)))

    def close(self) -> None:
        """Does nothing: memory is released with the object."""

    def _array(self) -> npt.NDArray[np.float32]:
        return np.empty((len(self.possible_agents), self._batch.observation_size), np.float32)

    def _by_agent(self, observations: npt.NDArray[np.float32]) -> dict[str, Any]:
        return {
            agent: self._spaces[agent].observed(observations[index])
            for index, agent in enumerate(self.possible_agents)
            if agent in self.agents
        }

    def _infos(self) -> dict[str, Any]:
        return {
            agent: self._batch.agent_info(index)
            for index, agent in enumerate(self.possible_agents)
            if agent in self.agents
        }
