"""Localizes a robot in a known map, without an initial pose."""

import numpy as np

from periplus import Amcl, LaserScanner, OccupancyGrid, RayScene

BEAM_COUNT = 180
WIDTH_M, HEIGHT_M, CELL_M = 6.0, 4.0, 0.05


def room() -> tuple[OccupancyGrid, RayScene]:
    """A room with a box in it, as a map and as walls for rays."""
    cells = np.zeros((round(HEIGHT_M / CELL_M), round(WIDTH_M / CELL_M)), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[20:30, 80:100] = 100
    scene = RayScene()
    for x, y, size_x, size_y in [
        (0.025, 2.0, 0.05, 4.0),
        (5.975, 2.0, 0.05, 4.0),
        (3.0, 0.025, 6.0, 0.05),
        (3.0, 3.975, 6.0, 0.05),
        (4.5, 1.25, 1.0, 0.5),
    ]:
        scene.add_box([size_x, size_y, 2.0], (x, y, 0.0))
    return OccupancyGrid(cells, CELL_M), scene


def main() -> None:
    grid, scene = room()
    step = 2 * np.pi / BEAM_COUNT
    scanner = LaserScanner(0.0, step, range_min=0.05, range_max=10.0)
    amcl = Amcl(grid, scanner=scanner)
    truth = np.array([1.5, 1.0, 0.3])

    def scan() -> np.ndarray:
        angles = truth[2] + step * np.arange(BEAM_COUNT)
        directions = np.stack([np.cos(angles), np.sin(angles), np.zeros(BEAM_COUNT)], axis=1)
        return scene.distances([truth[0], truth[1], 0.0], directions)

    found = amcl.localize_globally(scan())
    print(f"{len(found)} hypotheses, the best at {found[0]}")
    for tick in range(20):
        truth += [0.05 * np.cos(truth[2]), 0.05 * np.sin(truth[2]), 0.02]
        # Perfect odometry in a frame that begins elsewhere.
        odom = (truth[0] - 1.5, truth[1] - 1.0, truth[2])
        estimate = amcl.update(scan(), odom, time_s=0.1 * tick)
    assert estimate.pose is not None
    error_m = np.hypot(estimate.pose.x - truth[0], estimate.pose.y - truth[1])
    print(f"{estimate.state}; {error_m:.3f} m off: {estimate.reason}")
    assert error_m < 0.1


if __name__ == "__main__":
    main()
