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


def normalize_to_list_of_entities(entities):
    from periplus_launch.objects import flat

    return list(flat(entities))


def visit_all_entities_and_collect_futures(entity, context):
    return []


class AsyncSafeSignalManager:
    """Signals are handled by the program that launches."""

    def __init__(self, loop=None):
        pass


def is_a(obj, entity_type):
    return isinstance(obj, entity_type)


def is_a_subclass(obj, entity_type):
    return isinstance(obj, type) and issubclass(obj, entity_type)


def isclassinstance(obj):
    return hasattr(obj, "__class__")


def is_instance_of(value, data_type, *, can_be_str=False):
    return isinstance(value, data_type)


def coerce_to_type(value, data_type=None, *, can_be_str=False):
    import yaml

    loaded = yaml.safe_load(value)
    return loaded if data_type is None or data_type is str else data_type(loaded)


def perform_typed_substitution(context, value, data_type=None):
    if isinstance(value, (list, tuple, Substitution)):
        value = perform_substitutions(context, normalize_to_list_of_substitutions(value))
    return coerce_to_type(value, data_type) if isinstance(value, str) else value


def normalize_typed_substitution(value, data_type=None):
    return value


def iterate_and_flatten(items):
    from periplus_launch.objects import flat

    yield from flat(items)
