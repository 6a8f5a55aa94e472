"""Records a run, reads it back as messages and as arrays, and writes a bag."""

import numpy as np

from periplus import BagWriter, Simulation, World, open_bag
from periplus.msgs.geometry_msgs.msg import Twist, Vector3


def main() -> None:
    with Simulation(World.demo(), record="run.mcap") as sim:
        sim.publish("/cmd_vel", Twist(linear=Vector3(x=0.2)))
        sim.run(3.0)

    bag = open_bag("run.mcap")
    print({topic.name: topic.count for topic in bag.topics})
    scans = 0
    for topic, message, time_ns in bag:
        if topic == "/scan":
            scans += 1
            assert message.ranges.dtype == np.float32 and time_ns >= 0
    assert scans == 16, "at 5 Hz, from 0 to 3 s"

    odometry = bag.to_numpy("/demo/odom", ["pose.pose.position.x", "twist.twist.linear.x"])
    x = odometry["pose.pose.position.x"]
    print(f"{len(x)} poses, from x = {x[0]:.3f} m to {x[-1]:.3f} m")
    assert 0.45 < x[-1] < 0.6

    with BagWriter("copy.mcap") as copy:
        for topic, message, time_ns in open_bag("run.mcap", topics=["/scan"]):
            copy.write(topic, message, time_ns)
    assert open_bag("copy.mcap").message_count == scans


if __name__ == "__main__":
    main()
