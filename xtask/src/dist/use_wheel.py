"""Uses an installed wheel: a simulation with a lidar, a map of its scans, and the command.

    python use_wheel.py ROOT

ROOT is the source tree, of which only a robot is read.
"""

import shutil
import subprocess
import sys
from pathlib import Path

import periplus
from periplus import Simulation, Slam, World
from periplus.msgs.geometry_msgs.msg import Twist, Vector3

root = Path(sys.argv[1])
assert root not in Path(periplus.__file__).parents or "site-packages" in periplus.__file__, periplus.__file__

simulation, slam = Simulation(World.demo()), Slam(max_laser_range=3.5, minimum_travel_distance=0.1)
lidar = simulation.sensor("/scan")
for _ in range(5):
    simulation.publish("/cmd_vel", Twist(linear=Vector3(x=0.2)))
    simulation.run(1.0)
    slam.process(lidar.read(), simulation.lookup_transform("odom", "base_link"))
cells = slam.map().cells
# Percent; walls are at 65 and above.
assert (cells >= 65).sum() > 20, "no walls in the map"

command = shutil.which("periplus", path=str(Path(sys.executable).parent))
assert command, "the wheel installed no command"
robot = root / "robots/sam_bot/urdf/sam_bot.urdf.xacro"
subprocess.run([command, "check", "--quiet", robot], check=True)
version = subprocess.run([command, "--version"], check=True, capture_output=True, text=True).stdout.strip()
assert version == f"periplus {periplus.__version__}", version
print(f"{version} on Python {sys.version.split()[0]}: {cells.shape[1]} x {cells.shape[0]} cells")
