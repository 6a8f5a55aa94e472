"""What Python adds to a simulation: time of a step, and readings without copies. Prints a table.

The steps of ``sim.step()`` in a loop of Python are compared with those of one ``sim.step(n)``, which loops in
Rust, turn by turn in one run; the best of the turns counts.
"""

from __future__ import annotations

import time

from periplus import Simulation, World
from periplus.msgs.geometry_msgs.msg import Twist, Vector3

STEPS = 200
TURNS = 150


def main() -> None:
    sim = Simulation(World.demo(), threads=1)
    sim.publish("/cmd_vel", Twist(angular=Vector3(z=0.5)))
    sim.run(1.0)
    python_s = rust_s = float("inf")
    for _ in range(TURNS):
        start = time.perf_counter()
        for _ in range(STEPS):
            sim.step()
        middle = time.perf_counter()
        sim.step(STEPS)
        end = time.perf_counter()
        python_s = min(python_s, (middle - start) / STEPS)
        rust_s = min(rust_s, (end - middle) / STEPS)
    print(f"step from Python {python_s * 1e6:.2f} us, in Rust {rust_s * 1e6:.2f} us: ", end="")
    print(f"{(python_s - rust_s) * 1e6:.2f} us more")

    depth = sim.sensor("/depth_camera/depth/image_raw")
    cloud = sim.sensor("/depth_camera/points")
    sim.run(0.5)
    image, points = depth.read(), cloud.read()
    for name, reading, array in [
        ("depth image", image, image.pixels),
        ("cloud", points, points.points),
    ]:
        start = time.perf_counter()
        for _ in range(1000):
            reading.pixels if reading is image else reading.points
        each_us = (time.perf_counter() - start) * 1e3
        print(
            f"{name} {array.shape} {array.dtype}: message at {reading.address:#x}, "
            f"array at {array.ctypes.data:#x}; {each_us:.2f} us"
        )
        assert reading.address == array.ctypes.data


if __name__ == "__main__":
    main()
