"""Documentation of the public names: every one has a text, and its examples run."""

import doctest
import importlib.util
import inspect
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest

import periplus
import periplus.navigation
import periplus.scenarios
import periplus.sweeps

MODULES: list[ModuleType] = [periplus, periplus.navigation, periplus.scenarios, periplus.sweeps]
if importlib.util.find_spec("gymnasium") and importlib.util.find_spec("pettingzoo"):
    import periplus.gym

    MODULES.append(periplus.gym)


def public() -> Iterator[tuple[str, Any]]:
    for module in MODULES:
        for name in module.__all__:
            if not name.startswith("__"):
                yield f"{module.__name__}.{name}", getattr(module, name)


def members(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    yield name, value
    if inspect.isclass(value):
        for key, member in vars(value).items():
            is_documented = callable(member) or isinstance(member, property) or inspect.isdatadescriptor(member)
            if not key.startswith("_") and is_documented:
                yield f"{name}.{key}", member


NAMES = [pair for name, value in public() for pair in members(name, value)]


@pytest.mark.parametrize(("name", "value"), NAMES, ids=[name for name, _ in NAMES])
def test_every_public_name_has_a_text(name: str, value: Any) -> None:
    target = value.__func__ if isinstance(value, (staticmethod, classmethod)) else value
    text = inspect.getdoc(target)
    assert text, f"{name} has no docstring"


@pytest.mark.parametrize(("name", "value"), list(public()), ids=[name for name, _ in public()])
def test_every_class_and_function_has_an_example_that_runs(name: str, value: Any) -> None:
    finder = doctest.DocTestParser()
    count = 0
    for path, member in members(name, value):
        target = member.__func__ if isinstance(member, (staticmethod, classmethod)) else member
        text = inspect.getdoc(target) or ""
        case = finder.get_doctest(text, {}, path, None, 0)
        count += len(case.examples)
        if case.examples:
            runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
            runner.run(case)
            assert runner.failures == 0, f"an example of {path} fails, see above"
    is_plain = isinstance(value, type) and issubclass(value, BaseException)
    assert count or is_plain or name in WITHOUT_EXAMPLE, f"{name} has no example"


# Readings, which only a `Sensor` makes, and handles: the examples of their makers show them.
WITHOUT_EXAMPLE = {
    "periplus.Contact",
    "periplus.Image",
    "periplus.PointCloud",
    "periplus.Scan",
    "periplus.Subscription",
}
