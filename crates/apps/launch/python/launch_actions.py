"""Actions."""
from launch.action import Action
from launch.events import Shutdown as ShutdownEvent
from periplus_launch import objects
from periplus_launch.objects import pairs, text


class DeclareLaunchArgument(Action):
    def __init__(self, name, *, default_value=None, description=None, choices=None, **others):
        super().__init__(condition=others.get("condition"))
        self.name, self.default_value = name, default_value
        self.description, self.choices = description, choices

    def _deed(self):
        return {
            "do": "declare",
            "name": self.name,
            "default": text(self.default_value),
            "description": text(self.description),
            "choices": [str(choice) for choice in self.choices or []],
        }


class SetLaunchConfiguration(Action):
    def __init__(self, name, value, **others):
        super().__init__(**others)
        self._name, self._value = name, value

    def _deed(self):
        return {"do": "configure", "name": text(self._name), "value": text(self._value)}


class UnsetLaunchConfiguration(Action):
    def __init__(self, name, **others):
        super().__init__(**others)
        self._name = name

    def _deed(self):
        return {"do": "forget", "name": text(self._name)}


class ResetLaunchConfigurations(Action):
    def __init__(self, launch_configurations=None, **others):
        super().__init__(**others)
        self._keep = launch_configurations

    def _deed(self):
        return {"do": "forget_all", "keep": pairs(self._keep)}


class PushLaunchConfigurations(Action):
    """Actions at the start of a group."""

    def _deed(self):
        return {"do": "group", "actions": [], "is_scoped": False}


class PopLaunchConfigurations(PushLaunchConfigurations):
    pass


PushEnvironment = PopEnvironment = PushLaunchConfigurations


class SetEnvironmentVariable(Action):
    def __init__(self, name, value, **others):
        super().__init__(**others)
        self._name, self._value = name, value

    def _deed(self):
        return {"do": "environment", "name": text(self._name), "value": text(self._value)}


class UnsetEnvironmentVariable(Action):
    def __init__(self, name, **others):
        super().__init__(**others)
        self._name = name

    def _deed(self):
        return {"do": "unset", "name": text(self._name)}


class AppendEnvironmentVariable(Action):
    def __init__(self, name, value, prepend=False, separator=":", **others):
        super().__init__(**others)
        self._name, self._value = name, value
        self._prepend, self._separator = prepend, separator

    def _deed(self):
        return {
            "do": "append",
            "name": text(self._name),
            "value": text(self._value),
            "separator": text(self._separator),
            "prepend": self._prepend in (True, "true", "True", "1"),
        }


class ResetEnvironment(Action):
    def _deed(self):
        return {"do": "reset_environment"}


class GroupAction(Action):
    def __init__(self, actions, *, scoped=True, forwarding=True, launch_configurations=None, **others):
        super().__init__(condition=others.get("condition"))
        # Entities may come one by one, and are looked at more than once.
        self._actions = list(objects.flat(actions))
        self._scoped, self._forwarding = scoped, forwarding
        self._configurations = launch_configurations

    def _deed(self):
        return {
            "do": "group",
            "actions": [objects.described(action) for action in self._actions],
            "is_scoped": bool(self._scoped),
            "is_forwarding": bool(self._forwarding),
            "configurations": pairs(self._configurations),
        }


    def get_sub_entities(self):
        return self._actions


class IncludeLaunchDescription(Action):
    def __init__(self, launch_description_source, *, launch_arguments=None, condition=None):
        super().__init__(condition=condition)
        self._source = launch_description_source
        if hasattr(launch_arguments, "items"):
            launch_arguments = launch_arguments.items()
        self._arguments = list(launch_arguments or [])

    @property
    def launch_description_source(self):
        return self._source

    @property
    def launch_arguments(self):
        return tuple(self._arguments)

    def _deed(self):
        from launch import LaunchDescription, LaunchDescriptionSource

        source = self._source
        if isinstance(source, LaunchDescriptionSource):
            source = source.location
        if isinstance(source, LaunchDescription):
            actions = [SetLaunchConfiguration(name, value) for name, value in self._arguments]
            actions += source.entities
            return GroupAction(actions, scoped=False)._deed()
        return {"do": "include", "file": text(source), "arguments": pairs(self._arguments)}


class OpaqueFunction(Action):
    def __init__(self, *, function, args=None, kwargs=None, condition=None):
        super().__init__(condition=condition)
        self._function, self._args, self._kwargs = function, args or (), kwargs or {}

    def execute(self, context):
        return self._function(context, *self._args, **self._kwargs)


class OpaqueCoroutine(Action):
    """Runs beside the launch: what it does is not known before."""

    def __init__(self, *, coroutine, args=None, kwargs=None, ignore_context=False, **others):
        super().__init__(condition=others.get("condition"))

    def _deed(self):
        return {"do": "left", "what": "a coroutine of the launch file's own"}


class ForEach(Action):
    """Does what a function gives for each entry of `name=value, ...; name=value, ...`."""

    def __init__(self, input_values, *, function, condition=None):
        super().__init__(condition=condition)
        self._values, self._function = input_values, function

    def _deed(self):
        return {"do": "for_each", "function": objects.keep(_Each(self))}


class _Each:
    def __init__(self, action):
        self.action = action

    def __call__(self, context):
        import inspect

        from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
        from periplus_launch import conversation

        values = normalize_to_list_of_substitutions(self.action._values)
        entries = perform_substitutions(context, values)
        function = self.action._function
        names = list(inspect.signature(function).parameters)
        made = []
        for entry in filter(None, (entry.strip() for entry in entries.split(";"))):
            given = conversation.ask("yaml", text="{" + entry.replace("=", ": ") + "}")
            missing = [name for name in given if name not in names]
            if missing:
                raise ValueError(f"ForEach: the function takes no `{missing[0]}`")
            made.extend(objects.flat(function(**given)))
        return made


class ForLoop(Action):
    """Does what a function gives for each whole number below a length."""

    def __init__(self, length, *, function, name=None, condition=None):
        super().__init__(condition=condition)
        self._length, self._function = length, function

    def _deed(self):
        return {"do": "for_each", "function": objects.keep(_Pass(self))}


class _Pass:
    def __init__(self, action):
        self.action = action

    def __call__(self, context):
        from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

        length = normalize_to_list_of_substitutions(self.action._length)
        made = []
        for number in range(int(perform_substitutions(context, length))):
            made.extend(objects.flat(self.action._function(number)))
        return made


class ExecuteLocal(Action):
    """Starts a program that is described apart."""

    def __init__(self, *, process_description, condition=None, **running):
        super().__init__(condition=condition)
        self.process_description = process_description
        self._running = running

    @property
    def cmd(self):
        return self.process_description.cmd

    @property
    def name(self):
        return self.process_description.name

    def _deed(self):
        of = self.process_description
        described = {
            key: getattr(of, key, None) for key in ("prefix", "cwd", "env", "additional_env")
        }
        return _process(of.cmd, of.name, {**self._running, **described})


class ExecuteProcess(ExecuteLocal):
    def __init__(self, *, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None,
                 **running):
        from launch.descriptions import Executable

        described = Executable(
            cmd=[cmd] if isinstance(cmd, str) else cmd, prefix=prefix, name=name, cwd=cwd,
            env=env, additional_env=additional_env,
        )
        super().__init__(process_description=described, **running)


def _process(command, name, running):
    shell = running.get("shell", False)
    return {
        "do": "process",
        "command": [text(word) for word in command],
        "shell": text(shell if not isinstance(shell, bool) else str(shell)),
        "name": text(name),
        "running": described_running(running),
    }


def described_running(running):
    """Process settings, from the keyword arguments of actions that start one."""
    respawn, delay = running.get("respawn", False), running.get("respawn_delay")
    only = running.get("env")
    exits = running.get("on_exit")
    from launch.event_handler import _actions

    return {
        "prefix": text(running.get("prefix")),
        "folder": text(running.get("cwd")),
        "only_environment": None if only is None else pairs(only),
        "environment": pairs(running.get("additional_env")),
        "output": _output(running.get("output")),
        "respawn": text(str(respawn) if isinstance(respawn, bool) else respawn),
        "respawn_delay": text(None if delay is None else delay),
        "on_exit": [] if exits is None else _actions(exits),
    }


def _output(output):
    if isinstance(output, dict):
        return text("both")
    return text(output)


class Shutdown(Action):
    def __init__(self, *, reason="reason not given", **others):
        others.pop("kwargs", None)
        super().__init__(condition=others.get("condition"))
        self._reason = reason

    def _deed(self):
        return {"do": "shutdown", "reason": text(self._reason)}


ShutdownAction = Shutdown


class EmitEvent(Action):
    def __init__(self, *, event, condition=None):
        super().__init__(condition=condition)
        self._event = event

    def _deed(self):
        from launch.event_handler import _number
        from launch_ros.events.lifecycle import ChangeState

        event = self._event
        if isinstance(event, ShutdownEvent):
            return {"do": "shutdown", "reason": text(event.reason)}
        if isinstance(event, ChangeState):
            return {
                "do": "transition",
                "target": _number(event.lifecycle_node_matcher),
                "transition": event.transition,
            }
        from launch.events.process import ShutdownProcess, SignalProcess

        if isinstance(event, (ShutdownProcess, SignalProcess)):
            return {"do": "left", "what": "the end of a process that an event asks for"}
        return {"do": "left", "what": f"the event {type(event).__name__}"}

    @property
    def event(self):
        return self._event


class LogInfo(Action):
    _level = "info"

    def __init__(self, *, msg, level=None, **others):
        super().__init__(condition=others.get("condition"))
        self._msg = msg
        self._given = level

    def _deed(self):
        return {"do": "log", "text": text(self._msg), "level": text(self._given or self._level)}

    @property
    def msg(self):
        return self._msg


class Log(LogInfo):
    """A message with its level."""

    def __init__(self, *, msg, level, **others):
        super().__init__(msg=msg, level=level, **others)


class LogDebug(LogInfo):
    _level = "debug"


class LogWarning(LogInfo):
    _level = "warning"


class LogError(LogInfo):
    _level = "error"


class TimerAction(Action):
    def __init__(self, *, period, actions, **others):
        super().__init__(condition=others.get("condition"))
        self._period, self._actions = period, list(objects.flat(actions))

    @property
    def period(self):
        return self._period

    @property
    def actions(self):
        return self._actions

    def _deed(self):
        return {
            "do": "timer",
            "seconds": text(self._period),
            "actions": [objects.described(action) for action in objects.flat(self._actions)],
        }


class RegisterEventHandler(Action):
    def __init__(self, event_handler, **others):
        super().__init__(**others)
        self._handler = event_handler

    @property
    def event_handler(self):
        return self._handler

    def _deed(self):
        return self._handler._described()


class UnregisterEventHandler(Action):
    def __init__(self, event_handler, **others):
        super().__init__(**others)

    def _deed(self):
        return {"do": "left", "what": "the end of an event handler"}


class SetROSLogDir(Action):
    def __init__(self, new_log_dir, **others):
        super().__init__(**others)
        self._folder = new_log_dir

    def _deed(self):
        return {"do": "environment", "name": text("ROS_LOG_DIR"), "value": text(self._folder)}
