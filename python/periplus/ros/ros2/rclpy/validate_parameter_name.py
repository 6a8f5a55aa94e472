"""Check of the name of a parameter."""

from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """True for a valid name; raises `InvalidParameterException` for an empty one."""
    if not name:
        raise InvalidParameterException(name)
    return True
