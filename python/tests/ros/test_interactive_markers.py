"""Interactive markers: what a viewer gets, and what the program hears of it."""

import subprocess
import sys
from pathlib import Path

import pytest
from ros_programs import environment

ROS2 = """
import rclpy
from geometry_msgs.msg import Pose
from interactive_markers import InteractiveMarkerServer, MenuHandler
from visualization_msgs.msg import InteractiveMarker, InteractiveMarkerFeedback, InteractiveMarkerUpdate
from visualization_msgs.srv import GetInteractiveMarkers

rclpy.init()
node = rclpy.create_node("markers")
server = InteractiveMarkerServer(node, "cubes")
heard, updates = [], []
node.create_subscription(InteractiveMarkerUpdate, "cubes/update", updates.append, 10)
user = node.create_publisher(InteractiveMarkerFeedback, "cubes/feedback", 10)
viewer = node.create_client(GetInteractiveMarkers, "cubes/get_interactive_markers")
def spin():
    for _ in range(40):
        rclpy.spin_once(node, timeout_sec=0.0)
marker = InteractiveMarker(name="red")
marker.pose.position.x = 1.0
server.insert(marker, feedback_callback=lambda it: heard.append((it.client_id, it.event_type)))
menu = MenuHandler()
first = menu.insert("Go", callback=lambda it: heard.append("go"))
menu.setCheckState(first, MenuHandler.CHECKED)
menu.apply(server, "red")
server.applyChanges()
spin()
print(updates[-1].seq_num, [one.name for one in updates[-1].markers], updates[-1].markers[0].menu_entries[0].title)
moved = InteractiveMarkerFeedback(client_id="a", marker_name="red", event_type=InteractiveMarkerFeedback.POSE_UPDATE)
moved.pose.position.x = 2.0
user.publish(moved)
spin()
# Another viewer has to wait a second for the marker.
moved.client_id = "b"
user.publish(moved)
spin()
user.publish(InteractiveMarkerFeedback(
    client_id="a", marker_name="red", event_type=InteractiveMarkerFeedback.MENU_SELECT, menu_entry_id=first))
spin()
print(heard, server.get("red").pose.position.x)
server.applyChanges()
spin()
print(updates[-1].seq_num, [(one.name, one.pose.position.x) for one in updates[-1].poses])
answer = viewer.call_async(GetInteractiveMarkers.Request())
spin()
print(answer.result().sequence_number, answer.result().markers[0].pose.position.x)
# A program that answers a move with the marker itself.
server.setPose("red", Pose())
server.insert(marker)
server.applyChanges()
print(server.erase("red"), server.erase("blue"), server.setPose("blue", Pose()))
server.shutdown()
spin()
print(updates[-1].erases)
"""
ROS1 = """
import rospy
from interactive_markers.interactive_marker_server import *
from interactive_markers.menu_handler import MenuHandler
rospy.init_node("markers")
updates = []
rospy.Subscriber("cubes/update", InteractiveMarkerUpdate, updates.append)
server = InteractiveMarkerServer("cubes")
marker = InteractiveMarker()
marker.name = "red"
server.insert(marker, lambda it: None)
menu = MenuHandler()
menu.insert("Go")
menu.apply(server, "red")
server.applyChanges()
while not [one for one in updates if one.markers]:
    rospy.sleep(0.01)
shown = [one for one in updates if one.markers][0]
print(shown.seq_num, shown.markers[0].menu_entries[0].title, shown.server_id)
"""


@pytest.mark.parametrize(
    ("program", "lines"),
    [
        (ROS2, ["1 ['red'] [x] Go", "[('a', 1), 'go'] 2.0", "2 [('red', 2.0)]", "2 2.0", "True False False", "['red']"]),
        (ROS1, ["1 Go /markers"]),
    ],
)
def test_a_viewer_and_its_user(tmp_path: Path, program: str, lines: list[str]) -> None:
    (tmp_path / "markers.py").write_text(program)
    command = [sys.executable, "-m", "periplus.ros.run", "markers.py"]
    variables = environment(ROS_AUTOMATIC_DISCOVERY_RANGE="OFF", ROS_LOG_DIR=str(tmp_path))
    done = subprocess.run(command, cwd=tmp_path, env=variables, capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout.splitlines() == lines, done.stderr
