"""A program that knows nothing of Periplus: a ROS 2 node as rmw_cyclonedds would have it, of PyPI's
cyclonedds alone. It has topics, a service, parameters, a managed life and an action, and says on its
output what it hears.

    robot.py DOMAIN NODE
"""

import sys
import threading
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl.types import array, float64, int8, int32, int64, sequence, uint8, uint32, uint64
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

from ros import Entities, Gid, NodeEntities, Time, message, qos, service, struct

DOMAIN, NODE = int(sys.argv[1]), sys.argv[2]


Text = message("std_msgs/String", data=str)
Vector = message("geometry_msgs/Vector3", x=float64, y=float64, z=float64)
Twist = message("geometry_msgs/Twist", linear=Vector, angular=Vector)

Trigger = service("std_srvs/Trigger", {}, {"success": bool, "message": str})

Value = message(
    "rcl_interfaces/ParameterValue",
    type=uint8,
    bool_value=bool,
    integer_value=int64,
    double_value=float64,
    string_value=str,
    byte_array_value=sequence[uint8],
    bool_array_value=sequence[bool],
    integer_array_value=sequence[int64],
    double_array_value=sequence[float64],
    string_array_value=sequence[str],
)
Parameter = message("rcl_interfaces/Parameter", name=str, value=Value)
SetResult = message("rcl_interfaces/SetParametersResult", successful=bool, reason=str)
ListResult = message("rcl_interfaces/ListParametersResult", names=sequence[str], prefixes=sequence[str])
FloatRange = message("rcl_interfaces/FloatingPointRange", from_value=float64, to_value=float64, step=float64)
WholeRange = message("rcl_interfaces/IntegerRange", from_value=int64, to_value=int64, step=uint64)
Descriptor = message(
    "rcl_interfaces/ParameterDescriptor",
    name=str,
    type=uint8,
    description=str,
    additional_constraints=str,
    read_only=bool,
    dynamic_typing=bool,
    floating_point_range=sequence[FloatRange],
    integer_range=sequence[WholeRange],
)
GetParameters = service("rcl_interfaces/GetParameters", {"names": sequence[str]}, {"values": sequence[Value]})
SetParameters = service(
    "rcl_interfaces/SetParameters", {"parameters": sequence[Parameter]}, {"results": sequence[SetResult]}
)
ListParameters = service(
    "rcl_interfaces/ListParameters", {"prefixes": sequence[str], "depth": uint64}, {"result": ListResult}
)
DescribeParameters = service(
    "rcl_interfaces/DescribeParameters", {"names": sequence[str]}, {"descriptors": sequence[Descriptor]}
)
GetParameterTypes = service(
    "rcl_interfaces/GetParameterTypes", {"names": sequence[str]}, {"types": sequence[uint8]}
)

State = message("lifecycle_msgs/State", id=uint8, label=str)
Transition = message("lifecycle_msgs/Transition", id=uint8, label=str)
Description = message(
    "lifecycle_msgs/TransitionDescription", transition=Transition, start_state=State, goal_state=State
)
GetState = service("lifecycle_msgs/GetState", {}, {"current_state": State})
ChangeState = service("lifecycle_msgs/ChangeState", {"transition": Transition}, {"success": bool})
GetTransitions = service(
    "lifecycle_msgs/GetAvailableTransitions", {}, {"available_transitions": sequence[Description]}
)

Uuid = message("unique_identifier_msgs/UUID", uuid=array[uint8, 16])
GoalInfo = message("action_msgs/GoalInfo", goal_id=Uuid, stamp=Time)
GoalStatus = message("action_msgs/GoalStatus", goal_info=GoalInfo, status=int8)
StatusArray = message("action_msgs/GoalStatusArray", status_list=sequence[GoalStatus])
SendGoal = service(
    "example_interfaces/Fibonacci_SendGoal",
    {"goal_id": Uuid, "order": int32},
    {"accepted": bool, "stamp": Time},
    kind="action",
)
GetResult = service(
    "example_interfaces/Fibonacci_GetResult",
    {"goal_id": Uuid},
    {"status": int8, "sequence": sequence[int32]},
    kind="action",
)
CancelGoal = service(
    "action_msgs/CancelGoal", {"goal_info": GoalInfo}, {"return_code": int8, "goals_canceling": sequence[GoalInfo]}
)
Feedback = struct(
    "example_interfaces::action::dds_::Fibonacci_FeedbackMessage_", goal_id=Uuid, sequence=sequence[int32]
)


participant = DomainParticipant(DOMAIN)
readers, writers, servers = [], [], []


def writer(name, kind, of=qos()):
    end = DataWriter(participant, Topic(participant, name, kind, qos=of), qos=of)
    writers.append(end)
    return end


def reader(name, kind, of=qos()):
    end = DataReader(participant, Topic(participant, name, kind, qos=of), qos=of)
    readers.append(end)
    return end


def serve(name, kinds, answer):
    """Answers a service: `answer` makes the fields of the answer."""
    asks = reader(f"rq{name}Request", kinds[0])
    tells = writer(f"rr{name}Reply", kinds[1])

    def look():
        # What is no data tells that a caller went.
        for asked in (one for one in asks.take(10) if one.sample_info.valid_data):
            # The reply's reader may be known a little later than the question.
            for _ in range(200):
                if tells.get_matched_subscriptions():
                    break
                time.sleep(0.005)
            tells.write(kinds[1](asked.caller, asked.number, *answer(asked)))

    servers.append(look)


def value(of):
    kinds = {bool: 1, int: 2, float: 3, str: 4}
    kind = kinds.get(type(of), 0)
    of = {kind: of}
    return Value(
        kind, of.get(1, False), of.get(2, 0), of.get(3, 0.0), of.get(4, ""), [], [], [], [], []
    )


def plain(of):
    return [None, of.bool_value, of.integer_value, of.double_value, of.string_value][of.type]


parameters = {"use_sim_time": False, "speed": 0.5, "wheels": 4, "frame": "base_link"}


def set_one(asked):
    if asked.name not in parameters:
        return SetResult(False, f"{asked.name} is not declared")
    if asked.name == "wheels":
        return SetResult(False, "wheels are where they are")
    parameters[asked.name] = plain(asked.value)
    return SetResult(True, "")


full = f"/{NODE}"
serve(f"{full}/get_parameters", GetParameters, lambda asked: [[value(parameters.get(name)) for name in asked.names]])
serve(f"{full}/set_parameters", SetParameters, lambda asked: [[set_one(one) for one in asked.parameters]])
serve(f"{full}/list_parameters", ListParameters, lambda asked: [ListResult(sorted(parameters), [])])
serve(
    f"{full}/describe_parameters",
    DescribeParameters,
    lambda asked: [
        [
            Descriptor(name, value(parameters.get(name)).type, f"of {name}", "", False, False, [], [])
            for name in asked.names
        ]
    ],
)
serve(
    f"{full}/get_parameter_types",
    GetParameterTypes,
    lambda asked: [[value(parameters.get(name)).type for name in asked.names]],
)

serve("/trigger", Trigger, lambda asked: [True, f"from {NODE}"])

UNCONFIGURED, INACTIVE, ACTIVE = State(1, "unconfigured"), State(2, "inactive"), State(3, "active")
LIFE = [
    Description(Transition(1, "configure"), UNCONFIGURED, INACTIVE),
    Description(Transition(3, "activate"), INACTIVE, ACTIVE),
    Description(Transition(4, "deactivate"), ACTIVE, INACTIVE),
    Description(Transition(2, "cleanup"), INACTIVE, UNCONFIGURED),
]
now = [UNCONFIGURED]


def possible():
    return [one for one in LIFE if one.start_state.id == now[0].id]


def change(asked):
    for one in possible():
        if asked.transition.id == one.transition.id:
            now[0] = one.goal_state
            return [True]
    return [False]


serve(f"{full}/get_state", GetState, lambda asked: [now[0]])
serve(f"{full}/change_state", ChangeState, change)
serve(f"{full}/get_available_transitions", GetTransitions, lambda asked: [possible()])
serve(f"{full}/get_transition_graph", GetTransitions, lambda asked: [LIFE])

feedback = writer("rt/fibonacci/_action/feedback", Feedback)
status = writer("rt/fibonacci/_action/status", StatusArray, qos(latched=True, depth=1))
goals = {}


def begin(asked):
    numbers = [0, 1]
    while len(numbers) <= asked.order:
        numbers.append(numbers[-1] + numbers[-2])
    goals[bytes(asked.goal_id.uuid)] = numbers
    return [asked.order < 40, Time(7, 8)]


def result(asked):
    numbers = goals.get(bytes(asked.goal_id.uuid))
    feedback.write(Feedback(asked.goal_id, numbers[:3]))
    status.write(StatusArray([GoalStatus(GoalInfo(asked.goal_id, Time(7, 8)), 4)]))
    return [4, numbers]


serve("/fibonacci/_action/send_goal", SendGoal, begin)
serve("/fibonacci/_action/get_result", GetResult, result)
serve("/fibonacci/_action/cancel_goal", CancelGoal, lambda asked: [0, []])

talker = writer("rt/chatter", Text)
slow = writer("rt/slow", Text)
heard = reader("rt/commands", Text)
driven = reader("rt/cmd_vel", Twist)

told = writer("ros_discovery_info", Entities, qos(latched=True, depth=1))


def gid(end):
    return Gid(list(end.guid.bytes))


mine = NodeEntities("/", NODE, [gid(end) for end in readers], [gid(end) for end in writers if end is not told])
told.write(Entities(gid(participant), [mine]))
print("ready", flush=True)

ends = threading.Event()
threading.Thread(target=lambda: (sys.stdin.read(), ends.set()), daemon=True).start()
count, due = 0, time.monotonic()
while not ends.is_set():
    for look in servers:
        look()
    for sample in (one for one in heard.take(10) if one.sample_info.valid_data):
        print("heard", sample.data, flush=True)
    for sample in (one for one in driven.take(10) if one.sample_info.valid_data):
        print(f"driven {sample.linear.x:.2f} {sample.angular.z:.2f}", flush=True)
    if time.monotonic() >= due:
        due += 0.05
        talker.write(Text(f"hello {count}"))
        if count % 5 == 0:
            slow.write(Text(f"slow {count}"))
        count += 1
    time.sleep(0.002)
