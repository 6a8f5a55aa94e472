"""Calls everything public with random values: ``python fuzz_api.py --seconds 600 --seed 1``.

Any exception is a proper answer, except one that says "a fault of Periplus" (a panic). An abort of the process or
a call that does not return ends the run with the last call, which is printed before it is made with ``--trace``.
"""

from __future__ import annotations

import argparse
import faulthandler
import inspect
import math
import os
import random
import sys
import tempfile
import time
from collections import Counter
from typing import Any

import numpy as np

import periplus

# A call that takes longer is a hang [s].
LONGEST_CALL_S = 120.0

# What would leave the process, open a browser or a network, or run for long with a large number.
LEFT_OUT = {"view", "run_command"}

BOX = """<sdf version='1.7'><model name='box'><link name='l'><collision name='c'><geometry><box><size>1 1 1
</size></box></geometry></collision></link></model></sdf>"""

YAML = """image: m.pgm
resolution: 0.1
origin: [0, 0, 0]
"""


def plain(rng: random.Random) -> Any:
    """A value that is not of this package."""
    return rng.choice(
        [
            None,
            True,
            0,
            1,
            -1,
            3,
            360,
            2**40,
            -(2**70),
            0.0,
            0.5,
            -2.5,
            1e-300,
            1e30,
            math.nan,
            math.inf,
            "",
            "scan",
            "/scan",
            "/cmd_vel",
            "map",
            "base_link",
            "box",
            "sensor_msgs/msg/LaserScan",
            "none.yaml",
            "m.yaml",
            "m.pgm",
            "box.sdf",
            "\0",
            "é" * 300,
            BOX,
            b"",
            b"\0\1\0\0hi",
            (),
            (0.0, 0.0, 0.0),
            (1.0, 2.0, 3.0, 0.1, 0.2, 0.3),
            (math.nan, 0.0, 0.0),
            [],
            [1, 2, 3],
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ["a", "b"],
            {},
            {"resolution": 0.05},
            {"a": [1, {"b": None}]},
            object(),
            int,
            len,
            lambda *words: None,
        ]
    )


def array(rng: random.Random) -> Any:
    """An array of any type and shape, often strided."""
    shape = [rng.choice([0, 1, 2, 3, 4, 7, 30]) for _ in range(rng.randint(0, 3))]
    if rng.random() < 0.4:
        shape = [*shape[:1], 3]
    kind = rng.choice("f8 f4 i8 i4 u1 i1 ? c16 O U3".split())
    values = np.random.default_rng(rng.randrange(1 << 30)).normal(0.0, 3.0, shape)
    with np.errstate(all="ignore"):
        made: Any = values.astype(kind)
    if rng.random() < 0.3 and made.ndim:
        made = made[::2]
    if rng.random() < 0.2:
        made = made.T
    if rng.random() < 0.1 and kind in ("f8", "f4") and made.size:
        made = made.copy()
        made.flat[0] = rng.choice([math.nan, math.inf])
    return made


# Values that fit, by the names of parameters.
FITTING: dict[str, list[Any]] = {
    "pose": [(0.5, 0.2, 0.1), (0.5, 0.2, 0.1, 0.0, 0.0, 0.3), periplus.Pose(1.0, 2.0, yaw=0.4)],
    "robot_pose": [(0.0, 0.0, 0.0)],
    "sensor_pose": [(0.0, 0.0, 0.2, 0.0, 0.0, 0.0)],
    "odom_from_base": [(0.0, 0.0, 0.0), (0.1, 0.0, 0.01), None],
    "guess": [(0.1, 0.0, 0.0)],
    "topic": ["/scan", "/cmd_vel", "/depth_camera/points", "/chatter"],
    "name": ["sam_bot", "box", "cube"],
    "path": ["box.sdf", "m.yaml", "out.mcap"],
    "source": ["box.sdf", BOX],
    "size": [[1.0, 2.0, 0.5]],
    "radius": [0.3],
    "origins": [[0.0, 0.0, 0.5], np.zeros((5, 3))],
    "directions": [[1.0, 0.0, 0.0], np.eye(3), np.random.default_rng(1).normal(size=(50, 3))],
    "vertices": [np.random.default_rng(2).normal(size=(8, 3))],
    "triangles": [[[0, 1, 2], [2, 3, 4]], np.array([[5, 6, 7]])],
    "scan": [[1.0] * 40, np.linspace(1.0, 3.0, 40)],
    "scanner": [periplus.LaserScanner(-1.0, 0.05, range_max=10.0)],
    "map": [periplus.OccupancyGrid(np.pad(np.zeros((20, 30), np.int8), 1, constant_values=100), 0.1)],
    "grid": [periplus.OccupancyGrid(np.pad(np.zeros((20, 30), np.int8), 1, constant_values=100), 0.1)],
    "points": [[[1.0, 0.0], [1.0, 0.5], [2.0, 1.0]], np.zeros((4, 3))],
    "time_s": [0.0, 0.1, 1.0],
    "time_ns": [0, 100_000_000],
    "target": ["map", "odom"],
    "parent": ["map", "odom"],
    "child": ["odom", "base_link"],
    "covariance": [np.eye(3), np.eye(6)],
    "world": [periplus.World.demo(), periplus.World()],
    "force": [[10.0, 0.0, 0.0]],
    "linear": [[0.5, 0.0, 0.0]],
    "angular": [[0.0, 0.0, 0.3]],
}


class Fuzzer:
    """Objects that were made, and calls on them."""

    def __init__(self, seed: int, is_traced: bool) -> None:
        self.rng = random.Random(seed)
        self.is_traced = is_traced
        self.pool: list[Any] = []
        self.outcomes: Counter[str] = Counter()
        self.names: Counter[str] = Counter()

    def value(self) -> Any:
        """Any value: of the pool, plain, or an array."""
        draw = self.rng.random()
        if draw < 0.25 and self.pool:
            return self.rng.choice(self.pool)
        return plain(self.rng) if draw < 0.65 else array(self.rng)

    def arguments(self, function: Any) -> tuple[list[Any], dict[str, Any]]:
        """Arguments that fit the signature, mostly."""
        try:
            parameters = list(inspect.signature(function).parameters.values())
        except (TypeError, ValueError):
            return [self.value() for _ in range(self.rng.randint(0, 3))], {}
        words: list[Any] = []
        named: dict[str, Any] = {}
        for parameter in parameters:
            is_needed = parameter.default is inspect.Parameter.empty
            if parameter.name in ("self", "cls") or (not is_needed and self.rng.random() < 0.6):
                continue
            value = self.value()
            if parameter.name in FITTING and self.rng.random() < 0.6:
                value = self.rng.choice(FITTING[parameter.name])
            if parameter.name == "real_time_factor":
                # A small factor is a long wait.
                value = self.rng.choice([100.0, -1.0, math.nan, None, "x"])
            if parameter.name in ("seconds", "n", "timeout_s", "count"):
                value = self.rng.choice([0, 1, 2, 0.01, -1, math.nan, None, "x"])
            if parameter.name in ("width", "height", "threads") and isinstance(value, (int, float)):
                value = min(value, 64) if value == value else value
            if parameter.name in ("ros2", "gazebo") or parameter.name.startswith("_"):
                continue
            if parameter.kind in (parameter.POSITIONAL_ONLY, parameter.VAR_POSITIONAL):
                words.append(value)
            elif parameter.kind is not parameter.VAR_KEYWORD:
                named[parameter.name] = value
        if self.rng.random() < 0.03:
            named["nonsense"] = 1
        return words, named

    def keep(self, value: Any) -> None:
        """Put a result into the pool."""
        if type(value).__module__.startswith("periplus") or isinstance(value, np.ndarray):
            self.pool.append(value)
        if len(self.pool) > 60:
            del self.pool[self.rng.randrange(len(self.pool))]

    def call(self, name: str, function: Any) -> None:
        """Call a function and judge the outcome."""
        words, named = self.arguments(function)
        if self.is_traced:
            print(name, *[repr(it)[:60] for it in words], {k: repr(v)[:60] for k, v in named.items()})
            sys.stdout.flush()
        self.names[name] += 1
        faulthandler.dump_traceback_later(LONGEST_CALL_S, exit=True)
        try:
            result = function(*words, **named)
            self.outcomes["returned"] += 1
            for one in result if isinstance(result, (list, tuple)) else [result]:
                self.keep(one)
            repr(result)
        except Exception as error:
            if "fault of Periplus" in str(error):
                print(f"{name}({words!r}, {named!r})", file=sys.stderr)
                raise
            self.outcomes[type(error).__name__] += 1
        finally:
            faulthandler.cancel_dump_traceback_later()

    def step(self) -> None:
        """One random call."""
        if self.pool and self.rng.random() < 0.6:
            target = self.rng.choice(self.pool)
            kind = type(target)
            names = [it for it in dir(kind) if not it.startswith("_") or it in DUNDERS]
            names = [it for it in names if it not in LEFT_OUT]
            if isinstance(target, np.ndarray) or not names:
                return
            name = self.rng.choice(names)
            if isinstance(inspect.getattr_static(kind, name, None), property) or not callable(
                getattr(kind, name, None)
            ):
                self.call(f"{kind.__name__}.{name}", lambda: getattr(target, name))
            else:
                self.call(f"{kind.__name__}.{name}", getattr(target, name))
            return
        name = self.rng.choice([it for it in periplus.__all__ if it not in LEFT_OUT])
        value = getattr(periplus, name)
        if isinstance(value, type):
            static = [
                key
                for key, it in vars(value).items()
                if isinstance(it, (staticmethod, classmethod)) and not key.startswith("_")
            ]
            if static and self.rng.random() < 0.5:
                key = self.rng.choice(static)
                self.call(f"{name}.{key}", getattr(value, key))
                return
        if callable(value):
            self.call(name, value)


DUNDERS = {"__repr__", "__eq__", "__len__", "__mul__", "__getitem__", "__hash__", "__iter__", "_repr_png_"}


def main() -> int:
    """Run the fuzzer."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--trace", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, text in [("box.sdf", BOX), ("m.yaml", YAML), ("m.pgm", "P2 2 2 255 0 255 205 0\n")]:
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        fuzzer = Fuzzer(options.seed, options.trace)
        end = time.monotonic() + options.seconds
        while time.monotonic() < end:
            if fuzzer.rng.random() < 0.01:
                fuzzer.keep(periplus.Simulation(periplus.World.demo(), threads=1))
            fuzzer.step()
        os.chdir("/")
    print(f"{sum(fuzzer.names.values())} calls of {len(fuzzer.names)} names:", end=" ")
    print(", ".join(f"{name} {count}" for name, count in fuzzer.outcomes.most_common()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
