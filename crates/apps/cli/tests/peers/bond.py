"""An end of a bond that knows nothing of Periplus, of PyPI's cyclonedds alone.

    bond.py DOMAIN manager ID      a manager's end; says `formed`, `ended` and, after 2 s without a
                                   heartbeat, `broken`
    bond.py DOMAIN node NAME       a managed node that keeps a bond once it is active
    bond.py DOMAIN silent NAME     a managed node that keeps none
"""

import sys
import time
import uuid

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl.types import float32, uint8
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

from ros import Time, message, qos, service

DOMAIN, ROLE, NAME = int(sys.argv[1]), sys.argv[2], sys.argv[3]

Header = message("std_msgs/Header", stamp=Time, frame_id=str)
Status = message(
    "bond/Status",
    header=Header,
    id=str,
    instance_id=str,
    active=bool,
    heartbeat_timeout=float32,
    heartbeat_period=float32,
)
Transition = message("lifecycle_msgs/Transition", id=uint8, label=str)
State = message("lifecycle_msgs/State", id=uint8, label=str)
GetState = service("lifecycle_msgs/GetState", {}, {"current_state": State})
ChangeState = service("lifecycle_msgs/ChangeState", {"transition": Transition}, {"success": bool})

participant = DomainParticipant(DOMAIN)
topic = lambda name, kind: Topic(participant, name, kind, qos=qos())
heartbeats = DataWriter(participant, topic("rt/bond", Status), qos=qos())
heard = DataReader(participant, topic("rt/bond", Status), qos=qos())
if ROLE != "manager":
    asks = DataReader(participant, topic(f"rq/{NAME}/change_stateRequest", ChangeState[0]), qos=qos())
    tells = DataWriter(participant, topic(f"rr/{NAME}/change_stateReply", ChangeState[1]), qos=qos())
    looks = DataReader(participant, topic(f"rq/{NAME}/get_stateRequest", GetState[0]), qos=qos())
    shows = DataWriter(participant, topic(f"rr/{NAME}/get_stateReply", GetState[1]), qos=qos())

OWN = str(uuid.uuid4())
TIMEOUT = 2.0
state = 1
bonded, formed, ended, last, beaten = ROLE == "manager", False, False, 0.0, 0.0
print("ready", flush=True)
while True:
    if ROLE != "manager":
        for asked in (one for one in asks.take(10) if one.sample_info.valid_data):
            while not tells.get_matched_subscriptions():
                time.sleep(0.005)
            print("asked", asked.transition.id, flush=True)
            state = {1: 2, 2: 1, 3: 3, 4: 2}.get(asked.transition.id, state)
            bonded = ROLE == "node" and asked.transition.id == 3
            tells.write(ChangeState[1](asked.caller, asked.number, True))
        for asked in (one for one in looks.take(10) if one.sample_info.valid_data):
            while not shows.get_matched_subscriptions():
                time.sleep(0.005)
            shows.write(GetState[1](asked.caller, asked.number, State(state, "")))
    if formed and not ended and time.monotonic() - beaten > TIMEOUT:
        ended = True
        print("broken", flush=True)
    if bonded and time.monotonic() - last >= 0.1:
        last = time.monotonic()
        heartbeats.write(Status(Header(Time(0, 0), ""), NAME, OWN, not ended, 4.0, 0.1))
    for one in (one for one in heard.take(100) if one.sample_info.valid_data):
        if one.id != NAME or one.instance_id == OWN:
            continue
        beaten = time.monotonic()
        if one.active and not formed:
            formed = True
            print(f"formed {one.heartbeat_period:.1f} {one.heartbeat_timeout:.1f}", flush=True)
        if not one.active and not ended:
            ended = True
            print("ended", flush=True)
    time.sleep(0.005)
