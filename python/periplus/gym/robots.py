"""Robots of environments from the files of robots."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, TypeAlias, Union

from periplus import LaserScanner, Model, Pose, Simulation, World

Robot: TypeAlias = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""A file, or parameters, of which ``file`` can name a file for the others."""

FIRST_SCAN_S = 1.0
"""Time in which a robot comes to rest and its lidar measures [s]."""


def robot_values(robot: Robot | None) -> dict[str, Any]:
    """Parameters that are given, and those of the file."""
    if robot is None:
        return {}
    if not isinstance(robot, Mapping):
        return values_of_file(robot)
    given = dict(robot)
    file = given.pop("file", None)
    return given if file is None else {**values_of_file(file), **given}


def values_of_file(file: Union[str, "os.PathLike[str]"]) -> dict[str, Any]:
    """Footprint and lidar of a robot at rest on a floor, as parameters of an environment's robot."""
    simulation = Simulation(World().add_robot(file, name="robot"))
    topics = [topic for topic, kind in simulation.sensors.items() if kind == "sensor_msgs/msg/LaserScan"]
    if not topics:
        raise ValueError(f"{os.fspath(file)} has no planar lidar; add one, or give the parameters of the robot")
    lidar = simulation.sensor(sorted(topics)[0])
    simulation.run(FIRST_SCAN_S)
    model, scan = simulation.model("robot"), lidar.read()
    mount = mount_of(simulation, model, scan) or Pose()
    scanner = LaserScanner.from_message(scan, mount)
    values: dict[str, Any] = {
        "lidar_beams": len(scan),
        "lidar_min_angle": scanner.angle_min,
        "lidar_max_angle": scanner.angle_min + scanner.angle_increment * (len(scan) - 1),
        "lidar_min_range": scanner.range_min,
        "lidar_max_range": scanner.range_max,
        "lidar_x": mount.x,
        "lidar_y": mount.y,
        "lidar_yaw": mount.yaw,
        "lidar_height": max(model.pose.z, 0.0) + mount.z,
    }
    footprint = model.footprint
    if footprint is not None:
        values["footprint"] = footprint.tolist()
    return values


def mount_of(simulation: Simulation, model: Model, scan: Any) -> Pose | None:
    """Pose of the lidar in the frame of the model, from the transforms of the robot; none if it publishes none."""
    for link, world_from_link in model.links.items():
        try:
            link_from_lidar = simulation.lookup_transform(link, scan.frame_id)
        except LookupError:
            continue
        return model.pose.inverse() * world_from_link * link_from_lidar
    return None
