"""Keeps a costmap with a layer written in Python: a lane in which it is dearer to drive."""

import numpy as np

from periplus import Costmap, UpdateBounds


class Lane:
    """Raises the costs of a lane along x."""

    def __init__(self) -> None:
        self.rows = slice(0, 0)

    def update_bounds(self, x: float, y: float, yaw: float, bounds: UpdateBounds) -> None:
        bounds.touch_all()

    def update_costs(
        self, costs: np.ndarray, min_i: int, min_j: int, max_i: int, max_j: int
    ) -> None:
        lane = costs[60:70, min_i:max_i]
        np.maximum(lane, 120, out=lane)


def main() -> None:
    costmap = Costmap(
        {
            "rolling_window": True,
            "width": 4,
            "height": 4,
            "resolution": 0.05,
            "robot_radius": 0.2,
            "plugins": ["obstacle_layer", "inflation_layer"],
            "obstacle_layer": {
                "plugin": "nav2_costmap_2d::ObstacleLayer",
                "observation_sources": "scan",
                "scan": {"max_obstacle_height": 2.0, "clearing": True},
            },
            "inflation_layer": {
                "plugin": "nav2_costmap_2d::InflationLayer",
                "inflation_radius": 0.6,
                "cost_scaling_factor": 3.0,
            },
        }
    )
    costmap.add_layer(Lane())
    # A lidar 0.2 m above the floor sees a point 1 m ahead.
    costmap.observe("obstacle_layer", "scan", [[1.0, 0.0, 0.0]], (0.0, 0.0, 0.2, 0.0, 0.0, 0.0))
    costmap.update(0.0, (0.0, 0.0, 0.0))

    costs = costmap.cost_at([[1.0, 0.0, 0.0], [0.9, 0.0, 0.0], [0.6, 0.0, 0.0], [-1.0, -1.5, 0.0]])
    print(f"costs at 1.0, 0.9 and 0.6 m ahead, and beside: {costs.tolist()}")
    assert costs[0] == 254 and costs[1] == 253 and 0 < costs[2] < 253 and costs[3] == 0
    assert (costmap.costs[60:70] >= 120).all(), "the lane"
    print(costmap.explain(1.0, 0.0))


if __name__ == "__main__":
    main()
