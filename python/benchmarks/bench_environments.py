"""Environments with a lidar of 360 beams: steps per CPU second beside other simulators, and memory.

    pip install 'periplus[gym]' ir-sim vmas mujoco
    python python/benchmarks/bench_environments.py --python irsim-x=OTHER_ENVIRONMENT/bin/python

All drive in one scene: a room of 20 m x 20 m with ten cylinders and ten boxes; range 10 m, step period 0.1 s. Each runs in
a process of its own, turn by turn, so that a busy moment of the machine hits all alike; of each the best turn counts. CPU
seconds are those of all threads of the process. Peers that are not installed are reported and left out. The packages
ir-sim and irsim-x have modules of one name, so one of them needs another environment of Python, see ``--python``.

MuJoCo is measured twice: the rays alone (``mj_multiRay``), and with the motion of a planar robot, ten steps of 0.01 s.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

BEAMS = 360
RANGE_M = 10.0
HALF_SIZE_M = 10.0
STEP_S = 0.1
WORLDS = Path(__file__).resolve().parents[2] / "worlds"


@dataclass(frozen=True)
class Obstacle:
    """A cylinder with a radius, or a box with two sides [m]."""

    x: float
    y: float
    sides: tuple[float, ...]


def scene() -> list[Obstacle]:
    """Obstacles away from the middle, and apart from each other."""
    random = np.random.default_rng(5)
    found: list[Obstacle] = []
    while len(found) < 20:
        x, y = random.uniform(-9.0, 9.0, 2).round(2).tolist()
        is_apart = all(math.hypot(other.x - x, other.y - y) > 2.2 for other in found)
        if math.hypot(x, y) > 3.0 and is_apart:
            size = random.uniform(0.3, 0.7, 2).round(2).tolist()
            found.append(Obstacle(x, y, (size[0],) if len(found) % 2 else (2 * size[0], 2 * size[1])))
    return found


WALLS = [
    Obstacle(0.0, HALF_SIZE_M + 0.1, (2 * HALF_SIZE_M + 0.4, 0.2)),
    Obstacle(0.0, -HALF_SIZE_M - 0.1, (2 * HALF_SIZE_M + 0.4, 0.2)),
    Obstacle(HALF_SIZE_M + 0.1, 0.0, (0.2, 2 * HALF_SIZE_M)),
    Obstacle(-HALF_SIZE_M - 0.1, 0.0, (0.2, 2 * HALF_SIZE_M)),
]


def rate(step: Callable[[], int], seconds: float) -> float:
    """Environment steps per CPU second of this process."""
    step()
    begin, count = time.process_time(), 0
    while time.process_time() - begin < seconds:
        count += step()
    return count / (time.process_time() - begin)


def wall_rate(step: Callable[[], int], seconds: float) -> float:
    """Environment steps per second of wall time."""
    begin, count = time.perf_counter(), 0
    while time.perf_counter() - begin < seconds:
        count += step()
    return count / (time.perf_counter() - begin)


def memory_mb() -> float:
    """Maximum resident memory of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def sdf() -> str:
    """The scene as SDF."""
    parts = []
    for index, one in enumerate(scene() + WALLS):
        if len(one.sides) == 1:
            shape = f"<cylinder><radius>{one.sides[0]}</radius><length>1</length></cylinder>"
        else:
            shape = f"<box><size>{one.sides[0]} {one.sides[1]} 1</size></box>"
        for kind in ("collision", "visual"):
            pose = f"<pose>{one.x} {one.y} 0.5 0 0 0</pose>"
            parts.append(f'<{kind} name="{kind}_{index}">{pose}<geometry>{shape}</geometry></{kind}>')
    link = f'<link name="link">{"".join(parts)}</link>'
    return f'<sdf version="1.9"><world name="bench"><model name="all"><static>true</static>{link}</model></world></sdf>'


def periplus_vector(seconds: float, world: Path | None = None, count: int = 1024, threads: int = 0) -> dict[str, float]:
    """The native vector environment."""
    from periplus.gym import NavigateVectorEnv

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bench.sdf"
        file.write_text(sdf())
        before = memory_mb()
        envs = NavigateVectorEnv(count, world=world or file, robot={"lidar_beams": BEAMS}, threads=threads)
    envs.reset(seed=0)
    random = np.random.default_rng(0)
    actions = random.uniform(-1.0, 1.0, (16, count, 2)).astype(np.float32)
    turn = 0

    def step() -> int:
        nonlocal turn
        turn += 1
        envs.step(actions[turn % 16])
        return count

    step()
    memory = memory_mb() - before
    return {"rate": rate(step, seconds), "wall_rate": wall_rate(step, seconds), "memory_mb": memory}


def periplus_house(seconds: float) -> dict[str, float]:
    """The native vector environment in the house."""
    return periplus_vector(seconds, WORLDS / "house.sdf")


def periplus_single(seconds: float) -> dict[str, float]:
    """One environment, stepped from Python."""
    from periplus.gym import NavigateEnv

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bench.sdf"
        file.write_text(sdf())
        env = NavigateEnv(world=file, robot={"lidar_beams": BEAMS})
    env.reset(seed=0)
    random = np.random.default_rng(0)

    def step() -> int:
        _, _, terminated, truncated, _ = env.step(random.uniform(-1.0, 1.0, 2))
        if terminated or truncated:
            env.reset()
        return 1

    return {"rate": rate(step, seconds)}


def irsim(seconds: float) -> dict[str, float]:
    """ir-sim or irsim-x, whichever is installed, with one robot on a circle."""
    import irsim as package

    obstacles = ""
    for one in scene() + WALLS:
        if len(one.sides) == 1:
            shape = f"{{name: circle, radius: {one.sides[0]}}}"
        else:
            shape = f"{{name: rectangle, length: {one.sides[0]}, width: {one.sides[1]}}}"
        obstacles += f"  - {{shape: {shape}, state: [{one.x + HALF_SIZE_M}, {one.y + HALF_SIZE_M}, 0]}}\n"
    text = f"""world: {{height: 20, width: 20, step_time: {STEP_S}, collision_mode: unobstructed}}
robot:
  - kinematics: {{name: diff}}
    shape: {{name: circle, radius: 0.2}}
    state: [10, 9, 0]
    goal: [19, 19, 0]
    sensors:
      - {{type: lidar2d, range_min: 0, range_max: {RANGE_M}, angle_range: {2 * math.pi}, number: {BEAMS}}}
obstacle:
{obstacles}"""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bench.yaml"
        file.write_text(text)
        env = package.make(str(file), display=False, disable_all_plot=True)

    def step() -> int:
        env.step([0.5, 0.5])
        return 1

    return {"rate": rate(step, seconds)}


def mjcf() -> str:
    """The scene in MuJoCo's format."""
    geoms = ""
    for one in scene() + WALLS:
        if len(one.sides) == 1:
            shape = f'type="cylinder" size="{one.sides[0]} 0.5"'
        else:
            shape = f'type="box" size="{one.sides[0] / 2} {one.sides[1] / 2} 0.5"'
        geoms += f'<geom {shape} pos="{one.x} {one.y} 0.5"/>'
    joints = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint type="hinge" axis="0 0 1"/>'
    robot = f'<body name="robot" pos="0 0 0.2">{joints}<geom type="cylinder" size="0.2 0.1" mass="5"/></body>'
    return f'<mujoco><option timestep="0.01" gravity="0 0 0"/><worldbody>{geoms}{robot}</worldbody></mujoco>'


def mujoco_rays(seconds: float, steps: int = 0) -> dict[str, float]:
    """Scans by ``mj_multiRay``, with steps of the physics before each."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(mjcf())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "robot")
    hits, ranges = np.zeros(BEAMS, np.int32), np.zeros(BEAMS)
    angles = np.arange(BEAMS) * (2 * np.pi / BEAMS)
    has_normals = "normal" in (mujoco.mj_multiRay.__doc__ or "")

    def beams_at(yaw: float) -> np.ndarray:
        return np.stack([np.cos(angles + yaw), np.sin(angles + yaw), np.zeros(BEAMS)], axis=-1).ravel()

    beams = beams_at(0.0)

    def step() -> int:
        nonlocal beams
        if steps:
            yaw = data.qpos[2]
            data.qvel[:] = 0.5 * np.cos(yaw), 0.5 * np.sin(yaw), 0.5
            mujoco.mj_step(model, data, steps)
            beams = beams_at(data.qpos[2])
        rest = (hits, ranges, None, BEAMS, RANGE_M) if has_normals else (hits, ranges, BEAMS, RANGE_M)
        mujoco.mj_multiRay(model, data, data.xpos[body], beams, None, 1, body, *rest)
        return 1

    return {"rate": rate(step, seconds)}


def mujoco_steps(seconds: float) -> dict[str, float]:
    """Environment steps of MuJoCo: ten steps of the physics and a scan."""
    return mujoco_rays(seconds, steps=10)


def vmas(seconds: float, count: int = 64) -> dict[str, float]:
    """VMAS on the CPU, one thread of torch."""
    import torch
    from vmas import make_env
    from vmas.simulator.core import Agent, Box, Landmark, Sphere, World
    from vmas.simulator.scenario import BaseScenario
    from vmas.simulator.sensors import Lidar

    torch.set_num_threads(1)

    class Room(BaseScenario):  # type: ignore[misc]
        """The scene, and one agent in the middle."""

        def make_world(self, batch_dim: int, device: Any, **_: Any) -> Any:
            world = World(batch_dim, device, dt=STEP_S)
            lidar = Lidar(world, n_rays=BEAMS, max_range=RANGE_M)
            world.add_agent(Agent("robot", shape=Sphere(0.2), sensors=[lidar]))
            for index, one in enumerate(scene() + WALLS):
                shape = Sphere(one.sides[0]) if len(one.sides) == 1 else Box(one.sides[0], one.sides[1])
                world.add_landmark(Landmark(f"obstacle_{index}", shape=shape, collide=True))
            return world

        def reset_world_at(self, env_index: int | None = None) -> None:
            for landmark, one in zip(self.world.landmarks, scene() + WALLS):
                landmark.set_pos(torch.tensor([one.x, one.y]), batch_index=env_index)
            self.world.agents[0].set_pos(torch.zeros(2), batch_index=env_index)

        def observation(self, agent: Any) -> Any:
            return agent.sensors[0].measure()

        def reward(self, agent: Any) -> Any:
            return torch.zeros(self.world.batch_dim)

    env = make_env(Room(), num_envs=count, device="cpu", continuous_actions=True, seed=0)
    actions = [torch.full((count, 2), 0.1)]

    def step() -> int:
        env.step(actions)
        return count

    return {"rate": rate(step, seconds)}


CONTENDERS: dict[str, Callable[[float], dict[str, float]]] = {
    "periplus": periplus_vector,
    "periplus-house": periplus_house,
    "periplus-single": periplus_single,
    "ir-sim": irsim,
    "irsim-x": irsim,
    "vmas": vmas,
    "mujoco-rays": mujoco_rays,
    "mujoco-steps": mujoco_steps,
}
TITLES = {
    "periplus": "periplus, 1024 environments",
    "periplus-house": "periplus, 1024 environments, house",
    "periplus-single": "periplus, one environment",
    "ir-sim": "ir-sim",
    "irsim-x": "irsim-x",
    "vmas": "VMAS, 64 environments, CPU",
    "mujoco-rays": "MuJoCo, mj_multiRay alone",
    "mujoco-steps": "MuJoCo, ten steps and mj_multiRay",
}


def is_installed(python: str, name: str) -> bool:
    """True if the package of a peer is installed, and not another one with the same module."""
    package = {"mujoco-rays": "mujoco", "mujoco-steps": "mujoco"}.get(name, name)
    if name.startswith("periplus"):
        return True
    code = f"import importlib.metadata; importlib.metadata.version({package!r})"
    return subprocess.run([python, "-c", code], capture_output=True, check=False).returncode == 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=3.0, help="CPU seconds of each turn (default 3)")
    parser.add_argument("--turns", type=int, default=3, help="number of turns (default 3)")
    parser.add_argument("--python", action="append", default=[], metavar="NAME=PATH", help="interpreter of a peer")
    parser.add_argument("--run", choices=CONTENDERS, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        print(json.dumps(CONTENDERS[options.run](options.seconds)))
        return
    pythons = dict(one.split("=", 1) for one in options.python)
    best: dict[str, dict[str, float]] = {}
    for turn in range(options.turns):
        for name in CONTENDERS:
            python = pythons.get(name, sys.executable)
            if not is_installed(python, name):
                if turn == 0:
                    print(f"{name}: not installed, left out", file=sys.stderr)
                continue
            command = [python, __file__, "--run", name, "--seconds", str(options.seconds)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode:
                reason = done.stderr.strip().splitlines() or ["no message"]
                print(f"{name}: {reason[-1]}", file=sys.stderr)
                continue
            result = json.loads(done.stdout.strip().splitlines()[-1])
            if name not in best or result["rate"] > best[name]["rate"]:
                best[name] = result
    if "periplus" not in best:
        raise SystemExit("periplus was not measured, see above")
    print(f"{'':36} steps per CPU second   periplus is faster by")
    for name, result in best.items():
        ratio = best["periplus"]["rate"] / result["rate"]
        print(f"{TITLES[name]:36} {result['rate']:20,.0f} {ratio:22.2f}")
    for name in ("periplus", "periplus-house"):
        if name in best:
            print(f"{TITLES[name]}: {best[name]['wall_rate']:,.0f} steps per second of wall time with all cores")
    print(f"memory of 1024 environments: {best['periplus']['memory_mb']:.1f} MB")


if __name__ == "__main__":
    main()
