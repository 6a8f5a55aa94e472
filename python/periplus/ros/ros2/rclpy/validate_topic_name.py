"""Check of the name of a topic or a service."""

from rclpy._names import topic_problem
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException

TOPIC_SEPARATOR_STRING = "/"


def validate_topic_name(name: str, *, is_service: bool = False) -> bool:
    """True for a valid name, which may be relative; raises `InvalidTopicNameException` or `InvalidServiceNameException`."""
    problem = topic_problem(name)
    if problem is not None:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *problem)
    return True
