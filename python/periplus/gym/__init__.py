"""Navigation environments for gymnasium and PettingZoo.

Importing this module registers ``periplus/Navigate-v0``: a robot with a lidar drives to a goal in a world from a file
or from a generator. Many environments share one scene of exact rays and are stepped by native threads:

>>> import gymnasium
>>> import periplus.gym
>>> envs = gymnasium.make_vec("periplus/Navigate-v0", num_envs=8, vectorization_mode="vector_entry_point", world="maze")
>>> observations, infos = envs.reset(seed=0)
>>> observations.shape
(8, 365)
>>> observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
>>> rewards.shape, infos["clearance_m"].shape
((8,), (8,))

The same seeds and actions give the same numbers, at any number of threads.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from periplus.gym.requirements import require

require("gymnasium", "periplus.gym needs gymnasium, version 1.0 or later: pip install 'periplus[gym]'")

import gymnasium  # noqa: E402

from periplus.gym.environment import NavigateEnv  # noqa: E402
from periplus.gym.settings import WORLD_KINDS as WORLD_KINDS  # noqa: E402
from periplus.gym.settings import parameters, sector_minimums, world_sdf  # noqa: E402
from periplus.gym.single import SingleEnv  # noqa: E402
from periplus.gym.vector import NavigateVectorEnv  # noqa: E402

if TYPE_CHECKING:
    from periplus.gym.parallel import NavigateParallelEnv
    from periplus.gym.simulated import NavigateSimulationEnv

__all__ = [
    "NavigateEnv",
    "NavigateParallelEnv",
    "NavigateSimulationEnv",
    "NavigateVectorEnv",
    "SingleEnv",
    "parameters",
    "sector_minimums",
    "world_sdf",
]

ENVIRONMENT_ID = "periplus/Navigate-v0"
"""Name of the environment for ``gymnasium.make`` and ``gymnasium.make_vec``."""

if ENVIRONMENT_ID not in gymnasium.registry:
    gymnasium.register(
        id=ENVIRONMENT_ID,
        entry_point="periplus.gym.environment:NavigateEnv",
        vector_entry_point="periplus.gym.vector:NavigateVectorEnv",
    )

SIMULATION_ID = "periplus/NavigateSimulation-v0"
"""Name of the environment whose robot is simulated with physics."""

if SIMULATION_ID not in gymnasium.registry:
    gymnasium.register(id=SIMULATION_ID, entry_point="periplus.gym.simulated:NavigateSimulationEnv")


def __getattr__(name: str) -> object:
    # PettingZoo is needed for several robots only.
    if name == "NavigateParallelEnv":
        from periplus.gym.parallel import NavigateParallelEnv

        return NavigateParallelEnv
    if name == "NavigateSimulationEnv":
        from periplus.gym.simulated import NavigateSimulationEnv

        return NavigateSimulationEnv
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
