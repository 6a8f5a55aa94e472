"""A robot with two wheels and a caster in MuJoCo (PyPI `mujoco`), driven as told on stdin.

Usage: physics_mujoco.py ball|cylinder < jobs. A job is a line `NAME AHEAD TURN SECONDS BLOCK`: commanded
speed [m/s] and turn [rad/s], and what stands in the way (`none`, `wall`, `step`). The answer is a JSON
line. The robot is robots/sam_bot of this repository, whose wheels touch by a ball or by a cylinder.
"""

import json
import math
import sys
import time

import mujoco

STEP_S = 0.001
CHUNK = 100
RADIUS_M, SEPARATION_M = 0.10, 0.36
TYRES = {"ball": 'type="sphere" size=".1"', "cylinder": 'type="cylinder" size=".1 .02" euler="90 0 0"'}
BLOCKS = {
    "none": "",
    "wall": '<geom type="box" pos="2.1 0 .5" size=".1 3 .5" friction="1"/>',
    "step": '<geom type="box" pos="2 0 .005" size="1 3 .005" friction="1"/>',
}


def scene(tyre, block):
    # Friction of a pair is the larger one in MuJoCo unless one has priority. Velocity servos of
    # 1000 N m s/rad hold their speed as the motors of the other engines do.
    wheel = """<body name="{0}" pos="-.12 {1} -.05"><joint name="{0}" type="hinge" axis="0 1 0"/>
        <geom {2} mass=".5" friction="1 .005 .0001"/></body>"""
    servo = '<velocity joint="{0}" kv="1000" forcerange="-20 20"/>'
    return f"""<mujoco><option timestep="{STEP_S}" cone="elliptic" impratio="10" integrator="implicitfast"/>
      <worldbody><geom type="plane" size="50 50 .1" friction="1 .005 .0001"/>{BLOCKS[block]}
        <body name="base" pos="0 0 .15"><freejoint/>
          <geom type="box" size=".21 .155 .09" mass="15" friction="1 .005 .0001"/>
          <geom type="sphere" size=".06" pos=".14 0 -.09" mass=".5" friction=".001 .005 .0001" priority="1"/>
          {wheel.format("left", .18, TYRES[tyre])}{wheel.format("right", -.18, TYRES[tyre])}
        </body></worldbody>
      <contact><exclude body1="base" body2="left"/><exclude body1="base" body2="right"/></contact>
      <actuator>{servo.format("left")}{servo.format("right")}</actuator></mujoco>"""


def yaw(q):
    return math.atan2(2 * (q[3] * q[6] + q[4] * q[5]), 1 - 2 * (q[5] ** 2 + q[6] ** 2))


def drive(tyre, name, ahead, turn, seconds, block):
    model = mujoco.MjModel.from_xml_string(scene(tyre, block))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=round(1 / STEP_S))
    x, y, heading = data.qpos[0], data.qpos[1], yaw(data.qpos)
    wheels, last, turned, best = data.qpos[7:9].copy(), heading, 0.0, math.inf
    data.ctrl[:] = [(ahead + side * turn * SEPARATION_M / 2) / RADIUS_M for side in (-1, 1)]
    steps = round(seconds / STEP_S)
    for _ in range(steps // CHUNK):
        start = time.perf_counter()
        mujoco.mj_step(model, data, nstep=CHUNK)
        best = min(best, time.perf_counter() - start)
        now = yaw(data.qpos)
        turned += math.remainder(now - last, math.tau)
        last = now
    dx, dy = data.qpos[0] - x, data.qpos[1] - y
    left, right = data.qpos[7:9] - wheels
    cosine, sine = math.cos(heading), math.sin(heading)
    return {
        "test": name,
        "along_m": cosine * dx + sine * dy,
        "aside_m": cosine * dy - sine * dx,
        "turned_rad": turned,
        "left_rad": left,
        "right_rad": right,
        "height_m": data.qpos[2],
        "us_per_step": best / CHUNK * 1e6,
    }


if __name__ == "__main__":
    print(json.dumps({"engine": f"MuJoCo {mujoco.__version__}"}), flush=True)
    for line in sys.stdin:
        job, ahead, turn, seconds, block = line.split()
        result = drive(sys.argv[1], job, float(ahead), float(turn), float(seconds), block)
        print(json.dumps(result), flush=True)
