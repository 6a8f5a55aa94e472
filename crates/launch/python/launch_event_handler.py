"""The base of event handlers."""
from periplus_launch import objects


class EventHandler:
    """Does something when an event matches. Which events, is for Python alone to know."""

    def __init__(self, *, matcher=None, entities=None, handle_once=False):
        self.matcher, self.entities = matcher, entities
        self.handle_once = handle_once

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
        return {"do": "when", "event": event, "actions": _actions(self._reactions)}


def _number(action):
    """The number of the action that a handler is about; none for any."""
    from launch.action import Action

    if action is None:
        return None
    action = getattr(action, "action", action)  # a matcher
    return objects.keep(action) if isinstance(action, Action) else None


class _Reaction:
    """A function of event and context, called when the plan is made."""

    def __init__(self, function):
        self.function = function

    def __call__(self, context):
        from launch.events.process import ProcessExited

        return self.function(ProcessExited(), context)


def _actions(reactions):
    if callable(reactions):
        return [{"do": "call", "function": objects.keep(_Reaction(reactions))}]
    return [objects.described(action) for action in objects.flat(reactions)]
