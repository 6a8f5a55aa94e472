"""Stands in for `launch`, while a launch file is evaluated."""
import contextlib

from periplus_launch import conversation, objects

_active = []


class LaunchDescriptionEntity:
    """Base of everything in a launch description."""


class LaunchContext:
    """What holds while a file is evaluated."""

    def __init__(self, *, argv=None, noninteractive=False):
        self.argv = list(argv or [])
        self.noninteractive = noninteractive
        self.launch_configurations = {}
        self.environment = {}
        self.locals = _Locals()
        self._file = ""

    @classmethod
    def _of(cls, snapshot):
        context = cls()
        context.launch_configurations = dict(snapshot.get("configurations", {}))
        context._changed = dict(snapshot.get("environment", {}))
        context._file = snapshot.get("file", "")
        if snapshot.get("namespace"):
            context.launch_configurations.setdefault("ros_namespace", snapshot["namespace"])
        import os

        context.environment = dict(os.environ)
        for name, value in context._changed.items():
            if value is None:
                context.environment.pop(name, None)
            else:
                context.environment[name] = value
        context._environment_before = dict(context.environment)
        context._namespace_before = context.launch_configurations.get("ros_namespace")
        return context

    def _snapshot(self):
        return {
            "configurations": {
                name: str(value)
                for name, value in self.launch_configurations.items()
                if name != "ros_namespace"
            },
            "environment": self._environment_changes(),
            "file": self._file,
        }

    def _environment_changes(self):
        changed = dict(getattr(self, "_changed", {}))
        before = getattr(self, "_environment_before", self.environment)
        for name in before.keys() | self.environment.keys():
            if before.get(name) != self.environment.get(name):
                changed[name] = self.environment.get(name)
        return changed

    def _changes(self):
        snapshot = self._snapshot()
        return {key: snapshot[key] for key in ("configurations", "environment")}

    @contextlib.contextmanager
    def _active(self):
        _active.append(self)
        try:
            yield self
        finally:
            _active.pop()

    def perform_substitution(self, substitution):
        return substitution.perform(self)

    def get_locals_as_dict(self):
        return dict(self.locals.__dict__)

    def extend_locals(self, extensions):
        self.locals.__dict__.update(extensions)

    def extend_globals(self, extensions):
        self.locals.__dict__.update(extensions)


class _Locals:
    """Values by name as attributes."""


def _context():
    return _active[-1] if _active else LaunchContext()


class LaunchDescription(LaunchDescriptionEntity):
    """Actions in order."""

    def __init__(self, initial_entities=None, *, deprecated_reason=None):
        self.entities = list(initial_entities or [])
        self.deprecated_reason = deprecated_reason

    def add_action(self, action):
        self.entities.append(action)

    def add_entity(self, entity):
        self.entities.append(entity)


class LaunchService:
    """Files that launch themselves when they are run as scripts are not run as scripts."""

    def __init__(self, *, argv=None, **_others):
        self.argv = argv

    def include_launch_description(self, description):
        pass

    def run(self, **_others):
        return 0


class LaunchDescriptionSource:
    """Where included actions come from."""

    def __init__(self, launch_description=None, location=None, method=None):
        self._location = location if location is not None else launch_description

    @property
    def location(self):
        return self._location


class LaunchIntrospector:
    """Shows descriptions as text."""

    def format_launch_description(self, description):
        return "\n".join(type(entity).__name__ for entity in description.entities)


from . import action, condition, substitution  # noqa: E402
from .action import Action  # noqa: E402,F401
from .condition import Condition  # noqa: E402,F401
from .substitution import Substitution  # noqa: E402,F401
from .some_types import *  # noqa: E402,F401,F403
from . import (  # noqa: E402,F401
    actions,
    conditions,
    event,
    event_handler,
    event_handlers,
    events,
    frontend,
    launch_description_sources,
    logging,
    some_types,
    substitutions,
    utilities,
)
from .event import Event  # noqa: E402,F401
from .event_handler import EventHandler  # noqa: E402,F401

launch_context = launch_description = None
