"""Navigation with the ordinary simulation: robots from files, with physics, drives and noisy sensors."""

from __future__ import annotations

import math
import os
import shutil
import tempfile
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Literal, Union

import gymnasium
import numpy as np
import numpy.typing as npt

from periplus import LaserScanner, Pose, Simulation
from periplus import World as SimulationWorld
from periplus._native import generated_world_sdf
from periplus.gym.picture import Painter, checked_render_mode
from periplus.gym.robots import mount_of
from periplus.gym.settings import NavigationArguments, World, sector_minimums, sources_of
from periplus.gym.single import SingleEnv

MAX_FLOOR_SLOPE = 0.5
"""Contacts whose normals have a larger vertical part are those of wheels on the floor."""
SETTLE_S = 0.3
"""Time after a reset in which the robot comes to rest and the lidar measures for the first time [s]."""


class NavigateSimulationEnv(SingleEnv):
    """Task of :class:`NavigateEnv` for a robot from a file: ``gymnasium.make("periplus/NavigateSimulation-v0")``.

    The robot is driven by its own plugins or controllers and measured by its own lidar, with the physics and the noise
    of :class:`periplus.Simulation`. Start, goal and reward are those of :class:`NavigateEnv`; a collision is a contact
    with anything but the floor.

    Parameters
    ----------
    robot : path
        File of the robot: URDF, xacro or SDF.
    world : path, str or dict
        A world (SDF), a kind of generated world, or a dict of a generator.
    radius : float, optional
        Radius of a circle about the robot's origin that contains it [m]; the outline of its collision shapes if left out.
    limits : dict, optional
        Range of the commands: ``max_speed``, ``min_speed``, ``max_turn_rate`` and the like
        (``parameters("robot")``).
    physics : {"rigid", "kinematic"}
        Motion with physics, or as commanded.
    scan_topic, command_topic : str
        Topics of the lidar and of the velocity commands.
    observation, reward, task, normalize, max_episode_steps, render_mode
        As those of :class:`NavigateEnv`; ``"velocity"`` is the true one.

    >>> from periplus.gym import NavigateSimulationEnv
    >>> robot = '''<robot name="cart"><link name="base"><inertial><mass value="5"/><inertia ixx="0.1" ixy="0" ixz="0"
    ... iyy="0.1" iyz="0" izz="0.1"/></inertial><collision><origin xyz="0 0 0.1"/><geometry>
    ... <cylinder radius="0.15" length="0.1"/></geometry></collision></link><gazebo><plugin name="move"
    ... filename="libgazebo_ros_planar_move.so"/></gazebo><gazebo reference="base"><sensor name="lidar" type="ray">
    ... <pose>0 0 0.2 0 0 0</pose><update_rate>10</update_rate><ray><scan><horizontal><samples>90</samples>
    ... <min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal></scan><range><min>0.1</min><max>8</max></range>
    ... </ray><plugin name="scan" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>~/out:=scan</remapping></ros>
    ... <output_type>sensor_msgs/LaserScan</output_type></plugin></sensor></gazebo></robot>'''
    >>> import pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "cart.urdf"
    >>> _ = file.write_text(robot)
    >>> env = NavigateSimulationEnv(file, world="rooms", physics="kinematic")
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step([1.0, 0.0])
    >>> observation.shape, terminated
    ((95,), False)
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 10}  # type: ignore[misc]

    def __init__(
        self,
        robot: Union[str, os.PathLike[str]],
        world: World = "rooms",
        radius: float | None = None,
        limits: Mapping[str, float] | None = None,
        physics: Literal["rigid", "kinematic"] = "rigid",
        scan_topic: str = "/scan",
        command_topic: str = "/cmd_vel",
        observation: Sequence[str] = ("ranges", "goal", "velocity"),
        reward: Mapping[str, float] | None = None,
        task: Mapping[str, Any] | None = None,
        normalize: bool = False,
        max_episode_steps: int = 500,
        render_mode: str | None = None,
    ) -> None:
        self.render_mode = checked_render_mode(render_mode)
        # A generated world is a file as long as the simulation lives, which may read it again.
        folder = tempfile.mkdtemp()
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        simulated = load_world(world, Path(folder)).add_robot(robot, name="robot")
        self._simulation = Simulation(simulated, physics=physics)
        self._model = self._simulation.model("robot")
        self._initial = self._model.pose
        self._scan_topic, self._command_topic = scan_topic, command_topic
        first = self._first_scan()
        angles = {"lidar_min_angle": first.angle_min, "lidar_max_angle": first.angle_max}
        ranges = {"lidar_min_range": first.range_min, "lidar_max_range": first.range_max}
        # Free space, spaces, reward and pictures are those of a kinematic robot with this lidar.
        footprint = self._model.footprint
        outline: dict[str, Any] = {"radius": 0.2 if radius is None else radius}
        if radius is None and footprint is not None:
            outline["footprint"] = footprint.tolist()
        arguments = NavigationArguments(
            world, None, {**outline, "lidar_beams": len(first), **angles, **ranges, **(limits or {})}, observation,
            "continuous", reward, task, normalize, False, max_episode_steps, threads=1,
        )  # fmt: skip
        self._batch = arguments.batch(1, resets_in_next_step=False)
        self._normalizes, self._max_steps = normalize, max_episode_steps
        self._parts = {name: slice(start, start + len(low)) for name, start, low, _ in self._batch.layout}
        lows, highs = (np.concatenate([row[index] for row in self._batch.layout]) for index in (2, 3))
        self.observation_space = gymnasium.spaces.Box(lows, highs, dtype=np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (self._batch.action_size,), np.float32)
        self._scanner = LaserScanner.from_message(first, mount_of(self._simulation, self._model, first))
        self._range_max, self._limits = first.range_max, self._batch.commanded([1.0] * self._batch.action_size)
        self._goal = (0.0, 0.0)
        self._action = np.zeros(self._batch.action_size, np.float32)
        self._distance, self._path_length, self._steps = 0.0, 0.0, 0
        self._is_running, self._has_seed = False, False
        self._terms: list[float] = [0.0] * len(self._batch.reward_term_names)
        self._painter = Painter(self._batch)

    @property
    def simulation(self) -> Simulation:
        """The simulation, for its other sensors, topics and services."""
        return self._simulation

    @property
    def observation_parts(self) -> dict[str, slice]:
        """Index range of each part of the observation."""
        return dict(self._parts)

    @property
    def pose(self) -> tuple[float, float, float]:
        """Pose of the robot in the world: x [m], y [m], yaw [rad]. The truth."""
        pose = self._model.pose
        return pose.x, pose.y, pose.yaw

    @property
    def goal(self) -> tuple[float, float]:
        """Goal in the world: x, y [m]."""
        return self._goal

    def ranges(self) -> npt.NDArray[np.float32]:
        """Ranges of the last scan [m], infinite where nothing was hit."""
        ranges: npt.NDArray[np.float32] = self._lidar.read().ranges
        return ranges

    @property
    def scan_time(self) -> float:
        """Simulation time of the last scan [s]."""
        return float(self._lidar.read().time_s)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float32], dict[str, Any]]:
        """Starts an episode. With a seed the first of that seed, otherwise the next one."""
        super().reset(seed=seed)
        if seed is None and not self._has_seed:
            seed = int(self.np_random.integers(2**63))
        self._has_seed = True
        start, goal = (options or {}).get("start"), (options or {}).get("goal")
        self._batch.reset(
            np.empty((1, self._batch.observation_size), np.float32),
            None if seed is None else [seed],
            starts=None if start is None else [tuple(start)],
            goals=None if goal is None else [tuple(goal)],
        )
        x, y, yaw = self._batch.poses()[0].tolist()
        goal_x, goal_y = self._batch.goals()[0].tolist()
        # Noise of its own in each episode.
        self._simulation.reset(seed=int(self.np_random.integers(2**31)) if seed is None else seed)
        self._model.set_pose(Pose(x, y, self._initial.z, self._initial.roll, self._initial.pitch, yaw))
        self._command(np.zeros(3))
        self._simulation.run(SETTLE_S)
        self._goal = (goal_x, goal_y)
        self._action[:] = 0.0
        self._distance, self._path_length, self._steps = self._goal_distance(), 0.0, 0
        self._is_running = True
        return self._observe(), self._info(False, False)

    def step(self, action: Any) -> tuple[npt.NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Simulates one step period."""
        if not self._is_running:
            raise RuntimeError("the episode has ended, or never began: call reset()")
        self._action = np.clip(np.asarray(action, np.float32).reshape(self._batch.action_size), -1.0, 1.0)
        before, distance = self.pose, self._distance
        self._command(self._batch.commanded(self._action.tolist()))
        self._simulation.run(self._batch.step_period)
        self._steps += 1
        after = self.pose
        self._path_length += math.hypot(after[0] - before[0], after[1] - before[1])
        self._distance = self._goal_distance()
        is_collision = self._has_collided()
        is_success = not is_collision and self._distance <= self._batch.goal_tolerance
        turn_rate = float(self._model.angular_velocity[2])
        self._terms = self._batch.reward_terms_of(
            distance - self._distance, is_success, is_collision, turn_rate, self._clearance()
        )
        truncated = self._steps >= self._max_steps
        terminated = is_success or is_collision
        self._is_running = not (terminated or truncated)
        return self._observe(), float(sum(self._terms)), terminated, truncated, self._info(is_success, is_collision)

    def reward_terms(self) -> dict[str, float]:
        """Terms of the last reward by name, each multiplied by its weight."""
        return dict(zip(self._batch.reward_term_names, self._terms))

    def render(self) -> npt.NDArray[np.uint8] | None:
        """Picture from above, uint8, shape (height, width, 3), in the render mode ``"rgb_array"``."""
        if self.render_mode is None:
            gymnasium.logger.warn('render() without a render mode; use make(..., render_mode="rgb_array")')
            return None
        return self._painter.paint(0, [0], [self.pose], [self._goal])

    def _first_scan(self) -> Any:
        if self._scan_topic not in self._simulation.sensors:
            known = ", ".join(sorted(self._simulation.sensors)) or "none"
            raise ValueError(f"the robot has no lidar on {self._scan_topic}; its sensors are on: {known}")
        # A sensor measures from here on.
        self._lidar = self._simulation.sensor(self._scan_topic)
        self._simulation.run(1.0)
        scan = self._lidar.read()
        if not hasattr(scan, "ranges"):
            raise ValueError(f"{self._scan_topic} has no scans of a planar lidar within a second")
        return scan

    def _command(self, velocity: Sequence[float] | npt.NDArray[np.float64]) -> None:
        from periplus.msgs.geometry_msgs.msg import Twist

        command = Twist()
        command.linear.x, command.linear.y, command.angular.z = (float(part) for part in velocity)
        self._simulation.publish(self._command_topic, command)

    def _goal_distance(self) -> float:
        x, y, _ = self.pose
        return math.hypot(self._goal[0] - x, self._goal[1] - y)

    def _clearance(self) -> float:
        return self._batch.clearance(0, *self.pose)

    def _has_collided(self) -> bool:
        if self._clearance() == 0.0:
            return True
        for contact in self._simulation.contacts():
            models = {contact.one[0], contact.two[0]}
            if "robot" in models and len(models) == 2 and abs(float(contact.normal[2])) < MAX_FLOOR_SLOPE:
                return True
        return False

    def _observe(self) -> npt.NDArray[np.float32]:
        x, y, yaw = self.pose
        observed = np.empty(self._batch.observation_size, np.float32)
        for name, part in self._parts.items():
            if name in {"ranges", "sectors"}:
                ranges = np.nan_to_num(self._lidar.read().ranges, nan=self._range_max)
                if name == "sectors":
                    ranges = sector_minimums(ranges, part.stop - part.start)
                observed[part] = ranges / self._range_max if self._normalizes else ranges
            elif name == "goal":
                bearing = math.atan2(self._goal[1] - y, self._goal[0] - x) - yaw
                distance = min(self._distance / 10.0, 1.0) if self._normalizes else self._distance
                observed[part] = distance, math.cos(bearing), math.sin(bearing)
            elif name == "velocity":
                observed[part] = self._velocity(yaw)
            elif name == "pose":
                observed[part] = x, y, math.cos(yaw), math.sin(yaw)
            else:
                observed[part] = self._action
        # Beams without a hit are infinite, and physics may exceed the limits a little.
        clipped: npt.NDArray[np.float32] = np.clip(observed, self.observation_space.low, self.observation_space.high)  # type: ignore[attr-defined]
        return clipped

    def _velocity(self, yaw: float) -> list[float]:
        vx, vy, _ = self._model.linear_velocity
        velocity = [vx * math.cos(yaw) + vy * math.sin(yaw), vy * math.cos(yaw) - vx * math.sin(yaw)]
        velocity.append(self._model.angular_velocity[2])
        if self._normalizes:
            velocity = [part / (limit or 1.0) for part, limit in zip(velocity, self._limits)]
        return velocity if self._batch.action_size == 3 else [velocity[0], velocity[2]]

    def _info(self, is_success: bool, is_collision: bool) -> dict[str, Any]:
        return {
            "is_success": is_success,
            "is_collision": is_collision,
            "goal_distance_m": self._distance,
            "clearance_m": self._clearance(),
            "path_length_m": self._path_length,
        }


def load_world(world: World, folder: Path) -> SimulationWorld:
    """The world of the ordinary simulation; generated ones are written to the folder."""
    (source,) = sources_of(world, None)
    if not isinstance(source, dict):
        return SimulationWorld.load(source)
    file = folder / "generated.sdf"
    file.write_text(generated_world_sdf(source))
    return SimulationWorld.load(file)
