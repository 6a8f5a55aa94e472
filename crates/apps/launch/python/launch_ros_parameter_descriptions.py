"""Parameters with a type, and files of them."""
import typing

from periplus_launch.objects import text


class ParameterValue:
    """A value with the type that is asked for."""

    def __init__(self, value, *, value_type=None):
        self.value, self.value_type = value, value_type

    def evaluate(self, context):
        from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

        value = normalize_to_list_of_substitutions(self.value)
        return perform_substitutions(context, value)

    def _given(self):
        return {"given": "text", "text": text(self.value), "of_type": _type_name(self.value_type)}


def _type_name(wanted):
    if wanted is None:
        return None
    inner = typing.get_args(wanted)
    if typing.get_origin(wanted) is list and inner:
        return f"list_of_{inner[0].__name__}"
    return wanted.__name__


class ParameterFile:
    """A file of parameters, with or without `$(...)` to resolve."""

    def __init__(self, param_file, *, allow_substs=False):
        self.param_file, self.allow_substs = param_file, allow_substs

    def evaluate(self, context):
        from pathlib import Path

        from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

        file = normalize_to_list_of_substitutions(self.param_file)
        return Path(perform_substitutions(context, file))


class Parameter:
    """One parameter by name."""

    def __init__(self, name, value, *, value_type=None):
        self.name, self.value = name, ParameterValue(value, value_type=value_type)


def described(parameters):
    """`parameters` of a node, as JSON."""
    if parameters is None:
        return []
    if isinstance(parameters, dict) or isinstance(parameters, (str, ParameterFile)):
        raise TypeError("`parameters` of a node is a list")
    return [_one(each) for each in parameters]


def _one(each):
    if isinstance(each, dict):
        return {"parameters": "values", "values": list(_values(each, None))}
    if isinstance(each, Parameter):
        return {"parameters": "values", "values": [[text(each.name), each.value._given()]]}
    resolve = False
    if isinstance(each, ParameterFile):
        each, resolve = each.param_file, each.allow_substs
    if isinstance(resolve, bool):
        resolve = {"given": "value", "value": resolve}
    else:
        resolve = {"given": "text", "text": text(resolve), "of_type": "bool"}
    return {"parameters": "file", "file": text(each), "with_substitutions": resolve}


def _values(values, group):
    for key, value in values.items():
        name = text(list(key) if isinstance(key, tuple) else key)
        if group is not None:
            name = group + ["."] + name
        if isinstance(value, dict):
            yield from _values(value, name)
        else:
            yield [name, given(value)]


def given(value):
    """The value of a parameter, as JSON."""
    from launch.substitution import Substitution

    if isinstance(value, ParameterValue):
        inner = value.value
        if value.value_type is None and not isinstance(inner, (Substitution, list, tuple, str)):
            return given(inner)
        if isinstance(inner, (bool, int, float)):
            inner = str(inner)
        return ParameterValue(inner, value_type=value.value_type)._given()
    if isinstance(value, (bool, int, float)):
        return {"given": "value", "value": value}
    if isinstance(value, (bytes, bytearray)):
        return {"given": "value", "value": list(value)}
    if isinstance(value, str):
        return {"given": "value", "value": value}
    if isinstance(value, Substitution) or hasattr(value, "__fspath__"):
        return {"given": "text", "text": text(value), "of_type": None}
    if isinstance(value, (list, tuple)):
        if any(isinstance(item, (list, tuple)) for item in value):
            # A list of texts, each in parts.
            return {"given": "texts", "texts": [text(item) for item in value]}
        if any(isinstance(item, Substitution) for item in value):
            # Parts of one text.
            return {"given": "text", "text": text(value), "of_type": None}
        return {"given": "value", "value": list(value)}
    if type(value).__module__ == "numpy":
        return given(value.tolist())
    raise TypeError(f"{value!r} is not a parameter value")
