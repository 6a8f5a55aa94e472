"""A costmap layer written in Python: beside the same operations of numpy alone.

    python python/benchmarks/bench_costmap_layer.py [turns]

The layer updates the whole costmap in each update. The alternative runs the very same operations on an array of the
same size, without a costmap. Both run turn by turn; of each the best turn counts.
"""

import sys
import time
from collections.abc import Callable

import numpy as np
import periplus

SIDE = 20
RESOLUTION = 0.02


class Social:
    """Costs around three persons: a Gaussian each."""

    persons = ((3.0, 4.0), (10.0, 12.0), (16.0, 6.0))

    def update_costs(self, costs: np.ndarray, min_i: int, min_j: int, max_i: int, max_j: int) -> None:
        x = (np.arange(min_i, max_i, dtype=np.float32) + 0.5) * RESOLUTION
        y = (np.arange(min_j, max_j, dtype=np.float32) + 0.5) * RESOLUTION
        window = costs[min_j:max_j, min_i:max_i]
        for person_x, person_y in self.persons:
            cost = np.exp(-((y - person_y) ** 2))[:, None] * (250 * np.exp(-((x - person_x) ** 2)))
            np.maximum(window, cost.astype(np.uint8), out=window)


class Maximum:
    """The cheapest layer there is: the maximum with a mask."""

    def __init__(self, mask: np.ndarray) -> None:
        self.mask = mask

    def update_costs(self, costs: np.ndarray, min_i: int, min_j: int, max_i: int, max_j: int) -> None:
        window = costs[min_j:max_j, min_i:max_i]
        np.maximum(window, self.mask[min_j:max_j, min_i:max_i], out=window)


def seconds(run: Callable[[], object]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def main() -> None:
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    cells = round(SIDE / RESOLUTION)
    mask = np.random.default_rng(0).integers(0, 255, (cells, cells), dtype=np.uint8)
    for layer in (Social(), Maximum(mask)):
        costmap = periplus.Costmap(width=SIDE, height=SIDE, resolution=RESOLUTION, plugins=[layer])
        array = np.zeros((cells, cells), np.uint8)

        def alone(layer: Social | Maximum = layer, array: np.ndarray = array) -> None:
            array[:] = 0
            layer.update_costs(array, 0, 0, cells, cells)

        best = [float("inf")] * 2
        for _ in range(turns):
            best = [min(old, seconds(run)) for old, run in zip(best, (costmap.update, alone), strict=True)]
        assert np.array_equal(costmap.costs, array)
        print(
            f"{type(layer).__name__}, {cells} x {cells} cells: update of the costmap {1e3 * best[0]:.3f} ms, "
            f"numpy alone {1e3 * best[1]:.3f} ms, ratio {best[0] / best[1]:.2f}"
        )


if __name__ == "__main__":
    main()
