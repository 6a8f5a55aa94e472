"""Inflation with OpenCV: `opencv.py CELLS SIDE` prints the fastest seconds of some turns."""

import json
import sys
import time

import cv2
import numpy as np


def main() -> None:
    side = int(sys.argv[2])
    cells = np.fromfile(sys.argv[1], dtype=np.uint8).reshape(side, side)
    cv2.setNumThreads(1)
    resolution, radius, inscribed, scaling = 0.05, 0.55, 0.2, 3.0
    reach = int(np.ceil(radius / resolution))
    steps = np.arange(reach * 100 + 1) / 100.0 * resolution
    table = np.where(
        steps <= inscribed, 253, (252 * np.exp(-scaling * (steps - inscribed))).astype(np.uint8)
    ).astype(np.uint8)
    table[0] = 254
    best = {"transform": float("inf"), "whole": float("inf")}
    for _ in range(5):
        start = time.perf_counter()
        free = np.where(cells == 254, 0, 255).astype(np.uint8)
        before = time.perf_counter()
        distance = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        after = time.perf_counter()
        near = distance <= reach
        costs = np.zeros_like(cells)
        costs[near] = table[(distance[near] * 100 + 0.5).astype(np.int32)]
        result = np.maximum(cells, costs)
        end = time.perf_counter()
        best["transform"] = min(best["transform"], after - before)
        best["whole"] = min(best["whole"], end - start)
        assert result.max() == 254
    print(json.dumps(best))


main()
