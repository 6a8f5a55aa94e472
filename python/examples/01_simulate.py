"""Simulates a robot: it drives straight for two seconds."""

from periplus import Simulation, World
from periplus.msgs.geometry_msgs.msg import Twist, Vector3


def main() -> None:
    sim = Simulation(World.demo(), seed=0)
    sim.publish("/cmd_vel", Twist(linear=Vector3(x=0.2)))
    sim.run(2.0)

    robot = sim.model("sam_bot")
    print(f"after {sim.time_s} s the robot is at x = {robot.pose.x:.3f} m")
    # 2 s at 0.2 m/s, less the acceleration.
    assert 0.3 < robot.pose.x < 0.41
    # The same files, seed and calls give the same numbers, to the bit.
    again = Simulation(World.demo(), seed=0)
    again.publish("/cmd_vel", Twist(linear=Vector3(x=0.2)))
    again.run(2.0)
    assert again.model("sam_bot").pose == robot.pose


if __name__ == "__main__":
    main()
