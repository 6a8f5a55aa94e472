"""Check of the name of a node."""

from rclpy._names import node_problem
from rclpy.exceptions import InvalidNodeNameException


def validate_node_name(node_name: str) -> bool:
    """True for a valid name; raises `InvalidNodeNameException` for others."""
    problem = node_problem(node_name)
    if problem is not None:
        raise InvalidNodeNameException(node_name, *problem)
    return True
