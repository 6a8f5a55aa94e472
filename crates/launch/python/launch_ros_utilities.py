"""Helpers that launch files import."""
from launch_ros.parameter_descriptions import described as normalize_parameters  # noqa: F401


def to_parameters_list(context, node_name, namespace, evaluated_parameters):
    return list(evaluated_parameters)
