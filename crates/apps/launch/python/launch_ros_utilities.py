"""Helpers that launch files import."""
from launch_ros.parameter_descriptions import described as normalize_parameters  # noqa: F401


def to_parameters_list(context, node_name, namespace, evaluated_parameters):
    return list(evaluated_parameters)


def evaluate_parameters(context, parameters):
    return parameters


def normalize_remap_rule(rule):
    from launch.utilities import normalize_to_list_of_substitutions

    return tuple(normalize_to_list_of_substitutions(each) for each in rule)


def normalize_remap_rules(rules):
    return [normalize_remap_rule(rule) for rule in rules]


def is_namespace_absolute(namespace):
    return namespace.startswith("/")


def is_root_namespace(namespace):
    return namespace == "/"


def make_namespace_absolute(namespace):
    return namespace if namespace.startswith("/") else "/" + namespace


def prefix_namespace(base, namespace):
    if not namespace:
        return base or None
    if namespace.startswith("/"):
        return namespace
    return f"{base or ''}/{namespace}"


def add_node_name(context, node_name):
    """Names are counted when the plan runs."""


def get_node_name_count(context, node_name):
    return 1
