"""Check of a namespace."""

from rclpy._names import namespace_problem
from rclpy.exceptions import InvalidNamespaceException


def validate_namespace(namespace: str) -> bool:
    """True for a valid absolute namespace; raises `InvalidNamespaceException` for others."""
    problem = namespace_problem(namespace)
    if problem is not None:
        raise InvalidNamespaceException(namespace, *problem)
    return True
