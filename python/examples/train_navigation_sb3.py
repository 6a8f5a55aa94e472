"""Trains the policy of ``train_navigation.py`` with stable-baselines3.

    pip install 'periplus[gym]' stable-baselines3
    python train_navigation_sb3.py --minutes 15 --out policy_sb3

Environments, robot, reward and evaluation are those of ``train_navigation.py``. ``PeriplusVecEnv`` is the adapter that
stable-baselines3 needs, for scripts of your own.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecEnv
from train_navigation import EVALUATION_SEEDS, KINDS, TRAINING_SEEDS, evaluate, features, make_environments

from periplus.gym import NavigateVectorEnv


class PeriplusVecEnv(VecEnv):
    """Environments of Periplus for stable-baselines3, which resets in the step that ends an episode."""

    def __init__(self, envs: NavigateVectorEnv) -> None:
        self.envs = envs
        self.actions: Any = None
        space = envs.single_observation_space
        inputs = features(np.zeros((1, *(space.shape or ())), np.float32)).shape[1]
        super().__init__(
            envs.num_envs,
            gymnasium.spaces.Box(-2.0, 2.0, (inputs,), np.float32),
            envs.single_action_space,
        )
        self.seeds: list[int] | None = None

    def reset(self) -> Any:
        observations, _ = self.envs.reset(seed=self.seeds)
        self.seeds = None
        return features(observations)

    def step_async(self, actions: Any) -> None:
        self.actions = actions

    def step_wait(self) -> Any:
        observations, rewards, terminated, truncated, values = self.envs.step(np.clip(self.actions, -1.0, 1.0))
        observations, ends = features(observations), terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        if ends.any():
            for index in np.flatnonzero(ends):
                infos[index] = {
                    "terminal_observation": observations[index].copy(),
                    "TimeLimit.truncated": bool(truncated[index] and not terminated[index]),
                    "is_success": bool(values["is_success"][index]),
                }
            first, _ = self.envs.reset(options={"reset_mask": ends})
            observations[ends] = features(first)[ends]
        return observations, rewards.astype(np.float32), ends, infos

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        self.seeds = None if seed is None else [seed + index for index in range(self.num_envs)]
        return self.seeds or [None] * self.num_envs

    def close(self) -> None:
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self.envs, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise NotImplementedError("the environments share their settings; make others")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        raise NotImplementedError(f"call `{method_name}` of `envs`, which is for all environments")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        return [False] * len(list(self._get_indices(indices)))


class Clock(BaseCallback):
    """Ends the training after a time, and reports."""

    def __init__(self, minutes: float) -> None:
        super().__init__()
        self.seconds, self.begin, self.outcomes = 60.0 * minutes, time.monotonic(), [False]

    def _on_step(self) -> bool:
        self.outcomes.extend(info["is_success"] for info in self.locals["infos"] if "is_success" in info)
        return time.monotonic() - self.begin < self.seconds

    def _on_rollout_end(self) -> None:
        spent = time.monotonic() - self.begin
        last = self.outcomes[-1000:]
        rate = self.num_timesteps / spent
        print(f"{self.num_timesteps:10,} steps, {rate:7,.0f} a second, {sum(last) / len(last):5.1%} of goals reached", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=15.0, help="wall time of the training (default 15)")
    parser.add_argument("--envs", type=int, default=256, help="number of environments (default 256)")
    parser.add_argument("--seed", type=int, default=0, help="seed of the training (default 0)")
    parser.add_argument("--worlds", type=int, default=50, help="number of evaluation worlds of each kind (default 50)")
    parser.add_argument("--out", type=Path, default=Path("policy_sb3"), help="name of the file (default policy_sb3)")
    options = parser.parse_args()

    worlds = [{"kind": kind, "seed": seed} for kind in KINDS for seed in TRAINING_SEEDS]
    envs = PeriplusVecEnv(make_environments(options.envs, worlds))
    model = PPO(
        "MlpPolicy", envs, n_steps=64, batch_size=2048, n_epochs=4, learning_rate=3e-4, gamma=0.99, gae_lambda=0.95,
        ent_coef=0.003, seed=options.seed, device="cpu", policy_kwargs={"net_arch": [96, 96], "log_std_init": -0.5},
    )  # fmt: skip
    model.learn(10**9, callback=Clock(options.minutes))
    model.save(options.out)

    def policy(inputs: Any) -> Any:
        return model.predict(inputs, deterministic=True)[0]

    seeds = range(EVALUATION_SEEDS.start, EVALUATION_SEEDS.start + options.worlds)
    success, spl = evaluate(policy, seeds)
    print(f"{len(KINDS) * len(seeds)} worlds never seen: {success:.1%} of the goals reached, SPL {spl:.2f}")


if __name__ == "__main__":
    main()
