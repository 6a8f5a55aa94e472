"""Helpers that launch files import."""
from launch.substitution import Substitution
from launch.substitutions import TextSubstitution


def normalize_to_list_of_substitutions(subs):
    if isinstance(subs, (str, Substitution)) or hasattr(subs, "__fspath__"):
        subs = [subs]
    return [sub if isinstance(sub, Substitution) else TextSubstitution(text=str(sub)) for sub in subs]


def perform_substitutions(context, subs):
    return "".join(sub if isinstance(sub, str) else sub.perform(context) for sub in subs)


def ensure_argument_type(argument, types, argument_name, caller=None):
    wanted = tuple(types) if isinstance(types, (list, tuple)) else types
    if not isinstance(argument, wanted):
        raise TypeError(f"'{argument_name}' of '{caller}' has the wrong type: {type(argument).__name__}")


def is_a(obj, entity_type):
    return isinstance(obj, entity_type)


def is_a_subclass(obj, entity_type):
    return isinstance(obj, type) and issubclass(obj, entity_type)


def iterate_and_flatten(items):
    from periplus_launch.objects import flat

    yield from flat(items)
