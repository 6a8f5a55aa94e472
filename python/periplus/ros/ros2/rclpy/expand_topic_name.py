"""Full names of topics and services."""

from rclpy._names import expand, namespace_problem, node_problem, topic_problem


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Full name of a topic or a service for a node, without remapping.

    Raises `ValueError` for an invalid name.
    """
    for what, name, problem in (
        ("topic name", topic_name, topic_problem(topic_name)),
        ("node name", node_name, node_problem(node_name)),
        ("node namespace", node_namespace, namespace_problem(node_namespace)),
    ):
        if problem is not None:
            raise ValueError(f"{what} '{name}' is invalid: {problem[0]}")
    try:
        return expand(topic_name, node_name, node_namespace)
    except ValueError as error:
        raise ValueError(f"topic name '{topic_name}' is invalid: {error}") from None
