"""Reads a lidar, a depth camera and a cloud as arrays of numpy, without copies."""

import numpy as np

from periplus import Simulation, World


def main() -> None:
    sim = Simulation(World.demo())
    lidar = sim.sensor("/scan")
    depth = sim.sensor("/depth_camera/depth/image_raw")
    cloud = sim.sensor("/depth_camera/points")
    sim.run(0.5)

    scan, image, points = lidar.read(), depth.read(), cloud.read()
    nearest = int(np.argmin(scan.ranges))
    print(f"nearest: {scan.ranges[nearest]:.3f} m at {np.degrees(scan.angles[nearest]):.0f} degrees")
    print(f"depth: {image.pixels.shape} of {image.pixels.dtype}, cloud: {points.xyz.shape}")
    # The arrays are the memory of the messages.
    assert image.pixels.ctypes.data == image.address
    assert points.xyz.ctypes.data == points.address
    # The red cube is 1.55 m ahead of the robot's origin; the cloud has it too.
    assert 1.0 < np.nanmin(image.pixels[200:280, 300:340]) < 1.6
    assert np.isfinite(points.xyz[..., 2]).any()


if __name__ == "__main__":
    main()
