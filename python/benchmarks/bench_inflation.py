"""Inflation of grids: beside the distance transform of OpenCV with the exponential in numpy.

    pip install opencv-python-headless
    python python/benchmarks/bench_inflation.py [turns]

Both inflate the same grids on one thread, turn by turn, so that a busy moment of the machine hits both alike; of each
the best turn counts. OpenCV runs with its 5 x 5 mask, whose distances are approximate, and with its exact one; the cost
is looked up for the whole grid or only within the inflation radius, whichever is faster.
"""

import os
import sys
import time
from collections.abc import Callable

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import cv2
import numpy as np
import periplus

cv2.setNumThreads(1)
RESOLUTION, INSCRIBED, RADIUS, SCALING = 0.05, 0.2, 0.55, 3.0


def rooms(side: int) -> np.ndarray:
    """A grid of walls with doors and scattered obstacles."""
    random = np.random.default_rng(side)
    costs = np.zeros((side, side), np.uint8)
    for wall in range(0, side, 80):
        costs[wall, :] = costs[:, wall] = 254
        for door in range(20, side, 80):
            costs[wall, door : door + 20] = costs[door : door + 20, wall] = 0
    rows, columns = random.integers(0, side, (2, side * side // 2000))
    costs[rows, columns] = 254
    costs[random.random((side, side)) < 0.02] = 255
    return costs


def opencv(costs: np.ndarray, mask: int) -> np.ndarray:
    free = np.where(costs == 254, 0, 255).astype(np.uint8)
    distance = cv2.distanceTransform(free, cv2.DIST_L2, mask) * np.float32(RESOLUTION)
    inflated = costs.copy()
    near = np.flatnonzero(distance < RADIUS + RESOLUTION)
    around = distance.reshape(-1)[near]
    graded = np.where(around <= INSCRIBED, 253, 252 * np.exp(-SCALING * (around - INSCRIBED)))
    graded = np.where(around == 0, 254, graded).astype(np.uint8)
    graded[around > RADIUS + 1e-6] = 0
    old = costs.reshape(-1)[near]
    known = np.maximum(old, graded)
    inflated.reshape(-1)[near] = np.where(old == 255, np.where(graded >= 253, graded, 255), known)
    return inflated


def seconds(run: Callable[[], object]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def main() -> None:
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    for side in (200, 1000, 4000):
        costs = rooms(side)
        jobs = {
            "periplus.inflate": lambda costs=costs: periplus.inflate(costs, RESOLUTION, INSCRIBED, RADIUS, SCALING),
            "OpenCV exact + numpy": lambda costs=costs: opencv(costs, cv2.DIST_MASK_PRECISE),
            "OpenCV 5x5 + numpy": lambda costs=costs: opencv(costs, 5),
        }
        exact = opencv(costs, cv2.DIST_MASK_PRECISE).astype(int)
        differ = np.abs(jobs["periplus.inflate"]().astype(int) - exact)
        best = dict.fromkeys(jobs, float("inf"))
        for _ in range(turns):
            for name, job in jobs.items():
                best[name] = min(best[name], seconds(job))
        print(f"\n{side} x {side} cells; costs differ from those of exact OpenCV by at most {differ.max()}")
        for name, took in best.items():
            print(f"  {name:24} {1e3 * took:9.3f} ms  {took / best['periplus.inflate']:6.2f} x the time of periplus")


if __name__ == "__main__":
    main()
