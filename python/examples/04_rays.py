"""Casts rays against shapes and a mesh, without a simulation."""

import numpy as np

from periplus import Pose, RayScene


def main() -> None:
    scene = RayScene()
    pillar = scene.add_cylinder(0.25, 2.0, Pose(2.0, 0.0, 0.0))
    vertices = [[4.0, -5.0, -5.0], [4.0, 5.0, -5.0], [4.0, 0.0, 9.0]]
    wall = scene.add_mesh(vertices, [[0, 1, 2]])

    angles = np.linspace(-0.5, 0.5, 101)
    directions = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    distances, normals, ids = scene.cast([0.0, 0.0, 0.0], directions)
    print(f"ahead {distances[50]:.3f} m, {np.sum(ids == pillar)} of {len(ids)} rays hit the pillar")
    assert abs(distances[50] - 1.75) < 1e-12
    assert np.allclose(normals[50], [-1.0, 0.0, 0.0])
    # The first ray passes the pillar: 4 m / cos(0.5) to the wall.
    assert ids[0] == wall and abs(distances[0] - 4.0 / np.cos(0.5)) < 1e-6

    scene.remove(pillar)
    assert abs(scene.distances([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]) - 4.0) < 1e-6


if __name__ == "__main__":
    main()
