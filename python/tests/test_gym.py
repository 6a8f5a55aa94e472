"""Environments for learning: gymnasium's and PettingZoo's checks, seeds, episodes, errors."""

import math
import pickle
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

# Skipped with the reason in the summary, not silently.
gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed: pip install 'periplus[gym]'")
pettingzoo = pytest.importorskip("pettingzoo", reason="PettingZoo is not installed: pip install pettingzoo")

from gymnasium.utils.env_checker import check_env, data_equivalence  # noqa: E402
from pettingzoo.test import parallel_api_test, parallel_seed_test  # noqa: E402

import periplus  # noqa: E402
from periplus.gym import (  # noqa: E402
    ENVIRONMENT_ID,
    WORLD_KINDS,
    NavigateEnv,
    NavigateParallelEnv,
    NavigateSimulationEnv,
    NavigateVectorEnv,
    parameters,
    sector_minimums,
    world_sdf,
)
from periplus.gym.wrappers import AmclObservation, CostmapObservation, LidarWrapper, SlamObservation  # noqa: E402

WORLDS = Path(__file__).resolve().parents[2] / "worlds"

# A room of 8 x 4 m about the origin.
ROOM = """<sdf version="1.9"><world name="room"><model name="floor"><static>true</static><link name="link">
<collision name="floor"><geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry></collision></link>
</model><model name="walls"><static>true</static><link name="link">
{}</link></model></world></sdf>"""
WALL = """<{kind} name="{name}"><pose>{x} {y} 0.5 0 0 0</pose><geometry><box><size>{w} {h} 1</size></box></geometry>
</{kind}>"""


@pytest.fixture()
def room(tmp_path: Path) -> Path:
    walls = [(4.1, 0.0, 0.2, 4.4), (-4.1, 0.0, 0.2, 4.4), (0.0, 2.1, 8.4, 0.2), (0.0, -2.1, 8.4, 0.2)]
    parts = [
        WALL.format(kind=kind, name=f"{kind}_{index}", x=x, y=y, w=w, h=h)
        for index, (x, y, w, h) in enumerate(walls)
        for kind in ("collision", "visual")
    ]
    file = tmp_path / "room.sdf"
    file.write_text(ROOM.format("".join(parts)))
    return file


ARGUMENTS: list[dict[str, Any]] = [
    {},
    {"dict_observation": True, "action": "discrete", "world": "maze"},
    {"normalize": True, "robot": {"drive": "omni", "lidar_beams": 36}, "world": {"kind": "caves", "seed": 3}},
    {"observation": ["goal", "pose", "previous_action"], "world": "cylinders", "action": [[1.0, 0.0], [0.0, 1.0]]},
    {"world": "offices", "world_seeds": range(3), "robot": {"footprint": [[0.3, 0.2], [-0.3, 0.2], [0.0, -0.3]]}},
]


@pytest.mark.parametrize("arguments", ARGUMENTS)
def test_gymnasium_finds_no_fault(arguments: dict[str, Any]) -> None:
    env = gymnasium.make(ENVIRONMENT_ID, render_mode="rgb_array", **arguments)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)
    pickle.loads(pickle.dumps(env.spec))


@pytest.mark.parametrize("arguments", ARGUMENTS)
def test_the_vector_environment_equals_single_ones(arguments: dict[str, Any]) -> None:
    arguments = {"max_episode_steps": 25, **arguments}
    single = gymnasium.make_vec(ENVIRONMENT_ID, num_envs=4, vectorization_mode="sync", **arguments)
    native = gymnasium.make_vec(ENVIRONMENT_ID, num_envs=4, vectorization_mode="vector_entry_point", **arguments)
    assert native.metadata["autoreset_mode"] == gymnasium.vector.AutoresetMode.NEXT_STEP
    assert single.observation_space == native.observation_space
    assert single.action_space == native.action_space
    assert data_equivalence(single.reset(seed=3), native.reset(seed=3), exact=True)
    single.action_space.seed(1)
    ends = 0
    for _ in range(80):
        actions = single.action_space.sample()
        expected, found = single.step(actions), native.step(actions)
        ends += int(expected[2].sum() + expected[3].sum())
        assert data_equivalence(expected, found, exact=True)
    assert ends >= 8


def run(seed: int, threads: int) -> list[bytes]:
    envs = NavigateVectorEnv(11, world="caves", world_seeds=range(3), robot={"lidar_noise": 0.01}, threads=threads)
    envs.action_space.seed(seed)
    observations, _ = envs.reset(seed=seed)
    results = [observations.tobytes()]
    for _ in range(60):
        observations, rewards, *_ = envs.step(envs.action_space.sample())
        results.append(observations.tobytes() + rewards.tobytes())
    return results


def test_seeds_are_exact_at_any_number_of_threads() -> None:
    first = run(1, 1)
    assert first == run(1, 4)
    assert first != run(2, 4)


def test_what_a_robot_measures_in_a_room(room: Path) -> None:
    env = NavigateEnv(world=room, robot={"lidar_beams": 4, "max_acceleration": 0})
    observation, info = env.reset(seed=0, options={"start": (1.0, 0.5, 0.0), "goal": (1.0, 1.5)})
    # Backwards, to the right, ahead, to the left; the goal is 1 m to the left.
    np.testing.assert_allclose(observation[:4], [5.0, 2.5, 3.0, 1.5], atol=1e-6)
    np.testing.assert_allclose(observation[env.observation_parts["goal"]], [1.0, 0.0, 1.0], atol=1e-6)
    assert info["goal_distance_m"] == 1.0
    observation, reward, terminated, truncated, info = env.step([1.0, 0.0])
    assert env.pose == pytest.approx((1.08, 0.5, 0.0))
    assert observation[2] == pytest.approx(2.92)
    assert (terminated, truncated, info["is_collision"]) == (False, False, False)
    assert sum(env.reward_terms().values()) == pytest.approx(reward)


def test_ranges_are_those_of_a_ray_scene() -> None:
    env = NavigateEnv(world=WORLDS / "house.sdf", robot={"lidar_max_range": 30.0})
    scene = periplus.RayScene.from_file(WORLDS / "house.sdf")
    for seed in range(5):
        observation, _ = env.reset(seed=seed)
        x, y, yaw = env.pose
        angles = yaw - np.pi + np.arange(360) * (2 * np.pi / 360)
        beams = np.stack([np.cos(angles), np.sin(angles), np.zeros(360)], axis=-1)
        expected = np.minimum(scene.distances([x, y, 0.2], beams), 30.0)
        # A beam within a micrometre of an edge may hit either side of it.
        assert (np.abs(observation[:360] - expected) < 1e-5).mean() > 0.99


def test_collisions_and_goals_end_episodes(room: Path) -> None:
    env = NavigateEnv(world=room, robot={"max_acceleration": 0})
    env.reset(seed=0, options={"start": (3.0, 0.0, 0.0), "goal": (-3.0, 0.0)})
    steps = 0
    terminated = False
    while not terminated:
        _, reward, terminated, _, info = env.step([1.0, 0.0])
        steps += 1
    assert info["is_collision"] and steps in (10, 11) and reward < -9.0
    assert 3.78 < env.pose[0] <= 3.8
    with pytest.raises(RuntimeError, match="call reset"):
        env.step([1.0, 0.0])
    env.reset(options={"start": (0.0, 0.0, 0.0), "goal": (0.35, 0.0)})
    _, reward, terminated, _, info = env.step([1.0, 0.0])
    assert terminated and info["is_success"] and reward > 9.0
    assert env.shortest_path_length() == pytest.approx(0.35, abs=0.1)


def test_a_map_is_a_world(tmp_path: Path) -> None:
    cells = np.zeros((60, 80), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    periplus.OccupancyGrid(cells, 0.05).save(tmp_path / "map")
    env = NavigateEnv(world=tmp_path / "map.yaml", robot={"lidar_beams": 4})
    observation, _ = env.reset(seed=0, options={"start": (2.0, 1.5, 0.0)})
    np.testing.assert_allclose(observation[:4], [1.95, 1.45, 1.95, 1.45], atol=1e-5)


def test_generated_worlds_are_worlds_of_the_simulation(tmp_path: Path) -> None:
    for kind in WORLD_KINDS:
        file = tmp_path / f"{kind}.sdf"
        file.write_text(world_sdf(kind, seed=2))
        assert file.read_text() == world_sdf(kind, seed=2) != world_sdf(kind, seed=3)
        options = {"robot": {"lidar_beams": 90}, "observation": ["ranges"]}
        generated, _ = NavigateEnv(world={"kind": kind, "seed": 2}, **options).reset(seed=5)
        loaded, _ = NavigateEnv(world=file, **options).reset(seed=5)
        # Numbers of the file are decimal.
        np.testing.assert_allclose(generated, loaded, atol=1e-4)
        assert not [finding for finding in periplus.check(file) if finding.severity == "error"]


def test_several_robots() -> None:
    parallel_api_test(NavigateParallelEnv(agents=3, max_episode_steps=60), num_cycles=150)
    parallel_seed_test(lambda: NavigateParallelEnv(agents=2, world="maze"), num_cycles=30)


def test_robots_meet(room: Path) -> None:
    env = NavigateParallelEnv(world=room, robot={"max_acceleration": 0, "lidar_beams": 4})
    options = {"starts": [(-1.0, 0.0, 0.0), (1.0, 0.0, np.pi)], "goals": [(3.0, 0.0), (-3.0, 0.0)]}
    observations, _ = env.reset(seed=0, options=options)
    assert observations["robot_0"][2] == pytest.approx(1.8)
    while env.agents:
        _, rewards, ends, _, infos = env.step({agent: [1.0, 0.0] for agent in env.agents})
    assert ends == {"robot_0": True, "robot_1": True}
    assert all(info["is_collision"] for info in infos.values())


def test_a_robot_with_physics(room: Path) -> None:
    robot = WORLDS.parent / "robots" / "sam_bot" / "urdf" / "sam_bot.urdf.xacro"
    env = NavigateSimulationEnv(robot, world=room, radius=0.3, limits={"max_speed": 0.5}, reward={"progress": 1.0})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
    start = {"start": (2.5, 0.0, 0.0), "goal": (-3.0, 0.0)}
    runs = []
    for _ in range(2):
        observation, _ = env.reset(seed=4, options=start)
        assert observation[env.observation_parts["goal"]] == pytest.approx([5.5, -1.0, 0.0], abs=0.02)
        results = [observation.tobytes()]
        terminated = truncated = False
        while not (terminated or truncated):
            observation, reward, terminated, truncated, info = env.step([1.0, 0.0])
            results.append(observation.tobytes())
        runs.append(results)
        # 1.2 m to the wall at 0.5 m/s, after the acceleration.
        assert info["is_collision"] and 20 < len(results) < 45 and reward < -9.0
        assert sum(env.reward_terms().values()) == pytest.approx(reward)
    assert runs[0] == runs[1]


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"world": "room"}, ValueError, "kinds are rooms"),
        ({"world": "missing.sdf"}, FileNotFoundError, "missing.sdf"),
        ({"world": {"kind": "rooms", "cluter": 1}}, TypeError, "did you mean `clutter`"),
        ({"robot": {"lidar_beam": 3}}, TypeError, "did you mean `lidar_beams`"),
        ({"robot": {"radius": 9.0}}, ValueError, "nothing is free"),
        ({"reward": {"goal": "much"}}, ValueError, "much"),
        ({"observation": ["rangs"]}, ValueError, "did you mean ranges"),
        ({"observation": "ranges"}, TypeError, "must be a list"),
        ({"action": "discret"}, ValueError, "discrete"),
        ({"action": [[1.0, 2.0, 3.0]]}, ValueError, "must be a table"),
        ({"world": "house.sdf", "world_seeds": [1]}, ValueError, "generated worlds"),
    ],
)
def test_errors_name_the_argument(arguments: dict[str, Any], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        NavigateEnv(**arguments)


def test_a_start_in_a_wall_is_refused(room: Path) -> None:
    env = NavigateEnv(world=room)
    with pytest.raises(ValueError, match="start of agent 0 is in collision"):
        env.reset(seed=0, options={"start": (4.0, 0.0, 0.0)})


def test_partial_resets_keep_the_other_environments() -> None:
    envs = NavigateVectorEnv(3)
    before, _ = envs.reset(seed=0)
    mask = np.array([False, True, False])
    after, infos = envs.reset(options={"reset_mask": mask})
    assert ((before == after).all(axis=1) == ~mask).all()
    assert (infos["_clearance_m"] == mask).all()


def test_every_parameter_has_a_text() -> None:
    for name in ("robot", "task", "reward", "world"):
        assert all(row["doc"] for row in parameters(name))


def test_without_gymnasium_the_error_says_what_to_install() -> None:
    code = "import sys; sys.modules['gymnasium'] = None; import periplus.gym"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.returncode == 1
    assert "pip install 'periplus[gym]'" in result.stderr


WRAPPERS = [AmclObservation, SlamObservation, CostmapObservation]


@pytest.mark.parametrize("wrapper", WRAPPERS)
def test_gymnasium_finds_no_fault_in_wrappers(wrapper: type[LidarWrapper]) -> None:
    env = wrapper(NavigateEnv(world="offices", robot={"lidar_beams": 90}, normalize=True))
    with warnings.catch_warnings():
        # The checker prefers environments without wrappers.
        warnings.filterwarnings("ignore", message=".*is different from the unwrapped version")
        check_env(env, skip_render_check=True)
    assert env.observation_space.contains(env.reset(seed=1)[0])
    flat = gymnasium.wrappers.FlattenObservation(env)
    assert flat.observation_space.contains(flat.reset(seed=1)[0])


def drive(env: LidarWrapper, steps: int = 30) -> dict[str, Any]:
    """The last observation of an episode that turns on the spot and then curves, slowly."""
    observation, _ = env.reset(seed=3)
    for step in range(steps):
        action = np.array([-1.0 if step < steps // 2 else -0.5, 0.4], np.float32)
        observation, _, terminated, _, _ = env.step(action)
        assert not terminated
    return observation


def test_amcl_finds_the_robot_in_spite_of_its_odometry() -> None:
    env = AmclObservation(NavigateEnv(world="offices", robot={"lidar_beams": 180}), odometry_noise=0.2, laser_max_range=10.0)
    observed = drive(env)
    x, y, yaw = env.unwrapped.pose
    assert np.abs(observed["estimated_pose"] - [x, y, math.cos(yaw), math.sin(yaw)]).max() < 0.06
    assert (observed["pose_deviation"] < 0.5).all()
    # Distance and bearing are those from the estimate, which is near the truth.
    assert abs(observed["goal"][0] - math.hypot(env.unwrapped.goal[0] - x, env.unwrapped.goal[1] - y)) < 0.08


def test_slam_maps_the_surroundings(room: Path) -> None:
    env = SlamObservation(NavigateEnv(world=room, robot={"lidar_beams": 360}), size=6.0)
    env.reset(seed=1, options={"start": (1.0, 0.5, 0.0), "goal": (-1.0, 0.5)})
    observed = env.step(np.array([-1.0, 0.0], np.float32))[0]
    assert observed["map"].shape == (120, 120)
    # 3 m to each side of the robot: a wall 1.5 m to its left (30 cells), free in between, nothing seen behind it.
    ahead = observed["map"][60]
    assert ahead[28:32].max() > 50, "the wall"
    assert (ahead[32:88] >= 0).all() and (ahead[32:88] < 50).all(), "the room"
    assert (ahead[:27] == -1).all(), "behind the wall"
    assert np.allclose(observed["estimated_pose"], [0.0, 0.0, 1.0, 0.0], atol=0.02)
    assert np.allclose(observed["goal"], [2.0, -1.0, 0.0], atol=0.03), "behind the robot"


def test_a_costmap_is_in_the_frame_of_the_robot(room: Path) -> None:
    env = CostmapObservation(NavigateEnv(world=room), size=3.0, resolution=0.1, inflation_radius=0.3)
    # The wall at x = 4 m is 1 m ahead of the robot, then 1 m to its right.
    for yaw, wall in [(0.0, (slice(4, 6), slice(10, 20))), (math.pi / 2, (slice(10, 20), slice(24, 26)))]:
        observed = env.reset(seed=1, options={"start": (3.0, 0.0, yaw), "goal": (-1.0, 0.0)})[0]
        lethal = observed["costmap"] == 254
        assert lethal[wall].any(axis=0 if yaw == 0.0 else 1).all(), yaw
        assert not lethal[8:22, 8:22].any()


def test_wrappers_say_what_they_need() -> None:
    with pytest.raises(ValueError, match='needs "ranges" in the observation'):
        AmclObservation(NavigateEnv(observation=["goal"]))
    with pytest.raises(TypeError, match="before other wrappers"):
        SlamObservation(gymnasium.wrappers.FrameStackObservation(NavigateEnv(), 2))


def test_sectors_are_the_minima_of_the_ranges() -> None:
    task = {"lidar_sectors": 7}
    env = NavigateEnv(world="caves", observation=["ranges", "sectors"], robot={"lidar_noise": 0.01}, task=task)
    for observed in (env.reset(seed=2)[0], env.step([0.0, 0.0])[0]):
        assert np.array_equal(observed[360:], sector_minimums(observed[:360], 7))
    with pytest.raises(ValueError, match="`lidar_sectors` is 400"):
        NavigateEnv(observation=["sectors"], task={"lidar_sectors": 400})


def test_a_robot_from_a_file() -> None:
    file = WORLDS.parent / "robots" / "sam_bot" / "urdf" / "sam_bot.urdf.xacro"
    env = NavigateEnv(world="rooms", robot={"file": file, "max_speed": 0.4}, normalize=False)
    # Of its description: 360 beams of 0.12 m to 3.5 m, 0.12 m above a base that is 0.15 m above the floor.
    scanner = env.laser_scanner
    assert (scanner.range_min, scanner.range_max) == pytest.approx((0.12, 3.5))
    assert scanner.base_from_laser.z == pytest.approx(0.27, abs=0.002)
    outline = np.asarray(env.footprint)
    # Wheels and body: 0.42 m long, 0.41 m wide.
    assert outline.max(axis=0) == pytest.approx([0.21, 0.2], abs=0.015)
    assert outline.min(axis=0) == pytest.approx([-0.21, -0.2], abs=0.015)
    observed, _ = env.reset(seed=1)
    assert observed[: env.observation_parts["ranges"].stop].max() <= np.float32(3.5)
    with pytest.raises(FileNotFoundError, match=r"no_such_robot\.urdf"):
        NavigateEnv(robot="no_such_robot.urdf")
