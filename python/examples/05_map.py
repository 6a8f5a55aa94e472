"""Maps a room while a robot drives through it, and saves the map."""

from periplus import OccupancyGrid, Simulation, Slam, World
from periplus.msgs.geometry_msgs.msg import Twist, Vector3


def main() -> None:
    sim = Simulation(World.demo())
    slam = Slam(max_laser_range=3.5, minimum_travel_distance=0.2)
    lidar = sim.sensor("/scan")
    for turn in [0.5] * 60 + [0.0] * 40 + [0.5] * 30:
        sim.publish("/cmd_vel", Twist(linear=Vector3(x=0.2), angular=Vector3(z=turn)))
        sim.run(0.2)
        scan = lidar.read()
        slam.process(scan, sim.lookup_transform("odom", "base_link", scan.time_s))

    estimate, truth = slam.map_from_base, sim.model("sam_bot").pose
    grid = slam.map()
    print(f"{slam.counts['keyframes']} keyframes; map of {grid.width} x {grid.height} cells")
    print(f"the robot is at {estimate.x:.3f}, {estimate.y:.3f}; truly at {truth.x:.3f}, {truth.y:.3f}")
    assert abs(estimate.x - truth.x) < 0.1 and abs(estimate.y - truth.y) < 0.1
    assert 100 < (grid.cells > 65).sum() < 3000

    path = grid.save("room.yaml")
    assert OccupancyGrid.load(path).cells.shape == grid.cells.shape


if __name__ == "__main__":
    main()
