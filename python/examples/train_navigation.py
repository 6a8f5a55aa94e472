"""Trains a policy that drives a robot with a lidar to goals, by proximal policy optimization in numpy.

    pip install 'periplus[gym]' onnx
    python train_navigation.py --minutes 15 --out policy

Environments are generated worlds, a few hundred on one machine at a time. The policy sees the nearest obstacle in each of
72 sectors of a lidar of 360 beams, the goal and its velocity, and commands the velocity. The robot has the footprint and
the limits of sam_bot (``robots/sam_bot``). Afterwards the policy drives in 100 worlds that it has never seen, and is
written to ``policy.npz``, and to ``policy.onnx`` if the package ``onnx`` is installed. ``drive_policy.py`` drives a
robot with it.

The algorithm is PPO with clipped ratios (Schulman et al. 2017, "Proximal policy optimization algorithms") and
generalized advantage estimation (Schulman et al. 2015, arXiv 1506.02438).
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, TypeAlias

# Products of small matrices are faster in one thread, beside the threads of the environments. Read by numpy's import.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402
import numpy.typing as npt  # noqa: E402

from periplus.gym import NavigateVectorEnv, parameters  # noqa: E402

Floats: TypeAlias = npt.NDArray[np.float32]

ROBOT = {
    "footprint": [[0.21, 0.2], [-0.21, 0.2], [-0.21, -0.2], [0.21, -0.2]],
    "max_speed": 0.6, "min_speed": -0.2, "max_turn_rate": 1.5, "max_acceleration": 1.0, "max_turn_acceleration": 4.0,
    "lidar_beams": 360, "lidar_max_range": 4.0,
}  # fmt: skip
TASK = {"min_goal_distance": 2.0, "max_goal_distance": 6.0, "lidar_sectors": 72}
REWARD = {"progress": 2.0, "goal": 8.0, "collision": -8.0, "time": -0.02, "turning": -0.02, "clearance": -0.1}
NEAREST = np.float32(0.02)
"""Range below which all obstacles are the same, as a fraction of the maximum range."""
PARAMETERS: tuple[Literal["robot", "task"], ...] = "robot", "task"
KINDS = ("caves", "cylinders")
HIDDEN = 96, 96
"""Sizes of the layers of policy and critic."""
TRAINING_SEEDS = range(100)
EVALUATION_SEEDS = range(10_000, 10_050)


def make_environments(count: int, worlds: list[dict[str, Any]]) -> NavigateVectorEnv:
    """Environments of the task in these worlds."""
    return NavigateVectorEnv(
        count, world=worlds, robot=ROBOT, task=TASK, reward=REWARD, normalize=True, max_episode_steps=300,
        observation=["sectors", "goal", "velocity"],
    )  # fmt: skip


def features(observations: Floats) -> Floats:
    """Inputs of the networks: logarithms of the ranges, so that near obstacles differ as much as far ones, and the rest."""
    count = TASK["lidar_sectors"]
    ranges = np.log(np.maximum(observations[:, :count], NEAREST)) / np.float32(-np.log(NEAREST))
    return np.concatenate([ranges + 1.0, observations[:, count:]], axis=1)


@dataclass
class Network:
    """Perceptron with tanh between its layers."""

    weights: list[Floats]
    biases: list[Floats]

    @classmethod
    def random(cls, sizes: list[int], last_gain: float, random: np.random.Generator) -> Network:
        """Orthogonal weights (Saxe et al. 2013), and biases of zero."""
        weights, biases = [], []
        for index, (inputs, outputs) in enumerate(zip(sizes, sizes[1:])):
            gain = last_gain if index == len(sizes) - 2 else 2**0.5
            square, _ = np.linalg.qr(random.normal(size=(max(inputs, outputs), min(inputs, outputs))))
            matrix = square if inputs >= outputs else square.T
            weights.append((gain * matrix).astype(np.float32))
            biases.append(np.zeros(outputs, np.float32))
        return cls(weights, biases)

    def forward(self, inputs: Floats) -> list[Floats]:
        """Values of all layers, from the inputs to the outputs."""
        values = [inputs]
        for index, (weight, bias) in enumerate(zip(self.weights, self.biases)):
            linear = values[-1] @ weight + bias
            values.append(linear if index == len(self.weights) - 1 else np.tanh(linear))
        return values

    def __call__(self, inputs: Floats) -> Floats:
        return self.forward(inputs)[-1]

    def gradients(self, values: list[Floats], slopes: Floats) -> list[Floats]:
        """Gradients of the weights and biases, layer by layer, from the slopes of the loss at the outputs."""
        found: list[Floats] = []
        for index in reversed(range(len(self.weights))):
            found[:0] = [values[index].T @ slopes, slopes.sum(axis=0)]
            if index:
                slopes = (slopes @ self.weights[index].T) * (1.0 - values[index] ** 2)
        return found

    def parameters(self) -> list[Floats]:
        """Weights and biases, layer by layer."""
        return [array for pair in zip(self.weights, self.biases) for array in pair]


@dataclass
class Adam:
    """Adam (Kingma, Ba 2014, arXiv 1412.6980) with gradients limited to a norm of 0.5."""

    parameters: list[Floats]
    means: list[Floats] = field(init=False)
    squares: list[Floats] = field(init=False)
    steps: int = 0

    def __post_init__(self) -> None:
        self.means = [np.zeros_like(array) for array in self.parameters]
        self.squares = [np.zeros_like(array) for array in self.parameters]

    def update(self, gradients: list[Floats], rate: float) -> None:
        """Changes the parameters in place."""
        self.steps += 1
        norm = float(np.sqrt(sum(float((gradient**2).sum()) for gradient in gradients)))
        scale = min(1.0, 0.5 / (norm + 1e-8))
        rate *= (1.0 - 0.999**self.steps) ** 0.5 / (1.0 - 0.9**self.steps)
        for array, gradient, mean, square in zip(self.parameters, gradients, self.means, self.squares):
            gradient = gradient * scale
            mean += 0.1 * (gradient - mean)
            square += 0.001 * (gradient**2 - square)
            array -= rate * mean / (np.sqrt(square) + 1e-5)


@dataclass
class Rollout:
    """Steps of all environments: arrays of the shape (steps, environments, ...)."""

    observations: Floats
    actions: Floats
    log_probabilities: Floats
    advantages: Floats
    returns: Floats
    is_valid: npt.NDArray[np.bool_]


def log_probability(actions: Floats, means: Floats, log_deviations: Floats) -> Floats:
    """Logarithm of the density of a normal distribution, without its constant."""
    scaled = (actions - means) / np.exp(log_deviations)
    summed: Floats = -(0.5 * scaled**2 + log_deviations).sum(axis=-1)
    return summed


class Trainer:
    """Proximal policy optimization."""

    def __init__(self, envs: NavigateVectorEnv, seed: int, steps: int) -> None:
        self.envs = envs
        self.random = np.random.default_rng(seed)
        (inputs,), (outputs,) = envs.single_observation_space.shape or (0,), envs.single_action_space.shape or (0,)
        self.policy = Network.random([inputs, *HIDDEN, outputs], 0.01, self.random)
        self.critic = Network.random([inputs, *HIDDEN, 1], 1.0, self.random)
        self.log_deviations = np.full(outputs, -0.5, np.float32)
        self.policy_adam = Adam([*self.policy.parameters(), self.log_deviations])
        self.critic_adam = Adam(self.critic.parameters())
        self.steps = steps
        self.observed = features(envs.reset(seed=seed)[0])
        self.was_end = np.zeros(envs.num_envs, np.bool_)
        self.outcomes: list[bool] = []

    def collect(self) -> Rollout:
        """Drives for some steps."""
        shape, gamma, decay = (self.steps, self.envs.num_envs), 0.99, 0.95
        observations = np.empty((*shape, self.observed.shape[1]), np.float32)
        actions = np.empty((*shape, len(self.log_deviations)), np.float32)
        log_probabilities, values, next_values = (np.empty(shape, np.float32) for _ in range(3))
        rewards, is_end = np.empty(shape, np.float32), np.empty(shape, np.bool_)
        is_valid = np.empty(shape, np.bool_)
        for step in range(self.steps):
            observations[step], is_valid[step] = self.observed, ~self.was_end
            means = self.policy(self.observed)
            noise = self.random.standard_normal(means.shape, np.float32)
            actions[step] = means + np.exp(self.log_deviations) * noise
            log_probabilities[step] = log_probability(actions[step], means, self.log_deviations)
            values[step] = self.critic(self.observed)[:, 0]
            observed, rewards[step], ends, cuts, infos = self.envs.step(np.clip(actions[step], -1.0, 1.0))
            self.observed = features(observed)
            # The step after an end resets: the observation here is still the last one of the episode.
            next_values[step] = self.critic(self.observed)[:, 0] * ~ends
            is_end[step] = self.was_end = ends | cuts
            self.outcomes.extend(infos["is_success"][self.was_end].tolist())
        advantages, running = np.empty(shape, np.float32), np.zeros(shape[1], np.float32)
        for step in reversed(range(self.steps)):
            difference = rewards[step] + gamma * next_values[step] - values[step]
            running = difference + gamma * decay * running * ~is_end[step]
            advantages[step] = running
        return Rollout(observations, actions, log_probabilities, advantages, advantages + values, is_valid)

    def learn(self, rollout: Rollout, rate: float, epochs: int = 4, batch: int = 2048) -> None:
        """Improves policy and critic with the steps of a rollout."""
        valid = rollout.is_valid.ravel()
        flat = [
            array.reshape(len(valid), -1)[valid]
            for array in (rollout.observations, rollout.actions, rollout.log_probabilities, rollout.advantages, rollout.returns)
        ]
        for _ in range(epochs):
            order = self.random.permutation(len(flat[0]))
            for start in range(0, len(order), batch):
                chosen = order[start : start + batch]
                observations, actions, before, advantages, returns = (array[chosen] for array in flat)
                advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
                self.improve_policy(observations, actions, before[:, 0], advantages[:, 0], rate)
                layers = self.critic.forward(observations)
                slopes = (layers[-1] - returns) / np.float32(len(chosen))
                self.critic_adam.update(self.critic.gradients(layers, slopes), rate)

    def improve_policy(
        self, observations: Floats, actions: Floats, before: Floats, advantages: Floats, rate: float
    ) -> None:
        """One step along the gradient of the clipped objective and of the entropy."""
        layers = self.policy.forward(observations)
        means, deviations = layers[-1], np.exp(self.log_deviations)
        ratios = np.exp(log_probability(actions, means, self.log_deviations) - before)
        is_clipped = np.where(advantages > 0.0, ratios > 1.2, ratios < 0.8)
        # Slope of the loss along the logarithm of the probability of each action.
        slopes = np.where(is_clipped, 0.0, -ratios * advantages).astype(np.float32)[:, None] / np.float32(len(before))
        scaled = (actions - means) / deviations
        gradients = self.policy.gradients(layers, slopes * scaled / deviations)
        entropy_weight = 0.003
        gradients.append((slopes * (scaled**2 - 1.0)).sum(axis=0) - np.float32(entropy_weight))
        self.policy_adam.update(gradients, rate)
        np.clip(self.log_deviations, -2.5, 0.0, out=self.log_deviations)

    def success_rate(self) -> float:
        """Fraction of the last 1000 episodes that reached their goals."""
        last = self.outcomes[-1000:]
        return sum(last) / max(len(last), 1)


def evaluate(policy: Callable[[Floats], Floats], seeds: range, episodes: int = 5) -> tuple[float, float]:
    """Fraction of goals that the policy reaches, and its mean SPL, in worlds of these seeds, one after the other.

    SPL is the success weighted by path length (Anderson et al. 2018, arXiv 1807.06757).
    """
    successes: list[bool] = []
    weighted: list[float] = []
    for kind in KINDS:
        for seed in seeds:
            envs = make_environments(episodes, [{"kind": kind, "seed": seed}])
            observed, infos = envs.reset(seed=seed)
            shortest = envs.shortest_path_lengths()
            is_done = np.zeros(episodes, np.bool_)
            while not is_done.all():
                observed, _, ends, cuts, infos = envs.step(np.clip(policy(features(observed)), -1.0, 1.0))
                for index in np.flatnonzero((ends | cuts) & ~is_done):
                    is_done[index] = True
                    is_success = bool(infos["is_success"][index])
                    taken = max(float(infos["path_length_m"][index]), float(shortest[index]))
                    successes.append(is_success)
                    weighted.append(is_success * float(shortest[index]) / taken)
    return float(np.mean(successes)), float(np.mean(weighted))


def write_onnx(policy: Network, path: Path) -> None:
    """Writes the policy as ONNX: input ``observation`` as of the environments, output ``action`` from -1 to 1.

    The metadata have the parameters of ``robot`` and ``task`` as JSON, so that a driver needs nothing else.
    """
    import onnx
    from onnx import TensorProto, helper, numpy_helper

    sectors = TASK["lidar_sectors"]
    constants = [
        numpy_helper.from_array(np.array(value), name)
        for name, value in {
            "start": [0], "middle": [sectors], "end": [2**31], "axis": [1], "nearest": NEAREST, "one": np.float32(1.0),
            "log_scale": np.float32(-1.0 / np.log(NEAREST)), "low": np.float32(-1.0), "high": np.float32(1.0),
        }.items()
    ]  # fmt: skip
    nodes = [
        helper.make_node("Slice", ["observation", "start", "middle", "axis"], ["ranges"]),
        helper.make_node("Slice", ["observation", "middle", "end", "axis"], ["others"]),
        helper.make_node("Max", ["ranges", "nearest"], ["limited"]),
        helper.make_node("Log", ["limited"], ["logarithm"]),
        helper.make_node("Mul", ["logarithm", "log_scale"], ["scaled"]),
        helper.make_node("Add", ["scaled", "one"], ["nearness"]),
        helper.make_node("Concat", ["nearness", "others"], ["features"], axis=1),
    ]
    last = "features"
    for index, (weight, bias) in enumerate(zip(policy.weights, policy.biases)):
        constants += [numpy_helper.from_array(weight, f"w{index}"), numpy_helper.from_array(bias, f"b{index}")]
        nodes.append(helper.make_node("Gemm", [last, f"w{index}", f"b{index}"], [f"linear{index}"]))
        last = f"linear{index}"
        if index < len(policy.weights) - 1:
            nodes.append(helper.make_node("Tanh", [last], [f"tanh{index}"]))
            last = f"tanh{index}"
    nodes.append(helper.make_node("Clip", [last, "low", "high"], ["action"]))
    sizes = len(policy.weights[0]), policy.weights[-1].shape[1]
    values = [
        helper.make_tensor_value_info(name, TensorProto.FLOAT, ["batch", size])
        for name, size in zip(("observation", "action"), sizes)
    ]
    graph = helper.make_graph(nodes, "navigation_policy", values[:1], values[1:], constants)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    defaults = {name: {row["name"]: row["default"] for row in parameters(name)} for name in PARAMETERS}
    values_used = {"robot": {**defaults["robot"], **ROBOT}, "task": {**defaults["task"], **TASK}}
    helper.set_model_props(model, {name: json.dumps(value) for name, value in values_used.items()})
    onnx.checker.check_model(model)
    onnx.save(model, str(path))


def read_policy(path: Path) -> Network:
    """Reads a policy that was written as ``.npz``."""
    arrays = np.load(path)
    count = len(arrays.files) // 2
    return Network([arrays[f"weight{at}"] for at in range(count)], [arrays[f"bias{at}"] for at in range(count)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=15.0, help="wall time of the training (default 15)")
    parser.add_argument("--iterations", type=int, default=100_000, help="maximum number of rollouts")
    parser.add_argument("--envs", type=int, default=256, help="number of environments (default 256)")
    parser.add_argument("--seed", type=int, default=0, help="seed of the training (default 0)")
    parser.add_argument("--worlds", type=int, default=50, help="number of evaluation worlds of each kind (default 50)")
    parser.add_argument("--out", type=Path, default=Path("policy"), help="name of the files (default policy)")
    options = parser.parse_args()

    worlds = [{"kind": kind, "seed": seed} for kind in KINDS for seed in TRAINING_SEEDS]
    trainer = Trainer(make_environments(options.envs, worlds), options.seed, steps=64)
    begin = time.monotonic()
    for iteration in range(options.iterations):
        spent = (time.monotonic() - begin) / (60.0 * options.minutes)
        if spent >= 1.0:
            break
        trainer.learn(trainer.collect(), rate=3e-4 * max(1.0 - spent, 0.05))
        if iteration % 20 == 0:
            steps = (iteration + 1) * trainer.steps * options.envs
            rate = steps / (time.monotonic() - begin)
            print(f"{steps:10,} steps, {rate:7,.0f} a second, {trainer.success_rate():5.1%} of goals reached", flush=True)

    options.out.parent.mkdir(parents=True, exist_ok=True)
    names = [f"{kind}{index}" for index in range(len(trainer.policy.weights)) for kind in ("weight", "bias")]
    np.savez(options.out.with_suffix(".npz"), **dict(zip(names, trainer.policy.parameters())))  # type: ignore[arg-type]
    if importlib.util.find_spec("onnx"):
        write_onnx(trainer.policy, options.out.with_suffix(".onnx"))
    else:
        print("no ONNX file: pip install onnx")
    seeds = range(EVALUATION_SEEDS.start, EVALUATION_SEEDS.start + options.worlds)
    success, spl = evaluate(trainer.policy, seeds)
    print(f"{len(KINDS) * len(seeds)} worlds never seen: {success:.1%} of the goals reached, SPL {spl:.2f}")


if __name__ == "__main__":
    main()
