"""Substitutions."""
from launch.substitution import Substitution, perform
from periplus_launch import objects
from periplus_launch.objects import text


class SubstitutionFailure(Exception):
    """A substitution without a result."""


class _Of(Substitution):
    """One that the program evaluates."""

    def __init__(self, sub, **details):
        super().__init__()
        self._details = {"sub": sub, **details}

    def perform(self, context):
        return perform(self._details, context)

    def _described(self):
        if objects.is_own(type(self).perform.__code__.co_filename):
            return super()._described()
        return self._details


class TextSubstitution(Substitution):
    def __init__(self, *, text):
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution takes a str, not {type(text).__name__}")
        self.text = text

    def _described(self):
        return self.text

    def perform(self, context):
        return self.text


class LaunchConfiguration(_Of):
    def __init__(self, variable_name, *, default=None):
        super().__init__("configuration", name=text(variable_name), default=_default(default))
        self.variable_name = normalized(variable_name)


def normalized(value):
    """Substitutions, as the attributes of these objects hold them."""
    from launch.utilities import normalize_to_list_of_substitutions

    return [] if value is None else normalize_to_list_of_substitutions(value)


def _default(value):
    if value is None:
        return None
    if isinstance(value, (list, tuple)):
        return [part for each in value for part in _default(each)]
    return text(value if isinstance(value, Substitution) else str(value))


class EnvironmentVariable(_Of):
    def __init__(self, name, *, default_value=None):
        super().__init__("environment", name=text(name), default=_default(default_value))
        self.name, self.default_value = normalized(name), default_value


class Command(_Of):
    def __init__(self, command, *, on_stderr="fail"):
        super().__init__("command", command=text(command), on_stderr=text(on_stderr))
        self.command = normalized(command)


class FindExecutable(_Of):
    def __init__(self, *, name):
        super().__init__("executable", name=text(name))


class PathJoinSubstitution(_Of):
    def __init__(self, substitutions):
        super().__init__("path", parts=[text(part) for part in substitutions])
        self.substitutions = list(substitutions)

    def __truediv__(self, other):
        return PathJoinSubstitution([*self.substitutions, other])


class PathSubstitution(PathJoinSubstitution):
    """A path that is extended by `/`."""

    def __init__(self, path):
        super().__init__([path])


class StringJoinSubstitution(_Of):
    def __init__(self, substitutions, delimiter=""):
        super().__init__(
            "join", parts=[text(part) for part in substitutions], separator=text(delimiter)
        )


class PythonExpression(_Of):
    def __init__(self, expression, python_modules=("math",)):
        super().__init__("expression", expression=text(expression))
        self.expression = normalized(expression)
        self.python_modules = python_modules


class AnonName(_Of):
    def __init__(self, name):
        super().__init__("anonymous", name=text(name))


AnonymousName = AnonName


class EqualsSubstitution(_Of):
    def __init__(self, left, right):
        super().__init__("equals", a=_word(left), b=_word(right))


class NotEqualsSubstitution(_Of):
    def __init__(self, left, right):
        super().__init__("not_equals", a=_word(left), b=_word(right))


def _word(value):
    return text("" if value is None else str(value) if isinstance(value, bool) else value)


class AndSubstitution(_Of):
    def __init__(self, left, right):
        super().__init__("all", of=[_word(left), _word(right)])


class OrSubstitution(_Of):
    def __init__(self, left, right):
        super().__init__("any", of=[_word(left), _word(right)])


class AllSubstitution(_Of):
    def __init__(self, *args):
        super().__init__("all", of=[_word(arg) for arg in args])


class AnySubstitution(_Of):
    def __init__(self, *args):
        super().__init__("any", of=[_word(arg) for arg in args])


class NotSubstitution(_Of):
    def __init__(self, value):
        super().__init__("not", of=_word(value))


class IfElseSubstitution(_Of):
    def __init__(self, condition, if_value="", else_value=""):
        super().__init__(
            "if_else", condition=_word(condition), yes=_word(if_value), no=_word(else_value)
        )


class FileContent(_Of):
    def __init__(self, path):
        super().__init__("content", file=text(path))


class ThisLaunchFile(_Of):
    def __init__(self):
        super().__init__("this_file")


class ThisLaunchFileDir(_Of):
    def __init__(self):
        super().__init__("this_folder")


class LaunchLogDir(_Of):
    def __init__(self):
        super().__init__("log_folder")


class LocalSubstitution(Substitution):
    """A local of an event: nothing that is known before the event."""

    def __init__(self, expression, description=None):
        self.expression = expression

    def perform(self, context):
        value = context.locals
        for name in self.expression.split("."):
            value = getattr(value, name, "")
        return str(value)


class ForEachVar(Substitution):
    def __init__(self, name, default_value=None):
        self.name, self.default_value = name, default_value

    def perform(self, context):
        return str(context.get_locals_as_dict().get(self.name, self.default_value))


class ForLoopIndex(ForEachVar):
    """The number of a `ForLoop`'s pass."""
