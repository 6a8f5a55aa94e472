"""A cart between two casters in MuJoCo (PyPI `mujoco`), with its own contact settings.

Usage: casters_mujoco.py < jobs. A job is a line `DROP FRICTION`: how much too low the casters are [m], and
their friction. The answer is the way [m] in 5 s at 0.3 m/s, after a second of standing. The cart is that of
crates/simulation/physics/tests/casters/cart.rs. The servos are soft enough to be stable with wheels of 60 g.
"""

import sys

import mujoco

SPEED_M_S, RADIUS_M, STEP_S = 0.3, 0.035, 0.001


def scene(drop, friction):
    # Friction of a pair is the larger one in MuJoCo unless one has priority.
    caster = f'<geom type="sphere" size=".0175" pos="{{}} 0 {-0.0225 - drop}" mass=".03" friction="{friction} .005 .0001" priority="1"/>'
    wheel = """<body name="{0}" pos="0 {1} -.005"><joint name="{0}" type="hinge" axis="0 1 0"/>
        <geom type="cylinder" size=".035 .0025" euler="90 0 0" mass=".06" friction="1 .005 .0001"/></body>"""
    servo = '<velocity joint="{0}" kv=".05" forcerange="-5 5"/>'
    return f"""<mujoco><option timestep="{STEP_S}" cone="elliptic" impratio="10" integrator="implicitfast"/>
      <worldbody><geom type="plane" size="50 50 .1" friction="1 .005 .0001"/>
        <body name="deck" pos="0 0 .04"><freejoint/><geom type="box" size=".08 .08 .005" mass="2.5"/>
          {caster.format(0.052)}{caster.format(-0.052)}{wheel.format("left", 0.087)}{wheel.format("right", -0.087)}
        </body></worldbody>
      <contact><exclude body1="deck" body2="left"/><exclude body1="deck" body2="right"/></contact>
      <actuator>{servo.format("left")}{servo.format("right")}</actuator></mujoco>"""


for line in sys.stdin:
    drop, friction = map(float, line.split())
    model = mujoco.MjModel.from_xml_string(scene(drop, friction))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=1000)
    start = data.qpos[0]
    for tick in range(5000):
        data.ctrl[:] = min(SPEED_M_S, tick * STEP_S) / RADIUS_M
        mujoco.mj_step(model, data)
    print(f"{data.qpos[0] - start:.6f}", flush=True)
