"""The server of PyPI's foxglove-sdk, with one topic and one service, until stdin ends."""

import sys
import threading

import foxglove
from foxglove import Channel, Schema
from foxglove.websocket import Capability, MessageSchema, Service, ServiceSchema

request = MessageSchema(
    encoding="cdr",
    schema=Schema(name="std_srvs/srv/SetBool_Request", encoding="ros2msg", data=b"bool data"),
)
schema = ServiceSchema(name="std_srvs/srv/SetBool", request=request, response=request)
server = foxglove.start_server(
    name="peer",
    host="127.0.0.1",
    port=0,
    capabilities=[Capability.Services, Capability.Time],
    supported_encodings=["cdr"],
    services=[Service(name="/lamp", schema=schema, handler=lambda request: request.payload)],
)
words = Channel(
    "/words",
    message_encoding="cdr",
    schema=Schema(name="std_msgs/msg/String", encoding="ros2msg", data=b"string data"),
)
print(server.port, flush=True)
ended = threading.Event()


def publish() -> None:
    while not ended.wait(0.02):
        words.log(bytes([0, 1, 0, 0, 4, 0, 0, 0, 121, 101, 115, 0]), log_time=1_000_000_007)


thread = threading.Thread(target=publish)
thread.start()
sys.stdin.read()
ended.set()
thread.join()
server.stop()
