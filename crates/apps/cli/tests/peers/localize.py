"""A robot on a known map that knows nothing of Periplus: it drives to and fro, publishes scans, odometry
and the map, and says on its output where others say it is.

    localize.py DOMAIN

What it reads, a line each: `map FRAME` publishes the map in a frame; `scan FRAME` says in which frame it
scans from now on; `empty` makes the next 15 scans ones without ranges; `pose X Y YAW` says where it is, `doubt` the
same with no number in the covariance; `true` says where it really is; `anywhere` calls
/reinitialize_global_localization.
"""

import math
import sys
import threading
import time
from queue import Empty, Queue

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl.types import array, float32, float64, int8, sequence, uint8, uint32
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

from ros import Entities, Gid, NodeEntities, Time, message, qos, service

Header = message("std_msgs/Header", stamp=Time, frame_id=str)
Point = message("geometry_msgs/Point", x=float64, y=float64, z=float64)
Vector = message("geometry_msgs/Vector3", x=float64, y=float64, z=float64)
Turn = message("geometry_msgs/Quaternion", x=float64, y=float64, z=float64, w=float64)
Pose = message("geometry_msgs/Pose", position=Point, orientation=Turn)
Doubted = message("geometry_msgs/PoseWithCovariance", pose=Pose, covariance=array[float64, 36])
Stamped = message("geometry_msgs/PoseWithCovarianceStamped", header=Header, pose=Doubted)
Transform = message("geometry_msgs/Transform", translation=Vector, rotation=Turn)
TransformStamped = message(
    "geometry_msgs/TransformStamped", header=Header, child_frame_id=str, transform=Transform
)
Frames = message("tf2_msgs/TFMessage", transforms=sequence[TransformStamped])
MapData = message(
    "nav_msgs/MapMetaData", map_load_time=Time, resolution=float32, width=uint32, height=uint32, origin=Pose
)
Map = message("nav_msgs/OccupancyGrid", header=Header, info=MapData, data=sequence[int8])
Scan = message(
    "sensor_msgs/LaserScan",
    header=Header,
    angle_min=float32,
    angle_max=float32,
    angle_increment=float32,
    time_increment=float32,
    scan_time=float32,
    range_min=float32,
    range_max=float32,
    ranges=sequence[float32],
    intensities=sequence[float32],
)
Particle = message("nav2_msgs/Particle", pose=Pose, weight=float64)
Cloud = message("nav2_msgs/ParticleCloud", header=Header, particles=sequence[Particle])
Nothing = service("std_srvs/Empty", {}, {})

participant = DomainParticipant(int(sys.argv[1]))
readers, writers = [], []


def writer(name, kind, of=qos()):
    writers.append(DataWriter(participant, Topic(participant, name, kind, qos=of), qos=of))
    return writers[-1]


def reader(name, kind, of=qos()):
    readers.append(DataReader(participant, Topic(participant, name, kind, qos=of), qos=of))
    return readers[-1]


# The room: 6 by 4 metres with a pillar and a corner cut off, cells of 5 cm from (-1, -1) on.
SIDE, WIDTH, HEIGHT = 0.05, 120, 80
cells = [0] * (WIDTH * HEIGHT)
for left, low, right, high in (
    (0, 0, 120, 2), (0, 78, 120, 80), (0, 0, 2, 80), (118, 0, 120, 80), (30, 50, 38, 58), (90, 0, 120, 16)
):
    for row in range(low, high):
        cells[row * WIDTH + left : row * WIDTH + right] = [100] * (right - left)


def look(x, y, yaw):
    """What a scanner in the middle of the robot sees: 120 beams all around."""
    ranges = []
    for beam in range(120):
        angle = yaw - math.pi + beam * math.tau / 120
        cosine, sine = math.cos(angle), math.sin(angle)
        for step in range(1, 400):
            column = int((x + 0.02 * step * cosine + 1.0) / SIDE)
            row = int((y + 0.02 * step * sine + 1.0) / SIDE)
            if cells[row * WIDTH + column]:
                break
        ranges.append(0.02 * step)
    return ranges


def after(one, other):
    """The second pose, given as seen from the first."""
    (x, y, yaw), (right, up, turn) = one, other
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return (x + cosine * right - sine * up, y + sine * right + cosine * up, yaw + turn)


def pose(x, y, yaw):
    return Pose(Point(x, y, 0.0), Turn(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))


def plain(place, turn):
    return (place.x, place.y, 2 * math.atan2(turn.z, turn.w))


def header(stamp_ns, frame):
    return Header(Time(stamp_ns // 10**9, stamp_ns % 10**9), frame)


def frames(stamp_ns, parent, child, at):
    of = pose(*at)
    transform = Transform(Vector(of.position.x, of.position.y, 0.0), of.orientation)
    return Frames([TransformStamped(header(stamp_ns, parent), child, transform)])


maps = writer("rt/map", Map, qos(latched=True, depth=1))
scans = writer("rt/scan", Scan, qos(depth=5))
moving = writer("rt/tf", Frames)
fixed = writer("rt/tf_static", Frames, qos(latched=True, depth=1))
guesses = writer("rt/initialpose", Stamped)
asks = writer("rq/reinitialize_global_localizationRequest", Nothing[0])
answers = reader("rr/reinitialize_global_localizationReply", Nothing[1])
poses = reader("rt/amcl_pose", Stamped, qos(latched=True, depth=1))
clouds = reader("rt/particle_cloud", Cloud, qos(depth=5, reliable=False))
others = reader("rt/tf", Frames)

told = writer("ros_discovery_info", Entities, qos(latched=True, depth=1))


def gid(end):
    return Gid(list(end.guid.bytes))


mine = NodeEntities("/", "robot", [gid(end) for end in readers], [gid(end) for end in writers if end is not told])
told.write(Entities(gid(participant), [mine]))

MAP_FROM_ODOM = (0.5, 0.25, 0.5)
# To and fro over a metre, in steps of 0.1 m.
WAY = [0.1 * step for step in [*range(11), *range(9, 0, -1)]]
SEEN = {step: look(*after(MAP_FROM_ODOM, (step, 0.0, 0.0))) for step in sorted(set(WAY))}

fixed.write(frames(time.time_ns(), "base_footprint", "laser", (0.0, 0.0, 0.0)))

words = Queue()


def read():
    for line in sys.stdin:
        words.put(line)
    words.put("end")


threading.Thread(target=read, daemon=True).start()
print("ready", flush=True)


def guess(at, doubt):
    covariance = [0.0] * 36
    covariance[0] = covariance[7] = 0.05
    covariance[35] = 0.02
    if doubt:
        covariance[7] = math.nan
    guesses.write(Stamped(header(0, "map"), Doubted(pose(*at), covariance)))


def do(line):
    global blind, frame
    word, *rest = line.split()
    if word == "map":
        data = MapData(Time(0, 0), SIDE, WIDTH, HEIGHT, pose(-1.0, -1.0, 0.0))
        maps.write(Map(header(time.time_ns(), rest[0]), data, cells))
    elif word == "scan":
        frame = rest[0]
    elif word == "empty":
        blind = 15
    elif word in ("pose", "doubt"):
        guess([float(one) for one in rest], word == "doubt")
    elif word == "true":
        guess(after(MAP_FROM_ODOM, (here, 0.0, 0.0)), False)
    elif word == "anywhere":
        asks.write(Nothing[0](7, 1, 0))


def scan(stamp_ns, ranges):
    step = math.tau / 120
    scans.write(
        Scan(header(stamp_ns, frame), -math.pi, math.pi - step, step, 0.0, 0.1, 0.05, 10.0, ranges, [])
    )


def valid(reader):
    return [one for one in reader.take(100) if one.sample_info.valid_data]


def apart(one, other):
    return "near" if math.hypot(one[0] - other[0], one[1] - other[1]) < 0.15 else "far"


frame, blind, here, turn, due = "laser", 0, 0.0, 0, time.monotonic()
real = {}
while True:
    try:
        line = words.get_nowait().strip()
        if line == "end":
            break
        do(line)
    except Empty:
        pass
    if time.monotonic() >= due:
        due += 0.1
        stamp_ns = time.time_ns()
        here = WAY[turn % len(WAY)]
        turn += 1
        real[stamp_ns] = after(MAP_FROM_ODOM, (here, 0.0, 0.0))
        moving.write(frames(stamp_ns, "odom", "base_footprint", (here, 0.0, 0.0)))
        scan(stamp_ns, [] if blind else SEEN[here])
        blind = max(blind - 1, 0)
    for one in valid(poses):
        stamp = one.header.stamp
        truth = real.get(stamp.sec * 10**9 + stamp.nanosec)
        if truth:
            at = plain(one.pose.pose.position, one.pose.pose.orientation)
            print("pose", apart(at, truth), *(f"{number:.2f}" for number in at), flush=True)
    for one in valid(clouds):
        print("cloud", len(one.particles), one.header.frame_id, flush=True)
    for transform in (edge for one in valid(others) for edge in one.transforms):
        if (transform.header.frame_id, transform.child_frame_id) == ("map", "odom"):
            at = plain(transform.transform.translation, transform.transform.rotation)
            print("tf", apart(at, MAP_FROM_ODOM), flush=True)
    for _ in valid(answers):
        print("answered", flush=True)
    time.sleep(0.002)
