"""Check of the full name of a topic or a service."""

from rclpy._names import full_topic_problem
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """True for a valid full name; raises `InvalidTopicNameException` or `InvalidServiceNameException` for others."""
    problem = full_topic_problem(name)
    if problem is not None:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *problem)
    return True
