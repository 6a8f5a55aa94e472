"""The scripts that train a policy and drive with it: short trainings, the policy of the package, and its node."""

import importlib
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium", reason="gymnasium is not installed: pip install 'periplus[gym]'")
onnx = pytest.importorskip("onnx", reason="onnx is not installed: pip install onnx")

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
POLICY = EXAMPLES / "navigation_policy.onnx"


@pytest.fixture(scope="module")
def training() -> Iterator[Any]:
    sys.path.insert(0, str(EXAMPLES))
    yield importlib.import_module("train_navigation")
    sys.path.remove(str(EXAMPLES))


def evaluator(path: Path) -> Any:
    from onnx.reference import ReferenceEvaluator

    model = ReferenceEvaluator(str(path))
    return lambda inputs: model.run(None, {"observation": inputs})[0]


def test_a_policy_is_the_same_as_onnx(training: Any, tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    policy = training.Network.random([77, 8, 2], 1.0, random)
    training.write_onnx(policy, tmp_path / "policy.onnx")
    observations = random.random((50, 77)).astype(np.float32)
    expected = np.clip(policy(training.features(observations)), -1.0, 1.0)
    assert np.abs(evaluator(tmp_path / "policy.onnx")(observations) - expected).max() < 1e-5
    properties = {entry.key: entry.value for entry in onnx.load(tmp_path / "policy.onnx").metadata_props}
    assert sorted(properties) == ["robot", "task"]


def test_training_improves_what_it_should(training: Any) -> None:
    envs = training.make_environments(32, [{"kind": "caves", "seed": seed} for seed in range(4)])
    trainer = training.Trainer(envs, seed=3, steps=32)
    rollout = trainer.collect()
    steps = training.Trainer(envs, seed=3, steps=32).collect()
    assert np.array_equal(rollout.actions, steps.actions), "the same seed, the same steps"

    def critic_error() -> float:
        valid = rollout.is_valid
        values = trainer.critic(rollout.observations[valid])[:, 0]
        return float(((values - rollout.returns[valid]) ** 2).mean())

    before = critic_error()
    trainer.learn(rollout, rate=1e-3, batch=256)
    assert critic_error() < 0.9 * before


def test_the_gradients_are_those_of_the_loss(training: Any) -> None:
    random = np.random.default_rng(2)
    network = training.Network.random([3, 4, 1], 1.0, random)
    inputs = random.random((6, 3)).astype(np.float32)

    def loss() -> float:
        return float((network(inputs).astype(float) ** 2).sum() / 2.0)

    layers = network.forward(inputs)
    gradients = network.gradients(layers, layers[-1])
    for array, gradient in zip(network.parameters(), gradients):
        at = tuple(int(random.integers(size)) for size in array.shape)
        step = np.float32(1e-2)
        array[at] += step
        above = loss()
        array[at] -= 2 * step
        slope = (above - loss()) / (2.0 * float(step))
        array[at] += step
        assert slope == pytest.approx(float(gradient[at]), rel=0.02, abs=2e-3)


def test_the_policy_of_the_package_reaches_goals(training: Any) -> None:
    policy = evaluator(POLICY)
    found: list[bool] = []
    for kind in training.KINDS:
        for seed in range(20_000, 20_005):
            envs = training.make_environments(6, [{"kind": kind, "seed": seed}])
            observed, _ = envs.reset(seed=seed)
            is_done = np.zeros(6, np.bool_)
            while not is_done.all():
                observed, _, ends, cuts, infos = envs.step(policy(observed))
                for index in np.flatnonzero((ends | cuts) & ~is_done):
                    is_done[index] = True
                    found.append(bool(infos["is_success"][index]))
    # 90 % and more in hundreds of episodes; of these sixty at most twelve may fail.
    assert len(found) == 60 and sum(found) >= 48, sum(found)


def test_the_policy_drives_a_robot_as_a_node(tmp_path: Path) -> None:
    pytest.importorskip("onnxruntime", reason="onnxruntime is not installed: pip install onnxruntime")
    import periplus

    recording = tmp_path / "run.mcap"
    command = [
        sys.executable, "-m", "periplus", "launch", str(EXAMPLES / "drive_policy.launch.py"), "goal:=[2.5, 1.0]",
        "--duration", "14", "--headless", "--record", str(recording), "--topics", "^/(goal_reached|demo/odom)$",
        "--resource-path", str(EXAMPLES.parents[1]),
    ]  # fmt: skip
    variables = {**os.environ, "PERIPLUS_PYTHON": sys.executable}
    done = subprocess.run(command, cwd=tmp_path, env=variables, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    messages: dict[str, list[Any]] = {"/goal_reached": [], "/demo/odom": []}
    for topic, message, _ in periplus.open_bag(recording):
        messages[topic].append(message)
    assert len(messages["/goal_reached"]) == 1, done.stderr
    last = messages["/demo/odom"][-1].pose.pose.position
    # It stops within 0.3 m of the goal, and a little further for its inertia.
    assert math.hypot(last.x - 2.5, last.y - 1.0) < 0.4
