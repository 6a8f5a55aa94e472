"""The base of event handlers."""
from periplus_launch import objects


class EventHandler:
    """Event handler with a Python matcher."""

    def __init__(self, *, matcher=None, entities=None, handle_once=False):
        self.matcher, self.entities = matcher, entities
        self.handle_once = handle_once
        self._written = objects.written()

    def _described(self):
        return {"do": "left", "what": "an event handler with a matcher of the file's own"}


class BaseEventHandler(EventHandler):
    pass


class _On(EventHandler):
    """A handler of one kind of event."""

    def __init__(self, event, reactions, of=None, **details):
        super().__init__()
        self._event = {"event": event, **details}
        self._of, self._reactions = of, reactions

    def _described(self):
        event = dict(self._event)
        if event["event"] != "shutdown":
            event["of"] = _number(self._of)
        return {"do": "when", "event": event, "actions": _actions(self._reactions, self._class())}

    def _class(self):
        """The class of event that a function of the launch file gets."""
        from launch import events

        return {
            "started": events.process.ProcessStarted,
            "shutdown": events.Shutdown,
        }.get(self._event["event"], events.process.ProcessExited)


def _number(action):
    """The number of the action that a handler is about; none for any."""
    from launch.action import Action

    if action is None:
        return None
    action = getattr(action, "action", action)  # a matcher
    return objects.keep(action) if isinstance(action, Action) else None


class _Reaction:
    """A function of event and context."""

    def __init__(self, function, event):
        self.function, self.event = function, event

    def __call__(self, context):
        import inspect

        try:
            takes = len(inspect.signature(self.function).parameters)
        except (TypeError, ValueError):
            takes = 2
        return self.function(*(self.event(), context)[:max(takes, 1)])


def _actions(reactions, event=None):
    from launch.events.process import ProcessExited

    if callable(reactions):
        reaction = _Reaction(reactions, event or ProcessExited)
        return [{"do": "call", "function": objects.keep(reaction)}]
    return [objects.described(action) for action in objects.flat(reactions)]
