"""Replacement of `launch`, while a launch file is evaluated."""
import contextlib
import os
import sys
from typing import Any

_active = []
# The environment that this process was given.
_machine = dict(os.environ)


def _set_environment(values):
    values = {name: value for name, value in values.items() if value is not None}
    for name in os.environ.keys() - values.keys():
        del os.environ[name]
    for name, value in values.items():
        if os.environ.get(name) != value:
            os.environ[name] = value


SomeSubstitutionsType = SomeEntitiesType = SomeActionsType = Any
SomeSubstitutionsType_types_tuple = SomeEntitiesType_types_tuple = (str, list, tuple)


class InvalidLaunchFileError(Exception):
    """A launch file that cannot be read."""


class LaunchDescriptionEntity:
    """Base of everything in a launch description."""

    def visit(self, context):
        return [self]

    def describe(self):
        return type(self).__name__

    def describe_sub_entities(self):
        return []

    def describe_conditional_sub_entities(self):
        return []

    def get_asyncio_future(self):
        return None


class LaunchContext:
    """State of the evaluation of a file."""

    def __init__(self, *, argv=None, noninteractive=False):
        self.argv = list(argv or [])
        self.noninteractive = noninteractive
        self.launch_configurations = {}
        # As in `launch`, the context's environment is that of the process.
        self.environment = os.environ
        self.locals = _Locals()
        self.is_shutdown = False
        self.asyncio_loop = None
        self._file = ""

    @classmethod
    def _of(cls, snapshot):
        context = cls()
        context.launch_configurations = dict(snapshot.get("configurations", {}))
        context._changed = dict(snapshot.get("environment", {}))
        context._defaults = dict(snapshot.get("defaults", {}))
        context._file = snapshot.get("file", "")
        context.argv = list(snapshot.get("argv", []))
        if snapshot.get("namespace"):
            context.launch_configurations.setdefault("ros_namespace", snapshot["namespace"])
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
        """Changes of the environment; null for unset variables."""
        if self not in _active:
            return getattr(self, "_changed", {})
        changed = {}
        for name in _machine.keys() | os.environ.keys():
            value = os.environ.get(name)
            if value != _machine.get(name) and value != self._defaults.get(name):
                changed[name] = value
        return changed

    def _changes(self):
        snapshot = self._snapshot()
        return {key: snapshot[key] for key in ("configurations", "environment")}

    @contextlib.contextmanager
    def _active(self):
        """Makes this the context of everything that asks for one, and its environment the process's."""
        before = dict(os.environ)
        argv = sys.argv
        _set_environment({**_machine, **self._defaults, **self._changed})
        sys.argv = ["ros2", "launch", self._file, *self.argv]
        _active.append(self)
        try:
            yield self
        finally:
            self._changed = self._environment_changes()
            _active.pop()
            sys.argv = argv
            _set_environment(before)

    def perform_substitution(self, substitution):
        return substitution.perform(self)

    def get_locals_as_dict(self):
        return dict(self.locals.__dict__)

    def extend_locals(self, extensions):
        self.locals.__dict__.update(extensions)

    def extend_globals(self, extensions):
        self.locals.__dict__.update(extensions)

    def get_launch_configuration(self, name):
        return self.launch_configurations[name]

    def emit_event_sync(self, event):
        """Events are emitted by the plan alone."""

    async def emit_event(self, event):
        pass

    def register_event_handler(self, event_handler, append=False):
        pass

    def unregister_event_handler(self, event_handler):
        pass


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

    def visit(self, context):
        return self.entities

    def get_launch_arguments(self, conditional_inclusion=False):
        return [each for each in self.entities if isinstance(each, actions.DeclareLaunchArgument)]


class LaunchService:
    """Files that launch themselves when they are run as scripts are not run as scripts."""

    def __init__(self, *, argv=None, **_others):
        self.argv = argv
        self.context = LaunchContext(argv=argv)

    def include_launch_description(self, description):
        pass

    def emit_event(self, event):
        pass

    def shutdown(self):
        pass

    def run(self, **_others):
        return 0


class LaunchDescriptionSource:
    """Sources of included actions."""

    def __init__(self, launch_description=None, location=None, method=None):
        self._location = location if location is not None else launch_description

    @property
    def location(self):
        return self._location

    def get_launch_description(self, context):
        """Actions that read the file."""
        return LaunchDescription([actions.IncludeLaunchDescription(self)])


class LaunchIntrospector:
    """Shows descriptions as text."""

    def format_launch_description(self, description):
        return "\n".join(type(entity).__name__ for entity in description.entities)


from . import action, condition, substitution  # noqa: E402
from .action import Action  # noqa: E402,F401
from .condition import Condition  # noqa: E402,F401
from .substitution import Substitution  # noqa: E402,F401
from . import (  # noqa: E402,F401
    actions,
    conditions,
    descriptions,
    event,
    event_handler,
    event_handlers,
    events,
    frontend,
    launch_description_sources,
    logging,
    substitutions,
    utilities,
)
from .event import Event  # noqa: E402,F401
from .event_handler import EventHandler  # noqa: E402,F401
