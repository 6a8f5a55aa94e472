"""A controller of your own: the robot turns away from what its lidar sees."""

import numpy as np

from periplus import Simulation, World
from periplus.msgs.geometry_msgs.msg import Twist

STOP_RANGE_M = 0.6


def main() -> None:
    sim = Simulation(World.demo(), seed=3)
    nearest_m: list[float] = []

    def on_scan(scan: object) -> None:
        ranges = np.asarray(scan.ranges)  # type: ignore[attr-defined]
        front = np.concatenate([ranges[:30], ranges[-30:]])
        nearest_m.append(float(front[np.isfinite(front)].min(initial=np.inf)))
        command = Twist()
        if nearest_m[-1] < STOP_RANGE_M:
            command.angular.z = 0.8
        else:
            command.linear.x = 0.25
        sim.publish("/cmd_vel", command)

    sim.subscribe("/scan", on_scan)
    sim.run(20.0)

    pose = sim.model("sam_bot").pose
    print(f"{len(nearest_m)} scans; nearest in front {min(nearest_m):.2f} m; the robot is at {pose}")
    assert min(nearest_m) > 0.25, "the robot touched something"
    assert np.hypot(pose.x, pose.y) > 0.5, "the robot did not leave its start"


if __name__ == "__main__":
    main()
